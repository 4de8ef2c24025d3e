// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "regolith/features/feature_set.h"

namespace regolith {

/// Of two descriptors of one kind: the inner product of floats; of bits the same with ±1 for them,
/// over their number. 1 for the same, about 0 for unrelated ones.
float DescriptorSimilarity(const Descriptors& first, size_t first_row, const Descriptors& second,
                           size_t second_row);

/// The similarity of binary descriptors that differ in so many bits.
float SimilarityOfHamming(int bits);

/// The descriptors as unit vectors of floats, one a column.
Eigen::MatrixXf UnitDescriptors(const Descriptors& descriptors);

}  // namespace regolith
