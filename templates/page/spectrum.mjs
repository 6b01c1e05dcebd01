// The spectra: the peaks of many collisions over the frequency of the pier.
import { simulate } from "./model.mjs";

// How far a spectrum may be from the straight line between its points, and the ratios of two
// frequencies from which an interval is wide, and down to which it is halved.
const TOLERANCE = 0.002, WIDE = 1.02, SHORTEST = 1.001;

/** A pier of the given mass and damping on the spring that gives it this frequency [Hz]. */
export function pierAt(frequency, { mass, dampingRatio }) {
  return { mass, dampingRatio, stiffness: mass * (2 * Math.PI * frequency) ** 2 };
}

/** The outcome of one collision as a point of the spectra. */
export function pointAt(frequency, { truck, pier, speed }) {
  return { frequency, ...simulate(truck, pierAt(frequency, pier), speed) };
}

/** `count` points of the spectra from `low` to `high`, at equal ratios. */
export function coarseSpectrum({ low, high }, count, collision) {
  const ratio = high / low;
  return Array.from({ length: count }, (_, n) =>
    pointAt(low * ratio ** (n / (count - 1)), collision));
}

/**
 * Halve the intervals in which a straight line (over the logarithm of the frequency) is off by more
 * than `tolerance`, until none is left but the shortest. One that is wide is halved anyway: what
 * bends on one side of its middle could be missed.
 *
 * The new points, as `at` returns them for a frequency, are put into the array. A generator: it
 * yields after each of them, so that whoever refines can pause.
 */
export function* refine(points, at, { tolerance = TOLERANCE, wide = WIDE } = {}) {
  const open = points.slice(1).map((right, n) => [points[n], right]);
  while (open.length) {
    const [left, right] = open.shift();
    const middle = at(Math.sqrt(left.frequency * right.frequency));
    points.splice(points.indexOf(right), 0, middle);
    const straight = ["engine", "cargo"].every((body) => {
      const [a, b, c] = [left[body], middle[body], right[body]];
      if (b === null) return a === null && c === null;
      return a !== null && c !== null && Math.abs(0.5 * (a + c) / b - 1) < tolerance;
    });
    const ratio = right.frequency / left.frequency;
    if (ratio > wide || (!straight && ratio > SHORTEST)) {
      open.push([left, middle], [middle, right]);
    }
    yield;
  }
}

/**
 * Whether the largest reaction before cargo contact is the engine's peak: the engine has struck
 * before, and the reaction has not gone on rising until the cargo arrived.
 */
export function isEnginePeak({ engineContact, engineTime, cargoContact }) {
  if (engineContact === null || engineContact > engineTime) return false;
  return cargoContact === null || cargoContact - engineTime > 1e-6 * cargoContact;
}

/** What governs at a point: "engine", "cargo", or "sheet metal" where neither makes the peak. */
export function governs(point) {
  const { engine, cargo } = point;
  if (cargo !== null && cargo >= engine) return "cargo";
  return isEnginePeak(point) ? "engine" : "sheet metal";
}

/** Stretches of frequency with one thing governing: { what, low, high, crossing }. */
export function bandsOf(points, collision) {
  const bands = [{ what: governs(points[0]), low: points[0].frequency, crossing: false }];
  for (let n = 1; n < points.length; n++) {
    const what = governs(points[n]), last = bands.at(-1);
    if (what === last.what) continue;
    const both = points[n - 1].cargo !== null && points[n].cargo !== null;
    const crossing = both && (what === "cargo" || last.what === "cargo");
    last.high = crossing
      ? crossingOf(points[n - 1], points[n], collision)
      : points[n].frequency;
    bands.push({ what, low: last.high, crossing });
  }
  bands.at(-1).high = points.at(-1).frequency;
  return bands;
}

/** The frequency between two points at which the two peaks are equal. */
function crossingOf(left, right, collision) {
  const excess = (point) => point.engine - point.cargo;
  for (let n = 0; n < 4; n++) {
    const share = excess(left) / (excess(left) - excess(right));
    const frequency = left.frequency * (right.frequency / left.frequency) ** share;
    if (n === 3) return frequency;
    const middle = pointAt(frequency, collision);
    if (middle.cargo === null || excess(middle) === 0) return frequency;
    if (excess(middle) > 0 === excess(left) > 0) left = middle;
    else right = middle;
  }
}
