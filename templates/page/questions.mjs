// Three predictions: each is made before its answer is on show, and names what it may cure.
import { force, hertz } from "./chart.mjs";

const fold = (ratio) => `${ratio.toFixed(1)} times`;

/**
 * The questions about a truck.
 *
 * outcome(frequency, mass): the collision of the truck as it is first on show; frequencies: of a
 * soft and a stiff pier [Hz]; masses: of the truck as it is and with more cargo [kg]; range: the
 * frequencies on the chart. Each question has `words`, `choices`, and `answer()`, which returns the
 * index of the right choice and the `reason`; `show` are the values at which it can be seen.
 */
export function questions({ outcome, speed, masses, range, crossing }) {
  const tonnes = masses.map((mass) => `${(mass / 1e3).toFixed(1)} t`);
  const soft = 10, stiff = 100;
  return [
    {
      words: `The same truck, at ${speed} km/h, strikes one pier after another, each stiffer than the `
        + `one before: the natural frequency rises from ${range.low} to ${range.high} Hz. The pier feels `
        + "two blows, the engine’s and the cargo’s. What happens to the two peaks?",
      choices: [
        ["Both grow by about the same factor.", "A stiffer pier takes more of everything."],
        ["Neither changes much.", "The truck makes the force; the pier only receives it."],
        ["The engine’s grows several times over, the cargo’s far less.", ""],
        ["Both shrink.", "What moves more must carry more."],
      ],
      answer() {
        const [first, last] = [range.low, range.high].map((frequency) => outcome(frequency, masses[0]));
        const engine = last.engine / first.engine, cargo = last.cargo ? last.cargo / first.cargo : 1;
        const reason = `The engine’s peak grows ${fold(engine)}`
          + (last.cargo ? `, the cargo’s ${fold(cargo)}` : "")
          + ": the engine’s blow is over before a soft pier has begun to move, the cargo’s lasts long "
          + "enough for it to respond.";
        const right = Math.max(engine, cargo) < 0.8 ? 3
          : Math.max(engine, cargo) < 1.3 ? 1
          : engine > 1.5 * cargo ? 2 : 0;
        return { right, reason };
      },
    },
    {
      words: `A stiff pier (${stiff} Hz) carries far more of the engine’s blow than a soft one `
        + `(${soft} Hz). Now look at the bumper instead: the largest force between engine and pier is …`,
      choices: [
        ["… far larger at the stiff pier, too.", "The force at the bumper is the force in the pier."],
        ["… about the same at both.", ""],
        ["… far larger at the soft pier.", "A force that the pier does not carry has to go somewhere else."],
      ],
      answer() {
        const [a, b] = [soft, stiff].map((frequency) => outcome(frequency, masses[0]));
        const ratio = b.engineForce / a.engineForce;
        const reason = `At the bumper ${force(a.engineForce)} and ${force(b.engineForce)}, in the pier `
          + `${force(a.engine)} and ${force(b.engine)}. For these milliseconds the engine pushes against `
          + "the pier’s mass, which is there whatever holds it. The reaction R is what holds it: it "
          + "grows only as far as the pier moves.";
        return { right: ratio > 1.4 ? 0 : ratio < 1 / 1.4 ? 2 : 1, reason };
      },
      show: { frequency: soft, mass: masses[0], moment: "engineTime" },
    },
    {
      words: `The truck takes on more cargo: ${tonnes[1]} in all instead of ${tonnes[0]}, at the same speed. `
        + "Which of the two lines rises?",
      choices: [
        ["Both.", "A truck strikes as one block, so more mass makes every blow harder."],
        ["Only the cargo’s.", ""],
        ["Only the engine’s.", "The load pushes the engine into the pier."],
      ],
      answer() {
        const rise = (body) => {
          const [a, b] = masses.map((mass) => outcome(stiff, mass)[body] ?? 0);
          return b > 1.05 * (a || 1);
        };
        const [before, after] = masses.map(crossing);
        const moved = before && after
          ? ` So the lines cross farther to the ${after > before ? "right" : "left"}: at ${hertz(after)} `
            + `instead of ${hertz(before)}.`
          : "";
        const engine = rise("engine"), cargo = rise("cargo");
        const reason = "The cargo stands behind the engine and is not joined to it. The engine has done "
          + `with the pier before the cargo arrives, however much there is of it.${moved}`;
        return { right: engine ? (cargo ? 0 : 2) : 1, reason };
      },
      show: { frequency: stiff, mass: masses[1], moment: "cargoTime" },
    },
  ];
}
