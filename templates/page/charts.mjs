// An explorer of charts beside its controls.
import { fit } from "./chart.mjs";
import { Control, make } from "./controls.mjs";
import { barsHeight, drawBars, drawLines } from "./figures.mjs";
import { influences } from "./influences.mjs";
import { reactions } from "./reactions.mjs";
import { reduction } from "./reduction.mjs";
import { risk } from "./risk.mjs";
import { collisionOf, refusal } from "./scenario.mjs";
import { shape } from "./shape.mjs";

const KINDS = { influences, reactions, reduction, risk, shape };

/**
 * What an explorer of charts shows of some values, in SI units: { refusal }, or { charts: [{ kind:
 * "lines" or "bars", … }], facts: [[name as HTML, value, what it is]] or table: { heads, rows },
 * words: what all of that shows, warnings }.
 */
export function contents(values, setup) {
  const why = refusal(values, setup.truck);
  if (why) return { refusal: why };
  return KINDS[setup.kind]({ values, setup, collision: collisionOf(values, setup) });
}

/**
 * The explorer in an element.
 *
 * setup: { id, truck, concrete, variables, side, values } as an `Explorer` has them, kind: one of
 *   KINDS, and what that needs to know.
 * told: called with the values after each change of theirs by hand.
 */
export class Charts {
  constructor(root, setup, told = () => {}) {
    Object.assign(this, { setup, told, values: { ...setup.values } });
    root.classList.add("pierimpact");
    const { id, side, variables } = setup;
    this.panel = make("section", { className: "controls", id: `${id}controls`, ariaLabel: "Truck and pier" });
    this.refusal = make("p", { className: "refusal", role: "alert", hidden: true });
    this.readout = make("div", { className: "readout" });
    this.words = make("p", { role: "status", ariaLive: "polite" });
    this.row = make("div", { className: "row" });
    const main = make("section", { className: "views", ariaLabel: setup.title }, this.refusal, this.readout, this.words, this.row);
    this.frame = make("div", { className: "explorer charts" }, main, this.panel);
    root.append(this.frame);
    this.controls = {};
    for (const name of side) {
      this.controls[name] = new Control(variables[name], this.values[name], `${id}${name}`, (moved) => this.#moved(moved));
      this.panel.append(this.controls[name].element);
    }
    this.renew();
    let width = 0;
    this.observer = new ResizeObserver(() => {
      if (width !== this.frame.clientWidth) this.showAll();
      width = this.frame.clientWidth;
    });
    this.observer.observe(this.frame);
  }

  remove() {
    this.observer.disconnect();
  }

  #moved({ variable: { name }, value, error }) {
    if (error) return void this.#refuse(error);
    this.values[name] = value;
    this.told(this.values);
    this.soon();
  }

  /** Take other values, in SI units. */
  set(values) {
    Object.assign(this.values, values);
    for (const [name, control] of Object.entries(this.controls)) control.set(this.values[name]);
    this.soon();
  }

  /** Renew all before the next picture, however many inputs come. */
  soon() {
    this.waiting ??= requestAnimationFrame(() => {
      this.waiting = null;
      this.renew();
    });
  }

  #refuse(why) {
    this.refusal.textContent = why;
    this.refusal.hidden = !why;
    for (const part of [this.row, this.readout, this.words]) part.classList.toggle("stale", Boolean(why));
  }

  /** Calculate what is shown of the present values, or say why that cannot be done. */
  renew() {
    const found = contents(this.values, this.setup);
    this.#refuse(found.refusal ?? "");
    if (found.refusal) return;
    this.contents = found;
    this.showAll();
  }

  showAll() {
    if (!this.contents) return;
    const { charts, words, warnings = [] } = this.contents;
    this.readout.replaceChildren(readoutOf(this.contents));
    this.words.replaceChildren(words, ...warnings.map((each) => make("span", { className: "warning" }, each)));
    while (this.row.children.length < charts.length) {
      const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
      svg.setAttribute("role", "img");
      this.row.append(make("figure", {}, svg));
    }
    charts.forEach((chart, n) => {
      const svg = this.row.children[n].firstChild;
      svg.setAttribute("aria-label", `${chart.title || this.setup.title}. ${words}`);
      svg.setAttribute("class", `figure ${chart.kind}`);
      if (chart.kind === "bars") svg.style.height = `${barsHeight(chart)}px`;
      if (!svg.clientWidth) return;
      fit(svg);
      (chart.kind === "bars" ? drawBars : drawLines)(svg, chart);
    });
  }
}

function readoutOf({ facts, table }) {
  if (facts) {
    return make("dl", { className: "facts" }, ...facts.map(([name, value, title]) =>
      make("div", { title }, make("dt", { innerHTML: name }), make("dd", {}, value))));
  }
  const head = (words, scope) => make("th", { scope }, words);
  return make("table", {},
    make("thead", {}, make("tr", {}, ...table.heads.map((words) => head(words, "col")))),
    make("tbody", {}, ...table.rows.map(([body, ...others]) =>
      make("tr", { className: body }, head(body, "row"), ...others.map((words) => make("td", {}, words))))));
}
