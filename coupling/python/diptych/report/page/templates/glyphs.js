// diptych: draws arrows, crosses, forces and probes on a map. SPDX-License-Identifier: LGPL-2.1-or-later
"use strict";
const ARROW = 4;  // d, drawn length of the increment of the upper platen

// A legend in the lower right corner: a line and its meaning.
function drawKey(view, length, thick, colour, words) {
  const c = view.c, x = view.right - 8, y = view.bottom - 11;
  letters(c, "right", "middle");
  const wide = c.measureText(words).width + length + 14;
  c.fillStyle = "rgba(255, 255, 255, 0.9)";
  c.fillRect(x - wide + 4, y - 9, wide, 18);
  pen(c, colour, thick);
  c.beginPath();
  c.moveTo(x - length, y), c.lineTo(x, y);
  c.stroke();
  c.fillStyle = INK;
  c.fillText(words, x - length - 5, y);
}

function arrow(view, x, y, u, v) {
  const c = view.c, px = view.x(x), py = view.y(y), dx = view.scale * ARROW * u, dy = -view.scale * ARROW * v;
  const long = Math.hypot(dx, dy), head = Math.min(4.5, 0.45 * long);
  c.beginPath();
  c.moveTo(px, py), c.lineTo(px + dx, py + dy);
  c.stroke();
  if (long < 1.5) return;
  const ex = dx / long, ey = dy / long;
  c.beginPath();
  c.moveTo(px + dx, py + dy);
  c.lineTo(px + dx - head * (ex + 0.5 * ey), py + dy - head * (ey - 0.5 * ex));
  c.lineTo(px + dx - head * (ex - 0.5 * ey), py + dy - head * (ey + 0.5 * ex));
  c.fill();
}

function drawArrows(view, increment, panel, which) {
  const stored = (increment.arrows[panel] || {})[which];
  if (!stored) return 0;
  const [x, y, u, v] = [stored.x, stored.y, stored.u, stored.v].map(values), c = view.c;
  pen(c, data.colours[panel], 0.9);
  for (let k = 0; k < x.length; ++k) arrow(view, x[k], y[k], u[k], v[k]);
  drawBands(view, increment, panel, false);
  drawKey(view, view.scale * ARROW, 1.5, data.colours[panel], "upper platen");
  return x.length;
}

function cross(view, x, y, angle, arms) {
  const c = view.c;
  arms.forEach((arm, k) => {
    const a = angle + k * Math.PI / 2, dx = view.scale * arm * Math.cos(a), dy = -view.scale * arm * Math.sin(a);
    c.moveTo(view.x(x) - dx, view.y(y) - dy), c.lineTo(view.x(x) + dx, view.y(y) + dy);
  });
}

// Principal stresses as lines; the half length is the stress. Tension is grey.
function drawCrosses(view, increment, panel) {
  const stored = increment.crosses[panel];
  if (!stored) return 0;
  const [x, y, s1, s2, a] = [stored.x, stored.y, stored.s1, stored.s2, stored.a].map(values);
  const c = view.c, unit = data.cross_unit;
  pen(c, data.colours[panel], 0.8);
  c.beginPath();
  for (let k = 0; k < x.length; ++k) cross(view, x[k], y[k], a[k], [unit * s1[k], unit * Math.max(0, s2[k])]);
  c.stroke();
  c.strokeStyle = "#888888";
  c.beginPath();
  for (let k = 0; k < x.length; ++k) if (s2[k] < 0) cross(view, x[k], y[k], a[k], [0, unit * s2[k]]);
  c.stroke();
  drawBands(view, increment, panel, false);
  drawKey(view, view.scale * 4 * unit, 1.5, data.colours[panel], "2 P");
  return x.length;
}

// Grains: forces as segments of one diameter, centred at the contacts; the thickness is the force. Continuum: principal
// stresses as crosses of one size; the thickness is the force sigma d across one diameter.
function drawForces(view, increment, panel) {
  const c = view.c, unit = view.scale * data.force_unit;
  const stored = panel === "discrete" ? increment.forces : increment.crosses.continuum;
  if (!stored) return 0;
  const x = values(stored.x), y = values(stored.y), a = values(stored.a);
  const sizes = panel === "discrete" ? [values(stored.f)] : [values(stored.s1), values(stored.s2)];
  const arm = panel === "discrete" ? 0.5 : 0.8;
  c.strokeStyle = data.colours[panel];
  for (let k = 0; k < x.length; ++k) sizes.forEach((size, turn) => {
    const thick = unit * size[k];
    if (!(thick > 0.05)) return;
    c.lineWidth = thick;
    c.beginPath();
    cross(view, x[k], y[k], a[k] + turn * Math.PI / 2, [arm]);
    c.stroke();
  });
  drawBands(view, increment, panel, false);
  drawKey(view, 22, 5 * unit, data.colours[panel], "5 P d");
  return x.length;
}

// Half length of the line of 1 P [d]. The largest stress of both panels fits into the smallest probe.
function stressArm(increment, rectangles) {
  const extents = rectangles.flatMap((p) =>
    [0, 1].map((n) => p.polygon.map((q) => q[n])).map((u) => Math.max(...u) - Math.min(...u)));
  const stresses = Object.keys(increment.probes).flatMap((panel) =>
    increment.probes[panel].rectangles.map((p) => p.s1 || 0));
  return 0.46 * Math.min(...extents) / Math.max(1e-9, ...stresses);
}

function drawProbes(view, increment, panel) {
  const c = view.c, { rectangles, circle } = increment.probes[panel];
  if (increment.cells !== null) drawCells(view, increment.cells, "#eeeeee");
  drawOutline(view, increment);
  drawBands(view, increment, panel, false);
  const unit = stressArm(increment, rectangles);
  c.font = FONT;
  c.textAlign = "center";
  for (const probe of rectangles) {
    const [x, y] = [0, 1].map((n) => probe.polygon.reduce((sum, q) => sum + q[n], 0) / probe.polygon.length);
    pen(c, INK, 1);
    path(view, probe.polygon);
    c.closePath();
    c.stroke();
    if (probe.s1 !== null && probe.direction_deg !== null) {
      pen(c, data.colours[panel], 2.2);
      c.beginPath();
      cross(view, x, y, probe.direction_deg * Math.PI / 180, [unit * probe.s1, unit * Math.max(0, probe.s2 || 0)]);
      c.stroke();
    }
    nameProbe(view, probe);
  }
  if (circle) {
    c.setLineDash([3, 2]);
    pen(c, INK, 1);
    c.beginPath();
    c.arc(view.x(circle[0]), view.y(circle[1]), view.scale * circle[2], 0, 2 * Math.PI);
    c.stroke();
    c.setLineDash([]);
  }
  if (rectangles.length) drawKey(view, 2 * unit * view.scale, 2.2, data.colours[panel], "1 P");
  return rectangles.length + (circle ? 1 : 0);
}

// Puts the name above a horizontal rectangle, or below the lowest corner of an oblique one, where no other probe lies.
function nameProbe(view, probe) {
  const c = view.c, ys = probe.polygon.map((q) => q[1]), low = probe.polygon[ys.indexOf(Math.min(...ys))];
  const level = probe.polygon.filter((q) => Math.abs(q[1] - low[1]) < 1e-3).length > 1;
  const words = probe.name + (probe.t_over_s === null ? "" : ": t/s " + probe.t_over_s.toFixed(3));
  const half = c.measureText(words).width / 2;
  const x = level ? view.x(probe.polygon.reduce((s, q) => s + q[0], 0) / probe.polygon.length) : view.x(low[0]);
  c.textBaseline = level ? "bottom" : "top";
  const y = level ? view.y(Math.max(...ys)) - 2 : view.y(low[1]) + 3;
  const at = Math.max(view.left + half + 2, Math.min(view.right - half - 2, x));
  pen(c, "#ffffff", 3);
  c.lineJoin = "round";
  c.strokeText(words, at, y);
  c.fillStyle = INK;
  c.fillText(words, at, y);
}
