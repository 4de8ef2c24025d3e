// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "regolith/features/descriptor_matcher.h"

namespace regolith {

/// The product of two sets of fixed-point descriptors, of which only the nearest and second
/// nearest of each row and each column are kept: the matrix itself is never written.

/// Values a row of `dimension` takes, with padding.
size_t FixedStride(int dimension);
/// Rows of the first set and of the second (columns of the product), with padding.
size_t PaddedRows(size_t rows);
size_t PaddedColumns(size_t columns);

/// Interleaves the padded rows of the second set by eight, in pairs of values, as the product
/// reads them.
void InterleavePanels(const std::vector<int16_t>& rows, size_t stride,
                      std::vector<int16_t>* panels);

/// Nearest of each row in `first_nearest` and of each column in `second_nearest`, which have the
/// sizes without padding. Ties go to the lower index. No sum of products may leave 32 bits.
void SweepNearest(const std::vector<int16_t>& first_rows, const std::vector<int16_t>& second_panels,
                  size_t stride, std::vector<int32_t>* lanes,
                  std::vector<DescriptorMatcher::Nearest>* first_nearest,
                  std::vector<DescriptorMatcher::Nearest>* second_nearest);

}  // namespace regolith
