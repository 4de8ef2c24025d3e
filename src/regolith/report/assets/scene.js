// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A small renderer of point clouds and paths in WebGL 2: points as round sprites, shaded by the depths around them
// ("eye-dome lighting", Boucheny 2009), paths as smooth ribbons that shine faintly through what hides them.
"use strict";

const matrix = {
  multiply(a, b) {  // column by column, as WebGL has them
    const out = new Float32Array(16);
    for (let column = 0; column < 4; ++column) {
      for (let row = 0; row < 4; ++row) {
        let sum = 0;
        for (let k = 0; k < 4; ++k) sum += a[4 * k + row] * b[4 * column + k];
        out[4 * column + row] = sum;
      }
    }
    return out;
  },
  perspective(angle, aspect, near, far) {
    const f = 1 / Math.tan(angle / 2);
    return new Float32Array([f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0,
      2 * far * near / (near - far), 0]);
  },
  lookAt(eye, target) {  // z is up
    const z = normalized(subtracted(eye, target));
    const x = normalized(cross([0, 0, 1], z));
    const y = cross(z, x);
    return new Float32Array([x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0,
      -dot(x, eye), -dot(y, eye), -dot(z, eye), 1]);
  },
};
function subtracted(a, b) { return [a[0] - b[0], a[1] - b[1], a[2] - b[2]]; }
function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
function cross(a, b) { return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]; }
function normalized(a) { const n = Math.hypot(...a) || 1; return [a[0] / n, a[1] / n, a[2] / n]; }

const pointVertexShader = `#version 300 es
layout(location = 0) in vec3 place;
layout(location = 1) in float intensity;
uniform mat4 view_projection;
uniform vec3 scale, offset;
uniform vec2 heights;
uniform float size, by_intensity;
out float shade;
void main() {
  vec3 world = place * scale + offset;
  gl_Position = view_projection * vec4(world, 1.0);
  gl_PointSize = clamp(size / gl_Position.w, 1.5, 40.0);
  float height = clamp((world.z - heights.x) / (heights.y - heights.x), 0.0, 1.0);
  shade = mix(height, intensity, by_intensity);
}`;
const pointFragmentShader = `#version 300 es
precision mediump float;
in float shade;
uniform sampler2D ramp;
out vec4 color;
void main() {
  vec2 p = gl_PointCoord - 0.5;
  if (dot(p, p) > 0.25) discard;
  color = vec4(texture(ramp, vec2(shade * 0.992 + 0.004, 0.5)).rgb, 1.0);
}`;
const screenVertexShader = `#version 300 es
void main() { gl_Position = vec4(vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1), 0, 1); }`;
const screenFragmentShader = `#version 300 es
precision highp float;
uniform sampler2D colors;
uniform highp sampler2D depths;
uniform vec2 near_far;
uniform vec3 sky_low, sky_high;
uniform vec2 viewport;
uniform float radius;
out vec4 color;
float logDepth(ivec2 pixel) {
  float d = texelFetch(depths, clamp(pixel, ivec2(0), ivec2(viewport) - 1), 0).r;
  return log2(2.0 * near_far.x * near_far.y / (near_far.y + near_far.x - (2.0 * d - 1.0) * (near_far.y - near_far.x)));
}
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (texelFetch(depths, pixel, 0).r >= 1.0) {
    color = vec4(mix(sky_low, sky_high, smoothstep(0.0, 1.0, gl_FragCoord.y / viewport.y)), 1.0);
    return;
  }
  float here = logDepth(pixel), sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    float angle = 0.785398 * float(i);
    sum += max(0.0, here - logDepth(pixel + ivec2(round(radius * vec2(cos(angle), sin(angle))))));
  }
  color = vec4(texelFetch(colors, pixel, 0).rgb * exp(-4.5 * sum), 1.0);
}`;
const lineVertexShader = `#version 300 es
layout(location = 0) in vec3 start;
layout(location = 1) in vec3 end;
layout(location = 2) in vec2 time_value;
uniform mat4 view_projection;
uniform vec2 viewport;
uniform float width;
out float across, time, value;
void main() {
  vec4 a = view_projection * vec4(start, 1.0), b = view_projection * vec4(end, 1.0);
  float near = 0.02;
  if (a.w < near && b.w < near) { gl_Position = vec4(2, 2, 2, 1); return; }
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * viewport;
  along = length(along) < 1e-4 ? vec2(1, 0) : normalize(along);
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  vec4 p = gl_VertexID < 2 ? a : b;
  across = side * (0.5 * width + 1.0);
  p.xy += (across * vec2(-along.y, along.x) + (gl_VertexID < 2 ? -0.4 : 0.4) * along) * 2.0 / viewport * p.w;
  time = time_value.x;
  value = time_value.y;
  gl_Position = p;
}`;
const lineFragmentShader = `#version 300 es
precision highp float;
in float across, time, value;
uniform highp sampler2D depths;
uniform sampler2D ramp;
uniform vec2 near_far;
uniform vec4 line_color;
uniform float width, now, by_value, behind, ahead;
out vec4 color;
float linear(float d) {
  return 2.0 * near_far.x * near_far.y / (near_far.y + near_far.x - (2.0 * d - 1.0) * (near_far.y - near_far.x));
}
void main() {
  float alpha = line_color.a * clamp(0.5 * width + 0.5 - abs(across), 0.0, 1.0);
  float surface = linear(texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r);
  if (linear(gl_FragCoord.z) > surface * 1.01 + 0.1) alpha *= behind;
  if (time > now) alpha *= ahead;
  vec3 rgb = by_value > 0.5 ? texture(ramp, vec2(value, 0.5)).rgb : line_color.rgb;
  color = vec4(rgb, alpha);
}`;

function hexColor(text) {
  const n = parseInt(text.slice(1), 16);
  return [(n >> 16 & 255) / 255, (n >> 8 & 255) / 255, (n & 255) / 255];
}

// Stops at equal distances, after Crameri's "batlow" and others that keep their order for colour-blind eyes.
const ramps = {
  height: ["#2b4a78", "#2f7391", "#4a9c97", "#86bb8d", "#c9cf8b", "#eec07a", "#f09a66", "#f7d3bd"],
  intensity: ["#2b2d33", "#4a4844", "#6f6a62", "#968f83", "#bdb5a6", "#e2dacb", "#fbf6ea"],
  error: ["#2c7bb6", "#7fc5d8", "#f2e394", "#f59053", "#d7191c"],
};
function rampPixels(stops) {
  const pixels = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const place = i / 255 * (stops.length - 1);
    const low = Math.min(Math.floor(place), stops.length - 2);
    const a = hexColor(stops[low]), b = hexColor(stops[low + 1]);
    for (let c = 0; c < 3; ++c) pixels[4 * i + c] = 255 * (a[c] + (place - low) * (b[c] - a[c]));
    pixels[4 * i + 3] = 255;
  }
  return pixels;
}

// Draws `map` ({bytes, count, scale, offset, heights}) and lines into a canvas. Null where there is no WebGL 2.
function createScene(canvas, map, bounds, colors) {
  const gl = canvas.getContext("webgl2", { alpha: false, antialias: false, preserveDrawingBuffer: true });
  if (!gl) return null;

  function program(vertex, fragment) {
    const made = gl.createProgram();
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    const at = {};
    for (let i = 0; i < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); ++i) {
      const name = gl.getActiveUniform(made, i).name;
      at[name] = gl.getUniformLocation(made, name);
    }
    return { made, at };
  }
  const points = program(pointVertexShader, pointFragmentShader);
  const screen = program(screenVertexShader, screenFragmentShader);
  const strokes = program(lineVertexShader, lineFragmentShader);

  function texture(format) {
    const made = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, made);
    for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, format], [gl.TEXTURE_MAG_FILTER, format],
      [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) gl.texParameteri(gl.TEXTURE_2D, key, value);
    return made;
  }
  const rampTextures = {};
  for (const [name, stops] of Object.entries(ramps)) {
    rampTextures[name] = texture(gl.LINEAR);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, rampPixels(stops));
  }
  const colorTexture = texture(gl.NEAREST), depthTexture = texture(gl.NEAREST);
  const frame = gl.createFramebuffer();

  const pointArray = gl.createVertexArray(), emptyArray = gl.createVertexArray();
  if (map) {
    gl.bindVertexArray(pointArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, map.bytes, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, true, 8, 0);
    gl.enableVertexAttribArray(1);
    gl.vertexAttribPointer(1, 1, gl.UNSIGNED_BYTE, true, 8, 6);
  }

  const lines = new Map();
  // Rows x, y, z, time, value; `pairs`: each two rows are a piece of their own, else all are one path.
  function setLine(name, rows, style) {
    let line = lines.get(name);
    if (!line) {
      line = { array: gl.createVertexArray(), buffer: gl.createBuffer() };
      lines.set(name, line);
    }
    Object.assign(line, { width: 2, alpha: 1, behind: 0.35, ahead: 1, visible: true }, style);
    gl.bindVertexArray(line.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, line.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, rows, gl.DYNAMIC_DRAW);
    const stride = line.pairs ? 40 : 20;
    for (const [index, size, offset] of [[0, 3, 0], [1, 3, 20], [2, 2, 12]]) {
      gl.enableVertexAttribArray(index);
      gl.vertexAttribPointer(index, size, gl.FLOAT, false, stride, offset);
      gl.vertexAttribDivisor(index, 1);
    }
    line.count = line.pairs ? rows.length / 10 : Math.max(0, rows.length / 5 - 1);
  }

  const reach = Math.max(4, 0.62 * Math.hypot(...subtracted(bounds.high, bounds.low)));
  const middle = [0, 1, 2].map(i => 0.5 * (bounds.low[i] + bounds.high[i]));
  const view = { target: middle.slice(), distance: reach, azimuth: -2.2, elevation: 0.62, size: map ? map.size : 0.1,
    coloring: "height", now: Infinity, showMap: true };
  const fieldOfView = 0.75;

  function camera() {
    const c = Math.cos(view.elevation);
    const eye = [view.target[0] + view.distance * c * Math.cos(view.azimuth),
      view.target[1] + view.distance * c * Math.sin(view.azimuth), view.target[2] + view.distance * Math.sin(view.elevation)];
    const near = Math.max(0.02, 0.02 * view.distance), far = view.distance + 400;
    const looking = matrix.lookAt(eye, view.target);
    const projection = matrix.perspective(fieldOfView, canvas.width / canvas.height, near, far);
    return { eye, near, far, looking, both: matrix.multiply(projection, looking) };
  }

  let targetSize = "";
  function resize() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
    const size = width + "x" + height;
    if (size === targetSize) return ratio;
    targetSize = size;
    gl.bindTexture(gl.TEXTURE_2D, colorTexture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
    gl.bindTexture(gl.TEXTURE_2D, depthTexture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.DEPTH_COMPONENT24, width, height, 0, gl.DEPTH_COMPONENT, gl.UNSIGNED_INT, null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, colorTexture, 0);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depthTexture, 0);
    return ratio;
  }
  // So far away that the whole path is seen, also where the canvas is narrow.
  function fit(factor) { return factor * reach / Math.min(1, 0.75 * canvas.clientWidth / Math.max(1, canvas.clientHeight)); }

  function drawPoints(cam, ratio) {
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.disable(gl.BLEND);
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(0, 0, 0, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (!map || !view.showMap) return;
    gl.useProgram(points.made);
    gl.uniformMatrix4fv(points.at.view_projection, false, cam.both);
    gl.uniform3fv(points.at.scale, map.scale);
    gl.uniform3fv(points.at.offset, map.offset);
    gl.uniform2fv(points.at.heights, map.heights);
    gl.uniform1f(points.at.size, ratio * view.size * canvas.clientHeight / (2 * Math.tan(fieldOfView / 2)));
    gl.uniform1f(points.at.by_intensity, view.coloring === "intensity" ? 1 : 0);
    gl.bindTexture(gl.TEXTURE_2D, rampTextures[view.coloring]);
    gl.bindVertexArray(pointArray);
    gl.drawArrays(gl.POINTS, 0, map.count);
  }

  function shadeScreen(cam, ratio) {
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.disable(gl.DEPTH_TEST);
    gl.useProgram(screen.made);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, depthTexture);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, colorTexture);
    gl.uniform1i(screen.at.depths, 1);
    gl.uniform2f(screen.at.near_far, cam.near, cam.far);
    gl.uniform2f(screen.at.viewport, canvas.width, canvas.height);
    gl.uniform1f(screen.at.radius, 1.4 * ratio);
    gl.uniform3fv(screen.at.sky_low, hexColor(colors("--sky-low")));
    gl.uniform3fv(screen.at.sky_high, hexColor(colors("--sky-high")));
    gl.bindVertexArray(emptyArray);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  function drawLines(cam, ratio) {
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE);
    gl.useProgram(strokes.made);
    gl.uniformMatrix4fv(strokes.at.view_projection, false, cam.both);
    gl.uniform2f(strokes.at.viewport, canvas.width, canvas.height);
    gl.uniform2f(strokes.at.near_far, cam.near, cam.far);
    gl.uniform1i(strokes.at.depths, 1);
    gl.bindTexture(gl.TEXTURE_2D, rampTextures.error);
    for (const line of lines.values()) {
      if (!line.visible || line.count < 1) continue;
      gl.uniform1f(strokes.at.width, ratio * line.width);
      gl.uniform1f(strokes.at.now, line.timed === false ? Infinity : Math.min(view.now, 1e9));
      gl.uniform1f(strokes.at.ahead, line.ahead);
      gl.uniform1f(strokes.at.behind, line.behind);
      gl.uniform1f(strokes.at.by_value, line.byValue ? 1 : 0);
      gl.uniform4f(strokes.at.line_color, ...hexColor(line.color.startsWith("--") ? colors(line.color) : line.color), line.alpha);
      gl.bindVertexArray(line.array);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, line.count);
    }
  }

  const listeners = [];
  function draw() {
    const ratio = resize();
    const cam = camera();
    drawPoints(cam, ratio);
    shadeScreen(cam, ratio);
    drawLines(cam, ratio);
    for (const listener of listeners) listener(cam);
  }
  let waiting = false;
  function request() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; draw(); });
  }

  // Pixel (CSS) of a place; null behind the camera.
  function project(place) {
    const m = camera().both;
    const w = m[3] * place[0] + m[7] * place[1] + m[11] * place[2] + m[15];
    if (w <= 0) return null;
    const x = (m[0] * place[0] + m[4] * place[1] + m[8] * place[2] + m[12]) / w;
    const y = (m[1] * place[0] + m[5] * place[1] + m[9] * place[2] + m[13]) / w;
    return [(0.5 + 0.5 * x) * canvas.clientWidth, (0.5 - 0.5 * y) * canvas.clientHeight];
  }

  function turn(dx, dy) {
    view.azimuth -= 0.006 * dx;
    view.elevation = Math.min(1.5707, Math.max(-0.3, view.elevation + 0.006 * dy));
  }
  function shift(dx, dy) {
    const m = camera().looking, step = 2 * Math.tan(fieldOfView / 2) * view.distance / canvas.clientHeight;
    for (let i = 0; i < 3; ++i) view.target[i] += step * (-dx * m[4 * i] + dy * m[4 * i + 1]);
  }
  function zoom(factor) { view.distance = Math.min(2000, Math.max(0.5, view.distance * factor)); }

  const pointers = new Map();
  let travelled = 0;
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, event);
    travelled = 0;
  });
  canvas.addEventListener("pointermove", event => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last.clientX, dy = event.clientY - last.clientY;
    travelled += Math.abs(dx) + Math.abs(dy);
    if (pointers.size === 2) {
      const other = [...pointers.values()].find(pointer => pointer.pointerId !== event.pointerId);
      const before = Math.hypot(last.clientX - other.clientX, last.clientY - other.clientY);
      const after = Math.hypot(event.clientX - other.clientX, event.clientY - other.clientY);
      if (after > 0) zoom(before / after);
      shift(0.5 * dx, 0.5 * dy);
    } else if (event.buttons & 2 || event.shiftKey) {
      shift(dx, dy);
    } else {
      turn(dx, dy);
    }
    pointers.set(event.pointerId, event);
    request();
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, event => pointers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    zoom(Math.exp(Math.min(0.5, Math.max(-0.5, 0.0015 * event.deltaY))));
    request();
  }, { passive: false });
  new ResizeObserver(request).observe(canvas);

  view.distance = fit(1.75);
  return { view, setLine, lines, request, draw, project, listeners, middle, reach, fit, isClick: () => travelled < 6,
    metresPerPixel: () => 2 * Math.tan(fieldOfView / 2) * view.distance / canvas.clientHeight };
}
