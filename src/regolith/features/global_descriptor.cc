// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/global_descriptor.h"

#include <cmath>
#include <utility>

#include "regolith/core/check.h"

namespace regolith {
namespace {

// Shorter sums are rounding errors of descriptors that are their centroid.
constexpr float kMinNorm = 1e-5F;

}  // namespace

GlobalDescriptor::GlobalDescriptor(Eigen::MatrixXf centroids) : centroids_(std::move(centroids)) {
  REGOLITH_CHECK(centroids_.size() > 0, centroids_.rows(), " x ", centroids_.cols());
  for (Eigen::Index i = 0; i < centroids_.cols(); ++i) {
    const float length = centroids_.col(i).norm();
    REGOLITH_CHECK(std::abs(length - 1.0F) < 1e-3F, "centroid ", i, " is of length ", length);
  }
}

Eigen::VectorXf GlobalDescriptor::Describe(const Descriptors& descriptors) const {
  Eigen::VectorXf result = Eigen::VectorXf::Zero(centroids_.size());
  const auto count = static_cast<Eigen::Index>(descriptors.size());
  if (count == 0) return result;
  REGOLITH_CHECK(
      descriptors.type == DescriptorType::kFloat && descriptors.dimension == centroids_.rows(),
      "dimension=", descriptors.dimension, ", of the vocabulary ", centroids_.rows());
  const Eigen::Map<const Eigen::MatrixXf> columns(descriptors.values.data(), centroids_.rows(),
                                                  count);
  // Of unit vectors the nearest is the one with the largest inner product.
  const Eigen::MatrixXf similarities = centroids_.transpose() * columns;
  Eigen::Map<Eigen::MatrixXf> cells(result.data(), centroids_.rows(), centroids_.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    Eigen::Index nearest = 0;
    similarities.col(i).maxCoeff(&nearest);
    cells.col(nearest) += columns.col(i) - similarities(nearest, i) * centroids_.col(nearest);
  }
  for (Eigen::Index cell = 0; cell < cells.cols(); ++cell) {
    const float norm = cells.col(cell).norm();
    if (norm > kMinNorm) {
      cells.col(cell) /= norm;
    } else {
      cells.col(cell).setZero();
    }
  }
  const float norm = result.norm();
  if (norm > 0.0F) result /= norm;
  return result;
}

float Similarity(const Eigen::VectorXf& first, const Eigen::VectorXf& second) {
  REGOLITH_CHECK(first.size() == second.size(), first.size(), " and ", second.size());
  return first.dot(second);
}

}  // namespace regolith
