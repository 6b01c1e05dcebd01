// Which parameters of the truck matter: the collision once more with one of them changed.
import { force, hertz, number, roundUp } from "./chart.mjs";
import { simulate } from "./model.mjs";
import { bySheetMetal, firstPeak } from "./sentences.mjs";
import { pierAt } from "./spectrum.mjs";

const BODIES = ["engine", "cargo"];

/** A truck with one of its parameters times a factor; its springs keep the rules of a spring. */
function changed(truck, [part, name], factor) {
  if (name === undefined) return { ...truck, [part]: factor * truck[part] };
  const body = { ...truck[part], [name]: factor * truck[part][name] };
  body.unloadingStiffness = Math.max(body.unloadingStiffness, body.stiffness);
  body.plateauLength = Math.max(body.plateauLength, body.plateauForce / body.unloadingStiffness);
  return { ...truck, [part]: body };
}

/**
 * The relative change of either peak with one of the parameters smaller, and larger.
 *
 * parameters: each the names of a part of the truck and of a number of it. Returns, for "engine"
 * and "cargo", an array of [smaller, larger] by parameter, null where the peak is gone; null where
 * there is no such peak to begin with.
 */
export function changes({ truck, frequency, pier, speed }, parameters, change) {
  const solve = (of) => simulate(of, pierAt(frequency, pier), speed);
  const nominal = solve(truck);
  const ends = parameters.map((parameter) => [1 - change, 1 + change].map((factor) => solve(changed(truck, parameter, factor))));
  return Object.fromEntries(BODIES.map((body) => [body, nominal[body] === null ? null : ends.map((pair) =>
    pair.map((outcome) => (outcome[body] === null ? null : outcome[body] / nominal[body] - 1)))]));
}

/** The explorer of the sensitivity: see `Charts`. */
export function influences({ collision, setup: { symbols, parameters, change } }) {
  const { truck, frequency, pier, speed } = collision;
  const found = changes(collision, parameters.map(({ path }) => path), change);
  const outcome = simulate(truck, pierAt(frequency, pier), speed);
  const first = bySheetMetal(outcome) ? "Sheet metal" : "Engine peak";
  const share = Math.round(100 * change), words = [];
  const charts = BODIES.map((body) => {
    const rows = found[body] ?? parameters.map(() => [null, null]);
    const widest = 100 * roundUp(Math.max(0.1, ...rows.flat().map((value) => 1.05 * Math.abs(value ?? 0))));
    const peak = body === "engine" ? first : "Cargo peak";
    words.push(mostSensitive(body, peak, found[body], parameters));
    return {
      kind: "bars", title: peak,
      x: { label: "Change of the peak", low: -widest, high: widest, unit: " %" },
      key: [{ name: `−${share} %`, style: "smaller" }, { name: `+${share} %`, style: "larger" }],
      rows: rows.map((row, n) => ({
        name: parameters[n].short,
        bars: row.map((value, side) => ({ value: value === null ? null : 100 * value, style: ["smaller", "larger"][side] })),
        words: found[body] ? row.flatMap((value, side) => (value === null ? `${"−+"[side]}${share} %: no peak` : [])).join(", ") : "",
      })),
      empty: found[body] ? "" : `The ${body} does not reach the pier.`,
    };
  });
  return {
    charts,
    facts: [
      [symbols.fp, hertz(frequency), "natural frequency of the pier"],
      [symbols.kp, `${number(pierAt(frequency, pier).stiffness / 1e6)} MN/m`, "equivalent stiffness of the pier"],
      [symbols.mp, `${number(pier.mass / 1e3)} t`, "equivalent mass of the pier"],
      [firstPeak(outcome), force(outcome.engine), "largest reaction before cargo contact"],
      ["Cargo’s peak", outcome.cargo === null ? "none" : force(outcome.cargo), "largest reaction after cargo contact"],
    ],
    words: words.join(" "),
  };
}

function mostSensitive(body, peak, rows, parameters) {
  if (!rows) return `The ${body} does not reach the pier: there is no peak to change.`;
  const largest = rows.map((row) => Math.max(...row.map((value) => (value === null ? Infinity : Math.abs(value)))));
  const most = Math.max(...largest), names = parameters.filter((_, n) => largest[n] === most).map(({ meaning }) => `the ${meaning}`);
  const listed = names.length > 1 ? `${names.slice(0, -1).join(", ")} and ${names.at(-1)}` : names[0];
  const how = most === Infinity ? "disappears" : `changes by ${Math.round(100 * most)} %`;
  const which = peak === "Sheet metal" ? "reaction to crumpling sheet metal" : peak.toLowerCase();
  return `The ${which} is most sensitive to ${listed}: it ${how}.`;
}
