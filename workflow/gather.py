#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
"""Gathers the cells of a sweep into a table and a leaderboard.

usage: gather.py CELL.json... --csv FILE --parquet FILE --page FILE

A cell's place says what it is: …/SCENARIO_SEED/PIPELINE/SETTING/cell.json.
"""

import argparse
import html
import json
import pathlib
import sys

import pandas

METRICS = {"length_m": ("length_m",), "ape_rmse_m": ("ape", "rmse"), "ape_mean_m": ("ape", "mean"), "ape_max_m": ("ape", "max"),
           "rpe_10m_rmse_m": ("rpe_10m", "rmse"), "drift_percent": ("drift_percent",), "yaw_rmse_deg": ("yaw_deg", "rmse"),
           "percent_of_distance": ("percent_of_distance",)}  # fmt: skip
SUMMARY = ("coverage", "resets", "loops_accepted", "recording_seconds", "cpu_seconds", "real_time_factor", "peak_rss_mb", "version")
PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,"><title>Leaderboard</title>
<style>
:root {{ color-scheme: light dark; }}
body {{ margin: 0 auto; max-width: 1200px; padding: 24px; font: 15px/1.5 system-ui, sans-serif;
  background: Canvas; color: CanvasText; }}
h1 {{ font-size: 26px; }} h2 {{ font-size: 17px; margin-top: 28px; }}
.table {{ overflow-x: auto; }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; width: 100%; }}
th, td {{ padding: 5px 14px 5px 0; text-align: right; border-bottom: 1px solid color-mix(in srgb, CanvasText 18%, transparent); white-space: nowrap; }}
th:first-child, td:first-child, th:nth-child(2), td:nth-child(2) {{ text-align: left; }}
th {{ cursor: pointer; font-weight: 600; }}
tr:first-child td {{ font-weight: 600; }}
.failed {{ color: #d33; white-space: normal; }}
</style></head><body>
<h1>Leaderboard</h1><p>Medians over the seeds; best error first. Click a heading to sort by it.</p>
{tables}
<script>
for (const heading of document.querySelectorAll("th")) heading.addEventListener("click", () => {{
  const table = heading.closest("table"), index = heading.cellIndex, body = table.tBodies[0];
  const down = heading.dataset.down = heading.dataset.down === "1" ? "0" : "1";
  const value = row => row.cells[index].textContent, number = row => parseFloat(value(row));
  body.append(...[...body.rows].sort((a, b) => (down === "1" ? 1 : -1) *
    (isNaN(number(a)) || isNaN(number(b)) ? value(a).localeCompare(value(b)) : number(a) - number(b))));
}});
</script></body></html>
"""
COLUMNS = {"ape_rmse_m": ("APE RMSE, m", 3), "ape_mean_m": ("mean, m", 3), "drift_percent": ("drift, %", 2), "yaw_rmse_deg": ("yaw, °", 2),
           "coverage": ("coverage", 3), "load": ("processor s/s", 2), "peak_rss_mb": ("memory, MB", 0)}  # fmt: skip


def row_of(path):
    cell = json.loads(path.read_text(encoding="utf-8"))
    scenario, seed = path.parts[-4].rsplit("_", 1)
    row = {"scenario": scenario, "seed": int(seed), "pipeline": path.parts[-3], "setting": path.parts[-2]}
    for name, keys in METRICS.items():
        value = cell.get("metrics")
        for key in keys:
            value = value.get(key) if isinstance(value, dict) else None
        row[name] = value
    for name in SUMMARY:
        row[name] = cell.get("summary", {}).get(name)
    row["failure"] = cell.get("failure")
    return row


def leaderboard(table):
    parts = []
    frame = table.assign(load=table["cpu_seconds"] / table["recording_seconds"])
    for scenario, cells in frame.groupby("scenario"):
        rows = []
        for (pipeline, setting), group in cells.groupby(["pipeline", "setting"]):
            good = group[group["failure"].isna()]
            medians = good[list(COLUMNS)].median(numeric_only=True) if len(good) else None
            texts = [f"{medians[name]:.{digits}f}" if medians is not None and pandas.notna(medians[name]) else "–"
                     for name, (_, digits) in COLUMNS.items()]  # fmt: skip
            reasons = "; ".join(sorted(set(group["failure"].dropna())))
            note = f"<td class='failed'>{html.escape(reasons)}</td>" if reasons else "<td></td>"
            order = medians["ape_rmse_m"] if medians is not None else float("inf")
            rows.append((order, f"<tr><td>{html.escape(pipeline)}</td><td>{html.escape(setting)}</td>"
                         + "".join(f"<td>{text}</td>" for text in texts) + f"<td>{len(good)} of {len(group)}</td>{note}</tr>"))  # fmt: skip
        head = "".join(f"<th>{name}</th>" for name in ("pipeline", "setting", *(title for title, _ in COLUMNS.values()), "runs", "failed"))
        body = "\n".join(text for _, text in sorted(rows))
        parts.append(f"<h2>{html.escape(scenario)}</h2><div class='table'><table><thead><tr>{head}</tr></thead><tbody>\n{body}</tbody></table></div>")
    return PAGE.format(tables="\n".join(parts))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cells", nargs="+", type=pathlib.Path)
    for name in ("--csv", "--parquet", "--page"):
        parser.add_argument(name, type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    table = pandas.DataFrame([row_of(path) for path in arguments.cells])
    table = table.astype({name: "float64" for name in (*METRICS, *SUMMARY[:-1])}).astype({"failure": "string", "version": "string"})
    table = table.sort_values(["scenario", "pipeline", "setting", "seed"], ignore_index=True)
    table.to_csv(arguments.csv, index=False)
    table.to_parquet(arguments.parquet, index=False)
    arguments.page.write_text(leaderboard(table), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
