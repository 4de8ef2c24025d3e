#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""The report of a run in a real browser: laptop and phone, light and dark, clicks and all, without a network."""

import os
import pathlib
import shutil
import tempfile
import unittest

from browser import Browser, find_browser
from program import RECORDING, call, skip_all

LAPTOP = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844, "phone": True}
# Colours of the canvas, reduced to 4 bits a channel, and the share of the most frequent one.
COLORS = """(() => {
  const canvas = document.querySelector('#scene canvas'), copy = document.createElement('canvas');
  copy.width = canvas.width; copy.height = canvas.height;
  const context = copy.getContext('2d');
  window.regolithScene.draw();
  context.drawImage(canvas, 0, 0);
  const bytes = context.getImageData(0, 0, copy.width, copy.height).data, counts = new Map();
  for (let i = 0; i < bytes.length; i += 4) {
    const key = (bytes[i] >> 4) << 8 | (bytes[i + 1] >> 4) << 4 | bytes[i + 2] >> 4;
    counts.set(key, (counts.get(key) || 0) + 1);
  }
  return [counts.size, Math.max(...counts.values()) / (bytes.length / 4)];
})()"""
VIEW = "[regolithScene.view.azimuth, regolithScene.view.distance]"


def middle(selector):
    return f"""(() => {{ const target = document.querySelector("{selector}");
      target.scrollIntoView({{block: "center"}});
      const box = target.getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2]; }})()"""


class ReportInBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="regolith_report_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        result = call("run", RECORDING, "--out", cls.folder / "run", "--quiet")
        assert result.returncode == 0, result.stderr
        cls.page = cls.folder / "run" / "report.html"
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def open(self, **view):
        self.browser.problems.clear()
        self.browser.open(self.page, **view)

    def tearDown(self):
        self.assertEqual(self.browser.problems, [])

    def press(self, text):
        self.browser.evaluate(f"[...document.querySelectorAll('button')].find(one => one.textContent === '{text}').click()")
        self.browser.settle()

    def check_page(self):
        colors, share = self.browser.evaluate(COLORS)
        self.assertGreater(colors, 40)
        self.assertLess(share, 0.8)
        plots = self.browser.evaluate("[...document.querySelectorAll('.figure')].map(one => one.querySelectorAll('.main-svg').length > 0)")
        self.assertGreaterEqual(len(plots), 8)
        self.assertTrue(all(plots))
        self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth - window.innerWidth"), 0)

    def brightness(self):
        return self.browser.evaluate("getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)[0]")

    def test_is_one_file_of_moderate_size(self):
        self.assertLess(self.page.stat().st_size, 15e6)

    def test_laptop_in_the_dark(self):
        self.open(**LAPTOP, dark=True)
        self.check_page()
        self.assertLess(self.brightness(), 60)
        self.browser.evaluate("document.querySelector('#theme').click()")
        self.assertGreater(self.brightness(), 200)

    def test_phone(self):
        for dark in (False, True) if os.environ.get("REGOLITH_LONG_TESTS") else (False,):
            self.open(**PHONE, dark=dark)
            self.check_page()
            self.assertEqual(self.brightness() < 60, dark)

    def test_laptop_where_clicks_go_to_a_time_and_frames_show_features(self):
        self.open(**LAPTOP)
        self.check_page()
        self.assertGreater(self.brightness(), 200)
        self.assertAlmostEqual(self.browser.evaluate("clock.time"), self.browser.evaluate("data.duration"))
        self.browser.click(*self.browser.evaluate(middle("#errors .nsewdrag")))
        time = self.browser.evaluate("clock.time")
        self.assertGreater(time, 10.0)
        self.assertLess(time, 30.0)
        self.assertIn(f"{time:.1f}", self.browser.evaluate("document.querySelector('.readout').textContent"))
        self.assertEqual(self.browser.evaluate("document.querySelector('#features .time').style.display"), "block")
        shown = self.browser.evaluate("""[...document.querySelectorAll('.frames img')].map(one =>
          [one.naturalWidth, one.clientHeight, one.parentElement.querySelector('path').getAttribute('d').split('M').length])""")
        self.assertEqual(len(shown), 8)
        for width, height, features in shown:
            self.assertEqual(width, 640)
            self.assertGreater(height, 100)
            self.assertGreater(features, 50)

    def test_the_view_turns_zooms_plays_and_changes_colours(self):
        self.open(**LAPTOP)
        place = self.browser.evaluate(middle("#scene canvas"))
        azimuth, distance = self.browser.evaluate(VIEW)
        self.browser.drag(place, (place[0] + 120, place[1]))
        self.browser.send("Input.dispatchMouseEvent", type="mouseWheel", x=place[0], y=place[1], deltaX=0, deltaY=-300)
        self.browser.settle()
        turned, nearer = self.browser.evaluate(VIEW)
        self.assertNotAlmostEqual(azimuth, turned)
        self.assertLess(nearer, distance)
        picture = "regolithScene.draw(); document.querySelector('#scene canvas').toDataURL()"
        pictures = [self.browser.evaluate(picture)]
        for name in ("Intensity", "By error", "Above", "Map"):
            self.press(name)
            pictures.append(self.browser.evaluate(picture))
        self.assertEqual(len(set(pictures)), len(pictures))
        self.press("Play")
        self.browser.evaluate("new Promise(done => setTimeout(done, 1200))")
        self.press("Pause")
        time = self.browser.evaluate("clock.time")
        self.assertGreater(time, 0.3)
        self.assertLess(time, self.browser.evaluate("data.duration"))


if __name__ == "__main__":
    if not find_browser():
        skip_all("no Chromium (apt-get install chromium)")
    unittest.main()
