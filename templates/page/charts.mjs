// An explorer whose charts are calculated elsewhere: by the kernel, in a notebook.
import { fit } from "./chart.mjs";
import { Control, make } from "./controls.mjs";
import { barsHeight, drawBars, drawLines } from "./figures.mjs";

/**
 * The explorer in an element.
 *
 * setup: { id, variables, side, values } as an `Explorer` has them, and contents: what is on show,
 *   { charts: [{ kind: "lines" or "bars", … }], readout: as HTML, words: what they show, refusal }.
 * told: called with the values after each change of theirs by hand.
 */
export class Charts {
  constructor(root, setup, told = () => {}) {
    Object.assign(this, { setup, told, values: { ...setup.values }, contents: setup.contents });
    root.classList.add("pierimpact");
    const { id, side, variables } = setup;
    this.panel = make("section", { className: "controls", id: `${id}controls`, ariaLabel: "Truck and pier" });
    this.refusal = make("p", { className: "refusal", role: "alert", hidden: true });
    this.readout = make("div", { className: "readout", role: "status", ariaLive: "polite" });
    this.row = make("div", { className: "row" });
    const main = make("section", { className: "views", ariaLabel: setup.title }, this.refusal, this.readout, this.row);
    this.frame = make("div", { className: "explorer charts" }, main, this.panel);
    root.append(this.frame);
    this.controls = {};
    for (const name of side) {
      this.controls[name] = new Control(variables[name], this.values[name], `${id}${name}`, (moved) => this.#moved(moved));
      this.panel.append(this.controls[name].element);
    }
    this.show(setup.contents);
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
    this.#refuse(error || this.contents.refusal);
    if (error) return;
    this.values[name] = value;
    this.told(this.values);
  }

  /** Take other values, in SI units. */
  set(values) {
    Object.assign(this.values, values);
    for (const [name, control] of Object.entries(this.controls)) control.set(this.values[name]);
  }

  #refuse(why) {
    this.refusal.textContent = why;
    this.refusal.hidden = !why;
    this.row.classList.toggle("stale", Boolean(why));
    this.readout.classList.toggle("stale", Boolean(why));
  }

  /** Show what has been calculated. */
  show(contents) {
    this.contents = contents.refusal ? { ...this.contents, refusal: contents.refusal } : contents;
    this.#refuse(contents.refusal);
    this.showAll();
  }

  showAll() {
    const { charts, readout, words } = this.contents;
    if (this.readout.innerHTML !== readout) this.readout.innerHTML = readout;
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
