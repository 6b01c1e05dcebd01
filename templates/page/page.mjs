// The page: what its controls do.
import { MARGIN, drawHere, drawHistory, drawInstant, drawSpectrum, fit } from "./chart.mjs";
import { force, hertz, roundUp } from "./chart.mjs";
import { follow } from "./history.mjs";
import { simulate } from "./model.mjs";
import { EXAGGERATION, drawPicture } from "./picture.mjs";
import { button, make, predictions } from "./predictions.mjs";
import { questions } from "./questions.mjs";
import { answer, firstPeak, phase, sentence } from "./sentences.mjs";
import { bandsOf, coarseSpectrum, pierAt, pointAt, refine } from "./spectrum.mjs";

const $ = (id) => document.getElementById(id);
const { trucks, pier, range, speeds, first } = JSON.parse($("data").textContent);

const NOTCHES = 180; // steps of the frequency's slider, each by the same ratio
const COARSE = 33; // points of a spectrum while a slider moves
const SLICE = 12; // refining it goes on for so long at a time [ms]
const SLOWER = 40; // the collision is played so many times slower than it is
// Moments to look at, by the name of their time in an outcome, and the peak that governs.
const GOVERNING = "governing";
const MOMENTS = {
  engineContact: "Engine hits",
  engineTime: "Engine’s peak",
  cargoContact: "Cargo hits",
  cargoTime: "Cargo’s peak",
};

const state = {
  truck: 0,
  frequency: first.frequency, // [Hz]
  speed: first.speed, // [km/h]
  mass: trucks[0].masses.first, // [kg]
  instant: 0, // [s]
  moment: GOVERNING, // that the instant keeps to; null for none
};
let shown = null; // the spectra on show, with the ends of all axes
let followed = null; // the collision on show
let refining = null, playing = null;

// What is on show

/** The collision at hand but for its pier, or another one. */
function collision({ truck, mass, speed } = state) {
  const { engine, body, ...rest } = trucks[truck];
  const loaded = { ...rest, engine, body: { ...body, mass: mass - engine.mass } };
  return { truck: loaded, pier, speed: speed / 3.6 };
}

/** New spectra: coarse at once, and refined as soon as there is time. */
function renewSpectra() {
  const now = collision();
  shown = framed(coarseSpectrum(range, COARSE, now), now);
  $("instant").max = 1e3 * shown.end;
  clearTimeout(refining);
  const points = shown.points.slice(), refinement = refine(points, now);
  const slice = () => {
    const end = performance.now() + SLICE;
    while (performance.now() < end) {
      if (!refinement.next().done) continue;
      shown = { ...shown, points, bands: bandsOf(points, now) };
      showSpectra();
      return;
    }
    refining = setTimeout(slice);
  };
  refining = setTimeout(slice, SLICE);
}

/** Spectra with the ends of all axes, which stay where they are while only the pier changes. */
function framed(points, now) {
  const highest = Math.max(...points.flatMap((p) => [p.engine, p.cargo ?? 0, p.engineForce]));
  const lowest = Math.min(...points.map((p) => p.lowest));
  const last = Math.max(...points.flatMap((p) => [p.engineTime, p.cargoTime ?? 0]));
  const top = roundUp(1.12 * highest);
  return {
    points,
    bands: bandsOf(points, now),
    top,
    bottom: -0.25 * top * Math.ceil((-4 * lowest) / top),
    end: Math.max(0.15, 0.05 * Math.ceil((1.08 * last) / 0.05)),
  };
}

function renewCollision() {
  const { truck, speed } = collision();
  followed = follow(truck, pierAt(state.frequency, pier), speed, shown.end);
  const time = momentOf(followed.outcome, state.moment) ?? state.instant;
  state.instant = Math.min(time, shown.end);
}

/** The time of a moment; null where it does not happen. */
function momentOf(outcome, moment) {
  const { engine, engineTime, engineContact, cargo, cargoTime } = outcome;
  if (moment === GOVERNING) return cargo !== null && cargo >= engine ? cargoTime : engineTime;
  if (moment === "engineTime" && engineContact === null) return null;
  return outcome[moment] ?? null;
}

// Drawing it

function showSpectra() {
  const [peaks, governs] = answer(shown);
  $("answer").replaceChildren(peaks, make("strong", { textContent: governs }));
  if ($("chart-figure").hidden) return;
  drawSpectrum($("chart"), { ...shown, range });
  showHere();
}

function showHere() {
  if ($("chart-figure").hidden) return;
  const here = { frequency: state.frequency, ...followed.outcome };
  drawHere($("chart"), { ...shown, range, here });
}

function showCollision() {
  const { outcome } = followed, words = sentence(state.frequency, outcome);
  drawHistory($("history"), { history: followed, ...shown });
  $("engine-name").textContent = firstPeak(outcome);
  $("engine-peak").textContent = force(outcome.engine);
  $("cargo-peak").textContent = outcome.cargo === null ? "none" : force(outcome.cargo);
  $("sentence").textContent = words;
  $("history-words").textContent = `Forces against time. ${words}`;
  for (const each of $("moments").children) each.disabled = momentOf(outcome, each.value) === null;
  showInstant();
}

function showInstant() {
  const now = followed.at(state.instant), ms = (1e3 * state.instant).toFixed(1);
  const { truck } = collision();
  drawInstant($("history"), { history: followed, ...shown, instant: state.instant });
  drawPicture($("picture"), { truck, now, frequency: state.frequency, top: shown.top });
  $("instant").value = ms;
  $("instant").setAttribute("aria-valuetext", `${ms} milliseconds`);
  $("instant-value").textContent = `${ms} ms`;
  $("picture-words").textContent = `${ms} ms: ${phase(now, followed.outcome)}`;
}

/** Draw all anew in the room that there is now. */
function showAll() {
  if (!$("chart-figure").hidden) fit($("chart"));
  fit($("history"));
  showSpectra();
  showCollision();
}

// Controls

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
  showSpectra();
  showCollision();
}

/**
 * Give a range input its ends and its place, and say its value beside it and to screen readers.
 *
 * read(place): takes the value in; words(): [value, unit, unit in full]; changed: what follows.
 */
function setSlider(id, { low, high, step, place }, read, words, changed) {
  const input = $(id);
  Object.assign(input, { min: low, max: high, step });
  input.value = place;
  const tell = () => {
    const [value, unit, inFull] = words();
    $(`${id}-value`).textContent = `${value} ${unit}`;
    input.setAttribute("aria-valuetext", `${value} ${inFull}`);
  };
  input.oninput = () => {
    read(Number(input.value));
    tell();
    soon(changed);
  };
  tell();
}

const ratio = range.high / range.low;
const frequencyAt = (place) => range.low * ratio ** (place / NOTCHES);
const placeOf = (frequency) =>
  Math.round((NOTCHES * Math.log(frequency / range.low)) / Math.log(ratio));

function setSliders() {
  const { low, high, step } = trucks[state.truck].masses;
  setSlider("frequency", { low: 0, high: NOTCHES, step: 1, place: placeOf(state.frequency) },
    (place) => { state.frequency = frequencyAt(place); },
    () => [...hertz(state.frequency).split(" "), "hertz"], otherPier);
  setSlider("speed", { ...speeds, step: 1, place: state.speed },
    (place) => { state.speed = place; },
    () => [state.speed, "km/h", "kilometres per hour"], otherTruck);
  setSlider("mass", { low: low / 1e3, high: high / 1e3, step: step / 1e3, place: state.mass / 1e3 },
    (place) => { state.mass = 1e3 * place; },
    () => [(state.mass / 1e3).toFixed(1), "t", "tonnes"], otherTruck);
}

function choose(truck) {
  state.truck = truck;
  state.mass = trucks[truck].masses.first;
  $("truck").value = truck;
  for (const note of document.querySelectorAll(".status")) {
    note.hidden = Number(note.dataset.truck) !== truck;
  }
}

/** Look at a moment of this collision, and of those that the sliders make of it. */
function look(moment) {
  play(false);
  state.moment = moment;
  state.instant = momentOf(followed.outcome, moment) ?? state.instant;
  showInstant();
}

function play(start) {
  cancelAnimationFrame(playing);
  playing = null;
  $("play").textContent = start ? "Pause" : "Play";
  if (!start) return;
  if (state.moment === GOVERNING || state.instant >= shown.end - 1e-9) state.instant = 0;
  state.moment = null;
  let last = null;
  const picture = (time) => {
    const passed = last === null ? 0 : (time - last) / 1e3 / SLOWER;
    last = time;
    state.instant = Math.min(state.instant + passed, shown.end);
    showInstant();
    if (state.instant < shown.end) playing = requestAnimationFrame(picture);
    else play(false);
  };
  playing = requestAnimationFrame(picture);
}

$("play").onclick = () => play(playing === null);
$("instant").oninput = () => {
  play(false);
  Object.assign(state, { instant: Number($("instant").value) / 1e3, moment: null });
  soon(showInstant);
};
for (const [moment, words] of Object.entries(MOMENTS)) {
  $("moments").append(Object.assign(button(words, "", () => look(moment)), { value: moment }));
}
$("truck").onchange = () => {
  choose(Number($("truck").value));
  setSliders();
  soon(otherTruck);
};
for (const link of document.querySelectorAll(".status a")) {
  link.onclick = () => { document.querySelector(link.hash).open = true; };
}

// Start

globalThis.pierimpact = { simulate, trucks, pierAt }; // to calculate more in the console
$("exaggeration").textContent = EXAGGERATION;
$("slower").textContent = SLOWER;
document.documentElement.style.setProperty("--plot-left", `${MARGIN.left}px`);
document.documentElement.style.setProperty("--plot-right", `${MARGIN.right}px`);
state.frequency = frequencyAt(placeOf(state.frequency));
setSliders();
renewSpectra();
renewCollision();

// The predictions are about the first truck at the first speed.
const { masses } = trucks[0];
const of = (mass) => collision({ truck: 0, mass, speed: first.speed });
const about = {
  outcome: (frequency, mass) => pointAt(frequency, of(mass)),
  crossing: (mass) => bandsOf(coarseSpectrum(range, COARSE, of(mass)), of(mass))
    .findLast((band) => band.crossing)?.low,
  speed: first.speed,
  mass: masses.first,
  masses: masses.high > masses.first ? [masses.first, masses.high] : [masses.low, masses.first],
  range,
};
const asked = questions(about).filter(({ show }) => !show || masses.high > masses.low);
const { startAgain } = predictions(asked, {
  gate: $("gate"),
  list: $("questions"),
  key: `pierimpact page, ${trucks[0].name}`,
  reveal(revealed, words) {
    $("chart-figure").hidden = !revealed;
    showAll();
    if (!words) return;
    $("lead").replaceChildren(...words);
    $("lead").focus({ preventScroll: true });
  },
  show({ frequency, mass, moment }) {
    choose(0);
    Object.assign(state, { frequency: frequencyAt(placeOf(frequency)), mass, speed: first.speed });
    setSliders();
    otherTruck();
    look(moment);
    $("explorer").scrollIntoView();
    $("frequency").focus({ preventScroll: true });
  },
});
$("again").onclick = () => {
  startAgain();
  $("explorer").scrollIntoView();
};

let width = $("explorer").clientWidth;
new ResizeObserver(() => {
  if (width !== $("explorer").clientWidth) soon(showAll);
  width = $("explorer").clientWidth;
}).observe($("explorer"));
addEventListener("beforeprint", () => {
  for (const details of document.querySelectorAll("details")) details.open = true;
  showAll();
});
