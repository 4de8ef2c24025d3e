// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/report/report_template.h"

namespace regolith {

const std::string_view kReportStyle = R"css(
:root { --page: #f6f5f2; --card: #ffffff; --text: #1f2328; --muted: #666d75; --line: #dcdad4;
  --estimate: #d9480f; --reference: #1c6fb8; --second: #8a8f98; }
@media (prefers-color-scheme: dark) {
  :root { --page: #14161a; --card: #1d2026; --text: #e8e6e1; --muted: #9ba1a9; --line: #343941;
    --estimate: #ff8a4c; --reference: #62b0f5; --second: #7d848e; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--text);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, sans-serif; }
header, main { max-width: 1400px; margin: 0 auto; padding: 20px 24px; }
header { padding-bottom: 0; }
h1 { margin: 0; font-size: 26px; font-weight: 650; overflow-wrap: anywhere; }
h2 { margin: 0 0 10px; font-size: 16px; font-weight: 600; }
header p { margin: 2px 0 14px; color: var(--muted); }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 12px; }
.tile, section, .notice { background: var(--card); border: 1px solid var(--line);
  border-radius: 10px; }
.tile { padding: 10px 14px; }
.tile span { display: block; color: var(--muted); font-size: 13px; }
.tile b { font-size: 20px; font-weight: 600; font-variant-numeric: tabular-nums; }
main { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 16px; }
section { padding: 14px 16px; min-width: 0; }
.wide, .notice { grid-column: 1 / -1; }
.notice { padding: 12px 16px; margin: 0; border-left: 4px solid var(--estimate); }
.note { margin: 6px 0 0; color: var(--muted); font-size: 13px; }
.figure { width: 100%; height: 380px; }
#scene { height: 600px; }
table { width: 100%; border-collapse: collapse; font-size: 14px; }
th, td { padding: 4px 8px 4px 0; border-bottom: 1px solid var(--line); text-align: left;
  vertical-align: top; overflow-wrap: anywhere; }
th { font-weight: 400; color: var(--muted); width: 46%; }
td { font-variant-numeric: tabular-nums; }
tr:last-child th, tr:last-child td { border-bottom: 0; }
details summary { cursor: pointer; }
pre { overflow-x: auto; font-size: 13px; margin: 10px 0 0; }
@media (max-width: 800px) {
  header, main { padding: 14px 12px; }
  header { padding-bottom: 0; }
  main { grid-template-columns: minmax(0, 1fr); gap: 12px; }
  section { padding: 12px; }
  .figure { height: 300px; }
  #scene { height: 420px; } }
)css";

const std::string_view kReportScript = R"js(
const dark = window.matchMedia("(prefers-color-scheme: dark)");
const color = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const isNarrow = () => window.innerWidth < 800;
// On a phone the tool bar would cover the legend; fingers need no tools.
const config = { responsive: true, displaylogo: false, displayModeBar: isNarrow() ? false : "hover" };

function baseLayout() {
  const axis = { gridcolor: color("--line"), zerolinecolor: color("--line"), automargin: true };
  return {
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    font: { color: color("--text"), family: "system-ui, sans-serif", size: 13 },
    margin: { l: 50, r: 12, t: 34, b: 40 },
    legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0, itemsizing: "constant" },
    modebar: { bgcolor: "rgba(0,0,0,0)", color: color("--muted"), activecolor: color("--text") },
    xaxis: { ...axis }, yaxis: { ...axis },
  };
}

function paths(type) {
  const lines = [];
  const add = (part, name, variable, width, dash) => {
    if (!data[part]) return;
    const line = { type, mode: "lines", name, x: data[part].x, y: data[part].y,
      line: { color: color(variable), width, dash },
      customdata: data[part].t,
      hovertemplate: "%{x:.2f}, %{y:.2f} m<br>%{customdata:.1f} s<extra>" + name + "</extra>" };
    if (type === "scatter3d") line.z = data[part].z;
    lines.push(line);
  };
  // Where both coincide both must be seen: dashes over a line, or in space a thin line in a thick one.
  const flat = type !== "scatter3d";
  add("reference", "truth", "--reference", flat ? 2.5 : 3, "solid");
  add("estimate", "estimate", "--estimate", flat ? 2 : 7, flat && data.reference ? "dash" : "solid");
  return lines;
}

// The middle 96 per cent, so that a few stray points do not wash out the rest.
function colorRange(values) {
  const sorted = Float64Array.from(values).sort();
  const at = share => sorted[Math.floor(share * (sorted.length - 1))];
  return [at(0.02), at(0.98)];
}

function drawScene(element) {
  const traces = paths("scatter3d");
  if (data.map) {
    const [low, high] = colorRange(data.map.value);
    traces.unshift({ type: "scatter3d", mode: "markers", name: "map", x: data.map.x,
      y: data.map.y, z: data.map.z, hoverinfo: "skip",
      marker: { size: 1.4, color: data.map.value, cmin: low, cmax: high,
        colorscale: dark.matches ? [[0, "#474c56"], [1, "#efe6d2"]]
                                 : [[0, "#3f4147"], [1, "#cfc5ae"]],
        colorbar: isNarrow() ? undefined : { title: { text: data.map.name, side: "right" },
          thickness: 12, len: 0.6, outlinewidth: 0 }, showscale: !isNarrow() } });
  }
  const axis = name => ({ title: { text: name + ", m" }, gridcolor: color("--line"),
    zerolinecolor: color("--line"), backgroundcolor: "rgba(0,0,0,0)" });
  const layout = { ...baseLayout(), margin: { l: 0, r: 0, t: 0, b: 0 },
    legend: { orientation: "h", x: 0, y: 1, yanchor: "top", itemsizing: "constant" }, uirevision: "keep",
    scene: { aspectmode: "data", dragmode: "turntable", xaxis: axis("x"), yaxis: axis("y"),
      zaxis: axis("z"), camera: { eye: { x: -0.7, y: -0.9, z: 0.6 } } } };
  Plotly.react(element, traces, layout, config);
}

// Of the path with a margin; the map around it is far wider.
function pathRange(axis) {
  let low = Infinity, high = -Infinity;
  for (const part of [data.estimate, data.reference]) {
    for (const value of part ? part[axis] : []) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  const margin = Math.max(1, 0.1 * (high - low));
  return [low - margin, high + margin];
}

function drawTop(element) {
  const traces = paths("scatter");
  if (data.map) {
    traces.unshift({ type: "scattergl", mode: "markers", name: "map", x: data.map.x, y: data.map.y,
      hoverinfo: "skip", marker: { size: 2, opacity: 0.35, color: color("--second") } });
  }
  const layout = baseLayout();
  Object.assign(layout.xaxis, { title: { text: "x, m" }, range: pathRange("x") });
  Object.assign(layout.yaxis, { title: { text: "y, m" }, range: pathRange("y"), scaleanchor: "x" });
  Plotly.react(element, traces, layout, config);
}

function drawSeries(element, series, variable) {
  const layout = baseLayout();
  layout.showlegend = false;
  Object.assign(layout.xaxis, { title: { text: "time, s" } });
  Object.assign(layout.yaxis, { title: { text: series.name }, rangemode: "tozero" });
  const trace = { type: "scatter", mode: "lines", x: series.t, y: series.v,
    line: { color: color(variable), width: 1.5 }, hovertemplate: "%{y:.4g} at %{x:.2f} s<extra></extra>" };
  Plotly.react(element, [trace], layout, config);
}

function drawStages(element) {
  const bar = (name, values, variable) => ({ type: "bar", orientation: "h", name,
    y: data.stages.names, x: values, marker: { color: color(variable) },
    hovertemplate: "%{x:.2f} ms<extra>" + name + "</extra>" });
  const layout = baseLayout();
  layout.barmode = "group";
  Object.assign(layout.xaxis, { title: { text: "ms" } });
  Object.assign(layout.yaxis, { autorange: "reversed" });
  Plotly.react(element, [bar("median", data.stages.median, "--reference"),
    bar("99th percentile", data.stages.p99, "--second")], layout, config);
}

function drawStatus(element) {
  const rows = data.status.length;
  element.style.height = 60 + 130 * rows + "px";
  const layout = { ...baseLayout(), showlegend: false, annotations: [],
    margin: { l: 56, r: 12, t: 34, b: 40 },
    grid: { rows, columns: 1, pattern: "coupled", roworder: "top to bottom", ygap: 0.45 } };
  layout.xaxis.title = { text: "time, s" };
  const traces = data.status.map((series, row) => {
    const suffix = row ? row + 1 : "";
    layout["yaxis" + suffix] = { gridcolor: color("--line"), zerolinecolor: color("--line"),
      nticks: 4 };
    layout.annotations.push({ text: series.name, xref: "paper", yref: "y" + suffix + " domain",
      x: 0, y: 1, xanchor: "left", yanchor: "bottom", showarrow: false,
      font: { color: color("--muted") } });
    return { type: "scatter", mode: "lines", x: series.t, y: series.v, xaxis: "x",
      yaxis: "y" + suffix, line: { color: color("--reference"), width: 1.5, shape: "hv" },
      hovertemplate: "%{y:.4g} at %{x:.2f} s<extra>" + series.name + "</extra>" };
  });
  Plotly.react(element, traces, layout, config);
}

const figures = {
  scene: drawScene, top: drawTop, stages: drawStages, status: drawStatus,
  error: element => drawSeries(element, data.error, "--estimate"),
  frame_ms: element => drawSeries(element, data.frame_ms, "--reference"),
};

function drawAll() {
  for (const [id, draw] of Object.entries(figures)) {
    const element = document.getElementById(id);
    if (element) draw(element);
  }
}
drawAll();
dark.addEventListener("change", drawAll);
)js";

}  // namespace regolith
