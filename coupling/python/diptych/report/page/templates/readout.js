// diptych: shows the values under the pointer in both panels, and draws the maps of a print.
// SPDX-License-Identifier: LGPL-2.1-or-later
"use strict";
const hover = { part: null };

function discAt(discs, x, y) {
  const xs = values(discs.x), ys = values(discs.y), rs = values(discs.r);
  for (let k = 0; k < xs.length; ++k) if ((xs[k] - x) ** 2 + (ys[k] - y) ** 2 <= rs[k] ** 2) return k;
  return -1;
}

// Index of the convex cell that contains a point; the corners are in order.
function cellAt(id, x, y) {
  const q = values(id);
  for (let k = 0; 8 * k < q.length; ++k) {
    let left = 0, right = 0;
    for (let n = 0; n < 4; ++n) {
      const a = 8 * k + 2 * n, b = 8 * k + 2 * ((n + 1) % 4);
      const side = (q[b] - q[a]) * (y - q[a + 1]) - (q[b + 1] - q[a + 1]) * (x - q[a]);
      if (side >= 0) ++left;
      if (side <= 0) ++right;
    }
    if (left === 4 || right === 4) return k;
  }
  return -1;
}

function valueAt(increment, panel, x, y) {
  const { numbers, discs, cells } = shown(increment, panel, chosen.quantity, chosen.place);
  if (!numbers) return "–";
  const k = discs ? discAt(discs, x, y) : cellAt(cells, x, y);
  if (k < 0 || !(numbers[k] === numbers[k])) return "–";
  return numeral(numbers[k], Math.max(0, 2 - Math.floor(Math.log10(Math.abs(numbers[k]) || 1))));  // three digits
}

function hideReadout() {
  all(".hair").forEach((hair) => { hair.hidden = true; });
  all("output.readout").forEach((readout) => { readout.textContent = ""; });
}

document.addEventListener("pointermove", (event) => {
  const canvas = event.target.closest ? event.target.closest('.pair[data-draw="quantity"] canvas.map') : null;
  if (!canvas) return hover.part && (hover.part = null, hideReadout());
  hover.part = canvas.closest("section.part");
  const increment = increments.get(canvas.dataset.key), frame = canvas.getBoundingClientRect();
  const [x0, x1, , y1] = data.box;
  const scale = Math.max(0.1, (frame.width - 44) / (x1 - x0));
  const x = x0 + (event.clientX - frame.left - 38) / scale, y = y1 - (event.clientY - frame.top - 6) / scale;
  hover.part.querySelector("output.readout").textContent =
    "x " + numeral(x, 1) + " d, y " + numeral(y, 1) + " d: " +
    panes.map((pane) => data.panels[pane].toLowerCase() + " " + valueAt(increment, pane, x, y)).join(", ");
  for (const hair of all(".hair", hover.part)) {
    hair.hidden = false;
    hair.style.left = event.clientX - frame.left + "px";
    hair.style.top = event.clientY - frame.top + "px";
  }
});

// A print shows every increment of the chosen quantity as a small pair of maps.
function fillSheet() {
  const sheet = document.getElementById("sheet");
  sheet.replaceChildren(...data.increments.map((increment) => {
    const cell = document.createElement("div"), words = document.createElement("p");
    cell.className = "thumbnail";
    words.textContent = increment.title + ": " + panes.map((pane) => data.panels[pane]).join(" | ").toLowerCase();
    words.className = "caption";
    for (const panel of panes) {
      const frame = document.createElement("span"), canvas = document.createElement("canvas");
      frame.style.width = "160px";
      canvas.dataset.panel = panel;
      frame.append(canvas);
      cell.append(frame);
    }
    cell.append(words);
    return cell;
  }));
  sheet.hidden = false;
  data.increments.forEach((increment, k) => {
    for (const canvas of all("canvas", sheet.children[k])) drawMap(canvas, "quantity", increment);
  });
}

window.addEventListener("beforeprint", () => {
  paper = 310;
  pixels = 2.5;
  hideReadout();
  refreshAll();
  fillSheet();
  all("details.printed").forEach((d) => { d.dataset.was = d.open ? "yes" : ""; d.open = true; });
});
window.addEventListener("afterprint", () => {
  paper = 0;
  pixels = Math.min(3, Math.max(2, window.devicePixelRatio || 1));
  document.getElementById("sheet").replaceChildren();
  document.getElementById("sheet").hidden = true;
  all("details.printed").forEach((d) => { d.open = d.dataset.was === "yes"; });
  refreshAll();
});
let waiting = 0;
window.addEventListener("resize", () => {
  cancelAnimationFrame(waiting);
  waiting = requestAnimationFrame(refreshAll);
});
offerPlaces();
refreshAll();
document.documentElement.dataset.ready = "yes";
