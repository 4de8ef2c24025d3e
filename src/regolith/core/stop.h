// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace regolith {

/// Makes Ctrl-C (SIGINT) and SIGTERM raise a flag instead of ending the process; a second one ends
/// it. Long work asks StopRequested() between steps, ends early and keeps what it has.
void InstallStopSignals();

bool StopRequested();

}  // namespace regolith
