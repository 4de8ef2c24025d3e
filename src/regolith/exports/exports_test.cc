// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

TEST(Placeholder, Builds) {}
