// One body at a time against the pier: the amplification S of its blow.
import { force, roundUp } from "./chart.mjs";
import { simulate } from "./model.mjs";
import { amplification, short } from "./procedure.mjs";
import { symbolsOf } from "./scenario.mjs";
import { bySheetMetal } from "./sentences.mjs";
import { pierAt, refine } from "./spectrum.mjs";

const LOW = 0.02, HIGH = 50; // frequency ratios on show
const COARSE = 33; // points of a curve to begin with
const TOLERANCE = 0.004, WIDE = 1.07; // as in `spectrum`: of a straight line, and of an interval that is halved anyway
const OMEGA = 200; // of the body on its spring: slow beside the longest step of `simulate` [1/s]
const FAR = 1e6; // distance of the absent body [m]
const BODIES = ["engine", "cargo"];

/**
 * The peak reaction of a mass that strikes the pier through its steep spring alone, over v √(k m).
 *
 * beta, mu, e: frequency ratio, mass ratio and restitution; zeta: damping ratio of the pier.
 */
export function exactAmplification(beta, mu, e, zeta) {
  const stiffness = OMEGA ** 2, spring = { plateauForce: 0, plateauLength: 0, stiffness, unloadingStiffness: stiffness / e ** 2 };
  const absent = { mass: 1, plateauForce: 1, plateauLength: FAR, stiffness: 1, unloadingStiffness: 1 };
  const truck = { engine: { mass: 1, ...spring }, body: absent, friction: 0, frictionOnPier: false };
  const pier = { mass: 1 / mu, stiffness: (beta * OMEGA) ** 2 / mu, dampingRatio: zeta };
  return simulate(truck, pier, 1, { start: [0, 1, -FAR, 0, 0, 0] }).engine / OMEGA;
}

let known = []; // the last curves, each with what it is of

/** S over the frequency ratio, as { ratios, exact }: once for the same mass ratio, restitution and damping. */
function curve(mu, e, zeta) {
  const of = [mu, e, zeta].join();
  const found = known.find((each) => each.of === of) ?? { of, ...refined(mu, e, zeta) };
  known = [found, ...known.filter((each) => each !== found)].slice(0, 8);
  return found;
}

function refined(mu, e, zeta) {
  const at = (frequency) => ({ frequency, engine: exactAmplification(frequency, mu, e, zeta), cargo: null });
  const points = Array.from({ length: COARSE }, (_, n) => at(LOW * (HIGH / LOW) ** (n / (COARSE - 1))));
  for (const _ of refine(points, at, { tolerance: TOLERANCE, wide: WIDE }));
  return { ratios: points.map((point) => point.frequency), exact: points.map((point) => point.engine) };
}

/** The ends of a logarithmic axis, moved out in steps where a value lies beyond them. */
function roundOut(low, high, value) {
  return [
    value < 1.05 * low ? 10 ** (Math.floor(3 * Math.log10(value / 1.05)) / 3) : low,
    value > high / 1.05 ? 10 ** (Math.ceil(3 * Math.log10(value * 1.05)) / 3) : high,
  ];
}

/** The explorer of the reduction: see `Charts`. */
export function reduction({ collision }) {
  const { truck, frequency, pier, speed } = collision, zeta = pier.dampingRatio;
  const exact = (beta, mu, e) => [NaN, exactAmplification(beta, mu, e, zeta)];
  const found = short({ ...symbolsOf(collision), spectrum: exact });
  const outcome = simulate(truck, pierAt(frequency, pier), speed);
  const sheetMetal = bySheetMetal(outcome), charts = [], rows = [], words = [];
  BODIES.forEach((body, n) => {
    const [beta, mu, e, S, v, R] = ["beta", "mu", "e", "S", "v", "R"].map((name) => found[`${name}${n + 1}`]);
    const { ratios, exact: line } = curve(mu, e, zeta), arrives = v > 0;
    const [low, high] = roundOut(LOW, HIGH, beta);
    charts.push({
      kind: "lines", title: body === "engine" ? "Engine" : "Cargo",
      x: { label: "Frequency ratio β = fₚ / fᵢ [-]", low, high, log: true },
      y: { label: "Amplification S [-]", low: 0, high: roundUp(1.2 * Math.max(...line, S)) },
      curves: [
        { name: "impulse", style: "impulse", y: ratios.map((ratio) => ((1 + e) * ratio) / (1 + mu)) },
        { name: "static", style: "static", y: ratios.map((ratio) => 1 / Math.sqrt(1 + mu / ratio ** 2)) },
        { name: "closed form", style: "formula", y: ratios.map((ratio) => amplification(ratio, mu, e, zeta)) },
        { name: "exact", style: body, y: line },
      ].map((each) => ({ ...each, x: ratios })),
      here: { x: beta, y: S, words: `S = ${S.toFixed(3)}`, style: body },
    });
    const peak = arrives && !(body === "engine" && sheetMetal) ? outcome[body] : null;
    const reduced = arrives ? force(R) : "none";
    rows.push([body, `${v.toFixed(2)} m/s`, ...[beta, mu, e, S].map((each) => each.toFixed(3)), reduced, peak === null ? "none" : force(peak)]);
    const instead = body === "engine" && sheetMetal ? `: crumpling sheet metal makes the reaction, ${force(outcome.engine)}` : "";
    words.push(!arrives || peak === null
      ? `There is no ${body} peak${instead}.`
      : `For the ${body} S = ${S.toFixed(3)}, and the reaction is ${(R / peak).toFixed(2)} times the full model’s.`);
  });
  const heads = ["body", "contact speed", "β", "μ", "e", "S", "two degrees of freedom", "full model"];
  return { charts, table: { heads, rows }, words: words.join(" ") };
}
