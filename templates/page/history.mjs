// One collision against time, for pictures of it.
import { simulate } from "./model.mjs";

const ROWS = ["time", "x1", "v1", "x2", "v2", "xp", "vp", "F1", "F2", "left1", "left2"];

/**
 * Follow a collision for `duration` [s] and keep every step.
 *
 * Returns its `outcome`; `rows`, one array per step: time, the state, the forces of the springs and
 * the crush that they would keep without force; `at(time)`, the same at any instant, by name; and
 * `reaction(time)`.
 */
export function follow(truck, pier, speed, duration) {
  const rows = [];
  const kept = (spring) => spring.largest - spring.envelope(spring.largest) / spring.ku;
  const outcome = simulate(truck, pier, speed, {
    duration,
    record(time, y, engine, body) {
      const lefts = [[engine, 0], [body, 2]].map(([spring, x]) =>
        Math.max(kept(spring), spring.loading ? y[x] - y[4] - spring.force(y) / spring.ku : 0));
      rows.push([time, ...y, engine.force(y), body.force(y), ...lefts]);
    },
  });

  /** The step that covers a time: its rows, its length, and how much of it has passed. */
  function step(time) {
    let low = 0, high = rows.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (rows[middle][0] <= time) low = middle;
      else high = middle;
    }
    const a = rows[low], b = rows[high], h = b[0] - a[0];
    return { a, b, h, s: Math.min((time - a[0]) / h, 1) };
  }

  function at(time) {
    const { a, b, h, s } = step(time);
    const found = Object.fromEntries(ROWS.map((name, n) => [name, a[n] + s * (b[n] - a[n])]));
    for (const n of [1, 3, 5]) {
      const cubic = [a[n], a[n + 1], b[n], b[n + 1], h, s];
      found[ROWS[n]] = hermite(...cubic);
      found[ROWS[n + 1]] = hermiteRate(...cubic);
    }
    found.R = pier.stiffness * found.xp;
    return found;
  }

  function reaction(time) {
    const { a, b, h, s } = step(time);
    return pier.stiffness * hermite(a[5], a[6], b[5], b[6], h, s);
  }

  return { outcome, rows, at, reaction };
}

/**
 * Where the truck's energy is at each of the rows of `follow`, as shares of all of it: in motion, in
 * the pier's spring and in the truck's, in crushed metal, and what friction and damping took.
 */
export function energyShares(rows, truck, pier, speed) {
  const { engine, body, friction, frictionOnPier } = truck;
  const whole = 0.5 * (engine.mass + body.mass) * speed ** 2;
  let work = 0, rubbed = 0, before = rows[0];
  return rows.map((row) => {
    const [time, x1, v1, x2, v2, xp, vp, F1, F2] = row, [, p1, , p2, , pp, , G1, G2] = before;
    before = row;
    work += 0.5 * ((F1 + G1) * (x1 - xp - p1 + pp) + (F2 + G2) * (x2 - xp - p2 + pp));
    const slid = frictionOnPier ? (F2 + G2 > 0 ? x2 - xp - p2 + pp : 0) : x2 - p2;
    rubbed += friction * Math.abs(slid);
    const springs = 0.5 * (F1 ** 2 / engine.unloadingStiffness + F2 ** 2 / body.unloadingStiffness);
    const joules = {
      motion: 0.5 * (engine.mass * v1 ** 2 + body.mass * v2 ** 2 + pier.mass * vp ** 2),
      pier: 0.5 * pier.stiffness * xp ** 2, springs, crush: work - springs, friction: rubbed,
    };
    const shares = Object.fromEntries(Object.entries(joules).map(([name, value]) => [name, value / whole]));
    const known = Object.values(shares).reduce((sum, share) => sum + share, 0);
    return { time, ...shares, damping: 1 - known }; // energy is kept
  });
}

/** The cubic with values a, b and rates u, v at the ends of a step h, at the share s of it. */
function hermite(a, u, b, v, h, s) {
  const r = 1 - s;
  return r * r * ((1 + 2 * s) * a + s * h * u) + s * s * ((1 + 2 * r) * b - r * h * v);
}

function hermiteRate(a, u, b, v, h, s) {
  const r = 1 - s;
  return (6 * r * s * (b - a)) / h + r * (1 - 3 * s) * u + s * (1 - 3 * r) * v;
}
