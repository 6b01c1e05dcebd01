// The page: its sliders, its sentences, and the predictions.
import { MARGIN, drawHere, drawHistory, drawInstant, drawSpectrum, fit, force, hertz, roundUp } from "./chart.mjs";
import { follow } from "./history.mjs";
import { simulate } from "./model.mjs";
import { EXAGGERATION, drawPicture } from "./picture.mjs";
import { questions } from "./questions.mjs";
import { bandsOf, coarseSpectrum, pierAt, pointAt, refine } from "./spectrum.mjs";

const { trucks, pier, range, speeds, first } = JSON.parse(document.getElementById("data").textContent);
const NOTCHES = 180; // steps of the slider, each the same ratio
const COARSE = 33; // points of a spectrum while a slider moves
const SLICE = 12; // refining goes on for so long at a time [ms]
const SLOWER = 40; // the collision is played so many times slower than it is
const MEMORY = "pierimpact page";
// Moments to look at, by the time that the outcome has for them; at first the one that governs.
const GOVERNING = "governing";
const MOMENTS = { engineContact: "Engine hits", engineTime: "Engine’s peak", cargoContact: "Cargo hits", cargoTime: "Cargo’s peak" };

const $ = (id) => document.getElementById(id);
const state = { truck: 0, frequency: first.frequency, speed: first.speed, mass: trucks[0].masses.first, instant: 0, moment: GOVERNING };
let shown = null; // the spectra on show, with their axes
let history = null; // the collision on show
let refining = null, playing = null;

// What is on show

function loaded(truck, mass) {
  return { ...truck, body: { ...truck.body, mass: mass - truck.engine.mass } };
}

function collision({ truck, mass, speed } = state) {
  return { truck: loaded(trucks[truck], mass), pier, speed: speed / 3.6 };
}

/** New spectra: coarse at once, and refined as soon as there is time. */
function renewSpectra() {
  const now = collision();
  shown = framed(coarseSpectrum(range, COARSE, now), now);
  clearTimeout(refining);
  const points = shown.points.slice(), refinement = refine(points, now);
  const slice = () => {
    const end = performance.now() + SLICE;
    while (performance.now() < end) {
      if (!refinement.next().done) continue;
      shown = framed(points, now);
      showSpectra();
      return;
    }
    refining = setTimeout(slice);
  };
  refining = setTimeout(slice, SLICE);
}

/** The spectra with the ends of all axes, which do not depend on the pier. */
function framed(points, now) {
  const highest = Math.max(...points.flatMap((p) => [p.engine, p.cargo ?? 0, p.engineForce]));
  const lowest = Math.min(...points.map((p) => p.lowest));
  const last = Math.max(...points.flatMap((p) => [p.engineTime, p.cargoTime ?? 0]));
  const top = roundUp(1.12 * highest);
  return {
    points,
    bands: bandsOf(points, now),
    top,
    bottom: -0.25 * top * Math.ceil((-4 * lowest) / top - 0.2),
    end: Math.max(0.15, 0.05 * Math.ceil((1.08 * last) / 0.05)),
  };
}

function renewCollision() {
  const { truck, speed } = collision();
  history = follow(truck, pierAt(state.frequency, pier), speed, shown.end);
  const time = momentOf(history.outcome, state.moment);
  state.instant = Math.min(time ?? state.instant, shown.end);
}

/** The time of a moment; null where it does not happen. */
function momentOf(outcome, moment) {
  const { engine, engineTime, engineContact, cargo, cargoTime } = outcome;
  if (moment === GOVERNING) return cargo !== null && cargo >= engine ? cargoTime : engineTime;
  if (moment === "engineTime" && engineContact === null) return null;
  return outcome[moment] ?? null;
}

// Drawing

function showSpectra() {
  $("answer").replaceChildren(...answer());
  if ($("chart-figure").hidden) return;
  drawSpectrum($("chart"), { ...shown, range });
  showHere();
}

function showHere() {
  if ($("chart-figure").hidden) return;
  drawHere($("chart"), { ...shown, range, here: { frequency: state.frequency, ...history.outcome } });
}

/** Draw all anew in the room that there is now. */
function showAll() {
  if (!$("chart-figure").hidden) fit($("chart"));
  fit($("history"));
  showSpectra();
  showCollision();
}

function showCollision() {
  drawHistory($("history"), { history, ...shown });
  const { outcome } = history;
  $("engine-name").textContent = outcome.engineContact === null ? "Sheet metal’s peak" : "Engine’s peak";
  $("engine-peak").textContent = force(outcome.engine);
  $("cargo-peak").textContent = outcome.cargo === null ? "none" : force(outcome.cargo);
  $("sentence").textContent = sentence(outcome);
  for (const button of $("moments").children) {
    button.disabled = momentOf(outcome, button.value) === null;
  }
  $("history-words").textContent = `Forces against time. ${sentence(outcome)}`;
  showInstant();
}

function showInstant() {
  const now = history.at(state.instant), ms = (1e3 * state.instant).toFixed(1);
  drawInstant($("history"), { history, ...shown, instant: state.instant });
  drawPicture($("picture"), { truck: collision().truck, now, frequency: state.frequency, top: shown.top });
  $("instant").value = ms;
  $("instant-value").textContent = `${ms} ms`;
  $("instant").setAttribute("aria-valuetext", `${ms} milliseconds`);
  $("picture-words").textContent = `${ms} ms: ${phase(now)}`;
}

// Sentences

function sentence({ engine, engineContact, cargo }) {
  const at = `On a pier of ${hertz(state.frequency)}`;
  if (engineContact === null && cargo === null) {
    return `${at} neither engine nor cargo arrives: crumpling sheet metal stops both. The largest reaction is ${force(engine)}.`;
  }
  if (engineContact === null) {
    return `${at} the engine stops short; the cargo arrives and governs, with ${force(Math.max(cargo, engine))}.`;
  }
  if (cargo === null) {
    return `${at} the engine governs, with ${force(engine)}. The cargo stops short of the pier.`;
  }
  const [most, more, least, less] = cargo >= engine
    ? ["cargo", cargo, "engine", engine]
    : ["engine", engine, "cargo", cargo];
  return `${at} the ${most} governs: ${force(more)}, ${(more / less).toFixed(1)} times the ${least}’s ${force(less)}.`;
}

/** The answer to the question of the page, for the truck and the speed on show. */
function answer() {
  const { points, bands } = shown;
  const engine = points.filter((point) => point.engineContact !== null);
  const cargo = points.filter((point) => point.cargo !== null);
  if (!engine.length && !cargo.length) {
    return ["At this speed crumpling sheet metal stops engine and cargo before they reach any of these piers."];
  }
  const words = [
    engine.length ? `The engine’s peak ${trend(engine, "engine")}.` : "The engine stops short of all these piers.",
    cargo.length ? `The cargo’s peak ${trend(cargo, "cargo")}.` : "The cargo stops short of all these piers.",
  ];
  const crossings = bands.filter((band) => band.crossing).map((band) => hertz(band.low));
  const [lower, upper] = [bands[0].what, bands.at(-1).what];
  let governs = "";
  if (bands.length === 1) governs = `The ${lower} governs throughout.`;
  else if (bands.length === 2 && crossings.length === 1) {
    governs = `Below ${crossings[0]} the ${lower} governs, above it the ${upper}.`;
  } else if (crossings.length > 1) {
    governs = `The lines cross at ${crossings.slice(0, -1).join(", ")} and ${crossings.at(-1)}.`;
  }
  return [`${words.join(" ")} `, make("strong", { textContent: governs })];
}

/** How a peak changes from the softest pier to the stiffest, in words. */
function trend(points, body) {
  const most = points.reduce((p, q) => (q[body] > p[body] ? q : p));
  const [from, to, top] = [points[0], points.at(-1), most].map((point) => point[body]);
  const ends = `from ${force(from)} at ${hertz(points[0].frequency)}`;
  if (top > 1.1 * from && top > 1.1 * to) {
    return `rises ${ends} to ${force(top)} at ${hertz(most.frequency)}, then falls back to ${force(to)}`;
  }
  const verb = to > 1.1 * from ? "rises" : to < from / 1.1 ? "falls" : "hardly changes,";
  return `${verb} ${ends} to ${force(to)} at ${hertz(points.at(-1).frequency)}`;
}

function phase({ time, F1, F2 }) {
  const { engineContact, cargoContact } = history.outcome;
  const met = (contact) => contact !== null && time >= contact;
  if (time === 0) return "first touch.";
  if (F1 <= 0 && F2 <= 0) return "the truck has left, the pier vibrates.";
  if (met(cargoContact) && F2 > 0) return "the cargo is in contact.";
  if (met(engineContact) && F1 > 0) return "the engine is in contact.";
  if (met(engineContact)) return "the engine has rebounded.";
  return "sheet metal crumples.";
}

// Controls

/** A range input with its value and unit beside it and for screen readers. */
function slider(id, { low, high, step, value }, read, words, spoken, changed) {
  const input = $(id);
  Object.assign(input, { min: low, max: high, step });
  input.value = value;
  const tell = () => {
    $(`${id}-value`).textContent = words();
    input.setAttribute("aria-valuetext", spoken());
  };
  input.oninput = () => {
    read(Number(input.value));
    tell();
    soon(changed);
  };
  tell();
}

const frequencyAt = (n) => range.low * (range.high / range.low) ** (n / NOTCHES);
const placeOf = (frequency) =>
  Math.round((NOTCHES * Math.log(frequency / range.low)) / Math.log(range.high / range.low));

function setSliders() {
  slider("frequency", { low: 0, high: NOTCHES, step: 1, value: placeOf(state.frequency) },
    (n) => { state.frequency = frequencyAt(n); },
    () => hertz(state.frequency), () => hertz(state.frequency).replace("Hz", "hertz"), otherPier);
  slider("speed", { ...speeds, step: 1, value: state.speed },
    (value) => { state.speed = value; },
    () => `${state.speed} km/h`, () => `${state.speed} kilometres per hour`, otherTruck);
  const { low, high, step } = trucks[state.truck].masses;
  slider("mass", { low: low / 1e3, high: high / 1e3, step: step / 1e3, value: state.mass / 1e3 },
    (value) => { state.mass = 1e3 * value; },
    () => `${(state.mass / 1e3).toFixed(1)} t`, () => `${(state.mass / 1e3).toFixed(1)} tonnes`, otherTruck);
}

/** Act once before the next picture, however many inputs come. */
const waiting = new Set();
function soon(act) {
  if (!waiting.size) {
    requestAnimationFrame(() => {
      if (waiting.has(otherTruck)) waiting.delete(otherPier); // it renews that as well
      const acts = [...waiting];
      waiting.clear();
      acts.forEach((each) => each());
    });
  }
  waiting.add(act);
}

function otherPier() {
  renewCollision();
  showHere();
  showCollision();
}

function otherTruck() {
  renewSpectra();
  renewCollision();
  $("instant").max = 1e3 * shown.end;
  showSpectra();
  showCollision();
}

function choose(truck) {
  state.truck = truck;
  state.mass = trucks[truck].masses.first;
  $("truck").value = truck;
  for (const note of document.querySelectorAll(".status")) note.hidden = Number(note.dataset.truck) !== truck;
}

/** Look at a moment of this collision, and of those that the sliders make of it. */
function look(moment) {
  play(false);
  state.moment = moment;
  state.instant = momentOf(history.outcome, moment) ?? state.instant;
  showInstant();
}

function play(start) {
  cancelAnimationFrame(playing);
  playing = null;
  if (start) state.moment = null;
  if (start && state.instant >= shown.end - 1e-9) state.instant = 0;
  let last = null;
  const picture = (time) => {
    if (last !== null) state.instant = Math.min(state.instant + (time - last) / 1e3 / SLOWER, shown.end);
    last = time;
    showInstant();
    if (state.instant < shown.end) playing = requestAnimationFrame(picture);
    else play(false);
  };
  if (start) playing = requestAnimationFrame(picture);
  $("play").textContent = start ? "Pause" : "Play";
}

$("play").onclick = () => play(playing === null);
$("instant").oninput = () => {
  play(false);
  Object.assign(state, { instant: Number($("instant").value) / 1e3, moment: null });
  soon(showInstant);
};
for (const [moment, words] of Object.entries(MOMENTS)) {
  const go = button(words, "", () => look(moment));
  go.value = moment;
  $("moments").append(go);
}
$("truck").onchange = () => {
  choose(Number($("truck").value));
  setSliders();
  soon(otherTruck);
};

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
  return collision({ truck: 0, mass, speed: first.speed });
}

const { masses } = trucks[0];
const asked = questions({
  outcome: (frequency, mass) => pointAt(frequency, reference(mass)),
  crossing(mass) {
    const bands = bandsOf(coarseSpectrum(range, COARSE, reference(mass)), reference(mass));
    return bands.findLast((band) => band.crossing)?.low;
  },
  speed: first.speed,
  masses: [masses.first, masses.high > 1.05 * masses.first ? masses.high : 1.5 * masses.first],
  range,
});

function make(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

function button(words, className, act) {
  return make("button", { type: "button", textContent: words, className, onclick: act });
}

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
  play(false);
  choose(0);
  Object.assign(state, { frequency: frequencyAt(placeOf(frequency)), mass, speed: first.speed });
  setSliders();
  otherTruck();
  look(moment);
  $("explorer").scrollIntoView();
  $("frequency").focus({ preventScroll: true });
}

/** Put each question in its place: the first in that of the lines until it is answered or skipped. */
function ask() {
  const revealed = memory.skipped || 0 in memory.choices;
  const fields = asked.map(fieldset);
  $("gate").replaceChildren(...(revealed ? [] : [fields.shift()]));
  $("questions").replaceChildren(...fields);
  $("gate").hidden = revealed;
  $("chart-figure").hidden = !revealed;
  if (shown) showAll();
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
$("exaggeration").textContent = EXAGGERATION;
document.documentElement.style.setProperty("--plot-left", `${MARGIN.left}px`);
document.documentElement.style.setProperty("--plot-right", `${MARGIN.right}px`);
state.frequency = frequencyAt(placeOf(state.frequency));
ask();
setSliders();
fit($("chart"));
fit($("history"));
otherTruck();
let width = $("explorer").clientWidth;
new ResizeObserver(() => {
  if (width !== $("explorer").clientWidth) soon(showAll);
  width = $("explorer").clientWidth;
}).observe($("explorer"));
addEventListener("beforeprint", () => {
  for (const details of document.querySelectorAll("details")) details.open = true;
  showAll();
});
