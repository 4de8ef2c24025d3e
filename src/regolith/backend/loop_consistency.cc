// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/loop_consistency.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace regolith {
namespace {

// Sets are grown from this many loops, those with the most partners first.
constexpr size_t kStarts = 12;

}  // namespace

LoopConsistency::LoopConsistency(const LoopConsistencyOptions& options) : options_(options) {
  options.Check();
}

UncertainPose LoopConsistency::Way(const OdometryChain& odometry, size_t from, size_t to) const {
  UncertainPose way = odometry.Between(from, to);
  way.covariance *= options_.odometry_inflation * options_.odometry_inflation;
  return way;
}

bool LoopConsistency::AgreesWithOdometry(const LoopMeasurement& loop,
                                         const OdometryChain& odometry) const {
  return SquaredDistance(loop.T_old_new, Way(odometry, loop.old_keyframe, loop.new_keyframe)) <=
         options_.max_squared_distance;
}

LoopConsistency::Agreement LoopConsistency::Compare(const LoopMeasurement& first,
                                                    const LoopMeasurement& second,
                                                    const OdometryChain& odometry) const {
  const UncertainPose new_way = Way(odometry, first.new_keyframe, second.new_keyframe);
  const UncertainPose old_way = Way(odometry, second.old_keyframe, first.old_keyframe);
  const UncertainPose around =
      Compose(Compose(first.T_old_new, new_way), Compose(Inverse(second.T_old_new), old_way));
  Agreement agreement;
  agreement.agrees = SquaredDistance(around, UncertainPose()) <= options_.max_squared_distance;
  const double sigma = std::sqrt(around.covariance.bottomRightCorner<3, 3>().trace());
  const bool is_another = new_way.T_a_b.translation.norm() >= options_.support_distance &&
                          old_way.T_a_b.translation.norm() >= options_.support_distance;
  agreement.confirms = agreement.agrees && is_another && sigma <= options_.support_sigma;
  return agreement;
}

void LoopConsistency::Add(const LoopMeasurement& loop, const OdometryChain& odometry) {
  std::vector<Agreement> row;
  for (size_t i = first_; i < loops_.size(); ++i) row.push_back(Compare(loops_[i], loop, odometry));
  loops_.push_back(loop);
  accepted_.push_back(0);
  agreements_.push_back(std::move(row));
  if (agreements_.size() > static_cast<size_t>(options_.max_loops)) {
    ++first_;
    agreements_.erase(agreements_.begin());
    for (std::vector<Agreement>& rest : agreements_) rest.erase(rest.begin());
  }
  Decide();
}

// The heuristic of Pattabiraman et al. 2015, which PCM uses too: grow a set greedily from each of
// the best connected loops.
std::vector<size_t> LoopConsistency::LargestSet() const {
  const size_t count = agreements_.size();
  const auto agree = [this](size_t a, size_t b) {
    return agreements_[std::max(a, b)][std::min(a, b)].agrees;
  };
  std::vector<size_t> degrees(count, 0);
  for (size_t i = 0; i < count; ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (!agree(i, j)) continue;
      ++degrees[i];
      ++degrees[j];
    }
  }
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return degrees[a] > degrees[b]; });
  std::vector<size_t> largest;
  for (size_t start = 0; start < std::min(count, kStarts); ++start) {
    std::vector<size_t> set = {order[start]};
    for (const size_t candidate : order) {
      if (candidate == order[start]) continue;
      if (std::all_of(set.begin(), set.end(),
                      [&](size_t member) { return agree(member, candidate); })) {
        set.push_back(candidate);
      }
    }
    if (set.size() > largest.size()) largest = std::move(set);
  }
  return largest;
}

void LoopConsistency::Decide() {
  const std::vector<size_t> set = LargestSet();
  std::fill(accepted_.begin() + static_cast<std::ptrdiff_t>(first_), accepted_.end(), uint8_t{0});
  for (const size_t member : set) {
    int support = 0;
    for (const size_t other : set) {
      if (other == member) continue;
      support += agreements_[std::max(member, other)][std::min(member, other)].confirms ? 1 : 0;
    }
    accepted_[first_ + member] = support >= options_.min_support ? 1 : 0;
  }
}

}  // namespace regolith
