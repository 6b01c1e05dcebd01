// Controls: sliders, each with a box to type in where it has units, and lists of choices.

const TYPED = /^\s*([-+]?(?:\d+[.,]?\d*|[.,]\d+)(?:e[-+]?\d+)?)\s*(.*?)\s*$/i;
const BEYOND = 10; // how many times what is typed may lie beyond the slider's ends

/** An element of the page with its properties and children. */
export function make(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

export function button(words, className, act) {
  return make("button", { type: "button", textContent: words, className, onclick: act });
}

/**
 * One variable's slider or list of choices.
 *
 * variable: { name, label, symbol as HTML, unit, spoken: unit, size: of the unit in SI, low, high,
 *   step, log, choices, units: what may be typed, with sizes }; low and high in the unit shown, the
 *   step of a logarithmic slider in powers of ten. The value is in SI units.
 */
export class Control {
  constructor(variable, value, id, changed) {
    this.variable = variable;
    this.changed = changed;
    this.error = "";
    const { choices, units } = variable;
    const name = make("label", { htmlFor: id }, variable.label);
    if (variable.symbol) name.append(" ", make("span", { innerHTML: variable.symbol }));
    this.element = make("div", { className: "slider" }, name);
    if (choices) {
      this.input = make("select", { id }, ...choices.map((choice) => make("option", { value: choice }, choice)));
      this.input.onchange = () => this.take(this.input.value);
      this.element.append(this.input);
      this.element.className = "slider choice";
    } else {
      this.input = make("input", { type: "range", id, min: 0, step: 1 });
      this.reach(variable);
      this.input.oninput = () => this.take(this.at(Number(this.input.value)));
      this.box = units
        ? make("input", { type: "text", className: "value", id: `${id}-value`, autocomplete: "off" })
        : make("span", { className: "value", id: `${id}-value` });
      this.box.setAttribute(...(units ? ["aria-label", `${variable.label}, to type`] : ["aria-hidden", "true"]));
      if (units) {
        this.box.onchange = () => this.typed(this.box.value);
        // JupyterLab keeps the Enter key from what the browser does by itself.
        this.box.onkeydown = ({ key }) => { if (key === "Enter") this.typed(this.box.value); };
      }
      this.element.append(this.box, this.input);
    }
    this.set(value);
  }

  /** Take the ends and the step of another slider for the same variable. */
  reach({ low, high, step }) {
    Object.assign(this.variable, { low, high, step });
    this.notches = Math.round((this.variable.log ? Math.log10(high / low) : high - low) / step);
    this.input.max = this.notches;
  }

  /** The value at a notch of the slider. */
  at(notch) {
    const { low, high, step, log, size } = this.variable;
    return size * (log ? low * (high / low) ** (notch / this.notches) : low + notch * step);
  }

  /** The notch nearest to a value; the value itself stays as it is. */
  notch(value) {
    const { low, high, step, log, size } = this.variable, shown = value / size;
    return Math.round(log ? (this.notches * Math.log(shown / low)) / Math.log(high / low) : (shown - low) / step);
  }

  set(value) {
    const { choices, unit, spoken } = this.variable;
    this.value = value;
    this.error = "";
    if (choices) {
      this.input.value = value;
      return;
    }
    const shown = this.shown();
    this.input.value = this.notch(value);
    this.input.setAttribute("aria-valuetext", `${shown} ${spoken}`.trim());
    this.words = `${shown} ${unit}`.trim();
    this.box[this.variable.units ? "value" : "textContent"] = this.words;
  }

  /** The value in figures, as exact as the slider, or as what was typed to four figures. */
  shown() {
    const { log, step, size } = this.variable, value = this.value / size;
    const decimals = log ? Math.max(2 - Math.floor(Math.log10(value)), 0) : (String(step).split(".")[1] ?? "").length;
    const rounded = value.toFixed(decimals);
    return log || Math.abs(Number(rounded) - value) < 1e-4 * Math.abs(value) + 1e-12
      ? rounded : String(Number(value.toPrecision(4)));
  }

  take(value) {
    this.set(value);
    this.changed(this);
  }

  typed(text) {
    if (text === this.words && !this.error) return; // the value is more exact than its figures
    const { label, unit, units, size, low, high } = this.variable;
    const [, figures, given] = text.match(TYPED) ?? [];
    const own = figures === undefined ? undefined : given === "" ? size : units[given];
    const value = own * Number(figures?.replace(",", "."));
    const [least, most] = [(low * size) / BEYOND, high * size * BEYOND];
    const known = Object.keys(units).filter((each) => each).join(", ");
    if (!Number.isFinite(value)) {
      this.error = known
        ? `${label} must be a number with a unit (${known}), got “${text.slice(0, 40)}”.`
        : `${label} must be a number, got “${text.slice(0, 40)}”.`;
    } else if (value < least || value > most) {
      const words = (end) => `${Number((end / size).toPrecision(3))} ${unit}`.trim();
      this.error = `${label} must be from ${words(least)} to ${words(most)}, got “${text.slice(0, 40)}”.`;
    } else {
      this.set(value);
    }
    this.changed(this);
  }
}
