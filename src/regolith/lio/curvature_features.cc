// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/lio/curvature_features.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "regolith/core/check.h"

namespace regolith {
namespace {

// Neighbours along the ring are this many columns apart at most; a wider gap ends a stretch.
constexpr int kWidestGap = 4;

/// One ring's points in order of azimuth, without the empty cells.
class RingFeatures {
 public:
  RingFeatures(const RingImage& image, int row, const CurvatureFeatureOptions& options)
      : options_(options), reach_(static_cast<size_t>(options.neighbours)) {
    for (int column = 0; column < image.columns; ++column) {
      const size_t cell = image.Cell(row, column);
      if (image.indices[cell] == RingImage::kEmpty) continue;
      columns_.push_back(column);
      ranges_.push_back(image.ranges[cell]);
      indices_.push_back(static_cast<uint32_t>(image.indices[cell]));
    }
    usable_.assign(indices_.size(), true);
    curvatures_.assign(indices_.size(), std::numeric_limits<float>::infinity());
  }

  void Extract(const PointLabels* labels, CurvatureFeatures* features) {
    if (indices_.size() <= 2 * reach_) return;
    RejectEnds();
    RejectHiddenAndGrazing();
    MeasureCurvatures();
    open_ = usable_;
    const size_t first = reach_;
    const size_t count = indices_.size() - 2 * reach_;
    const auto sectors = static_cast<size_t>(options_.sectors);
    for (size_t sector = 0; sector < sectors; ++sector) {
      SortByCurvature(first + sector * count / sectors, first + (sector + 1) * count / sectors);
      PickEdges(labels, features);
      PickPlanars(labels, features);
    }
  }

 private:
  void RejectFrom(size_t begin, size_t end) {
    std::fill(usable_.begin() + static_cast<ptrdiff_t>(begin),
              usable_.begin() + static_cast<ptrdiff_t>(std::min(end, usable_.size())), false);
  }

  bool AreNeighbours(size_t i) const { return columns_[i + 1] - columns_[i] <= kWidestGap; }

  /// Points whose neighbours reach beyond the ring's ends or across a gap.
  void RejectEnds() {
    RejectFrom(0, reach_);
    RejectFrom(usable_.size() - reach_, usable_.size());
    for (size_t i = 0; i + 1 < usable_.size(); ++i) {
      if (!AreNeighbours(i)) RejectFrom(i + 1 < reach_ ? 0 : i + 1 - reach_, i + 1 + reach_);
    }
  }

  /// Zhang & Singh 2014, figure 4: (a) surfaces nearly along the beam, (b) what a nearer thing
  /// hides in part.
  void RejectHiddenAndGrazing() {
    const auto share = static_cast<float>(options_.occlusion_share);
    const auto least = static_cast<float>(options_.occlusion_step);
    const auto grazing = static_cast<float>(options_.grazing_share);
    for (size_t i = 1; i + 1 < ranges_.size(); ++i) {
      const float before = ranges_[i - 1] - ranges_[i];
      const float after = ranges_[i + 1] - ranges_[i];
      const float limit = std::max(least, share * ranges_[i]);
      if (AreNeighbours(i) && after > limit) RejectFrom(i + 1, i + 1 + reach_);
      if (AreNeighbours(i - 1) && before > limit) RejectFrom(i < reach_ ? 0 : i - reach_, i);
      const float allowed = grazing * ranges_[i];
      if (std::abs(before) > allowed && std::abs(after) > allowed) usable_[i] = false;
    }
  }

  void MeasureCurvatures() {
    const auto count = static_cast<float>(2 * reach_);
    for (size_t i = reach_; i + reach_ < ranges_.size(); ++i) {
      if (!usable_[i]) continue;
      float sum = -(count + 1.0F) * ranges_[i];
      for (size_t j = i - reach_; j <= i + reach_; ++j) sum += ranges_[j];
      curvatures_[i] = std::abs(sum) / (count * ranges_[i]);
    }
  }

  void SortByCurvature(size_t begin, size_t end) {
    order_.clear();
    for (size_t i = begin; i < end; ++i) {
      if (usable_[i]) order_.push_back(i);
    }
    std::sort(order_.begin(), order_.end(), [this](size_t first, size_t second) {
      return curvatures_[first] != curvatures_[second] ? curvatures_[first] < curvatures_[second]
                                                       : first < second;
    });
  }

  /// Keeps later picks away from this one.
  void Occupy(size_t place) {
    for (size_t i = place - reach_; i <= place + reach_; ++i) open_[i] = false;
  }

  void PickEdges(const PointLabels* labels, CurvatureFeatures* features) {
    int picked = 0;
    for (auto place = order_.rbegin(); place != order_.rend() && picked < options_.edges; ++place) {
      if (static_cast<double>(curvatures_[*place]) < options_.edge_curvature) break;
      if (!open_[*place]) continue;
      if (labels && (*labels)[indices_[*place]] != PointLabel::kCluster) continue;
      features->edges.push_back(indices_[*place]);
      if (++picked <= options_.sharp_edges) features->sharp_edges.push_back(indices_[*place]);
      Occupy(*place);
    }
  }

  void PickPlanars(const PointLabels* labels, CurvatureFeatures* features) {
    int picked = 0;
    for (const size_t place : order_) {
      if (static_cast<double>(curvatures_[place]) > options_.planar_curvature) break;
      const PointLabel label = labels ? (*labels)[indices_[place]] : PointLabel::kGround;
      if (label == PointLabel::kNone) continue;
      features->planars.push_back(indices_[place]);
      if (label != PointLabel::kGround || picked >= options_.flat_planars) continue;
      if (!open_[place]) continue;
      ++picked;
      features->flat_planars.push_back(indices_[place]);
      Occupy(place);
    }
  }

  const CurvatureFeatureOptions& options_;
  size_t reach_;
  std::vector<int> columns_;
  std::vector<float> ranges_;  ///< m
  std::vector<uint32_t> indices_;
  std::vector<bool> usable_;
  std::vector<bool> open_;  ///< usable, and away from what has been picked
  std::vector<float> curvatures_;
  std::vector<size_t> order_;
};

}  // namespace

void CurvatureFeatureOptions::Check() const {
  REGOLITH_CHECK(neighbours > 0, "neighbours=", neighbours);
  REGOLITH_CHECK(sectors > 0, "sectors=", sectors);
  REGOLITH_CHECK(sharp_edges >= 0 && sharp_edges <= edges, "sharp_edges=", sharp_edges);
  REGOLITH_CHECK(flat_planars >= 0, "flat_planars=", flat_planars);
  REGOLITH_CHECK(planar_curvature > 0.0 && planar_curvature <= edge_curvature,
                 "planar_curvature=", planar_curvature);
  REGOLITH_CHECK(occlusion_step > 0.0, "occlusion_step=", occlusion_step);
  REGOLITH_CHECK(occlusion_share > 0.0, "occlusion_share=", occlusion_share);
  REGOLITH_CHECK(grazing_share > 0.0, "grazing_share=", grazing_share);
}

CurvatureFeatures ExtractCurvatureFeatures(const RingImage& image, const PointLabels* labels,
                                           const CurvatureFeatureOptions& options) {
  CurvatureFeatures features;
  for (int row = 0; row < image.rows; ++row) {
    RingFeatures(image, row, options).Extract(labels, &features);
  }
  return features;
}

CurvatureFeatures ExtractCurvatureFeatures(const LidarScan& scan, int rings,
                                           const CurvatureFeatureOptions& options) {
  return ExtractCurvatureFeatures(MakeRingImage(scan, rings), nullptr, options);
}

}  // namespace regolith
