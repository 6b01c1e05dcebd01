// Three questions to predict the answer of; each wrong choice names the misconception behind it.
import { force, hertz } from "./chart.mjs";

const SOFT = 10, STIFF = 100; // piers to compare [Hz]

/**
 * The questions about a truck.
 *
 * outcome(frequency, mass): of the collision of this truck at `speed` [km/h];
 * mass: of the truck as it is [kg]; masses: without and with more cargo;
 * crossing(mass): the frequency from which on the engine governs, if there is one;
 * range: { low, high } of the frequencies on the chart.
 *
 * Each question has `words`; `choices`, each with the misconception behind it; `answer()`, which
 * returns the place of the right choice and the `reason`; and `show`, where it can be seen.
 */
export function questions({ outcome, speed, mass, masses, crossing, range }) {
  return [stiffer(), bumper(), heavier()];

  function stiffer() {
    return {
      words: `The same truck, at ${speed} km/h, strikes one pier after another, each stiffer than `
        + `the one before: the natural frequency rises from ${range.low} to ${range.high} Hz. `
        + "Each feels two blows, the engine’s and the cargo’s. What happens to the two peaks?",
      choices: [
        ["Both grow by about the same factor.", "A stiffer pier takes more of everything."],
        ["Neither changes much.", "The truck makes the force, the pier only receives it."],
        ["The engine’s grows several times over, the cargo’s far less.", ""],
        ["Both shrink.", "What moves more must carry more."],
      ],
      answer() {
        const [soft, stiff] = [range.low, range.high].map((frequency) => outcome(frequency, mass));
        const engine = stiff.engine / soft.engine;
        const cargo = soft.cargo && stiff.cargo ? stiff.cargo / soft.cargo : 1;
        const most = Math.max(engine, cargo);
        const right = most < 0.8 ? 3 : most < 1.3 ? 1 : engine > 1.5 * cargo ? 2 : 0;
        const reason = `The engine’s peak grows ${engine.toFixed(1)} times`
          + (stiff.cargo ? `, the cargo’s ${cargo.toFixed(1)} times` : "")
          + ": the engine’s blow is over before a soft pier has begun to move, the cargo’s lasts "
          + "long enough for it to respond.";
        return { right, reason };
      },
    };
  }

  function bumper() {
    return {
      words: `Now look at the bumper instead, at a stiff pier (${STIFF} Hz) and at a soft one `
        + `(${SOFT} Hz). The largest force between engine and pier is …`,
      choices: [
        ["… far larger at the stiff pier, too.", "The force at the bumper is that in the pier."],
        ["… about the same at both.", ""],
        ["… far larger at the soft pier.", "What the pier does not carry, the bumper must."],
      ],
      answer() {
        const [soft, stiff] = [SOFT, STIFF].map((frequency) => outcome(frequency, mass));
        const ratio = stiff.engineForce / soft.engineForce;
        const reason = `At the bumper ${force(soft.engineForce)} and ${force(stiff.engineForce)}, `
          + `in the pier ${force(soft.engine)} and ${force(stiff.engine)}. In these milliseconds `
          + "the engine pushes against the pier’s mass, which is there whatever holds it. The reaction "
          + "is the force in what holds it, and grows only as far as the pier moves.";
        return { right: ratio > 1.4 ? 0 : ratio < 1 / 1.4 ? 2 : 1, reason };
      },
      show: { frequency: SOFT, mass, moment: "engineContact" },
    };
  }

  function heavier() {
    const [less, more] = masses.map((each) => `${(each / 1e3).toFixed(1)} t`);
    return {
      words: `The truck takes on more cargo: ${more} in all instead of ${less}, at the same speed. `
        + "Which of the two lines rises?",
      choices: [
        ["Both.", "A truck strikes as one block: more mass, harder blows."],
        ["Only the cargo’s.", ""],
        ["Only the engine’s.", "The load pushes the engine into the pier."],
      ],
      answer() {
        const rises = (body) => {
          const [before, after] = masses.map((each) => outcome(STIFF, each)[body] ?? 0);
          return after > 1.05 * before;
        };
        const [before, after] = masses.map(crossing);
        const moved = before && after
          ? ` So the lines become equal at ${hertz(after)} instead of ${hertz(before)}.`
          : "";
        const engine = rises("engine");
        const reason = "The cargo stands behind the engine and is not joined to it. The engine has "
          + `done with the pier before the cargo arrives, however much of it there is.${moved}`;
        return { right: engine && rises("cargo") ? 0 : engine ? 2 : 1, reason };
      },
      show: { frequency: STIFF, mass: masses[1], moment: "cargoTime" },
    };
  }
}
