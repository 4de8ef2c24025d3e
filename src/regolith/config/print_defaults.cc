// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Prints the defaults of all options as YAML, one document each, for tools/make_parameters.py.
#include <cstdio>

#include "regolith/config/pipeline_config.h"
#include "regolith/config/ros_node_config.h"
#include "regolith/config/scenario_config.h"

int main() {
  const regolith::PipelineOptions pipeline;
  const regolith::ScenarioOptions scenario;
  std::printf("---\n%s\n---\n%s\n---\n%s\n---\n%s\n", regolith::WriteSlamNode({}).c_str(),
              regolith::WriteSimNode({}).c_str(), regolith::WritePipeline(pipeline).c_str(),
              regolith::WriteScenario(scenario).c_str());
  return 0;
}
