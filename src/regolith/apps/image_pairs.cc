// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/apps/image_pairs.h"

#include <cstdio>
#include <filesystem>

#include "regolith/apps/progress.h"
#include "regolith/core/check.h"
#include "regolith/core/stop.h"
#include "regolith/io/atomic_file.h"
#include "regolith/io/image_file.h"
#include "regolith/io/raster.h"

namespace regolith {
namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;

std::string PairName(int index) {
  char name[16];
  std::snprintf(name, sizeof(name), "%06d", index);
  return name;
}

}  // namespace

bool WritePairs(Simulator& simulator, int count, bool quiet, const std::string& folder) {
  std::filesystem::create_directories(folder);
  Progress progress("pairs", count, quiet, "pairs");
  std::string index = "id,baseline_m,rotation_deg,same_sun\n";
  int written = 0;
  for (; written < count && !StopRequested(); ++written) {
    const ImagePair pair = simulator.Pair(written, count);
    const std::string name = PairName(written);
    WritePng(folder + "/" + name + "_1.png", pair.first);
    WritePng(folder + "/" + name + "_2.png", pair.second);
    WriteTwoBands(folder + "/" + name + "_flow.tif", pair.first.width, pair.flow_x, pair.flow_y);
    index += Concatenate(name, ",", pair.baseline, ",", pair.rotation * kDegreesPerRadian, ",",
                         pair.same_sun ? 1 : 0, "\n");
    progress.Update(written + 1);
  }
  progress.Finish();
  const bool complete = written == count;
  const std::string path = folder + "/index.csv";
  WriteFile(complete ? path : PartialPath(path), index);
  return complete;
}

}  // namespace regolith
