// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Light or dark: the system's choice until the button says otherwise.
"use strict";

const root = document.documentElement;
const systemTheme = window.matchMedia("(prefers-color-scheme: dark)");
const themeListeners = [];
let chosenTheme = null;
function applyTheme() {
  root.dataset.theme = chosenTheme || (systemTheme.matches ? "dark" : "light");
  for (const listener of themeListeners) listener();
}
document.getElementById("theme").addEventListener("click", () => {
  chosenTheme = root.dataset.theme === "dark" ? "light" : "dark";
  applyTheme();
});
systemTheme.addEventListener("change", applyTheme);
applyTheme();
