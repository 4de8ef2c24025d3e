// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Draws the object `data` (report.cc) into the elements that the page has.
"use strict";

const color = name => getComputedStyle(root).getPropertyValue(name).trim();
const isNarrow = () => window.innerWidth < 820;
const $ = id => document.getElementById(id);

function element(tag, properties, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}
function button(text, title, pressed, action) {
  const made = element("button", { textContent: text, title, type: "button" });
  if (pressed !== null) made.setAttribute("aria-pressed", pressed);
  made.addEventListener("click", () => action(made));
  return made;
}
function isPressed(one) { return one.getAttribute("aria-pressed") === "true"; }
function choice(options, chosen, action) {
  const group = element("span", { className: "group" });
  for (const [value, text, title] of options) {
    group.append(button(text, title, value === chosen, made => {
      for (const other of group.children) other.setAttribute("aria-pressed", other === made);
      action(value);
    }));
  }
  return group;
}

// The last index whose time is not later.
function indexAt(times, time) {
  let low = 0, high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time) low = middle; else high = middle - 1;
  }
  return low;
}
function bytesOf(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// ---- time, which the view and all plots share --------------------------------------------------

const clock = { time: data.duration, listeners: [] };
function seek(time) {
  clock.time = Math.min(data.duration, Math.max(0, time));
  for (const listener of clock.listeners) listener(clock.time);
}

// ---- plots -------------------------------------------------------------------------------------

const plotConfig = { responsive: true, displaylogo: false, modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"] };
const redraws = [];

function baseLayout(xTitle, yTitle) {
  const axis = { gridcolor: color("--line"), zerolinecolor: color("--line"), automargin: true, tickfont: { size: 12 } };
  return {
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", hovermode: "x unified",
    font: { color: color("--text"), family: "system-ui, sans-serif", size: 12.5 },
    hoverlabel: { bgcolor: color("--card"), bordercolor: color("--line"), font: { color: color("--text") } },
    margin: { l: 52, r: 10, t: 30, b: 40 },
    legend: { orientation: "h", y: 1.02, yanchor: "bottom", x: 0, itemsizing: "constant" },
    modebar: { bgcolor: "rgba(0,0,0,0)", color: color("--muted"), activecolor: color("--text") },
    xaxis: { ...axis, title: { text: xTitle, standoff: 8 } }, yaxis: { ...axis, title: { text: yTitle, standoff: 6 } },
  };
}
function plot(id, make) {
  const target = $(id);
  if (!target) return;
  const draw = () => {
    const { traces, layout } = make();
    // On a phone the tool bar would cover the legend; fingers need no tools.
    Plotly.react(target, traces, layout, { ...plotConfig, displayModeBar: isNarrow() ? false : "hover" });
  };
  draw();
  redraws.push(draw);
  return target;
}
// A plot over time: a line shows the time of the view, a click sets it.
function timePlot(id, make) {
  const target = plot(id, make);
  if (!target) return;
  const line = element("div", { className: "time" });
  target.append(line);
  const place = time => {
    const layout = target._fullLayout, axis = layout && layout.xaxis;
    const x = axis ? axis.l2p(time) : -1;
    const shown = x >= 0 && x <= axis._length && time < data.duration;
    line.style.display = shown ? "block" : "none";
    if (!shown) return;
    Object.assign(line.style, { left: axis._offset + x + "px", top: layout._size.t + "px", height: layout._size.h + "px" });
  };
  clock.listeners.push(place);
  target.on("plotly_afterplot", () => place(clock.time));
  target.on("plotly_click", event => seek(event.points[0].x));
}
const palette = ["#1c6fb8", "#d9480f", "#2f8a4c", "#b0539c", "#b58900", "#5f6b78", "#7a5230", "#0f8b8d"];
const darkPalette = ["#5fb0f7", "#ff8a4c", "#63c27f", "#dd8fd0", "#e3b341", "#9aa5b1", "#c39b77", "#4cc9cb"];
const paint = index => (root.dataset.theme === "dark" ? darkPalette : palette)[index % palette.length];
function lineOf(series, index, extra) {
  return { type: series.t.length > 3000 ? "scattergl" : "scatter", mode: "lines", name: series.name, x: series.t, y: series.v,
    line: { color: paint(index), width: 1.6 }, hovertemplate: "%{y:.4~g}", ...extra };
}
function seriesPlot(id, yTitle, list, options = {}) {
  timePlot(id, () => {
    const layout = baseLayout("time, s", yTitle);
    if (options.fromZero) layout.yaxis.rangemode = "tozero";
    const traces = list.map((series, index) => lineOf(series, index, options.stacked
      ? { type: "scatter", stackgroup: "all", line: { color: paint(index), width: 0.5 } }
      : index > 0 && options.firstOnly ? { visible: "legendonly" } : {}));
    layout.showlegend = list.length > 1;
    return { traces, layout };
  });
}

function drawTop() {
  plot("top", () => {
    const layout = baseLayout("x, m", "y, m");
    layout.hovermode = "closest";
    Object.assign(layout.yaxis, { scaleanchor: "x" });
    const traces = [], hover = "%{x:.2f}, %{y:.2f} m<br>%{customdata:.1f} s";
    const path = (part, name, extra) => data[part] && traces.push({ type: "scatter", mode: "lines", name, x: data[part].x,
      y: data[part].y, customdata: data[part].t, hovertemplate: hover + "<extra>" + name + "</extra>", ...extra });
    path("reference", "truth", { line: { color: color("--reference"), width: 4 }, opacity: 0.55 });
    if (data.estimate && data.estimate.error) {
      path("estimate", "estimate", { line: { color: color("--estimate"), width: 1.5 } });
      const step = Math.ceil(data.estimate.x.length / 1500), every = list => list.filter((_, i) => i % step === 0);
      traces.push({ type: "scatter", mode: "markers", name: "error", x: every(data.estimate.x), y: every(data.estimate.y),
        customdata: every(data.estimate.t), text: every(data.estimate.error), hovertemplate: hover + "<br>error %{text:.3f} m<extra></extra>",
        marker: { size: 5, color: every(data.estimate.error), cmin: 0, cmax: data.estimate.errorScale, showscale: true,
          colorscale: ramps.error.map((stop, i) => [i / (ramps.error.length - 1), stop]),
          colorbar: { thickness: 9, len: 0.9, outlinewidth: 0, title: { text: "error, m", side: "right" } } }, showlegend: false });
    } else {
      path("estimate", "estimate", { line: { color: color("--estimate"), width: 2 } });
    }
    return { traces, layout };
  });
  const target = $("top");
  if (target) target.on("plotly_click", event => seek(event.points[0].customdata));
}

function drawLeader() {
  timePlot("leader", () => {
    const layout = baseLayout("time, s", "");
    layout.barmode = "overlay";
    layout.hovermode = "closest";
    const names = [...new Set(data.leader.map(span => span.name))];
    const traces = names.map((name, index) => {
      const spans = data.leader.filter(span => span.name === name);
      return { type: "bar", orientation: "h", name, y: spans.map(() => "leads"), base: spans.map(span => span.from), width: 0.55,
        x: spans.map(span => span.to - span.from), marker: { color: paint(index), line: { width: 0 } },
        hovertemplate: name + ", from %{base:.1f} s<extra></extra>" };
    });
    if (data.degenerate) {
      traces.push({ type: "scatter", mode: "lines", name: "degenerate directions", x: data.degenerate.t, y: data.degenerate.v,
        xaxis: "x", yaxis: "y2", line: { color: color("--bad"), width: 1.4, shape: "hv" }, hovertemplate: "%{y} of 6 at %{x:.1f} s<extra></extra>" });
      layout.yaxis.domain = [0.72, 1];
      layout.xaxis.anchor = "y2";
      layout.yaxis2 = { ...layout.yaxis, domain: [0, 0.62], title: { text: "degenerate" }, range: [-0.2, 6.2], dtick: 2 };
    }
    layout.showlegend = true;
    return { traces, layout };
  });
}

function drawStages() {
  plot("stages", () => {
    const layout = baseLayout("ms", "");
    layout.barmode = "group";
    layout.hovermode = "closest";
    layout.yaxis.autorange = "reversed";
    const bar = (name, values, variable) => ({ type: "bar", orientation: "h", name, y: data.stages.names, x: values,
      marker: { color: variable }, hovertemplate: "%{x:.2f} ms<extra>" + name + "</extra>" });
    return { layout, traces: [bar("median", data.stages.median, paint(0)), bar("99th percentile", data.stages.p99, color("--second"))] };
  });
}

function drawPlots() {
  drawTop();
  if (data.errors) seriesPlot("errors", "error, m", data.errors, { firstOnly: true });
  if (data.yaw) seriesPlot("yaw", "heading, °", [data.yaw]);
  if (data.features) seriesPlot("features", "features", data.features, { fromZero: true });
  if (data.leader) drawLeader();
  if (data.stages) drawStages();
  for (const group of data.groups || []) seriesPlot(group.id, group.unit, group.series, { fromZero: true, stacked: group.stacked });
}

// ---- the view in space -------------------------------------------------------------------------

function rowsOf(path, scale) {
  const rows = new Float32Array(5 * path.x.length);
  for (let i = 0; i < path.x.length; ++i) {
    rows.set([path.x[i], path.y[i], path.z[i], path.t[i], scale ? Math.min(1, path.error[i] / scale) : 0], 5 * i);
  }
  return rows;
}
// The rover's axes at a pose: forward, left and up.
function axesRows(pose, size) {
  const [x, y, z, w] = pose.q, p = pose.place, rows = [];
  const axes = [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
    [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)], [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]];
  return axes.map(axis => {
    rows.length = 0;
    rows.push(...p, 0, 0, p[0] + size * axis[0], p[1] + size * axis[1], p[2] + size * axis[2], 0, 0);
    return new Float32Array(rows);
  });
}
function boundsOf() {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const part of [data.estimate, data.reference]) {
    if (!part) continue;
    ["x", "y", "z"].forEach((axis, i) => {
      for (const value of part[axis]) { low[i] = Math.min(low[i], value); high[i] = Math.max(high[i], value); }
    });
  }
  return low[0] <= high[0] ? { low, high } : { low: data.map.box[0], high: data.map.box[1] };
}
function niceLength(metres) {
  const power = 10 ** Math.floor(Math.log10(metres));
  return power * (metres / power >= 5 ? 5 : metres / power >= 2 ? 2 : 1);
}

function buildScene() {
  const holder = $("scene");
  if (!holder) return;
  const canvas = element("canvas", { tabIndex: 0, ariaLabel: "Map and trajectory in space" });
  holder.append(canvas);
  const map = data.map && { bytes: bytesOf(data.map.points), count: data.map.count, scale: data.map.scale, offset: data.map.offset,
    heights: data.map.heights, size: data.map.spacing };
  const sceneColor = name => getComputedStyle(holder).getPropertyValue(name).trim();
  const scene = createScene(canvas, map, boundsOf(), sceneColor);
  if (!scene) {
    holder.replaceChildren(element("p", { className: "note", style: "padding: 18px",
      textContent: "This browser has no WebGL 2, so the map is not shown; the plots below need none." }));
    return;
  }
  window.regolithScene = scene;
  const estimate = data.estimate;
  const byError = estimate && estimate.error;
  if (data.reference) scene.setLine("truth", rowsOf(data.reference), { color: "--scene-truth", width: 5, alpha: 0.75, timed: false });
  if (estimate) scene.setLine("estimate", rowsOf(estimate), { color: "--scene-estimate", width: 3, ahead: 0.16 });
  const diamonds = [];
  for (const [x, y, z, t] of data.keyframes || []) {
    for (const [dx, dy] of [[0.12, 0], [0, 0.12]]) diamonds.push(x - dx, y - dy, z, t, 0, x + dx, y + dy, z, t, 0);
  }
  if (diamonds.length) scene.setLine("keyframes", new Float32Array(diamonds), { color: "--scene-keyframe", width: 1.6, pairs: true, ahead: 0, behind: 0.15 });
  const loops = (data.loops || []).flatMap(loop => [...loop.from, loop.t, 0, ...loop.to, loop.t, 0]);
  if (loops.length) scene.setLine("loops", new Float32Array(loops), { color: "--scene-loop", width: 2.2, pairs: true, ahead: 0 });

  const legend = element("div", { className: "legend" });
  const key = (name, variable, text) => scene.lines.has(name) && legend.append(element("div", {}, element("i", { style: `background: var(${variable})` }), text));
  key("truth", "--scene-truth", "truth");
  key("estimate", "--scene-estimate", "estimate");
  key("loops", "--scene-loop", "loop closures");
  const ramp = element("div", { className: "ramp" });
  const readout = element("div", { className: "readout" });
  const scale = element("div", { className: "scale" });
  holder.append(legend, ramp, readout, scale);

  function showRamp() {
    const name = scene.view.coloring;
    const [low, high] = name === "height" ? data.map.heights : data.map.intensities;
    ramp.replaceChildren(element("i", { style: `background: linear-gradient(90deg, ${ramps[name].join(",")})` }),
      element("span", {}, element("b", { textContent: low.toFixed(1) }), name === "height" ? "height, m" : "intensity",
        element("b", { textContent: high.toFixed(1) })));
  }
  if (map) showRamp();

  let following = false, playing = false, speed = Math.max(1, Math.round(data.duration / 30)), last = 0;
  function poseAt(time) {
    const i = indexAt(estimate.t, time);
    return { i, place: [estimate.x[i], estimate.y[i], estimate.z[i]], q: [0, 1, 2, 3].map(k => estimate.q[4 * i + k]) };
  }
  function showRover(time) {
    if (!estimate) return;
    const pose = poseAt(time);
    axesRows(pose, Math.max(0.5, 0.03 * scene.reach)).forEach((rows, axis) => scene.setLine("rover" + axis, rows,
      { color: ["#ff5c5c", "#5ee07f", "#5cb8ff"][axis], width: 4, timed: false, pairs: true, behind: 1 }));
    scene.view.now = time >= data.duration ? Infinity : time;
    if (following) scene.view.target = pose.place;
    const lines = [`${time.toFixed(1)} s   x ${pose.place[0].toFixed(2)}  y ${pose.place[1].toFixed(2)}  z ${pose.place[2].toFixed(2)} m`];
    const parts = [];
    if (byError) parts.push(`error ${estimate.error[pose.i].toFixed(3)} m`);
    if (data.features) parts.push(`${data.features[0].v[indexAt(data.features[0].t, time)]} features`);
    if (data.leader) parts.push(data.leader[indexAt(data.leader.map(span => span.from), time)].name + " leads");
    if (parts.length) lines.push(parts.join("   "));
    readout.textContent = lines.join("\n");
    scene.request();
  }
  clock.listeners.push(showRover);
  scene.listeners.push(() => {
    const length = niceLength(110 * scene.metresPerPixel());
    scale.replaceChildren(`${length} m`, element("i", { style: `width: ${Math.round(length / scene.metresPerPixel())}px` }));
  });
  canvas.addEventListener("click", event => {  // on the path: that time
    if (!scene.isClick() || !estimate) return;
    const box = canvas.getBoundingClientRect();
    let best = 18, found = -1;
    for (let i = 0; i < estimate.x.length; ++i) {
      const pixel = scene.project([estimate.x[i], estimate.y[i], estimate.z[i]]);
      if (!pixel) continue;
      const distance = Math.hypot(pixel[0] - event.clientX + box.left, pixel[1] - event.clientY + box.top);
      if (distance < best) { best = distance; found = i; }
    }
    if (found >= 0) seek(estimate.t[found]);
  });

  const bar = $("scene-bar"), toggles = element("span", { className: "bar", style: "margin: 0" });
  if (map) {
    bar.append(choice([["height", "Height", "Colour the map by height"], ["intensity", "Intensity", "Colour the map by the lidar's intensity"]],
      "height", value => { scene.view.coloring = value; showRamp(); scene.request(); }));
    toggles.append(button("Map", "Show the map", true, made => {
      made.setAttribute("aria-pressed", !isPressed(made));
      scene.view.showMap = isPressed(made);
      scene.request();
    }));
  }
  for (const [name, text] of [["truth", "Truth"], ["estimate", "Estimate"], ["keyframes", "Keyframes"], ["loops", "Loops"]]) {
    if (!scene.lines.has(name)) continue;
    toggles.append(button(text, "Show " + text.toLowerCase(), true, made => {
      made.setAttribute("aria-pressed", !isPressed(made));
      scene.lines.get(name).visible = isPressed(made);
      scene.request();
    }));
  }
  if (byError) {
    toggles.append(button("By error", "Colour the estimate by its error", false, made => {
      made.setAttribute("aria-pressed", !isPressed(made));
      scene.setLine("estimate", rowsOf(estimate, data.estimate.errorScale), { color: "--scene-estimate", width: 4, ahead: 0.16, byValue: isPressed(made) });
      scene.request();
    }));
  }
  bar.append(toggles, element("span", { className: "spacer" }));
  const look = (azimuth, elevation, factor) => {
    following = false;
    Object.assign(scene.view, { azimuth, elevation, distance: scene.fit(factor), target: scene.middle.slice() });
    scene.request();
  };
  bar.append(button("Reset", "The first view", null, () => look(-2.2, 0.62, 1.75)),
    button("Above", "From above, x to the right", null, () => look(-Math.PI / 2, 1.5707, 2.2)),
    button("Follow", "Keep the rover in the middle", false, made => {
      following = !isPressed(made);
      made.setAttribute("aria-pressed", following);
      if (following) { scene.view.distance = Math.min(scene.view.distance, 14); scene.view.elevation = Math.min(scene.view.elevation, 0.5); }
      showRover(clock.time);
    }),
    button("Save picture", "The view as a PNG file", null, () => {
      scene.draw();
      element("a", { href: canvas.toDataURL("image/png"), download: "map.png" }).click();
    }));

  const play = $("scene-play");
  const slider = element("input", { type: "range", min: 0, max: data.duration, step: 0.1, value: data.duration, ariaLabel: "time" });
  const reading = element("span", { className: "clock" });
  const toggle = button("Play", "Play along time (space)", null, () => setPlaying(!playing));
  toggle.className = "toggle";
  const rates = element("select", { title: "Speed", ariaLabel: "speed" });
  for (const rate of [...new Set([1, 2, 5, 10, 20, 50, speed])].sort((a, b) => a - b)) {
    rates.append(element("option", { value: rate, textContent: rate + " ×", selected: rate === speed }));
  }
  rates.addEventListener("change", () => { speed = Number(rates.value); });
  slider.addEventListener("input", () => { setPlaying(false); seek(Number(slider.value)); });
  clock.listeners.push(time => {
    slider.value = time;
    reading.textContent = `${time.toFixed(1)} / ${data.duration.toFixed(1)} s`;
  });
  function setPlaying(value) {
    playing = value;
    toggle.textContent = playing ? "Pause" : "Play";
    if (!playing) return;
    if (clock.time >= data.duration) seek(0);
    last = performance.now();
    requestAnimationFrame(step);
  }
  function step(now) {
    if (!playing) return;
    seek(clock.time + speed * Math.min(0.2, (now - last) / 1000));
    last = now;
    if (clock.time >= data.duration) setPlaying(false); else requestAnimationFrame(step);
  }
  canvas.addEventListener("keydown", event => {
    if (event.key !== " ") return;
    event.preventDefault();
    setPlaying(!playing);
  });
  if (estimate) play.append(toggle, rates, slider, reading); else play.remove();
  redraws.push(() => scene.request());
  scene.request();
}

// ---- the rest ----------------------------------------------------------------------------------

for (const figure of document.querySelectorAll(".frames figure[data-time]")) {
  figure.addEventListener("click", () => seek(Number(figure.dataset.time)));
}
themeListeners.push(() => redraws.forEach(draw => draw()));
buildScene();
drawPlots();
seek(data.duration);
