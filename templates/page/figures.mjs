// Charts of what is calculated elsewhere: lines, and bars in rows.
import { apart, element, path, roundUp, tag, text, ticks } from "./chart.mjs";

const TOP = 30, RIGHT = 16, BOTTOM = 42, BAR = 24; // margins and height of a row [px]

function scale({ low, high, log }, first, last) {
  const of = log ? Math.log : (value) => value;
  return (value) => first + ((of(value) - of(low)) / (of(high) - of(low))) * (last - first);
}

/** The values at which an axis has ticks. */
function marksOf({ low, high, log }, most) {
  if (!log) return ticks(low, high, most);
  const decades = [];
  for (let n = Math.floor(Math.log10(low)); n <= Math.log10(high); n++) {
    for (const step of [1, 2, 5]) decades.push(Number(`${step}e${n}`));
  }
  const inside = decades.filter((value) => value >= 0.999 * low && value <= 1.001 * high);
  return inside.length > most ? inside.filter((value) => /^[0.]*1/.test(String(value))) : inside;
}

const written = (value) => String(Number(value.toPrecision(6))).replace("-", "−");

/** The key of the lines, above the chart at the right. */
function key(curves, right) {
  const items = [];
  for (const { name, style } of curves.filter((curve) => curve.name).toReversed()) {
    right -= 6.6 * name.length;
    items.push(text(name, right, 14, "key", "start"),
      element("line", { x1: right - 24, x2: right - 5, y1: 10, y2: 10, class: `curve ${style}` }));
    right -= 34;
  }
  return items;
}

/**
 * Draw lines.
 *
 * chart: { title, x and y: axes { label, low, high, log }, curves: [{ name, style, x, y, filled: to
 *   the vertical axis }], level: a horizontal line { y, words }, here: { x, y, words, style } or null
 *   for one place }; null in a curve where it has a gap.
 */
export function drawLines(svg, { title, x, y, curves, level, here }) {
  const { width, height } = svg.viewBox.baseVal;
  const left = 46, right = width - RIGHT, foot = height - BOTTOM;
  const X = scale(x, left, right), Y = scale(y, foot, TOP);
  const drawing = [text(title, 4, 14, "title", "start"), ...key(curves, right)];
  for (const value of marksOf(y, 6)) {
    drawing.push(element("line", { x1: left, x2: right, y1: Y(value), y2: Y(value), class: value ? "grid" : "axis" }),
      text(written(value), left - 6, Y(value) + 4, "tick", "end"));
  }
  for (const value of marksOf(x, (right - left) / 42)) {
    drawing.push(element("line", { x1: X(value), x2: X(value), y1: foot, y2: foot + 4, class: "axis" }),
      text(written(value), X(value), foot + 17, "tick"));
  }
  drawing.push(text(x.label, 0.5 * (left + right), foot + 35, "label"), turned(y.label, 12, 0.5 * (TOP + foot)));
  const plot = element("svg", { x: left, y: TOP - 4, width: right - left, height: foot - TOP + 4,
    viewBox: `${left} ${TOP - 4} ${right - left} ${foot - TOP + 4}`, class: "plot" });
  for (const curve of curves) {
    const places = curve.x.map((value, n) => (curve.y[n] === null || value === null ? null : [X(value), Y(curve.y[n])]));
    if (curve.filled) {
      const edge = places.map(([px, py]) => `${px.toFixed(1)},${py.toFixed(1)}`);
      plot.append(element("polygon", { points: [`${X(0)},${places[0][1]}`, ...edge, `${X(0)},${places.at(-1)[1]}`].join(" "), class: `filled ${curve.style}` }));
    } else {
      plot.append(path(places, `curve ${curve.style}`));
    }
  }
  drawing.push(plot);
  if (level) {
    const ly = Y(level.y);
    drawing.push(element("line", { x1: left, x2: right, y1: ly, y2: ly, class: "drop" }),
      tag(level.words, right - 4, ly > TOP + 24 ? ly - 6 : ly + 16, "label", "end"));
  }
  if (here) {
    const at = X(here.x), late = at > left + 0.6 * (right - left), up = Y(here.y);
    drawing.push(element("line", { x1: at, x2: at, y1: TOP, y2: foot, class: "here" }),
      element("circle", { cx: at, cy: up, r: 5, class: `mark ${here.style}` }),
      tag(here.words, at + (late ? -11 : 11), apart([up - 9, TOP], TOP + 14, foot - 6)[0], "value", late ? "end" : "start"));
  }
  svg.replaceChildren(...drawing);
}

function turned(words, x, y) {
  return element("text", { transform: `translate(${x} ${y}) rotate(-90)`, class: "label", "text-anchor": "middle" }, words);
}

/** How high a chart of bars is, with all of its rows [px]. */
export function barsHeight({ rows }) {
  return TOP + BAR * rows.length + BOTTOM;
}

/**
 * Draw bars in rows.
 *
 * chart: { title, x: axis { label, low, high, unit: of a tick }, rows: [{ name, bars: [{ value,
 *   style }], words }], key: [{ name, style }] }; a value of null has no bar.
 */
export function drawBars(svg, { title, x, rows, key: names = [], empty = "" }) {
  const { width, height } = svg.viewBox.baseVal;
  const left = Math.min(12 + 6.9 * Math.max(...rows.map(({ name }) => name.length)), 0.52 * width);
  const right = width - RIGHT, foot = height - BOTTOM, X = scale(x, left, right);
  const drawing = [text(title, 4, 14, "title", "start"), ...key(names, right)];
  for (const value of marksOf(x, (right - left) / 60)) {
    drawing.push(element("line", { x1: X(value), x2: X(value), y1: TOP, y2: foot, class: value ? "grid" : "axis" }),
      text(`${written(value)}${x.unit ?? ""}`, X(value), foot + 17, "tick"));
  }
  drawing.push(text(x.label, 0.5 * (left + right), foot + 35, "label"));
  const words = [];
  rows.forEach(({ name, bars, words: said }, n) => {
    const y = TOP + n * BAR, middle = y + 0.5 * BAR + 4;
    drawing.push(text(name, left - 7, middle, "name", "end"));
    for (const { value, style } of bars) {
      if (value === null) continue;
      const [a, b] = [X(0), X(value)].sort((p, q) => p - q);
      drawing.push(element("rect", { x: a, y: y + 4, width: b - a, height: BAR - 8, class: `bar ${style}` }));
    }
    if (said) words.push(tag(said, Math.max(X(0), ...bars.map(({ value }) => X(value ?? 0))) + 6, middle, "value", "start"));
  });
  if (empty) words.push(text(empty, 0.5 * (left + right), 0.5 * (TOP + foot), "label"));
  svg.replaceChildren(...drawing, ...words);
}
