// The collision of a truck with a bridge pier: the coupled mass-spring-damper model (CMSD).
//
// Engine and body (with the cargo) each act on the pier through a spring of their own, and the
// pier is a mass on a spring and a damper. SI units; x in the direction of travel, time from first
// touch.
//
//   engine   m1 x1'' = −F1(δ1)             δ1 = x1 − xp, crush of the engine's spring
//   body     m2 x2'' = −F2(δ2) − Fs        δ2 = x2 − xp, crush of the body's spring
//   pier     mp xp'' + cp xp' + kp xp = F1 + F2 (+ Fs where the friction acts on the pier)
//   start    x1 = x2 = xp = 0,  x1' = x2' = V,  xp' = 0
//   result   R = kp xp, the reaction of the pier
//
// While each spring stays on one straight line of its law these equations are linear. They then
// give all derivatives of the motion, and Taylor's series sums it; a step ends at the very instant
// at which a spring leaves its line.

// The state is an array: x1, x1', x2, x2', xp, xp'.
const X1 = 0, V1 = 1, X2 = 2, V2 = 3, XP = 4, VP = 5;

// Numerical settings: derivatives taken; how far the fastest vibration may turn in a step [rad];
// the longest step [s]; how closely an instant is found, as a share of the step; the most steps.
const ORDER = 11, PHASE = 1, LONGEST = 2e-3, CLOSE = 1e-10, STEPS = 200000;
const RECIPROCALS = Float64Array.from({ length: ORDER + 1 }, (_, n) => 1 / n);

/**
 * The crush law of a spring, with plateau force P, plateau length d, stiffness k and unloading
 * stiffness ku:
 *
 *   first loading    E(δ) = min(ku δ, P) up to δ = d   plateau: sheet metal crumples
 *                    E(δ) = P + k (δ − d) beyond       steep rise: engine or cargo is in contact
 *   unloading and    F = E(δmax) − ku (δmax − δ), never below zero: no tension
 *   reloading
 */
class CrushSpring {
  constructor({ plateauForce, plateauLength, stiffness, unloadingStiffness }, x, v) {
    this.P = plateauForce;
    this.d = plateauLength;
    this.k = stiffness;
    this.ku = unloadingStiffness;
    this.x = x; // where the state has the position of the mass behind it,
    this.v = v; // and its velocity
    this.contact = null; // the time at which the hard body first meets the pier
    this.largest = this.P / this.ku; // a new spring behaves as if it had been crushed so far
    this.enter("unloading");
  }

  envelope(crush) {
    return this.P + this.k * Math.max(crush - this.d, 0);
  }

  /** Go on along another line of the law, F = intercept + slope δ. */
  enter(line) {
    const { P, d, k, ku, largest } = this;
    const residual = largest - this.envelope(largest) / ku; // crush left when the force has gone
    this.line = line;
    this.loading = line === "plateau" || line === "steep";
    this.lower = line === "unloading" ? residual : -Infinity;
    switch (line) {
      case "apart": this.slope = 0, this.intercept = 0, this.upper = residual; break;
      case "unloading": this.slope = ku, this.intercept = -ku * residual, this.upper = largest; break;
      case "plateau": this.slope = 0, this.intercept = P, this.upper = d; break;
      default: this.slope = k, this.intercept = P - k * d, this.upper = Infinity; // steep
    }
  }

  crush(y) {
    return y[this.x] - y[XP];
  }

  rate(y) {
    return y[this.v] - y[VP];
  }

  force(y) {
    return this.intercept + this.slope * this.crush(y);
  }

  /** Follow the law to the state y; return whether that is on another line. */
  follow(y) {
    const crush = this.crush(y);
    if (this.loading && this.rate(y) < 0) {
      this.largest = crush;
      this.enter("unloading");
    } else if (crush < this.lower) {
      this.enter("apart");
    } else if (crush > this.upper) {
      const plateau = this.line === "unloading" && this.largest < this.d;
      this.enter(this.line === "apart" ? "unloading" : plateau ? "plateau" : "steep");
    } else {
      return false;
    }
    return true;
  }
}

/** Coulomb friction Fs on the body, against its motion over the road or along the pier. */
class Friction {
  constructor({ friction, frictionOnPier, body }, pier) {
    this.limit = friction;
    this.onPier = frictionOnPier;
    this.stuck = false;
    this.direction = friction > 0 ? 1 : 0; // of sliding; 0 where it sticks or does not act
    // A pier moves along with the body that it holds, the road does not.
    this.share = frictionOnPier ? body.mass / (body.mass + pier.mass) : 0;
  }

  /** Velocity of the body along what it rubs against. */
  velocity(y) {
    return y[V2] - (this.onPier ? y[VP] : 0);
  }
}

/** The friction that holds the body: x2'' = 0 on the road, x2'' = xp'' on the pier. */
function held(F1, F2, resistance, share) {
  return -F2 - share * (F1 - resistance);
}

/**
 * Follow one collision until no later instant can bring a higher peak.
 *
 * truck: { engine, body, friction [N], frictionOnPier }, where engine and body are each
 *   { mass, plateauForce, plateauLength, stiffness, unloadingStiffness };
 * pier: { mass, stiffness, dampingRatio };
 * speed: at first touch [m/s];
 * duration: time that is covered at least [s];
 * record: called as record(time, y, engine, body) at first touch and after each step;
 * start: the state to begin with, in place of that at first touch.
 *
 * Returns the peaks of R before and from cargo contact on [N], their times, and the times of both
 * contacts [s]; null for what does not happen. Beside them the lowest reaction and the largest
 * force on the engine [N].
 */
export function simulate(truck, pier, speed, { duration = 0, record = null, start = [0, speed, 0, speed, 0, 0] } = {}) {
  const m1 = truck.engine.mass, m2 = truck.body.mass;
  const mp = pier.mass, kp = pier.stiffness, cp = 2 * pier.dampingRatio * Math.sqrt(kp * mp);
  const engine = new CrushSpring(truck.engine, X1, V1), body = new CrushSpring(truck.body, X2, V2);
  const friction = new Friction(truck, pier);
  const y = Float64Array.from(start); // the state at the start of a step
  const later = new Float64Array(6); // and within it
  const happened = new Float64Array(8); // of what may end it, by how far it has happened

  const now = { time: 0, changed: 0, lowest: 0, engineForce: 0 }; // changed: of the last change
  const before = { xp: 0, time: 0 }, after = { xp: 0, time: 0 };
  let peak = before; // `after` from cargo contact on

  /** All derivatives of the motion at the start of a step: x1[n] is dⁿx1/dtⁿ, and so on. */
  const [x1, x2, xp] = [1, 2, 3].map(() => new Float64Array(ORDER + 1));
  function differentiate() {
    const { slope: s1, intercept: i1 } = engine, { slope: s2, intercept: i2 } = body;
    const { stuck, share, onPier } = friction, sliding = friction.direction * friction.limit;
    x1[0] = y[X1], x1[1] = y[V1], x2[0] = y[X2], x2[1] = y[V2], xp[0] = y[XP], xp[1] = y[VP];
    for (let n = 0; n + 2 <= ORDER; n++) {
      const once = n === 0 ? 1 : 0; // what is constant has no derivatives
      const F1 = once * i1 + s1 * (x1[n] - xp[n]);
      const F2 = once * i2 + s2 * (x2[n] - xp[n]);
      const resistance = kp * xp[n] + cp * xp[n + 1];
      const Fs = stuck ? held(F1, F2, resistance, share) : once * sliding;
      x1[n + 2] = -F1 / m1;
      x2[n + 2] = -(F2 + Fs) / m2;
      xp[n + 2] = (F1 + F2 + (onPier ? Fs : 0) - resistance) / mp;
    }
  }

  /** Put the state a time t after the start of the step into `later`, by x(t) = Σ x[n] tⁿ/n!. */
  function advance(t) {
    let p1 = x1[ORDER], p2 = x2[ORDER], pp = xp[ORDER], v1 = 0, v2 = 0, vp = 0;
    for (let n = ORDER - 1; n >= 0; n--) {
      const share = t * RECIPROCALS[n + 1];
      p1 = x1[n] + p1 * share, v1 = x1[n + 1] + v1 * share;
      p2 = x2[n] + p2 * share, v2 = x2[n + 1] + v2 * share;
      pp = xp[n] + pp * share, vp = xp[n + 1] + vp * share;
    }
    later[X1] = p1, later[V1] = v1, later[X2] = p2, later[V2] = v2, later[XP] = pp, later[VP] = vp;
  }

  /** The longest step in which no vibration turns by more than PHASE. */
  function longestStep() {
    const fastest = Math.max(engine.slope / m1, body.slope / m2) + (cp / mp) ** 2
      + (kp + engine.slope + body.slope) / mp;
    const turn = record ? 0.5 * PHASE : PHASE; // what is drawn has straight lines between its steps
    return Math.min(turn / Math.sqrt(fastest), LONGEST);
  }

  function holding(state) {
    const resistance = kp * state[XP] + cp * state[VP];
    return held(engine.force(state), body.force(state), resistance, friction.share);
  }

  /**
   * What ends a step, by how far it has happened in `later`: positive as soon as it has. Crushes and
   * pier turn first; between their turns they only rise or only fall, so that nothing else is passed
   * unseen.
   */
  function measure() {
    const crush1 = engine.crush(later), crush2 = body.crush(later);
    happened[0] = -Math.sign(engine.rate(y)) * engine.rate(later);
    happened[1] = -Math.sign(body.rate(y)) * body.rate(later);
    happened[2] = y[VP] > 0 && y[XP] + y[VP] * LONGEST > peak.xp ? -later[VP] : -1;
    happened[3] = crush1 - engine.upper;
    happened[4] = engine.lower - crush1;
    happened[5] = crush2 - body.upper;
    happened[6] = body.lower - crush2;
    happened[7] = friction.stuck
      ? Math.abs(holding(later)) - friction.limit
      : -friction.direction * friction.velocity(later);
  }

  /** Put the instant within the step h at which `what` has happened by just a little into `later`. */
  function findInstant(what, h) {
    let low = 0, high = h, side = 0, above = happened[what];
    advance(low);
    measure();
    let below = happened[what];
    for (let n = 1; high - low > CLOSE * h; n++) {
      let t = low - (below * (high - low)) / (above - below); // where the chord meets zero,
      if (n % 4 === 0 || !(t > low && t < high)) t = 0.5 * (low + high); // or halfway
      advance(t);
      measure();
      const value = happened[what];
      if (value > 0) {
        if (side > 0) below *= 0.5; // or the chord would end on this side for ever (Illinois rule)
        high = t, above = value, side = 1;
      } else {
        if (side < 0) above *= 0.5;
        low = t, below = value, side = -1;
      }
    }
    advance(high);
    measure();
    return high;
  }

  /** The end of the step: after h, or where the first change has happened. */
  function endOfStep(h) {
    advance(h);
    measure();
    for (let what = 0; what < happened.length; what++) if (happened[what] > 0) h = findInstant(what, h);
    return h;
  }

  /** Let springs and friction follow to the present state; return whether any of them changed. */
  function change() {
    const engineChanged = engine.follow(y), wasApart = body.line === "apart";
    const bodyChanged = body.follow(y);
    if (engine.contact === null && engine.line === "steep") engine.contact = now.time;
    if (body.contact === null && body.line === "steep") {
      body.contact = after.time = now.time;
      after.xp = y[XP];
      peak = after;
    }
    if (bodyChanged && friction.onPier) rubOnlyInContact(wasApart);
    return rub() || engineChanged || bodyChanged;
  }

  /** Friction on the pier acts while the body's spring is in contact. */
  function rubOnlyInContact(wasApart) {
    if (body.line === "apart") {
      friction.direction = 0;
      friction.stuck = false;
    } else if (wasApart && friction.limit > 0) {
      friction.direction = 1;
    }
  }

  /** Where sliding has come to rest it sticks or reverses; what sticks may begin to slide. */
  function rub() {
    const rests = friction.direction * friction.velocity(y) < 0;
    if (!rests && !friction.stuck) return false;
    const force = holding(y), sticks = Math.abs(force) <= friction.limit;
    if (friction.stuck && sticks) return false;
    friction.stuck = sticks;
    friction.direction = sticks ? 0 : Math.sign(force);
    if (rests) y[V2] = friction.onPier ? y[VP] : 0;
    return true;
  }

  /** Whether too little energy can still reach the pier, or the truck has left it for a period. */
  function finished() {
    let energy = 0.5 * (kp * y[XP] ** 2 + mp * y[VP] ** 2);
    if (y[V1] > 0) energy += 0.5 * m1 * y[V1] ** 2;
    if (y[V2] > 0 || friction.onPier) energy += 0.5 * m2 * y[V2] ** 2;
    energy += 0.5 * (engine.force(y) ** 2 / engine.ku + body.force(y) ** 2 / body.ku);
    const arrives = (spring) => spring.contact === null
      && spring.P * (spring.d - Math.max(spring.largest, spring.crush(y))) <= energy;
    const higher = 2 * energy > kp * peak.xp ** 2 * (1 + 1e-9);
    if (!higher && !arrives(engine) && !arrives(body)) return true;
    const engineLeft = engine.line === "apart" && y[V1] <= 0;
    const bodyLeft = friction.stuck || (body.line === "apart" && y[V2] <= 0);
    const period = 2 * Math.PI * Math.sqrt((mp + (friction.onPier ? m2 : 0)) / kp);
    return engineLeft && bodyLeft && now.time > now.changed + period;
  }

  if (record) record(now.time, y, engine, body);
  for (let n = 0; now.time < duration || !finished(); n++) {
    if (n === STEPS) throw new Error("the collision did not come to an end");
    differentiate();
    now.time += endOfStep(longestStep());
    y.set(later);
    if (y[XP] > peak.xp) {
      peak.xp = y[XP];
      peak.time = now.time;
    }
    now.lowest = Math.min(now.lowest, y[XP]);
    now.engineForce = Math.max(now.engineForce, engine.force(y));
    while (change()) now.changed = now.time;
    if (record) record(now.time, y, engine, body);
  }
  const reached = peak === after;
  return {
    engine: kp * before.xp,
    engineTime: before.time,
    engineContact: engine.contact,
    cargo: reached ? kp * after.xp : null,
    cargoTime: reached ? after.time : null,
    cargoContact: body.contact,
    lowest: kp * now.lowest,
    engineForce: now.engineForce,
  };
}
