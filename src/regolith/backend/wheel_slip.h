// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "regolith/backend/uncertain_pose.h"
#include "regolith/imu/wheel_preintegration.h"

namespace regolith {

struct WheelSlipOptions {
  double initial_sigma = 0.1;   ///< 1 σ of the slip before any was seen
  double least_sigma = 0.01;    ///< and at least ever
  double memory = 15.0;         ///< m of the way after which what was seen weighs a third
  double min_way = 0.3;         ///< m; shorter pieces say nothing
  double outlier_sigmas = 3.0;  ///< a piece farther off counts as if it were this far

  void Check() const;
};

/// How much further the wheels turn than the rover moves, and how that varies: mean and variance
/// over the last metres, from pieces of the way whose true length the graph knows. Slopes change it
/// for as long as they last, so the variance counts for the whole of a piece, not for its root.
class WheelSlip {
 public:
  explicit WheelSlip(const WheelSlipOptions& options);

  /// `wheel_way`, `true_way`: m of one piece.
  void Observe(double wheel_way, double true_way);

  double slip() const { return slip_; }  ///< wheel way over true way, less 1
  double sigma() const;                  ///< of one piece's slip
  /// The motion of the body that the wheels' stands for: shortened by the slip, and as unsure along
  /// the track as slip varies. For an edge with a robust loss.
  UncertainPose Correct(const WheelDelta& delta, const SE3& T_body_base) const;

 private:
  WheelSlipOptions options_;
  double slip_ = 0.0;
  double variance_;
};

}  // namespace regolith
