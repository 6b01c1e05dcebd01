// The design reaction beside the full model's, and the forces of codes.
import { force, hertz, roundUp } from "./chart.mjs";
import { simulate } from "./model.mjs";
import { long, short } from "./procedure.mjs";
import { symbolsOf } from "./scenario.mjs";
import { bySheetMetal } from "./sentences.mjs";
import { pierAt } from "./spectrum.mjs";

/** A sentence for each value that is outside the domain, and one where both blows overlap. */
function warnings(given, found, frequency, domain) {
  const known = { ...given, m: given.m1 + given.m2, fp: frequency };
  const outside = domain.filter(({ name, low, high, size }) =>
    known[name] < low * size * (1 - 1e-9) || known[name] > high * size * (1 + 1e-9));
  return [
    ...outside.map(({ name, meaning, low, high, unit, size }) =>
      `${meaning} ${Number((known[name] / size).toPrecision(4))} ${unit} is outside the studied ${low} to ${high} `
      + `${unit}: the design formulas were not checked there.`),
    ...(found.R2 >= 0 && found.t2 <= found.tJ
      ? ["The cargo meets the pier before the engine has separated: the design formulas take one after the other."]
      : []),
  ];
}

/** The explorer of the design reaction: see `Charts`. */
export function reactions({ collision, setup: { symbols, codes, domain } }) {
  const { truck, frequency, pier, speed } = collision, given = symbolsOf(collision);
  const outcome = simulate(truck, pierAt(frequency, pier), speed);
  const full = Math.max(outcome.engine, outcome.cargo ?? 0);
  const levels = { short: short(given), long: long(given) };
  const larger = ({ R1, R2 }) => (R2 > R1 ? R2 : R1);
  const first = bySheetMetal(outcome) ? "sheet metal" : "engine";
  const bars = ["engine", "cargo"].map((body) =>
    ({ name: `Full model, ${body === "engine" ? first : body}`, value: outcome[body], style: body }));
  for (const [level, found] of Object.entries(levels)) {
    const value = larger(found);
    bars.push({ name: `Design procedure, ${level}`, value, style: "design", remark: `${(value / full).toFixed(2)} × full model` });
  }
  for (const { name, value, stiffness, remark } of codes) { // of hard impact F = v √(k m)
    const hard = stiffness && speed * Math.sqrt(stiffness * (truck.engine.mass + truck.body.mass));
    bars.push({ name, value: hard ?? value, style: "code", remark });
  }
  const rows = bars.map(({ name, value, style, remark }) => {
    const words = value === null ? "none" : force(value);
    return { name, bars: [{ value: value && value / 1e6, style }], words: remark ? `${words}: ${remark}` : words };
  });
  const { R0, R1, R2, v1 } = levels.long, design = larger(levels.long);
  const struck = v1 > 0 && R1 > R0; // by the engine, harder than sheet metal has pushed before
  const none = (value) => (Number.isNaN(value) ? "none" : force(value));
  return {
    charts: [{
      kind: "bars", title: "", rows,
      x: { label: "Force [MN]", low: 0, high: roundUp(Math.max(...bars.map(({ value }) => value ?? 0))) / 1e6 },
    }],
    facts: [
      [symbols.fp, hertz(frequency), "natural frequency of the pier"],
      [`Design, ${struck ? "engine" : "sheet metal"}`, force(R1), "long level"], ["Design, cargo", none(R2), "long level"],
      ["Design reaction", force(design), "the larger of the two"],
    ],
    words: `Design reaction ${force(design)}, ${(design / full).toFixed(2)} times the full model’s. `
      + (design !== R1 ? "The cargo governs." : struck ? "The engine governs." : "Crumpling sheet metal governs."),
    warnings: warnings(given, levels.long, frequency, domain),
  };
}
