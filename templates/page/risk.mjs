// The risk from traffic: collisions solved once, weighed anew as the traffic changes. What Python has
// in `pierimpact.teaching.presampled`.
import { force, roundUp } from "./chart.mjs";

const ROAD = [4, 201], BRAKING = [3, 9], CELLS = 64, EVENLY = 2000; // numerical, as in Python
const YEARS = [1e2, 1e5]; // of the curve
const POINTS = 120;
const MASSES = [10e3, 20e3, 30e3, 40e3], SPEEDS = [30, 50, 70, 90]; // limits of the classes [kg], [km/h]
const TXDOT = 1e-3; // hits a year
const FEW = 10; // collisions below which a frequency is rough: in trials it was off by a factor of two, and more

/** Values of a lognormal law with their weights, evenly in its logarithm. */
function lognormal(mean, deviation, [reach, count]) {
  const variance = Math.log1p((deviation / mean) ** 2), points = [];
  let sum = 0;
  for (let n = 0; n < count; n++) {
    const z = reach * (-1 + (2 * n) / (count - 1)), weight = Math.exp(-0.5 * z * z);
    points.push({ value: mean * Math.exp(Math.sqrt(variance) * z - 0.5 * variance), weight });
    sum += weight;
  }
  return points.map(({ value, weight }) => ({ value, weight: weight / sum }));
}

/** The chance of arriving faster than each of some speeds, evenly between the ends. */
function arrivals(values, { laws, speeds: [low, high] }) {
  const road = lognormal(values.mean_speed, laws.speedDeviation, ROAD);
  const braking = lognormal(laws.deceleration, laws.decelerationDeviation, BRAKING);
  return Array.from({ length: CELLS + 1 }, (_, n) => {
    const x = low + (n * (high - low)) / CELLS;
    let chance = 0;
    for (const { value: v, weight } of road) {
      const left = v * v - x * x;
      if (left <= 0) continue;
      for (const { value: a, weight: share } of braking) {
        const sine = (2 * a * values.distance_from_road) / left;
        if (sine < 1) chance += weight * share * Math.exp(-0.25 * Math.PI * (Math.asin(sine) / laws.angle) ** 2);
      }
    }
    return chance;
  });
}

/** How many times a year each of the collisions happens. */
export function yearly(values, presampled) {
  const { mass, speed, laws, masses: [light, heavy], speeds: [slow, fast], departures } = presampled;
  const beyond = arrivals(values, presampled), width = (fast - slow) / CELLS;
  const bell = (m) => Math.exp(-0.5 * ((m - values.mean_mass) / laws.massDeviation) ** 2);
  const step = (heavy - light) / EVENLY;
  let area = -0.5 * step * (bell(light) + bell(heavy));
  for (let n = 0; n <= EVENLY; n++) area += step * bell(light + n * step);
  const all = values.traffic_volume * values.truck_share * departures;
  const each = (all * (heavy - light) * (fast - slow)) / (area * width * mass.length);
  return mass.map((m, n) => {
    const cell = Math.min(Math.max(Math.floor((speed[n] - slow) / width), 0), CELLS - 1);
    return each * bell(m) * (beyond[cell] - beyond[cell + 1]);
  });
}

const sum = (values) => values.reduce((all, value) => all + value, 0);

/** Values by how often they are exceeded: the thousands of years between, and the values [MN]. */
function curve(found, weights) {
  const order = [...found.keys()].sort((a, b) => found[b] - found[a]), x = [], y = [];
  const ratio = (YEARS[1] / YEARS[0]) ** (1 / POINTS);
  let rate = 0, next = YEARS[1];
  for (const n of order) {
    rate += weights[n];
    while (rate > 0 && 1 / rate <= next && next >= YEARS[0]) {
      x.push(next / 1e3);
      y.push(found[n] / 1e6);
      next /= ratio;
    }
  }
  return { x, y };
}

/** Years between two events as they are said. */
function years(rate) {
  const between = 1 / rate;
  if (!(between < 1e7)) return "less than once in 10 million years";
  const digits = 10 ** Math.max(Math.floor(Math.log10(between)) - 1, 0);
  return `once in ${(Math.round(between / digits) * digits).toLocaleString("en-US").replaceAll(",", "\u202f")} years`;
}

/** How sure a frequency is, in a sentence: by how many of the collisions account for most of it. */
function doubt(weights) {
  const behind = sum(weights) ** 2 / sum(weights.map((weight) => weight * weight));
  if (!(behind < FEW)) return "";
  const few = Math.round(behind) === 1 ? "one" : `some ${Math.round(behind)}`;
  return ` Only ${few} of the ${weights.length} collisions solved account for that: it is rough.`;
}

/** The shares of the weights in classes with these limits. */
function classes(values, limits, weights) {
  const shares = Array(limits.length + 1).fill(0), all = sum(weights) || 1;
  values.forEach((value, n) => {
    const above = limits.findIndex((limit) => value < limit);
    shares[above < 0 ? limits.length : above] += weights[n] / all;
  });
  return shares;
}

/** Rows of bars: of which classes the trucks are that exceed the resistance. */
function bars(title, limits, unit, of, above, every) {
  const names = limits.map((limit, n) => (n ? `${limits[n - 1]}–${limit} ${unit}` : `below ${limit} ${unit}`));
  const contribution = classes(of, limits, above), hits = classes(of, limits, every), some = sum(above) > 0;
  return {
    kind: "bars", title, x: { label: "Share of those above the resistance", low: 0, high: 100, unit: " %", most: 100 },
    rows: [...names, `above ${limits.at(-1)} ${unit}`].map((name, n) => ({
      name, bars: [{ value: some ? 100 * contribution[n] : null, style: "larger" }],
      words: some ? `${Math.round(100 * contribution[n])} %: ${Math.round(100 * hits[n])} % of hits` : "",
    })),
    empty: some ? "" : "None of the collisions solved exceeds the resistance in this traffic.",
  };
}

/** The explorer of the risk: see `Charts`. */
export function risk({ values, setup: { presampled } }) {
  const { mass, speed, stiffness } = presampled, { resistance, risk_pier: pier } = values;
  const reaction = presampled.reaction[pier], engine = presampled.engine[pier];
  const weights = yearly(values, presampled);
  const above = weights.map((weight, n) => (reaction[n] > resistance ? weight : 0));
  const hits = sum(weights), exceeded = sum(above);
  const full = curve(reaction, weights);
  const hard = curve(mass.map((m, n) => speed[n] * Math.sqrt(stiffness * m)), weights);
  const tons = mass.map((m) => m / 1e3), kmh = speed.map((v) => 3.6 * v);
  const at = (when) => {
    const place = full.x.findIndex((between) => 1e3 * between <= 1.0001 * when);
    return place < 0 ? "—" : force(1e6 * full.y[place]);
  };
  const top = roundUp(Math.max(1.1 * resistance, ...full.y.map((value) => 1.05e6 * value))) / 1e6;
  const byEngine = sum(above.filter((_, n) => engine[n])) / (exceeded || 1);
  return {
    charts: [
      {
        kind: "lines", title: "How strong once in how many years",
        x: { label: "Exceeded once in … thousand years", low: YEARS[0] / 1e3, high: YEARS[1] / 1e3, log: true },
        y: { label: "Reaction [MN]", low: 0, high: top },
        curves: [{ name: "full model", style: "reaction", ...full }, { name: "v √(k m)", style: "impulse", ...hard }],
        level: { y: resistance / 1e6, words: "resistance" },
      },
      bars("By mass", MASSES.map((limit) => limit / 1e3), "t", tons, above, weights),
      bars("By speed at the pier", SPEEDS, "km/h", kmh, above, weights),
    ],
    facts: [
      ["Struck", years(hits), "trucks that reach the pier"],
      ["Resistance exceeded", exceeded > 0 ? years(exceeded) : "by none of the collisions solved", "reactions above the resistance"],
      ["Once in 10 000 years", at(1e4), "reaction that is exceeded so often"],
    ],
    words: `The pier is struck ${years(hits)}, ${hits < TXDOT ? "less" : "more"} often than the 0.001 a year from which `
      + "TxDOT asks for a check; its resistance is exceeded "
      + (exceeded > 0 ? `${years(exceeded)}, in ${Math.round(100 * byEngine)} % by the engine’s peak.${doubt(above)}`
        : `by none of the ${mass.length} collisions solved.`),
  };
}
