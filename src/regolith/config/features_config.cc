// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/config/features_config.h"

#include "regolith/config/features_fields_internal.h"

namespace regolith {

FeatureOptions LoadFeatures(const YamlDocument& document) {
  FeatureOptions options;
  FieldReader reader(document);
  reader("features", options);
  reader.Finish();
  return options;
}

std::string WriteFeatures(const FeatureOptions& options) {
  FieldWriter writer;
  FeatureOptions copy = options;
  writer("features", copy);
  return writer.Text();
}

}  // namespace regolith
