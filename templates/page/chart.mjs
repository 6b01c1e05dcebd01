// The charts, as SVG: pure functions of what they show.
import { isEnginePeak } from "./spectrum.mjs";

/** Margins of the charts [px]; the slider above the spectra has the same. */
export const MARGIN = { left: 40, right: 14, top: 26, bottom: 40 };
const ROUND = [1, 1.2, 1.6, 2, 2.5, 3, 4, 5, 6, 8, 10];
const FREQUENCIES = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000];
const LINE = 16, LETTER = 7; // height of a line, and width of a letter, rather too large [px]

/** An SVG element with its attributes and children. */
export function element(name, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** The next round number, as the end of an axis that seldom has to move. */
export function roundUp(value) {
  const unit = 10 ** Math.floor(Math.log10(value));
  return unit * ROUND.find((step) => unit * step >= 0.999 * value);
}

export function force(newtons) {
  return `${(newtons / 1e6).toFixed(2)} MN`.replace("-", "−");
}

export function hertz(frequency) {
  return `${frequency.toFixed(frequency < 99.95 ? 1 : 0)} Hz`;
}

/** A number in three figures, or all before the decimal point. */
export function number(value) {
  return value >= 1000 ? Math.round(value).toLocaleString("en").replaceAll(",", " ") : String(Number(value.toPrecision(3)));
}

/** Fit a chart to the room that it has, so that its text keeps its size: before it is drawn. */
export function fit(svg) {
  svg.setAttribute("viewBox", `0 0 ${svg.clientWidth} ${svg.clientHeight}`);
}

function scale(from, to, first, last) {
  return (value) => first + ((value - from) / (to - from)) * (last - first);
}

export function text(words, x, y, className, anchor = "middle") {
  return element("text", { x, y, class: className, "text-anchor": anchor }, words);
}

export function path(places, className) {
  let d = "", pen = "M";
  for (const place of places) {
    if (place) d += `${pen}${place[0].toFixed(1)} ${place[1].toFixed(1)}`;
    pen = place ? "L" : "M";
  }
  return element("path", { d, class: className });
}

/** Marks that differ in shape as well as in colour: a circle for the engine, a square for cargo. */
function mark(body, x, y, className = "mark") {
  const attributes = { class: `${className} ${body}` };
  if (body === "engine") return element("circle", { cx: x, cy: y, r: 5.5, ...attributes });
  return element("rect", { x: x - 5, y: y - 5, width: 10, height: 10, ...attributes });
}

/** Round values from `low` to `high`, in so many steps at most. */
export function ticks(low, high, steps) {
  const least = (high - low) / steps, decade = 10 ** Math.floor(Math.log10(least));
  const unit = decade * [1, 2, 5, 10].find((n) => n * decade >= 0.999 * least), values = [];
  for (let n = Math.ceil(low / unit - 1e-9); n * unit <= high + 1e-4 * unit; n++) values.push(n * unit);
  return values;
}

/** The axis of forces with its grid, from `bottom` to `top` [N] in so many steps at most. */
function forceAxis(Y, bottom, top, left, right, steps) {
  const values = ticks(bottom, top, steps), whole = values.every((value) => Math.abs(value / 1e6 % 1) < 1e-9);
  return values.flatMap((value) => [
    element("line", { x1: left, x2: right, y1: Y(value), y2: Y(value), class: value ? "grid" : "axis" }),
    text((value / 1e6).toFixed(whole ? 0 : 1).replace("-", "−"), left - 7, Y(value) + 4, "tick", "end"),
  ]);
}

/** What the lines are, above the chart at the right; with their marks where they have some. */
function key(entries, right, y) {
  const items = [];
  for (const [kind, words, marked] of [...entries].reverse()) {
    right -= 6.5 * words.length;
    const line = { x1: right - 26, x2: right - 6, y1: y - 4, y2: y - 4, class: `curve ${kind}` };
    items.push(text(words, right, y, "key", "start"), element("line", line));
    if (marked) items.push(mark(kind, right - 16, y - 4));
    right -= 37;
  }
  return items;
}

/** Words on a ground of their own, which are read wherever they stand. */
export function tag(words, x, y, className, anchor) {
  const width = LETTER * words.length + 6;
  const left = { start: x - 3, middle: x - 0.5 * width, end: x + 3 - width }[anchor];
  return element("g", {},
    element("rect", { x: left, y: y - LINE + 2, width, height: LINE + 2, rx: 3, class: "ground" }),
    text(words, x, y, className, anchor));
}

function spectrumAxes(svg, range, top) {
  const { width, height } = svg.viewBox.baseVal;
  const left = MARGIN.left, right = width - MARGIN.right;
  const head = MARGIN.top, foot = height - MARGIN.bottom;
  const X = scale(Math.log(range.low), Math.log(range.high), left, right);
  const x = (frequency) => X(Math.log(frequency)), Y = scale(0, top, foot, head);
  return { x, Y, width, left, right, head, foot };
}

/**
 * Draw both spectra on one pair of axes.
 *
 * data: { points, bands, range: { low, high }, top [N] }, points and bands as `spectrum` has them.
 */
export function drawSpectrum(svg, { points, bands, range, top }) {
  const { x, Y, width, left, right, head, foot } = spectrumAxes(svg, range, top);
  const drawing = [], names = [];

  for (const { what, low, high } of bands) {
    const from = x(low), to = x(high);
    const area = { x: from, y: head, width: to - from, height: foot - head, class: `band ${what}` };
    drawing.push(element("rect", area));
    const words = [`${what} governs`, what].find((name) => LETTER * name.length < to - from - 10);
    if (words) names.push(tag(words, 0.5 * (from + to), head + LINE, `name ${what}`, "middle"));
  }
  drawing.push(...forceAxis(Y, 0, top, left, right, 7));
  for (const tick of new Set([range.low, ...FREQUENCIES, range.high])) {
    const ends = tick === range.low || tick === range.high;
    if (!ends && (tick < 1.4 * range.low || tick > range.high / 1.4)) continue;
    drawing.push(
      element("line", { x1: x(tick), x2: x(tick), y1: foot, y2: foot + 4, class: "axis" }),
      text(tick, x(tick), foot + 17, "tick"),
    );
  }
  drawing.push(
    text("Peak reaction of the pier [MN]", 4, 14, "label", "start"),
  );
  const [middle, ...ends] = width > 520
    ? ["Natural frequency of the pier [Hz]", "← softer pier", "stiffer pier →"]
    : ["Frequency [Hz]", "← softer pier", "stiffer pier →"];
  drawing.push(
    text(middle, 0.5 * (left + right), foot + 34, "label"),
    text(ends[0], left, foot + 34, "label", "start"),
    text(ends[1], right, foot + 34, "label", "end"),
  );

  drawing.push(...key([["engine", "engine", true], ["cargo", "cargo", true]], right, 14));

  const line = (body, shown) =>
    points.map((point) => (shown(point) ? [x(point.frequency), Y(point[body])] : null));
  drawing.push(
    path(line("engine", (point) => !isEnginePeak(point)), "curve crumpling"),
    path(line("cargo", (point) => point.cargo !== null), "curve cargo"),
    path(line("engine", isEnginePeak), "curve engine"),
  );
  // Every crossing is marked; the last, from which on one peak stays the larger, is named.
  const crossings = bands.filter((band) => band.crossing).map((band) => band.low);
  for (const frequency of crossings) {
    const at = x(frequency), y = Y(valueAt(points, frequency));
    drawing.push(
      element("line", { x1: at, x2: at, y1: y, y2: foot, class: "drop" }),
      element("circle", { cx: at, cy: y, r: 3.5, class: "crossing" }),
    );
  }
  if (crossings.length) {
    const words = `equal at ${hertz(crossings.at(-1))}`, half = 0.5 * LETTER * words.length;
    const place = Math.min(Math.max(x(crossings.at(-1)), left + half), right - half);
    drawing.push(tag(words, place, foot - 6, "value crossing", "middle"));
  }
  svg.replaceChildren(...drawing, element("g", { class: "pier-on-show" }), ...names);
}

/** Mark the pier `here`, a point of the spectra, on a drawing of `drawSpectrum`. */
export function drawHere(svg, { range, top, here }) {
  const { x, Y, left, right, head, foot } = spectrumAxes(svg, range, top);
  const at = x(here.frequency), late = at > left + 0.72 * (right - left);
  const marks = [element("line", { x1: at, x2: at, y1: head, y2: foot, class: "here" })];
  const bodies = ["engine", "cargo"].filter((body) => here[body] !== null);
  // Values above the upper mark and below the lower one, where the lines are not.
  const upper = here.cargo !== null && here.cargo > here.engine ? "cargo" : "engine";
  const beside = bodies.map((body) => Y(here[body]) + (body === upper ? -9 : 19));
  const heights = apart(beside, head + 2 * LINE + 4, foot - LINE - 8);
  bodies.forEach((body, n) => {
    const kind = body === "engine" && !isEnginePeak(here) ? "crumpling" : body;
    const [x, anchor] = late ? [at - 12, "end"] : [at + 12, "start"];
    marks.push(
      mark(body, at, Y(here[body]), kind === body ? "mark" : "mark crumpling"),
      tag(force(here[body]), x, heights[n], `value ${kind}`, anchor),
    );
  });
  svg.querySelector(".pier-on-show").replaceChildren(...marks);
}

function valueAt(points, frequency) {
  const n = Math.max(points.findIndex((point) => point.frequency >= frequency), 1);
  const [a, b] = [points[n - 1], points[n]];
  const share = Math.log(frequency / a.frequency) / Math.log(b.frequency / a.frequency);
  return a.engine + share * (b.engine - a.engine);
}

/** Move the heights of two labels apart where they would collide, and into their room. */
export function apart(heights, top, bottom) {
  const inside = (y) => Math.min(Math.max(y, top), bottom);
  const [a, b] = heights.map(inside);
  if (b === undefined || Math.abs(a - b) >= LINE) return [a, b];
  const middle = Math.min(Math.max(0.5 * (a + b), top + LINE / 2), bottom - LINE / 2);
  const sign = heights[0] < heights[1] ? -1 : 1;
  return [middle + (sign * LINE) / 2, middle - (sign * LINE) / 2];
}

/**
 * Draw the forces of one collision against time.
 *
 * data: { history: as `follow` returns it, end: of the axis [s], top, bottom: of the axis [N] }.
 */
export function drawHistory(svg, { history, end, top, bottom }) {
  const { X, Y, left, right } = historyAxes(svg, end, top, bottom);
  const drawing = [...forceAxis(Y, bottom, top, left, right, 5), ...timeAxis(svg, end)];
  const room = right - left > 300;
  const names = room
    ? [["engine thin", "on engine"], ["cargo thin", "on cargo"], ["reaction", "reaction"]]
    : [["engine thin", "engine"], ["cargo thin", "cargo"], ["reaction", "R"]];
  drawing.push(
    text(room ? "Force [MN]" : "[MN]", 4, 14, "label", "start"),
    ...key(names, right, 14),
  );
  const rows = history.rows.filter((row) => row[0] <= end);
  drawing.push(
    path(rows.map((row) => [X(row[0]), Y(row[7])]), "curve thin engine"),
    path(rows.map((row) => [X(row[0]), Y(row[8])]), "curve thin cargo"),
  );
  const count = Math.round(right - left);
  const times = Array.from({ length: count }, (_, n) => (n * end) / count);
  drawing.push(path(times.map((time) => [X(time), Y(history.reaction(time))]), "curve reaction"));
  const { outcome } = history;
  for (const body of ["engine", "cargo"]) {
    if (outcome[body] === null) continue;
    const kind = body === "engine" && !isEnginePeak(outcome) ? "mark crumpling" : "mark";
    drawing.push(mark(body, X(outcome[`${body}Time`]), Y(outcome[body]), kind));
  }
  svg.replaceChildren(...drawing, element("g", { class: "instant" }));
}

/** The axis of time, to its end [s]. */
function timeAxis(svg, end) {
  const { X, left, right, foot } = historyAxes(svg, end, 1, 0);
  const step = [0.05, 0.1, 0.2, 0.5, 1, 2, 5].find((each) => end / each <= 7) ?? end;
  const drawing = [text("Time after first touch [ms]", 0.5 * (left + right), foot + 31, "label")];
  for (let n = 0; n * step <= end * 1.001; n++) {
    const x = X(n * step);
    drawing.push(
      element("line", { x1: x, x2: x, y1: foot, y2: foot + 4, class: "axis" }),
      text(Math.round(1e3 * n * step), x, foot + 16, "tick"),
    );
  }
  return drawing;
}

/**
 * Draw where the truck's energy is against time, one share on the other.
 *
 * data: { shares: as `energyShares` returns them, end: of the axis [s] }.
 */
export function drawEnergy(svg, { shares, end }) {
  const { X, Y, left, right } = historyAxes(svg, end, 1, 0);
  const drawing = timeAxis(svg, end), known = shares.filter(({ time }) => time <= end);
  let below = known.map(() => 0), x = right;
  for (const name of Object.keys(known[0]).slice(1)) {
    const above = known.map((share, n) => below[n] + share[name]);
    const edge = (heights) => known.map(({ time }, n) => `${X(time).toFixed(1)},${Y(heights[n]).toFixed(1)}`);
    drawing.push(element("polygon", { points: [...edge(above), ...edge(below).reverse()].join(" "), class: `share ${name}` }));
    below = above;
  }
  for (const name of Object.keys(known[0]).slice(1).reverse()) {
    x -= 7 * name.length;
    drawing.push(text(name, x, 14, "key", "start"), element("rect", { x: x - 12, y: 5, width: 9, height: 9, class: `share ${name}` }));
    x -= 19;
  }
  for (const share of [0, 0.5, 1]) drawing.push(text(`${100 * share}%`, left - 5, Y(share) + 4, "tick", "end"));
  svg.replaceChildren(...drawing, element("g", { class: "instant" }));
}

/** Mark an instant [s] on a drawing of `drawHistory`, with the same data; or with a `line` alone. */
export function drawInstant(svg, { history, end, top, bottom, instant, line = false }) {
  const { X, Y, head, foot } = historyAxes(svg, end, top, bottom);
  const x = X(instant), marks = [element("line", { x1: x, x2: x, y1: head, y2: foot, class: "here" })];
  if (!line) marks.push(element("circle", { cx: x, cy: Y(history.at(instant).R), r: 4, class: "now" }));
  svg.querySelector(".instant").replaceChildren(...marks);
}

function historyAxes(svg, end, top, bottom) {
  const { width, height } = svg.viewBox.baseVal;
  const left = MARGIN.left, right = width - MARGIN.right;
  const head = MARGIN.top, foot = height - MARGIN.bottom + 4;
  const X = scale(0, end, left, right), Y = scale(bottom, top, foot, head);
  return { X, Y, left, right, head, foot };
}
