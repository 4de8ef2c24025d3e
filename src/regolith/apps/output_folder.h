// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace regolith {

/// Makes the folder that --out names. Throws InputError where the name is empty, the folder holds
/// something and `overwrite` is false, a file of that name exists, or it cannot be written to.
void PrepareOutputFolder(const std::string& path, bool overwrite);

}  // namespace regolith
