// What is on show, in sentences.
import { force, hertz } from "./chart.mjs";
import { isEnginePeak } from "./spectrum.mjs";

/** The outcome of one collision, as `simulate` returns it, on a pier of this frequency [Hz]. */
export function sentence(frequency, outcome) {
  const { engine, engineContact, engineTime, cargo } = outcome, at = `On a pier of ${hertz(frequency)}`;
  if (engineContact === null && cargo === null) {
    return `${at} neither engine nor cargo arrives: crumpling sheet metal stops both. `
      + `The largest reaction is ${force(engine)}.`;
  }
  if (engineContact === null) {
    return `${at} the engine stops short and the cargo arrives: its peak is ${force(cargo)}, after `
      + `${force(engine)} from crumpling sheet metal.`;
  }
  if (engineContact > engineTime && !(cargo >= engine)) {
    return `${at} crumpling sheet metal governs, with ${force(engine)} before the engine arrives. `
      + (cargo === null ? "The cargo stops short of the pier." : `The cargo’s peak is ${force(cargo)}.`);
  }
  if (cargo === null) {
    return `${at} the engine governs, with ${force(engine)}. The cargo stops short of the pier.`;
  }
  if (!isEnginePeak(outcome) && cargo >= engine) {
    return `${at} the cargo governs, with ${force(cargo)}. It arrives while the reaction to the `
      + `engine is still rising, at ${force(engine)}.`;
  }
  const [most, more, least, less] = cargo >= engine
    ? ["cargo", cargo, "engine", engine]
    : ["engine", engine, "cargo", cargo];
  return `${at} the ${most} governs: ${force(more)}, ${(more / less).toFixed(1)} times the `
    + `${least}’s ${force(less)}.`;
}

/** Whether crumpling sheet metal makes the first of the two peaks: the engine does not arrive, or after it. */
export function bySheetMetal({ engineContact, engineTime }) {
  return engineContact === null || engineContact > engineTime;
}

/** What the first of the two peaks is a peak of. */
export function firstPeak(outcome) {
  if (bySheetMetal(outcome)) return "Sheet metal";
  return isEnginePeak(outcome) ? "Engine’s peak" : "Until cargo hits";
}

/** How the peaks depend on the frequency, and what governs where: two pieces of text. */
export function answer({ points, bands }) {
  const engine = points.filter(isEnginePeak);
  const cargo = points.filter((point) => point.cargo !== null);
  if (!engine.length && !cargo.length) {
    return ["At this speed crumpling sheet metal stops engine and cargo before they reach any of "
      + "these piers.", ""];
  }
  const peaks = [["engine", engine], ["cargo", cargo]].map(([body, some]) => (some.length
    ? `The ${body}’s peak ${trend(some, body)}.`
    : `The ${body} stops short of all these piers.`));
  const crossings = bands.filter((band) => band.crossing).map((band) => hertz(band.low));
  const [lower, upper] = [bands[0].what, bands.at(-1).what];
  let governs = "";
  if (bands.length === 1) governs = `The ${lower} governs throughout.`;
  else if (bands.length === 2 && crossings.length === 1) {
    governs = `Below ${crossings[0]} the ${lower} governs, above it the ${upper}.`;
  } else if (crossings.length > 1) {
    governs = `The lines cross at ${crossings.slice(0, -1).join(", ")} and ${crossings.at(-1)}.`;
  }
  return [`${peaks.join(" ")} `, governs];
}

/** How a peak changes from the softest pier to the stiffest. */
function trend(points, body) {
  const [first, last] = [points[0], points.at(-1)];
  const most = points.reduce((p, q) => (q[body] > p[body] ? q : p));
  const from = `from ${force(first[body])} at ${hertz(first.frequency)}`;
  if (most[body] > 1.1 * Math.max(first[body], last[body])) {
    return `rises ${from} to ${force(most[body])} at ${hertz(most.frequency)}, then falls back to `
      + force(last[body]);
  }
  const ratio = last[body] / first[body];
  const verb = ratio > 1.1 ? "rises" : ratio < 1 / 1.1 ? "falls" : "hardly changes,";
  return `${verb} ${from} to ${force(last[body])} at ${hertz(last.frequency)}`;
}

/** What goes on at an instant, as `follow(…).at(time)` returns it. */
export function phase({ time, F1, F2 }, { engineContact, cargoContact }) {
  const met = (contact) => contact !== null && time >= contact;
  if (time === 0) return "first touch.";
  if (F1 <= 0 && F2 <= 0) return "the truck has left, the pier vibrates.";
  if (met(cargoContact) && F2 > 0) return "the cargo is in contact.";
  if (met(engineContact) && F1 > 0) return "the engine is in contact.";
  if (met(engineContact)) return "the engine has rebounded.";
  return "sheet metal crumples.";
}
