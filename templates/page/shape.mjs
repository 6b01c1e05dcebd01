// How a column becomes a mass on a spring: its shape, and both against the impact height.
import { hertz, number, roundUp } from "./chart.mjs";
import { pierOf } from "./column.mjs";

const HEIGHTS = 47; // impacts of the lines against the height
const POINTS = 81; // of the shape

const spread = (low, high, count) => Array.from({ length: count }, (_, n) => low + ((high - low) * n) / (count - 1));

/** The explorer of a pier: see `Charts`. */
export function shape({ values, setup: { symbols, concrete } }) {
  const { column_diameter: diameter, column_height: height, impact_height: impact, base, top } = values;
  const struck = (z) => pierOf({ diameter, height, impact: z, base, top, ...concrete });
  const here = struck(impact), tall = Math.ceil(height);
  const z = [...spread(0, height, POINTS), impact].sort((a, b) => a - b);
  const phi = z.map(here.shape), squares = phi.map((value) => value ** 2);
  const lowest = Math.min(...phi);
  const charts = [{
    kind: "lines", title: "Shape function",
    x: { label: "φ, φ² [-]", low: lowest < -1e-9 ? -roundUp(-1.05 * lowest) : 0, high: roundUp(1.05 * Math.max(...phi, ...squares)) },
    y: { label: "Height z [m]", low: 0, high: tall },
    curves: [
      { name: "", style: "square", x: squares, y: z, filled: true },
      { name: "φ²", style: "square", x: [], y: [] },
      { name: "φ", style: "shape", x: phi, y: z },
    ],
    level: { y: impact, words: "impact height" },
  }];
  const heights = spread(0.04 * height, 0.96 * height, HEIGHTS), along = heights.map(struck);
  for (const [name, title, unit, size] of [["stiffness", "Stiffness kₚ (Eq. 3)", "MN/m", 1e6], ["mass", "Mass mₚ (Eq. 1)", "t", 1e3]]) {
    const line = along.map((pier) => pier[name] / size), value = here[name] / size;
    charts.push({
      kind: "lines", title,
      x: { label: "Impact height zₙ [m]", low: 0, high: tall },
      // Next to a support the stiffness has no bound: the curve is cut off above.
      y: { label: `${name === "mass" ? "Mass" : "Stiffness"} [${unit}]`, low: 0, high: roundUp(Math.max(1.05 * value, Math.min(1.05 * Math.max(...line), 4 * value))) },
      curves: [{ name: "", style: "shape", x: heights, y: line }],
      here: { x: impact, y: value, words: `${number(value)} ${unit}`, style: "shape" },
    });
  }
  const percent = (share) => `${Math.round(100 * share)} %`;
  return {
    charts,
    facts: [
      [symbols.kp, `${number(here.stiffness / 1e6)} MN/m`, "equivalent stiffness of the pier, Eq. 3"],
      [symbols.mp, `${number(here.mass / 1e3)} t`, "equivalent mass of the pier, Eq. 1"],
      [symbols.fp, hertz(Math.sqrt(here.stiffness / here.mass) / (2 * Math.PI)), "natural frequency of the pier"],
      ["Whole column", `${number(here.whole / 1e3)} t`, "mass per length times height"],
    ],
    words: `The pier moves as if ${percent(here.mass / here.whole)} of the column’s mass were concentrated at the `
      + `impact height. Shear accounts for ${percent(here.shear)} of the deflection there, flexure for the rest.`,
  };
}
