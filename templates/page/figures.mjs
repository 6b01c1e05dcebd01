// Charts of what is calculated elsewhere: lines, and bars in rows.
import { element, path, roundUp, tag, text, ticks } from "./chart.mjs";

const TOP = 30, RIGHT = 22, BOTTOM = 42, BAR = 24, ROW = 17; // margins and heights of rows [px]
const LETTER = 7; // width of one, rather more than less [px]

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

/** The title and the key of the lines, above the chart: in as many rows as they need. */
function heading(title, curves, right) {
  const items = [text(title, 4, 14, "title", "start")];
  let x = 22 + 8 * title.length, y = 14;
  for (const { name, style } of curves.filter((curve) => curve.name)) {
    const width = 27 + 7 * name.length;
    if (x + width > right && x > 4) [x, y] = [4, y + ROW];
    items.push(element("line", { x1: x, x2: x + 19, y1: y - 4, y2: y - 4, class: `curve ${style}` }),
      text(name, x + 24, y, "key", "start"));
    x += width + 12;
  }
  return { items, top: TOP + y - 14 };
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
  const heights = marksOf(y, 6).map(written), right = width - RIGHT;
  const left = 30 + LETTER * Math.max(...heights.map((words) => words.length)), foot = height - BOTTOM;
  const { items: drawing, top } = heading(title, curves, right);
  const X = scale(x, left, right), Y = scale(y, foot, top);
  for (const value of marksOf(y, 6)) {
    drawing.push(element("line", { x1: left, x2: right, y1: Y(value), y2: Y(value), class: value ? "grid" : "axis" }),
      text(written(value), left - 6, Y(value) + 4, "tick", "end"));
  }
  for (const value of marksOf(x, (right - left) / 42)) {
    drawing.push(element("line", { x1: X(value), x2: X(value), y1: foot, y2: foot + 4, class: "axis" }),
      text(written(value), X(value), foot + 17, "tick"));
  }
  drawing.push(text(x.label, 0.5 * (left + right), foot + 35, "label"), turned(y.label, 12, 0.5 * (top + foot)));
  const plot = element("svg", { x: left, y: top - 4, width: right - left, height: foot - top + 4,
    viewBox: `${left} ${top - 4} ${right - left} ${foot - top + 4}`, class: "plot" });
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
      tag(level.words, right - 4, ly > top + 24 ? ly - 6 : ly + 16, "label", "end"));
  }
  if (here) {
    const at = X(here.x), late = at > left + 0.6 * (right - left), up = Y(here.y);
    const width = LETTER * here.words.length, beside = late ? Math.max(at - 11, left + width) : Math.min(at + 11, right - width);
    drawing.push(element("line", { x1: at, x2: at, y1: top, y2: foot, class: "here" }),
      element("circle", { cx: at, cy: up, r: 5, class: `mark ${here.style}` }),
      tag(here.words, beside, Math.min(Math.max(up - 9, top + 14), foot - 6), "value", late ? "end" : "start"));
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

/** Words in lines that have so much room. */
function inLines(words, room) {
  const lines = [];
  for (const word of words ? words.split(" ") : []) {
    const longer = `${lines.at(-1) ?? ""} ${word}`.trim();
    if (lines.length && LETTER * longer.length <= room) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

/** The axis long enough for the words beside the bars, and these: where room is short, of the remark no more than that a value is unverified. */
function withRoom(x, rows, room) {
  if (x.low < 0) return [x, rows.map(({ words }) => words)];
  const longest = Math.max(...rows.map(({ words }) => words.length));
  const said = rows.map(({ words }) => (LETTER * longest + 20 < 0.75 * room ? words : words.match(/^[^:]*(: unverified)?/)[0]));
  const ends = rows.map(({ bars }, n) => {
    const free = room - LETTER * said[n].length - 20;
    return (Math.max(...bars.map(({ value }) => value ?? 0)) * room) / Math.max(free, 0.25 * room);
  });
  return [{ ...x, high: roundUp(Math.max(...ends)) }, said];
}

/**
 * Draw bars in rows.
 *
 * chart: { title, x: axis { label, low, high, unit: of a tick, most: above which there is none }, rows: [{ name, bars: [{ value,
 *   style }], words }], key: [{ name, style }] }; a value of null has no bar.
 */
export function drawBars(svg, { title, x, rows, key: names = [], empty = "" }) {
  const { width, height } = svg.viewBox.baseVal;
  const left = 12 + LETTER * Math.max(...rows.map(({ name }) => name.length));
  const right = width - RIGHT, foot = height - BOTTOM, room = right - left;
  const [axis, said] = withRoom(x, rows, room), X = scale(axis, left, right);
  const { items: drawing } = heading(title, names, right);
  for (const value of marksOf(axis, room / 60).filter((each) => each <= (x.most ?? Infinity))) {
    drawing.push(element("line", { x1: X(value), x2: X(value), y1: TOP, y2: foot, class: value ? "grid" : "axis" }),
      text(`${written(value)}${x.unit ?? ""}`, X(value), foot + 17, "tick"));
  }
  drawing.push(text(x.label, 0.5 * (left + right), foot + 35, "label"));
  const words = [];
  rows.forEach(({ name, bars }, n) => {
    const y = TOP + n * BAR, middle = y + 0.5 * BAR + 4;
    drawing.push(text(name, left - 7, middle, "row-name", "end"));
    for (const { value, style } of bars) {
      if (value === null) continue;
      const [a, b] = [X(0), X(value)].sort((p, q) => p - q);
      drawing.push(element("rect", { x: a, y: y + 4, width: b - a, height: BAR - 8, class: `bar ${style}` }));
    }
    const ends = [X(0), ...bars.map(({ value }) => X(value ?? 0))], long = LETTER * said[n].length;
    const below = Math.max(...ends) + 6 + long > right && Math.min(...ends) - 6 - long > left; // room on that side only
    const [at, anchor] = below ? [Math.min(...ends) - 6, "end"] : [Math.min(Math.max(...ends) + 6, right - long), "start"];
    if (said[n]) words.push(tag(said[n], at, middle, "value", anchor));
  });
  inLines(empty, room).forEach((line, n) => words.push(text(line, 0.5 * (left + right), 0.5 * (TOP + foot) + n * ROW, "label")));
  svg.replaceChildren(...drawing, ...words);
}
