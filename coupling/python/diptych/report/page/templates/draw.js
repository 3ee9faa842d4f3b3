// diptych: draws one map on a canvas. SPDX-License-Identifier: LGPL-2.1-or-later
// Lengths are in mean diameters d, stresses in P. A "view" converts them to pixels.
"use strict";
const INK = "#222222", FONT = '11px Arial, "Liberation Sans", Helvetica, "DejaVu Sans", sans-serif';
const data = JSON.parse(document.getElementById("map-data").textContent);
const decoded = new Map();
const panes = ["discrete", "continuum", "measured"].filter((pane) => pane in data.panels);

// Values of one stored array; NaN: no value.
function values(id) {
  if (id === null || id === undefined) return null;
  if (!decoded.has(id)) {
    const { low, high, data: text } = data.arrays[id];
    const codes = new Uint16Array(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);
    decoded.set(id, Float32Array.from(codes, (code) => code === 65535 ? NaN : low + code * (high - low) / 65534));
  }
  return decoded.get(id);
}

function colourOf(map, limits, value) {
  if (!(value === value)) return data.no_value;
  const share = (value - limits[0]) / (limits[1] - limits[0]);
  return data.maps[map][Math.max(0, Math.min(255, Math.floor(256 * share)))];
}

// About n round numbers between two limits.
function ticks(low, high, n) {
  const rough = (high - low) / n, power = Math.pow(10, Math.floor(Math.log10(rough)));
  const step = power * [1, 2, 5, 10].find((m) => m * power >= rough * 0.999), out = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= Math.floor(high / step + 1e-9); ++k) out.push(k * step);
  return { at: out, digits: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}

function numeral(value, digits) {
  return value.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1").replace("-", "\u2212");
}

function pen(c, colour, thick) {
  Object.assign(c, { strokeStyle: colour, fillStyle: colour, lineWidth: thick });
}

function letters(c, align, baseline) {
  Object.assign(c, { font: FONT, textAlign: align, textBaseline: baseline });
}

// The white canvas of a given size, to draw in CSS pixels.
function cleared(canvas, width, height, pixels) {
  const c = canvas.getContext("2d");
  canvas.width = Math.round(width * pixels);
  canvas.height = Math.round(height * pixels);
  canvas.style.aspectRatio = width + " / " + height;
  c.setTransform(pixels, 0, 0, pixels, 0, 0);
  c.fillStyle = "#ffffff";
  c.fillRect(0, 0, width, height);
  return c;
}

// Prepares a canvas of a given width. Both axes have the same scale, which gives the height.
function viewOf(canvas, width, pixels) {
  const [x0, x1, y0, y1] = data.box, left = 38, right = 6, top = 6, bottom = 34;
  const scale = Math.max(0.1, (width - left - right) / (x1 - x0)), height = top + bottom + scale * (y1 - y0);
  return { c: cleared(canvas, width, height, pixels), scale, left, top, right: width - right, bottom: height - bottom,
           x: (x) => left + scale * (x - x0), y: (y) => top + scale * (y1 - y) };
}

function clipToAxes(view) {
  view.c.save();
  view.c.beginPath();
  view.c.rect(view.left, view.top, view.right - view.left, view.bottom - view.top);
  view.c.clip();
}

function drawAxes(view) {
  const c = view.c, [x0, x1, y0, y1] = data.box;
  c.restore();
  pen(c, INK, 0.8);
  c.strokeRect(view.left, view.top, view.right - view.left, view.bottom - view.top);
  const across = ticks(x0, x1, Math.max(2, Math.min(7, (view.right - view.left) / 45)));
  const up = ticks(y0, y1, Math.max(2, Math.min(8, (view.bottom - view.top) / 45)));
  c.beginPath();
  letters(c, "center", "top");
  for (const x of across.at) {
    c.moveTo(view.x(x), view.bottom), c.lineTo(view.x(x), view.bottom + 3);
    c.fillText(numeral(x, across.digits), view.x(x), view.bottom + 5);
  }
  c.fillText("x / d", (view.left + view.right) / 2, view.bottom + 19);
  letters(c, "right", "middle");
  for (const y of up.at) {
    c.moveTo(view.left, view.y(y)), c.lineTo(view.left - 3, view.y(y));
    c.fillText(numeral(y, up.digits), view.left - 5, view.y(y));
  }
  c.stroke();
  c.save();
  c.translate(9, (view.top + view.bottom) / 2);
  c.rotate(-Math.PI / 2);
  c.textAlign = "center";
  c.fillText("y / d", 0, 0);
  c.restore();
}

function drawDiscs(view, discs, numbers, map, limits) {
  const x = values(discs.x), y = values(discs.y), r = values(discs.r), c = view.c;
  for (let k = 0; k < x.length; ++k) {
    c.fillStyle = typeof numbers === "string" ? numbers : colourOf(map, limits, numbers[k]);
    c.beginPath();
    c.arc(view.x(x[k]), view.y(y[k]), view.scale * r[k], 0, 2 * Math.PI);
    c.fill();
  }
}

// The path through a list of places [d].
function path(view, places) {
  view.c.beginPath();
  places.forEach(([x, y], k) => k ? view.c.lineTo(view.x(x), view.y(y)) : view.c.moveTo(view.x(x), view.y(y)));
}

function drawCells(view, id, numbers, map, limits) {
  const corners = values(id), c = view.c;
  c.lineWidth = 0.6;
  for (let k = 0; 8 * k < corners.length; ++k) {
    // Edges in the colour of the face close the hairlines that anti-aliasing leaves between cells.
    c.fillStyle = c.strokeStyle = typeof numbers === "string" ? numbers : colourOf(map, limits, numbers[k]);
    path(view, [0, 2, 4, 6].map((n) => corners.subarray(8 * k + n, 8 * k + n + 2)));
    c.closePath();
    c.fill();
    c.stroke();
  }
}

// Colours between the nodes; the value of a node is the mean over its cells. Each cell is drawn in n x n parts.
function drawSmooth(view, id, numbers, map, limits) {
  const corners = values(id), c = view.c, known = new Map(), count = numbers.length;
  const nodeOf = (k, i) => corners[8 * k + 2 * i] + "," + corners[8 * k + 2 * i + 1];
  for (let k = 0; k < count; ++k)
    for (let i = 0; numbers[k] === numbers[k] && i < 4; ++i) {
      const [sum, n] = known.get(nodeOf(k, i)) || [0, 0];
      known.set(nodeOf(k, i), [sum + numbers[k], n + 1]);
    }
  const n = Math.max(2, Math.min(6, Math.floor(Math.sqrt(20000 / count))));
  const between = (four, s, t) => (1 - t) * ((1 - s) * four[0] + s * four[1]) + t * ((1 - s) * four[3] + s * four[2]);
  c.lineWidth = 0.6;
  for (let k = 0; k < count; ++k) {
    const [x, y] = [0, 1].map((axis) => [0, 2, 4, 6].map((i) => corners[8 * k + i + axis]));
    const four = [0, 1, 2, 3].map((i) => known.get(nodeOf(k, i)) || [NaN, 1]).map(([sum, cells]) => sum / cells);
    for (let part = 0; part < n * n; ++part) {
      const s = part % n / n, t = Math.floor(part / n) / n, h = 1 / n;
      c.fillStyle = c.strokeStyle = colourOf(map, limits, between(four, s + h / 2, t + h / 2));
      const ends = [[s, t], [s + h, t], [s + h, t + h], [s, t + h]];
      path(view, ends.map(([a, b]) => [between(x, a, b), between(y, a, b)]));
      c.closePath();
      c.fill();
      c.stroke();
    }
  }
}

function drawOutline(view, increment) {
  pen(view.c, INK, 0.7);
  for (const side of increment.outline) {
    path(view, side);
    view.c.stroke();
  }
}

// Centre line of each band, and dashed lines at plus and minus half its 10-90 % width. On colours the lines are white
// with a dark rim. Bands with less than half of the largest jump are fainter.
function drawBands(view, increment, panel, onColour) {
  const c = view.c, far = 4 * (data.box[1] - data.box[0] + data.box[3] - data.box[2]);
  const bands = increment.bands[panel], strongest = Math.max(0, ...bands.map((band) => Math.abs(band[3] || 0)));
  for (const [angle, offset, width, jump] of bands) {
    if (angle === null) continue;
    const a = angle * Math.PI / 180, half = (width || 0) / 2;
    c.globalAlpha = Math.abs(jump || 0) < 0.5 * strongest ? 0.45 : 1;
    for (const shift of half > 0 ? [0, -half, half] : [0]) {
      const along = (offset || 0) + shift;  // the band's normal (-sin, cos)
      const x = increment.centre[0] - Math.sin(a) * along, y = increment.centre[1] + Math.cos(a) * along;
      c.setLineDash(shift === 0 ? [] : [6, 4]);
      for (const [colour, thick] of onColour ? [["#000000", 3], ["#ffffff", 1.5]] : [[INK, 1]]) {
        pen(c, colour, thick);
        path(view, [-far, far].map((reach) => [x + reach * Math.cos(a), y + reach * Math.sin(a)]));
        c.stroke();
      }
    }
  }
  c.setLineDash([]);
  c.globalAlpha = 1;
}

// Lines of a text no wider than width, in FONT, broken at spaces.
function wrapped(canvas, text, width) {
  const c = canvas.getContext("2d"), lines = [];
  c.setTransform(1, 0, 0, 1, 0, 0);
  c.font = FONT;
  for (const word of text.split(" ")) {
    const longer = lines.length ? lines[lines.length - 1] + " " + word : word;
    if (lines.length && c.measureText(longer).width <= width) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

// One colour bar for a pair of maps. An arrow at an end marks values beyond it.
function drawBar(canvas, width, pixels, quantity, limits, beyond) {
  const lines = wrapped(canvas, quantity.label, width);
  const inset = Math.max(24, 0.12 * width), c = cleared(canvas, width, 32 + 14 * lines.length, pixels);
  const long = width - 2 * inset, table = data.maps[quantity.map];
  // Each colour is painted to the end and the next one over it, so there are no seams.
  table.forEach((colour, k) => {
    c.fillStyle = colour;
    c.fillRect(inset + long * k / 256, 2, long * (1 - k / 256), 10);
  });
  [[0, -1], [1, 1]].forEach(([end, sense]) => {
    if (!beyond[end]) return;
    const x = inset + end * long;
    c.fillStyle = table[255 * end];
    c.beginPath();
    c.moveTo(x, 2), c.lineTo(x + 9 * sense, 7), c.lineTo(x, 12);
    c.fill();
  });
  const marks = ticks(limits[0], limits[1], Math.max(3, Math.min(7, long / 55)));
  pen(c, INK, 0.8);
  letters(c, "center", "top");
  for (const mark of marks.at) {
    const x = inset + long * (mark - limits[0]) / (limits[1] - limits[0]);
    c.fillRect(x - 0.4, 12, 0.8, 3);
    c.fillText(numeral(mark, marks.digits), x, 17);
  }
  lines.forEach((line, k) => { c.fillText(line, width / 2, 32 + 14 * k); });
}
