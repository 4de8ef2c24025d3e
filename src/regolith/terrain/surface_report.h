// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

/// What the relief of a surface was made of.
struct SurfaceReport {
  double hurst = 0.0;                 ///< exponent between 1 m and the effective resolution
  double slope_at_1m_deg = 0.0;       ///< degrees, the figure of ReliefOptions::statistic
  double pixel = 0.0;                 ///< m, of the elevation model; 0 for generated ground
  double effective_resolution = 0.0;  ///< m, likewise: wavelength below which statistics begin
  bool hurst_clamped = false;         ///< no sane exponent leads from 1 m to the elevation model
};

}  // namespace regolith
