// The page: the explorer, its trucks, and the predictions.
import { button, make } from "./controls.mjs";
import { Explorer } from "./explorer.mjs";
import { simulate } from "./model.mjs";
import { questions } from "./questions.mjs";
import { bandsOf, coarseSpectrum, pierAt, pointAt } from "./spectrum.mjs";

const { trucks, pier, setup } = JSON.parse(document.getElementById("data").textContent);
const { range } = setup, first = setup.values;
const COARSE = 33; // points of a spectrum that is only asked for its crossing
const MEMORY = "pierimpact page";

const $ = (id) => document.getElementById(id);
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

// Predictions

const memory = remembered();

/** What was decided before, where the browser keeps it. */
function remembered() {
  try {
    const kept = JSON.parse(localStorage.getItem(MEMORY));
    if (kept && typeof kept.choices === "object") return { choices: kept.choices, skipped: Boolean(kept.skipped) };
  } catch { /* none, or none allowed */ }
  return { choices: {}, skipped: false };
}

function remember() {
  try {
    localStorage.setItem(MEMORY, JSON.stringify(memory));
  } catch { /* it works without */ }
}

/** The first truck at the first speed, which the predictions are about. */
function reference(mass) {
  const [truck] = trucks;
  return { truck: { ...truck, body: { ...truck.body, mass: mass - truck.engine.mass } }, pier, speed: first.speed };
}

const { masses } = trucks[0];
const asked = questions({
  outcome: (frequency, mass) => pointAt(frequency, reference(mass)),
  crossing(mass) {
    const bands = bandsOf(coarseSpectrum(range, COARSE, reference(mass)), reference(mass));
    return bands.findLast((band) => band.crossing)?.low;
  },
  speed: Math.round(3.6 * first.speed),
  masses: [masses.first, masses.high > 1.05 * masses.first ? masses.high : 1.5 * masses.first],
  range,
});

/** A question as a field set; once it is locked, with its answer. */
function fieldset(question, number) {
  const field = make("fieldset", { id: `question-${number}` }, make("legend", { textContent: `${number + 1}. ${question.words}` }));
  const locked = number in memory.choices;
  const { right, reason } = locked ? question.answer() : {};
  const choices = make("div", { className: "choices" });
  question.choices.forEach(([words], n) => {
    const chosen = memory.choices[number] === n;
    const input = make("input", { type: "radio", name: field.id, value: n, checked: chosen, disabled: locked });
    const label = make("label", {}, input, make("span", { textContent: words }));
    if (locked && n === right) label.className = "right";
    if (chosen) label.append(make("small", { textContent: n === right ? "✓ your prediction" : "✗ your prediction" }));
    else if (locked && n === right) label.append(make("small", { textContent: "✓ what happens" }));
    choices.append(label);
  });
  field.append(choices);
  const buttons = make("div", { className: "buttons" });
  if (locked) {
    field.append(make("p", { className: "verdict", tabIndex: -1 }, ...verdict(question, memory.choices[number], right, reason)));
    if (question.show) buttons.append(button("Show it above", "", () => showExample(question.show)));
  } else {
    const lock = button("Lock my prediction", "main", () => {
      memory.choices[number] = Number(choices.querySelector(":checked").value);
      remember();
      ask();
      if (number === 0) lead(verdict(question, memory.choices[0], question.answer().right, question.answer().reason));
      else document.querySelector(`#question-${number} .verdict`).focus();
    });
    lock.disabled = true;
    choices.onchange = () => { lock.disabled = false; };
    buttons.append(lock);
    if (number === 0 && !memory.skipped) {
      buttons.append(button("Show the lines without predicting", "plain", () => {
        memory.skipped = true;
        remember();
        ask();
        lead(["Move the slider: the marks stand for this pier, the lines for all the others. Each point of a line is a whole collision."]);
      }));
    }
  }
  if (buttons.children.length) field.append(buttons);
  return field;
}

function verdict(question, choice, right, reason) {
  if (choice === right) return [make("strong", { textContent: "As you predicted. " }), reason];
  const misconception = question.choices[choice][1];
  return [
    make("strong", { textContent: "Not so. " }),
    ...(misconception ? ["A common misconception: ", make("em", { textContent: `“${misconception}”` }), " "] : []),
    reason,
  ];
}

function lead(words) {
  $("lead").replaceChildren(...words);
  $("lead").focus({ preventScroll: true });
}

function showExample({ frequency, mass, moment }) {
  const { pier_frequency: slider } = explorer.controls;
  choose(0, { truck_mass: mass, speed: first.speed, pier_frequency: slider.at(slider.notch(frequency)) });
  explorer.look(moment);
  $("explorer").scrollIntoView();
  $("pier_frequency").focus({ preventScroll: true });
}

/** Put each question in its place: the first in that of the lines until it is answered or skipped. */
function ask() {
  const revealed = memory.skipped || 0 in memory.choices;
  const fields = asked.map(fieldset);
  $("gate").replaceChildren(...(revealed ? [] : [fields.shift()]));
  $("questions").replaceChildren(...fields);
  explorer.reveal(revealed);
}

$("again").onclick = () => {
  Object.assign(memory, { choices: {}, skipped: false });
  remember();
  ask();
  $("explorer").scrollIntoView();
  document.querySelector("#question-0 input").focus({ preventScroll: true });
};

// Start

globalThis.pierimpact = { simulate, trucks, pierAt }; // to calculate more in the console
choose(0);
ask();
addEventListener("beforeprint", () => {
  for (const details of document.querySelectorAll("details")) details.open = true;
  explorer.showAll();
});
