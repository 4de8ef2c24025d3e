// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/backend/wheel_slip.h"

#include <algorithm>
#include <cmath>

#include "regolith/core/check.h"

namespace regolith {

void WheelSlipOptions::Check() const {
  REGOLITH_CHECK(least_sigma > 0.0 && least_sigma <= initial_sigma, "least_sigma=", least_sigma);
  REGOLITH_CHECK(memory > 0.0, "memory=", memory);
  REGOLITH_CHECK(min_way > 0.0, "min_way=", min_way);
  REGOLITH_CHECK(outlier_sigmas > 0.0, "outlier_sigmas=", outlier_sigmas);
}

WheelSlip::WheelSlip(const WheelSlipOptions& options)
    : options_(options), variance_(options.initial_sigma * options.initial_sigma) {
  options.Check();
}

double WheelSlip::sigma() const { return std::max(std::sqrt(variance_), options_.least_sigma); }

void WheelSlip::Observe(double wheel_way, double true_way) {
  if (true_way < options_.min_way || wheel_way < options_.min_way) return;
  const double weight = 1.0 - std::exp(-true_way / options_.memory);
  const double limit = options_.outlier_sigmas * sigma();
  const double innovation = std::clamp(wheel_way / true_way - 1.0 - slip_, -limit, limit);
  slip_ += weight * innovation;
  variance_ += weight * (innovation * innovation - variance_);
}

UncertainPose WheelSlip::Correct(const WheelDelta& delta, const SE3& T_body_base) const {
  SE3 T_from_to = delta.T_from_to;
  T_from_to.translation /= 1.0 + slip_;
  Matrix6d covariance = PlusToExpCovariance(delta.covariance, delta.T_from_to);
  const double along = delta.distance / (1.0 + slip_) * sigma();
  // The base's x axis is along the track; what wheel preintegration assumed of slip is replaced.
  covariance(3, 3) = along * along + 1e-6;
  covariance.block<1, 3>(3, 0).setZero();
  covariance.block<3, 1>(0, 3).setZero();
  covariance.block<1, 2>(3, 4).setZero();
  covariance.block<2, 1>(4, 3).setZero();
  const UncertainPose body_base{T_body_base, Matrix6d::Zero()};
  return Compose(Compose(body_base, {T_from_to, covariance}), Inverse(body_base));
}

}  // namespace regolith
