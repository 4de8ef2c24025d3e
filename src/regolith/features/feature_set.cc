// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/features/feature_set.h"

#include "regolith/core/check.h"

namespace regolith {

size_t Descriptors::size() const {
  switch (type) {
    case DescriptorType::kFloat:
      return dimension == 0 ? 0 : values.size() / static_cast<size_t>(dimension);
    case DescriptorType::kBinary:
      return bits.size() / kBinaryBytes;
    case DescriptorType::kNone:
      break;
  }
  return 0;
}

void Descriptors::ResetLike(const Descriptors& other) {
  type = other.type;
  dimension = other.dimension;
  values.clear();
  bits.clear();
}

void Descriptors::Append(const Descriptors& other, size_t index) {
  REGOLITH_CHECK(type == other.type && dimension == other.dimension, "dimension=", dimension,
                 " and ", other.dimension);
  if (type == DescriptorType::kFloat) {
    values.insert(values.end(), other.Row(index), other.Row(index) + dimension);
  } else if (type == DescriptorType::kBinary) {
    bits.insert(bits.end(), other.Bits(index), other.Bits(index) + kBinaryBytes);
  }
}

}  // namespace regolith
