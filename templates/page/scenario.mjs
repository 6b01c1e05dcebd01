// The values of the controls as a collision.
import { isMechanism, pierOf } from "./column.mjs";
import { pierAt } from "./spectrum.mjs";

const SPRING = { plateau_force: "plateauForce", plateau_length: "plateauLength", stiffness: "stiffness", unloading_stiffness: "unloadingStiffness" };

/** The truck of these values, as `simulate` takes it: its own parameters where they are not among them. */
function truckOf(truck, values) {
  const spring = (body) => Object.fromEntries(Object.entries(SPRING).map(([key, name]) =>
    [name, values[`${body}_${key}`] ?? truck[body][name]]));
  const mass = values.engine_mass ?? truck.engine.mass;
  return {
    ...truck,
    friction: values.friction_force ?? truck.friction,
    engine: { ...spring("engine"), mass },
    body: { ...spring("body"), mass: values.truck_mass - mass },
  };
}

/** The frequency [Hz] and mass of the pier: as they are given, or those of a column. */
export function pierFrom(values, concrete) {
  if (values.pier_frequency !== null) return { frequency: values.pier_frequency, mass: values.pier_mass };
  const { stiffness, mass } = pierOf({
    diameter: values.column_diameter, height: values.column_height, impact: values.impact_height,
    base: values.base, top: values.top, ...concrete,
  });
  return { frequency: Math.sqrt(stiffness / mass) / (2 * Math.PI), mass };
}

/** Why there is no such collision, as a sentence; empty where there is. */
export function refusal(values, truck) {
  const { engine, body } = truckOf(truck, values);
  if (values.pier_frequency === null) {
    const { base, top, column_height: height, impact_height: impact } = values;
    if (isMechanism(base, top)) {
      return `With a ${base} base and a ${top} top the column is a mechanism: fix one end, or pin both.`;
    }
    if (impact >= height) return "The truck strikes above the column: lower the impact height.";
  }
  if (body.mass <= 0) return "The truck’s total mass must exceed that of its engine.";
  for (const [name, spring] of [["engine", engine], ["body", body]]) {
    if (spring.unloadingStiffness < spring.stiffness) {
      return `The ${name} spring’s unloading stiffness must be at least its steep stiffness.`;
    }
    if (spring.plateauLength < spring.plateauForce / spring.unloadingStiffness) {
      return `The ${name} spring’s plateau is too short: its force over its unloading stiffness must fit in.`;
    }
  }
  return "";
}

/** The collision of these values: { truck, pier: { mass, dampingRatio }, its frequency [Hz], speed }. */
export function collisionOf(values, { truck, concrete }) {
  const { frequency, mass } = pierFrom(values, concrete);
  return {
    truck: truckOf(truck, values), frequency,
    pier: { mass, dampingRatio: values.damping_ratio }, speed: values.speed,
  };
}

/** A collision by the names of its symbols, as the procedure takes it. */
export function symbolsOf({ truck, frequency, pier, speed }) {
  const { engine, body } = truck;
  return {
    V: speed, mp: pier.mass, kp: pierAt(frequency, pier).stiffness, zeta: pier.dampingRatio,
    m1: engine.mass, P1: engine.plateauForce, d1: engine.plateauLength, k1: engine.stiffness, ku1: engine.unloadingStiffness,
    m2: body.mass, P2: body.plateauForce, d2: body.plateauLength, k2: body.stiffness, ku2: body.unloadingStiffness,
    cs: truck.friction, on_pier: truck.frictionOnPier,
  };
}
