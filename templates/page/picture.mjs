// The collision as a picture: a truck with its two springs, and the pier as a mass on a spring.
import { element, force } from "./chart.mjs";

/** How many times too large the movement of the pier is drawn, always. */
export const EXAGGERATION = 10;
// All else is to scale, in metres: from the pier's face at rest and above the road. The model
// itself has everything at one height.
const RIGHT = 10.2, BOTTOM = -0.8, TOP = 4.4;
const WALL = 9.9, PIER = 1.4, DECK = 3.95, PAD = 0.12;
const BOX = 4.6, BOX_BOTTOM = 1.2, BOX_TOP = 3.3, ENGINE = 1.0, WHEEL = 0.44, ARROW = 3.4;
const ENGINE_HEIGHT = 0.88, BODY_HEIGHT = 2.1, PIER_SPRING = 1.2;
const FARTHEST = WALL - PIER - 0.8; // where the face of the pier is drawn at most

/** Whether the pier has moved farther than the picture can show. */
export function isBeyond({ xp }) {
  return EXAGGERATION * xp > FARTHEST;
}

/**
 * Draw one instant.
 *
 * data: { truck, now: as `follow(…).at(time)` returns it, frequency [Hz], top: the longest arrow's
 *   reaction [N] }.
 */
export function drawPicture(svg, { truck, now, frequency, top }) {
  const d1 = truck.engine.plateauLength, d2 = truck.body.plateauLength;
  const left = -(d2 + BOX + 0.9);
  svg.setAttribute("viewBox", `${left} ${-TOP} ${RIGHT - left} ${TOP - BOTTOM}`);
  const face = Math.min(EXAGGERATION * now.xp, FARTHEST);
  const crush1 = now.x1 - now.xp, crush2 = now.x2 - now.xp;
  const engineFront = face - gap(d1, crush1), boxFront = face - gap(d2, crush2);
  // What has been crushed does not stretch again: after the rebound there is a gap.
  const engineTip = Math.min(engineFront + gap(d1, Math.max(now.left1, crush1)), face);
  const nose = Math.min(boxFront + gap(d2, Math.max(now.left2, crush2)), face);
  const stroke = 1 + 1.6 * Math.log10(frequency / 3); // thicker for a stiffer pier
  svg.replaceChildren(
    // What stands still: deck, road, wall, and where the pier was.
    box(left, DECK, RIGHT - left, TOP - DECK, "deck"),
    line(left, 0, RIGHT, 0, "road"),
    box(WALL, 0, 0.3, 2.3, "wall"),
    box(0, 0.06, PIER, DECK - 0.12, "rest"),
    // The pier and what holds it.
    box(face, 0.06, PIER, DECK - 0.12, "pier"),
    label("pier", face + 0.5 * PIER, 1.75, "inside"),
    zigzag(face + PIER, WALL, PIER_SPRING, 0.26, 11, "holding", stroke),
    // The truck, from the back.
    box(boxFront - BOX, 1.0, BOX, 0.2, "chassis"),
    wheel(boxFront - BOX + 1.1),
    wheel(engineFront - ENGINE + 0.1),
    cab(boxFront, nose, d2 + PAD),
    box(boxFront - BOX, BOX_BOTTOM, BOX, BOX_TOP - BOX_BOTTOM, "cargo-box", 0.1),
    label("cargo", boxFront - 0.5 * BOX, 2.42, "cargo"),
    label(kmh(now.v2), boxFront - 0.5 * BOX, 1.6, "cargo small"),
    zigzag(boxFront, nose, BODY_HEIGHT, 0.17, 7, "cargo", now.F2 > 0 ? 3 : 1.6),
    box(engineFront - ENGINE, 0.5, ENGINE, 0.68, "engine-box", 0.08),
    zigzag(engineFront, engineTip, ENGINE_HEIGHT, 0.17, 7, "engine", now.F1 > 0 ? 3 : 1.6),
    label(`engine ${kmh(now.v1)}`, Math.min(engineFront, -0.8), -0.64, "engine small", "end"),
    ...arrow(face, now.R, top),
  );
}

/** The length drawn of what is left of a spring; crushed flat it is still seen. */
function gap(length, crush) {
  return Math.max(length - crush, 0) + PAD;
}

function kmh(velocity) {
  const value = 3.6 * velocity;
  return `${(Math.abs(value) < 0.5 ? 0 : value).toFixed(0)} km/h`.replace("-", "−");
}

function box(x, z, width, height, className, round = 0) {
  return element("rect", { x, y: -z - height, width, height, rx: round, class: className });
}

function line(x1, z1, x2, z2, className) {
  return element("line", { x1, y1: -z1, x2, y2: -z2, class: className });
}

function label(words, x, z, className, anchor = "middle") {
  return element("text", { x, y: -z, class: className, "text-anchor": anchor }, words);
}

function polygon(points, className) {
  const places = points.map(([x, z]) => `${x},${-z}`).join(" ");
  return element("polygon", { points: places, class: className });
}

function wheel(x) {
  return element("g", {},
    element("circle", { cx: x, cy: -WHEEL, r: WHEEL, class: "tyre" }),
    element("circle", { cx: x, cy: -WHEEL, r: 0.45 * WHEEL, class: "hub" }));
}

/** A spring with a plate at its end; `stroke` in pixels. */
function zigzag(start, end, z, height, turns, className, stroke) {
  const quarters = 4 * turns, wave = [0, 1, 0, -1];
  const points = Array.from({ length: quarters + 1 }, (_, n) =>
    `${start + ((end - start) * n) / quarters},${-z - height * wave[n % 4]}`);
  return element("g", { class: `spring ${className}`, "stroke-width": stroke },
    element("polyline", { points: points.join(" ") }),
    line(end, z - 1.4 * height, end, z + 1.4 * height, ""));
}

/** Bonnet and cab between the cargo and the nose; they fold as they shorten. */
function cab(rear, nose, whole) {
  const length = nose - rear, fold = 0.16 * Math.max(1 - length / whole, 0);
  const bonnet = Array.from({ length: 9 }, (_, n) =>
    [0.42 + 0.0725 * n, 1.62 - 0.015 * n + (n % 8 ? fold * (n % 2 ? 1 : -1) : 0)]);
  const place = ([x, z]) => [rear + x * length, z];
  const outline = [[0, 2.75], [0.2, 2.75], ...bonnet, [1, 0.72], [0.93, 0.55], [0, 0.75]];
  const window = [[0.05, 2.6], [0.19, 2.6], [0.36, 1.78], [0.05, 1.78]];
  return element("g", {}, polygon(outline.map(place), "cab"), polygon(window.map(place), "glass"));
}

/** The reaction as an arrow that holds against the pier, to scale; its value where there is room. */
function arrow(face, reaction, top) {
  const z = 2.75, length = (ARROW * Math.abs(reaction)) / top;
  const tip = Math.min(face + PIER + 0.12, RIGHT - length - 0.2);
  const [place, anchor] = tip < RIGHT - 6 ? [tip, "start"] : [face - 0.2, "end"];
  const words = label(`R = ${force(reaction)}`, place, 3.44, "reaction", anchor);
  if (length < 0.05) return [words];
  const [end, start] = reaction > 0 ? [tip, tip + length] : [tip + length, tip];
  const head = Math.min(0.4, length) * Math.sign(start - end);
  return [
    line(end + 0.8 * head, z, start, z, "arrow"),
    polygon([[end, z], [end + head, z + 0.2], [end + head, z - 0.2]], "arrow-head"),
    words,
  ];
}
