// diptych: steps through the increments and draws the chosen maps. SPDX-License-Identifier: LGPL-2.1-or-later
"use strict";
const increments = new Map(data.increments.map((increment) => [increment.key, increment]));
const chosen = { quantity: data.quantities[0], place: data.quantities[0].home, arrows: "increment" };
const all = (selector, root) => Array.from((root || document).querySelectorAll(selector));
let paper = 0;  // width of a map in print [CSS pixels]; 0 on a screen
let pixels = Math.min(3, Math.max(2, window.devicePixelRatio || 1));

// Numbers of one panel for a quantity. With the place "discs" the continuum shows its cells.
function shown(increment, panel, quantity, place) {
  const stored = (increment.values[quantity.key] || {})[place];
  const cells = place === "grid" ? increment.grid : increment.cells;
  const discs = place === "points" || panel === "measured" ? increment.points
              : place === "discs" && panel === "discrete" ? increment.discs : null;
  return { limits: stored ? stored.limits : null, numbers: stored ? values(stored[panel]) : null, discs, cells };
}

function bandText(increment, panel) {
  const bands = increment.bands[panel];
  return bands.map(([angle]) => angle === null ? "diffuse zone" : "band at " + numeral(angle, 0) + " degrees").join("; ") || "no band detected";
}

function drawQuantity(view, increment, panel, canvas) {
  const { limits, numbers, discs, cells } = shown(increment, panel, chosen.quantity, chosen.place);
  if (!numbers) return "";
  if (discs) drawDiscs(view, discs, numbers, chosen.quantity.map, limits);
  else (chosen.place === "discs" ? drawSmooth : drawCells)(view, cells, numbers, chosen.quantity.map, limits);
  drawOutline(view, increment);
  drawBands(view, increment, panel, true);
  Object.assign(canvas.dataset, { quantity: chosen.quantity.key, low: limits[0], high: limits[1] });
  const what = numbers.length + (!discs ? " cells" : discs === increment.points ? " points" : " grains as discs");
  return chosen.quantity.label + ", " + what + "; " + bandText(increment, panel);
}

// Continuum minus grains on the same cells; for the panel "error" the standard error of the grains.
function differenceOf(increment, panel) {
  const place = chosen.place === "grid" ? "grid" : "cells", cells = place === "grid" ? increment.grid : increment.cells;
  const quantity = panel === "error" ? data.quantities.find((q) => q.key === "error") : chosen.quantity;
  const stored = quantity && (increment.values[quantity.key] || {})[place];
  if (!stored) return null;
  if (panel === "error") return { cells, quantity, limits: stored.limits, numbers: values(stored.discrete) };
  const left = values(stored.discrete), right = values(stored.continuum);
  if (!left || !right) return null;
  const numbers = left.map((value, k) => right[k] - value);
  const sizes = Array.from(numbers).filter((v) => v === v).map(Math.abs).sort((a, b) => a - b);
  const reach = Number((sizes[Math.floor(0.98 * (sizes.length - 1))] || 1).toPrecision(2));
  const shownAs = { map: "RdBu_r", label: "continuum − grains: " + quantity.label };
  return { cells, numbers, limits: [-reach, reach], quantity: shownAs };
}

function drawDifference(view, increment, panel) {
  const found = differenceOf(increment, panel);
  if (!found || !found.numbers) return "";
  drawCells(view, found.cells, found.numbers, found.quantity.map, found.limits);
  drawOutline(view, increment);
  return found.quantity.label + ", " + found.numbers.length + " cells";
}

const counted = (draw, what) => (view, increment, panel) => {
  const n = draw(view, increment, panel, chosen.arrows);
  return n ? n + " " + what + "; " + bandText(increment, panel) : "";
};
const DRAWINGS = {
  quantity: drawQuantity, difference: drawDifference,
  arrows: counted(drawArrows, "arrows of displacement or velocity"),
  crosses: counted(drawCrosses, "crosses of principal stresses"),
  forces: counted(drawForces, "forces, thickness by size"),
  probes: counted(drawProbes, "probes with their principal stresses as crosses"),
};

function drawPair(pair, key) {
  const increment = increments.get(key);
  if (!increment) return;
  for (const canvas of all("canvas.map", pair)) drawMap(canvas, pair.dataset.draw, increment);
  for (const bar of all("canvas.bar", pair.parentElement)) drawBarOf(bar, increment);
}

function drawMap(canvas, drawing, increment) {
  const panel = canvas.dataset.panel, frame = canvas.parentElement;
  const view = viewOf(canvas, parseInt(frame.style.width) || paper || frame.clientWidth || 400, pixels);
  clipToAxes(view);
  const words = DRAWINGS[drawing](view, increment, panel, canvas);
  drawAxes(view);
  canvas.dataset.key = increment.key;
  canvas.dataset.drawn = words ? "yes" : "no";
  const reason = panel === "measured" ? "not measured" : increment.kind === "window" ? "only stages store this; choose a stage"
               : panel === "continuum" ? "not defined for the continuum" : "not stored";
  canvas.setAttribute("aria-label",
                      (data.panels[panel] || canvas.dataset.title) + ", " + increment.title + ": " + (words || reason));
  frame.classList.toggle("empty", !words);
  all(".none", frame).forEach((none) => { none.textContent = reason; });
}

function drawBarOf(bar, increment) {
  const width = paper * (bar.dataset.of === "pair" ? 1.5 : 1) || bar.parentElement.clientWidth || 400;
  if (bar.dataset.of !== "pair") {
    const found = differenceOf(increment, bar.dataset.of);
    bar.hidden = !found || !found.numbers;
    if (!bar.hidden) drawBar(bar, width, pixels, found.quantity, found.limits, beyond([found.numbers], found.limits));
    return;
  }
  const both = panes.map((panel) => shown(increment, panel, chosen.quantity, chosen.place));
  const limits = both[0].limits;
  bar.hidden = !limits;
  if (limits) drawBar(bar, width, pixels, chosen.quantity, limits, beyond(both.map((b) => b.numbers), limits));
}

function beyond(sets, limits) {
  const every = sets.filter((set) => set);
  return [every.some((set) => set.some((v) => v < limits[0])), every.some((set) => set.some((v) => v > limits[1]))];
}

// The largest width at which both maps of a pair and their controls fit the screen.
function fit() {
  const [x0, x1, y0, y1] = data.box;
  for (const pair of all(".pair[data-draw]")) {
    const tall = Math.max(300, (pair.dataset.draw === "quantity" ? 0.47 : 0.72) * window.innerHeight);
    pair.style.setProperty("--map-width", Math.round((tall - 40) * (x1 - x0) / (y1 - y0) + 44) + "px");
  }
}

function refresh(part) {
  const radio = part.querySelector(".stepper input:checked"), key = radio ? radio.dataset.key : null;
  all(".pane", part).forEach((pane) => pane.classList.toggle("open", pane.dataset.key === key));
  all(".pair[data-draw]", part).forEach((pair) => drawPair(pair, key));
  const slider = part.querySelector("input[type=range]");
  if (slider && radio) {
    const stages = all('.stepper input[data-kind="stage"]', part), { title } = increments.get(key);
    const at = stages.findIndex((stage) => stage.dataset.end === radio.dataset.end);
    if (at >= 0) slider.value = at;
    slider.setAttribute("aria-valuetext", title);
    part.querySelector(".now").textContent = title;
  }
  if (hover.part === part) hideReadout();
}

// Shows the meaning of the chosen numbers, from the files.
function showMeaning() {
  document.getElementById("meaning").textContent = (chosen.quantity.meaning || {})[chosen.place] || "";
}

function refreshAll() {
  fit();
  all("section.part").forEach(refresh);
}

// Chooses an increment in one part, and the same one (or one with the same end) in all other parts.
function choose(radio) {
  radio.checked = true;
  const own = radio.closest("section.part");
  refresh(own);
  if (!document.getElementById("together").checked) return;
  for (const part of all("section.part")) {
    if (part === own) continue;
    const other = part.querySelector('.stepper input[data-key="' + radio.dataset.key + '"]') ||
                  part.querySelector('.stepper input[data-end="' + radio.dataset.end + '"]');
    if (other) other.checked = true, refresh(part);
  }
}

function chooseQuantity(key) {
  chosen.quantity = data.quantities.find((quantity) => quantity.key === key);
  chosen.place = chosen.quantity.home;
  offerPlaces();
  all('section.part').filter((part) => part.querySelector('[data-draw="quantity"], [data-draw="difference"]'))
    .forEach(refresh);
}

function offerPlaces() {
  const names = { discs: "grains as discs", cells: "both on the cells of the mesh", grid: "both on a regular grid",
                  points: "all at the measured points, levelled" };
  const place = document.getElementById("place");
  place.replaceChildren(
    ...chosen.quantity.places.map((key) => new Option(names[key], key, false, key === chosen.place)));
  showMeaning();
}

document.addEventListener("change", (event) => {
  const target = event.target;
  if (target.id === "quantity") chooseQuantity(target.value);
  else if (target.id === "place") chosen.place = target.value, showMeaning(), all("section.part").forEach(refresh);
  else if (target.id === "arrows-kind") chosen.arrows = target.value, all("section.part").forEach(refresh);
  else if (target.dataset.key && target.type === "radio") choose(target);
});
document.addEventListener("input", (event) => {
  if (event.target.type !== "range") return;
  choose(all('.stepper input[data-kind="stage"]', event.target.closest("section.part"))[Number(event.target.value)]);
});
