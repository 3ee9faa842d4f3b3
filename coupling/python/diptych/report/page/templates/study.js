// diptych: draws the curves of the ticked points of a study
// SPDX-License-Identifier: LGPL-2.1-or-later
"use strict";
const palette = ["#222222", "#0072B2", "#D55E00", "#007A5E", "#CC79A7", "#E69F00", "#56B4E9"];
const box = {left: 64, right: 700, top: 12, bottom: 312};
const picture = document.querySelector("#curves svg");
const boxes = [...document.querySelectorAll("input[data-point]")];

function element(name, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
  if (text !== undefined) made.textContent = text;
  picture.append(made);
}

// About five round numbers within a range.
function ticks(low, high) {
  const rough = (high - low) / 5, decade = 10 ** Math.floor(Math.log10(rough));
  const step = decade * [1, 2, 5, 10].find((m) => m * decade >= rough);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) found.push(k * step);
  return found;
}

function drawCurves() {
  picture.replaceChildren();
  const curve = curves[document.querySelector("#which").selectedIndex];
  if (!curve) return;
  const chosen = boxes.filter((b) => b.checked).map((b) => Number(b.dataset.point));
  const values = chosen.flatMap((k) => curve.rows[k].filter((v) => v !== null));
  if (!values.length)
    return element("text", {x: 360, y: 170, "text-anchor": "middle"}, "no curve; tick a finished point");
  let low = Math.min(0, ...values), high = Math.max(0, ...values);
  const room = 0.04 * (high - low || 1), last = curve.progress[curve.progress.length - 1] || 1;
  low -= low < 0 ? room : 0, high += high > 0 ? room : 0;
  const across = (x) => box.left + x / last * (box.right - box.left);
  const up = (y) => box.bottom - (y - low) / (high - low) * (box.bottom - box.top);
  const shown = (v) => Number(v.toPrecision(6)).toString().replace("-", "−");
  ticks(0, last).forEach((x) => {
    element("line", {x1: across(x), x2: across(x), y1: box.top, y2: box.bottom, stroke: "#e4e4e4"});
    element("text", {x: across(x), y: box.bottom + 16, "text-anchor": "middle"}, shown(x));
  });
  ticks(low, high).forEach((y) => {
    element("line", {x1: box.left, x2: box.right, y1: up(y), y2: up(y), stroke: "#e4e4e4"});
    element("text", {x: box.left - 6, y: up(y) + 4, "text-anchor": "end"}, shown(y));
  });
  element("text", {x: (box.left + box.right) / 2, y: box.bottom + 36, "text-anchor": "middle"},
          "progress of the loading");
  chosen.forEach((k, n) => {
    let path = "", pen = false;
    curve.rows[k].forEach((v, i) => {
      if (v !== null) path += `${pen ? "L" : "M"}${across(curve.progress[i]).toFixed(1)} ${up(v).toFixed(1)}`;
      pen = v !== null;
    });
    const colour = palette[n % palette.length], dash = ["", "6 3", "2 2"][Math.floor(n / palette.length) % 3];
    element("path", {d: path, fill: "none", stroke: colour, "stroke-width": 1.6,
                     "stroke-dasharray": dash, "data-curve": k});
    const row = boxes.find((b) => Number(b.dataset.point) === k).closest("tr").querySelector("th").textContent;
    element("text", {x: box.right - 6, y: box.bottom - 8 - 15 * (chosen.length - 1 - n), "text-anchor": "end",
                     style: `fill:${colour}`}, row);
  });
}

boxes.forEach((b) => b.addEventListener("change", drawCurves));
document.querySelector("#which").addEventListener("change", drawCurves);
drawCurves();
