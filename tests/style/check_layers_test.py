#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""tools/check_layers.py must fail where the order is broken."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECKER = pathlib.Path(__file__).parents[2] / "tools" / "check_layers.py"


class CheckLayers(unittest.TestCase):
    def check(self, name, text):
        with tempfile.TemporaryDirectory() as root:
            path = pathlib.Path(root, "src", "regolith", name)
            path.parent.mkdir(parents=True)
            path.write_text(text, encoding="utf-8")
            result = subprocess.run([sys.executable, CHECKER, root], capture_output=True, text=True, check=False)
            return result.returncode, result.stdout

    def test_lower_levels_and_the_own_folder_are_allowed(self):
        self.assertEqual(self.check("lio/a.h", '#include "regolith/core/time.h"\n#include "regolith/lio/b.h"\n')[0], 0)

    def test_higher_and_equal_levels_are_not(self):
        for included in ("lio/a.h", "sensor/a.h"):
            code, output = self.check("sensor/x.cc" if included == "lio/a.h" else "geometry/x.cc",
                                      f'#include "regolith/{included}"\n')
            self.assertEqual(code, 1, output)
        self.assertEqual(self.check("imu/x.cc", '#include "regolith/cloud/a.h"\n')[0], 1)

    def test_estimators_are_blind_to_files_and_truth(self):
        for folder in ("io", "sim", "eval"):
            self.assertEqual(self.check("lio/x.cc", f'#include "regolith/{folder}/a.h"\n')[0], 1)

    def test_third_party_headers_stay_in_source_files(self):
        self.assertEqual(self.check("io/a.cc", "#include <opencv2/core.hpp>\n")[0], 0)
        self.assertEqual(self.check("io/a.h", "#include <opencv2/core.hpp>\n")[0], 1)
        self.assertEqual(self.check("io/a.h", "#include <vector>\n#include <Eigen/Core>\n")[0], 0)

    def test_an_empty_tree_is_an_error(self):
        with tempfile.TemporaryDirectory() as root:
            self.assertEqual(subprocess.run([sys.executable, CHECKER, root], capture_output=True, check=False).returncode, 1)


if __name__ == "__main__":
    unittest.main()
