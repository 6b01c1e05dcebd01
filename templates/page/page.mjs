// The page: the explorer, its trucks, and the predictions.
import { Explorer } from "./explorer.mjs";
import { simulate } from "./model.mjs";
import { predictions } from "./predictions.mjs";
import { questions } from "./questions.mjs";
import { bandsOf, coarseSpectrum, pierAt, pointAt } from "./spectrum.mjs";

const { trucks, pier, setup } = JSON.parse(document.getElementById("data").textContent);
const { range } = setup, first = setup.values;
const COARSE = 33; // points of a spectrum that is only asked for its crossing

const $ = (id) => document.getElementById(id);
const introduction = [...$("lead").childNodes];
const explorer = new Explorer($("explorer"), { ...setup, truck: trucks[0] });

$("controls").prepend($("truck-choice"));
$("controls").append($("truck-notes"));
$("truck").onchange = () => choose(Number($("truck").value));

function choose(number, values = {}) {
  const { masses } = trucks[number];
  explorer.truck = trucks[number];
  explorer.controls.truck_mass.reach({ low: masses.low / 1e3, high: masses.high / 1e3, step: masses.step / 1e3 });
  $("truck").value = number;
  for (const note of document.querySelectorAll(".status")) note.hidden = Number(note.dataset.truck) !== number;
  explorer.set({ truck_mass: masses.first, ...values });
}

// The predictions are about the first truck at the first speed.
const { masses } = trucks[0];

function about(mass) {
  const [truck] = trucks, body = { ...truck.body, mass: mass - truck.engine.mass };
  return { truck: { ...truck, body }, pier, speed: first.speed };
}

const asked = questions({
  outcome: (frequency, mass) => pointAt(frequency, about(mass)),
  crossing: (mass) => bandsOf(coarseSpectrum(range, COARSE, about(mass)), about(mass))
    .findLast((band) => band.crossing)?.low,
  speed: Math.round(3.6 * first.speed),
  mass: masses.first,
  masses: masses.high > masses.first ? [masses.first, masses.high] : [masses.low, masses.first],
  range,
}).filter(({ show }) => !show || masses.high > masses.low);

choose(0);
const { startAgain } = predictions(asked, {
  gate: $("gate"),
  list: $("questions"),
  key: `pierimpact page, ${trucks[0].name}`,
  reveal(revealed, words) {
    explorer.reveal(revealed);
    $("lead").replaceChildren(...(words ?? introduction));
    if (words) $("lead").focus({ preventScroll: true });
  },
  show({ frequency, mass, moment }) {
    const { pier_frequency: slider } = explorer.controls;
    const at = slider.at(slider.notch(frequency));
    choose(0, { truck_mass: mass, speed: first.speed, pier_frequency: at });
    explorer.look(moment);
    $("explorer").scrollIntoView();
    $("pier_frequency").focus({ preventScroll: true });
  },
});
$("again").onclick = () => {
  startAgain();
  $("explorer").scrollIntoView();
};
for (const link of document.querySelectorAll(".status a")) {
  link.onclick = () => { document.querySelector(link.hash).open = true; };
}

globalThis.pierimpact = { simulate, trucks, pierAt }; // to calculate more in the console
addEventListener("beforeprint", () => {
  for (const details of document.querySelectorAll("details")) details.open = true;
  explorer.showAll();
});
