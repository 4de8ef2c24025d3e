// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace regolith {

struct GnuplotSize {
  int width = 1200;  ///< pixels
  int height = 700;
};

/// Text as gnuplot reads it between single quotes, quotes included.
std::string QuoteGnuplot(const std::string& text);

/// Writes `folder`/`name`.dat and `name`.gp and has gnuplot draw `name`.png and `name`.svg from
/// them. `commands` is the script from the titles on; it reads the data as '`name`.dat'. False,
/// after a warning, where gnuplot is missing or fails; throws OutputError where the files cannot be
/// written.
bool DrawWithGnuplot(const std::string& folder, const std::string& name, const std::string& data,
                     const std::string& commands, const GnuplotSize& size);

}  // namespace regolith
