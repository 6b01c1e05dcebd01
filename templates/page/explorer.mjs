// The explorer of one collision: its picture, its forces, and its place on the spectra.
import { MARGIN, drawEnergy, drawHere, drawHistory, drawInstant, drawSpectrum, fit, force, hertz, number, roundUp } from "./chart.mjs";
import { Control, button, make } from "./controls.mjs";
import { energyShares, follow } from "./history.mjs";
import { EXAGGERATION, drawPicture, isBeyond } from "./picture.mjs";
import { collisionOf, pierFrom, refusal } from "./scenario.mjs";
import { answer, firstPeak, phase, sentence } from "./sentences.mjs";
import { bandsOf, coarseSpectrum, isEnginePeak, pierAt, pointAt, refine } from "./spectrum.mjs";

const COARSE = 33; // points of a spectrum while a slider moves
const SLICE = 24, SOON = 8; // refining goes on for so long at a time, and begins so long after a picture [ms]
const SLOWER = 40; // the collision is played so many times slower than it is
const STRETCH = 0.05; // the axis of time grows by so much at a time [s]
// Moments to look at, by the time that the outcome has for them; at first the one that governs.
const GOVERNING = "governing";
const MOMENTS = { engineContact: "Engine hits", engineTime: "Engine’s peak", cargoContact: "Cargo hits", cargoTime: "Cargo’s peak" };
const COLUMN = ["column_diameter", "column_height", "impact_height", "base", "top"];

const skeleton = (id) => `
<section class="spectra" aria-label="The peaks over the frequency of the pier">
  <div class="aligned" id="${id}above"></div>
  <div class="gate" id="${id}gate" hidden></div>
  <figure class="chart-figure" id="${id}chart-figure">
    <svg class="chart" id="${id}chart" role="img" aria-labelledby="${id}answer"></svg>
    <figcaption class="answer" id="${id}answer"></figcaption>
  </figure>
</section>
<section class="outcome" aria-label="This collision">
  <dl class="peaks">
    <div class="engine"><dt id="${id}engine-name">Engine’s peak</dt><dd id="${id}engine-peak"></dd></div>
    <div class="cargo"><dt>Cargo’s peak</dt><dd id="${id}cargo-peak"></dd></div>
  </dl>
  <p class="sentence" id="${id}sentence" role="status" aria-live="polite"></p>
  <p class="refusal" id="${id}refusal" role="alert" hidden></p>
  <dl class="facts" id="${id}facts"></dl>
</section>
<section class="collision" aria-label="The collision in slow motion">
  <figure>
    <svg class="picture" id="${id}picture" role="img" aria-labelledby="${id}picture-words"></svg>
    <figcaption><span id="${id}picture-words"></span> <span class="quiet" id="${id}picture-scale"></span></figcaption>
  </figure>
  <figure>
    <svg class="history" id="${id}history" role="img" aria-labelledby="${id}history-words"></svg>
    <figcaption class="unseen" id="${id}history-words"></figcaption>
  </figure>
  <div class="player">
    <button type="button" id="${id}play">Play</button>
    <label for="${id}instant" class="unseen">Time after first touch</label>
    <input type="range" id="${id}instant" min="0" step="0.5">
    <span class="value" id="${id}instant-value" aria-hidden="true"></span>
    <span class="moments" id="${id}moments" role="group" aria-label="Show a moment"></span>
  </div>
  <figure id="${id}energy-figure" hidden>
    <svg class="history" id="${id}energy" role="img" aria-labelledby="${id}energy-words"></svg>
    <figcaption class="unseen" id="${id}energy-words"></figcaption>
  </figure>
</section>
<section class="controls" id="${id}controls" aria-label="Truck and pier"></section>`;

/**
 * The explorer in an element.
 *
 * setup: { id: that all of its ids begin with, truck, concrete of the column, values: of all
 *   variables in SI units, pier_frequency null where the pier is a column, variables: as `Control`
 *   takes them, above: the names of those above the spectra, side: of those beside them, drawers:
 *   { title: names }, spectra: whether there are any, energy and facts likewise, range: of the
 *   frequencies [Hz], moment: on show at first [s] }
 * told: called with the values after each change of theirs by hand.
 */
export class Explorer {
  constructor(root, setup, told = () => {}) {
    Object.assign(this, { root, setup, told, truck: setup.truck });
    this.values = { ...setup.values };
    this.moment = GOVERNING;
    this.instant = 0;
    this.playing = null;
    this.waiting = new Set();
    root.classList.add("pierimpact");
    this.frame = make("div", { className: setup.spectra ? "explorer" : "explorer plain", innerHTML: skeleton(setup.id) });
    root.append(this.frame);
    this.$("chart-figure").closest("section").hidden = !setup.spectra;
    this.$("facts").hidden = !setup.facts;
    this.$("energy-figure").hidden = !setup.energy;
    this.frame.style.setProperty("--plot-left", `${MARGIN.left}px`);
    this.frame.style.setProperty("--plot-right", `${MARGIN.right}px`);
    this.#addControls();
    this.#addPlayer();
    this.#renewAll();
    let width = 0;
    this.observer = new ResizeObserver(() => {
      if (width !== this.frame.clientWidth) this.soon(this.showAll);
      width = this.frame.clientWidth;
    });
    this.observer.observe(this.frame);
    this.showAll();
  }

  $(name) {
    return this.frame.querySelector(`#${this.setup.id}${name}`);
  }

  remove() {
    this.play(false);
    this.observer.disconnect();
  }

  // Controls

  #addControls() {
    const { id, variables, above, side, drawers } = this.setup;
    this.controls = {};
    const add = (place, names) => {
      for (const name of names) {
        const control = new Control(variables[name], this.#onShow(name), `${id}${name}`, (moved) => this.#moved(moved));
        this.controls[name] = control;
        place.append(control.element);
      }
    };
    add(this.$("above"), above);
    add(this.$("controls"), side);
    for (const [title, names] of Object.entries(drawers)) {
      const drawer = make("details", {}, make("summary", {}, title));
      add(drawer, names);
      this.$("controls").append(drawer);
    }
  }

  /** What a control shows of the present values: of the pier also where a column makes it. */
  #onShow(name) {
    const value = this.values[name];
    if (value !== null) return value;
    const { frequency, mass } = pierFrom(this.values, this.setup.concrete);
    return name === "pier_mass" ? mass : frequency;
  }

  #moved({ variable: { name }, value, error }) {
    const { values } = this;
    this.error = error;
    if (!error) {
      if (name === "pier_frequency" || name === "pier_mass") {
        if (values.pier_frequency === null) { // what was a column goes on as its mass
          const { frequency, mass } = pierFrom(values, this.setup.concrete);
          Object.assign(values, { pier_frequency: frequency, pier_mass: mass });
        }
      } else if (COLUMN.includes(name)) {
        Object.assign(values, { pier_frequency: null, pier_mass: null });
      }
      values[name] = value;
    }
    this.soon(name === "pier_frequency" ? this.#otherPier : this.#otherTruck);
  }

  /** Take other values, in SI units, and show them. */
  set(values) {
    Object.assign(this.values, values);
    this.error = "";
    this.#otherTruck(false);
  }

  /** Act once before the next picture, however many inputs come. */
  soon(act) {
    if (!this.waiting.size) {
      requestAnimationFrame(() => {
        if (this.waiting.has(this.#otherTruck)) this.waiting.delete(this.#otherPier); // it renews that as well
        const acts = [...this.waiting];
        this.waiting.clear();
        acts.forEach((each) => each.call(this));
      });
    }
    this.waiting.add(act);
  }

  // What is on show

  get collision() {
    return collisionOf(this.values, { ...this.setup, truck: this.truck });
  }

  #otherPier() {
    if (!this.#accepted()) return;
    if (this.setup.spectra) {
      const range = rangeWith(this.collision.frequency, this.setup.range), { low, high } = this.shown?.range ?? {};
      if (range.low !== low || range.high !== high) return void this.#otherTruck();
    }
    this.#follow();
    this.#showHere();
    this.#showCollision();
    this.told(this.values);
  }

  #otherTruck(byHand = true) {
    for (const [name, control] of Object.entries(this.controls)) {
      if (!control.error && !this.#refused()) control.set(this.#onShow(name));
    }
    if (byHand) this.told(this.values);
    if (!this.#renewAll()) return;
    this.#showSpectra();
    this.#showCollision();
  }

  /** Calculate all anew; return whether there is something to calculate. */
  #renewAll() {
    if (!this.#accepted()) return false;
    this.#renewSpectra();
    this.#follow();
    return true;
  }

  #refused() {
    return refusal(this.values, this.truck);
  }

  /** Whether there is such a collision; if not, the reason stands in its place. */
  #accepted() {
    const why = this.error || this.#refused();
    this.$("refusal").textContent = why;
    this.$("refusal").hidden = !why;
    for (const part of ["answer", "picture", "sentence", "facts"]) {
      this.$(part).closest("section, p, dl").classList.toggle("stale", Boolean(why));
    }
    return !why;
  }

  /** New spectra: coarse at once, and refined as soon as there is time. */
  #renewSpectra() {
    clearTimeout(this.refining);
    if (!this.setup.spectra) return;
    const now = this.collision, range = rangeWith(now.frequency, this.setup.range);
    this.shown = framed(coarseSpectrum(range, COARSE, now), now, range);
    const points = this.shown.points.slice(), refinement = refine(points, (each) => pointAt(each, now));
    const slice = () => {
      const end = performance.now() + SLICE;
      while (performance.now() < end) {
        if (!refinement.next().done) continue;
        this.shown = framed(points, now, range);
        if (!this.#refused()) this.#showSpectra(); // which marks the pier of the values there are now
        return;
      }
      this.refining = setTimeout(slice);
    };
    this.refining = setTimeout(slice, SOON);
  }

  #follow() {
    const { truck, pier, frequency, speed } = this.collision, equivalent = pierAt(frequency, pier);
    let history = follow(truck, equivalent, speed, 3 * STRETCH);
    const last = 1.08 * Math.max(history.outcome.engineTime, history.outcome.cargoTime ?? 0);
    const end = Math.max(3 * STRETCH, STRETCH * Math.ceil(last / STRETCH));
    if (history.rows.at(-1)[0] < end) history = follow(truck, equivalent, speed, end);
    const { engine, cargo, engineForce, lowest } = history.outcome;
    const top = this.shown?.top ?? roundUp(1.12 * Math.max(engine, cargo ?? 0, engineForce));
    const bottom = this.shown?.bottom ?? depth(lowest, top);
    const shares = this.setup.energy ? energyShares(history.rows, truck, equivalent, speed) : null;
    Object.assign(this, { history, axes: { history, end, top, bottom, shares } });
    this.instant = Math.min(momentOf(history.outcome, this.moment) ?? this.instant, end);
    this.$("instant").max = 1e3 * end;
  }

  // Drawing

  /** Draw all anew in the room that there is now. */
  showAll() {
    if (!this.history || !this.frame.clientWidth || this.#refused()) return;
    for (const name of ["chart", "history", "energy"]) if (this.$(name).clientWidth) fit(this.$(name));
    this.#showSpectra();
    this.#showCollision();
  }

  /** Whether a chart knows its room: it is in sight, or has been. */
  #fitted(name) {
    return this.$(name).viewBox.baseVal.width > 0;
  }

  /** Show the spectra, or what stands for them until they may be seen. */
  reveal(revealed) {
    this.$("gate").hidden = revealed;
    this.$("chart-figure").hidden = !revealed;
    this.showAll();
  }

  #showSpectra() {
    if (!this.setup.spectra || !this.history) return;
    const [peaks, governs] = answer(this.shown);
    this.$("answer").replaceChildren(peaks, make("strong", { textContent: governs }));
    if (!this.#fitted("chart")) return;
    drawSpectrum(this.$("chart"), this.shown);
    this.#showHere();
  }

  #showHere() {
    if (!this.setup.spectra || !this.#fitted("chart")) return;
    const here = { frequency: this.collision.frequency, ...this.history.outcome };
    drawHere(this.$("chart"), { ...this.shown, here });
  }

  #showCollision() {
    const { outcome } = this.history, words = sentence(this.collision.frequency, outcome);
    this.$("engine-name").textContent = firstPeak(outcome);
    this.$("engine-peak").textContent = force(outcome.engine);
    this.$("cargo-peak").textContent = outcome.cargo === null ? "none" : force(outcome.cargo);
    this.$("sentence").textContent = words;
    for (const moment of this.$("moments").children) {
      moment.disabled = momentOf(outcome, moment.value) === null;
    }
    this.$("history-words").textContent = `Forces against time. ${words}`;
    this.#showFacts();
    if (this.#fitted("history")) drawHistory(this.$("history"), this.axes);
    if (this.setup.energy) {
      const { shares } = this.axes, [crush, pier] = ["crush", "pier"].map((name) => Math.max(...shares.map((share) => share[name])));
      this.$("energy-words").textContent = `Energy against time. At the end ${percent(crush)} has gone into `
        + `crushed metal; never more than ${percent(pier)} is in the pier.`;
      if (this.#fitted("energy")) drawEnergy(this.$("energy"), this.axes);
    }
    this.#showInstant();
  }

  #showFacts() {
    if (!this.setup.facts) return;
    const { truck, pier, frequency, speed } = this.collision;
    const { stiffness } = pierAt(frequency, pier);
    const facts = [
      ["Pier’s frequency", `${hertz(frequency)}`], ["stiffness", `${number(stiffness / 1e6)} MN/m`],
      ["mass", `${number(pier.mass / 1e3)} t`],
      ["Truck’s energy", `${((0.5 * (truck.engine.mass + truck.body.mass) * speed ** 2) / 1e6).toFixed(2)} MJ`],
    ];
    this.$("facts").replaceChildren(...facts.map(([name, value]) =>
      make("div", {}, make("dt", {}, name), make("dd", {}, value))));
  }

  #showInstant() {
    const { instant, history, axes } = this;
    const now = history.at(instant), ms = (1e3 * instant).toFixed(1);
    if (this.#fitted("history")) drawInstant(this.$("history"), { ...axes, instant });
    if (this.setup.energy && this.#fitted("energy")) drawInstant(this.$("energy"), { ...axes, instant, top: 1, bottom: 0, line: true });
    const { truck, frequency } = this.collision;
    drawPicture(this.$("picture"), { truck, now, frequency, top: axes.top });
    this.$("instant").value = ms;
    this.$("instant-value").textContent = `${ms} ms`;
    this.$("instant").setAttribute("aria-valuetext", `${ms} milliseconds`);
    this.$("picture-words").textContent = `${ms} ms: ${phase(now, history.outcome)}`;
    this.$("picture-scale").textContent = `Pier’s movement ${EXAGGERATION} × too large`
      + `${isBeyond(now) ? " (here more than there is room for)" : ""}, time ${SLOWER} × too slow.`;
  }

  // The player

  #addPlayer() {
    this.$("play").onclick = () => this.play(this.playing === null);
    this.$("instant").oninput = () => {
      this.play(false);
      Object.assign(this, { instant: Number(this.$("instant").value) / 1e3, moment: null });
      this.soon(this.#showInstant);
    };
    for (const [moment, words] of Object.entries(MOMENTS)) {
      const go = button(words, "", () => this.look(moment));
      go.value = moment;
      this.$("moments").append(go);
    }
  }

  /** Look at a moment of this collision, and of those that the sliders make of it. */
  look(moment) {
    this.play(false);
    this.moment = moment;
    this.instant = momentOf(this.history.outcome, moment) ?? this.instant;
    this.#showInstant();
  }

  play(start) {
    cancelAnimationFrame(this.playing);
    this.playing = null;
    const { end } = this.axes ?? {};
    if (start && (this.moment === GOVERNING || this.instant >= end - 1e-9)) this.instant = 0;
    if (start) this.moment = null;
    let last = null;
    const picture = (time) => {
      if (last !== null) this.instant = Math.min(this.instant + (time - last) / 1e3 / SLOWER, this.axes.end);
      last = time;
      this.#showInstant();
      if (this.instant < this.axes.end) this.playing = requestAnimationFrame(picture);
      else this.play(false);
    };
    if (start) this.playing = requestAnimationFrame(picture);
    this.$("play").textContent = start ? "Pause" : "Play";
  }
}

/** The range of the axis of frequencies [Hz]: wider than the slider's only for a pier outside of it. */
function rangeWith(frequency, { low, high }) {
  return {
    low: frequency < low ? Number((frequency / 1.2).toPrecision(1)) / 2 : low,
    high: frequency > high ? roundUp(1.2 * frequency) : high,
  };
}

/** Spectra with the ends of the axes, which do not depend on the pier. */
function framed(points, now, range) {
  const highest = Math.max(...points.flatMap((p) => [p.engine, p.cargo ?? 0, p.engineForce]));
  const top = roundUp(1.12 * highest);
  return { points, range, bands: bandsOf(points, now), top, bottom: depth(Math.min(...points.map((p) => p.lowest)), top) };
}

/** The lower end of an axis of forces, in quarters of the height above, which seldom change. */
function depth(lowest, top) {
  return -0.25 * top * Math.ceil((-4 * lowest) / top - 0.2);
}

/** The time of a moment; null where it does not happen. */
function momentOf(outcome, moment) {
  const { engine, engineTime, cargo, cargoTime } = outcome;
  if (moment === GOVERNING) return cargo !== null && cargo >= engine ? cargoTime : engineTime;
  if (moment === "engineTime" && !isEnginePeak(outcome)) return null;
  return outcome[moment] ?? null;
}

function percent(share) {
  return `${(100 * share).toFixed(share < 0.095 ? 1 : 0)} %`;
}
