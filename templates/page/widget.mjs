// The explorers in a notebook, and where it has no kernel.
import { Charts } from "./charts.mjs";
import { button, make } from "./controls.mjs";
import { Explorer } from "./explorer.mjs";

/** Put an explorer into an element; `told` as it is by an `Explorer`, where there is a kernel. */
export function explore(el, setup, told = () => {}) {
  const Kind = setup.kind ? Charts : Explorer;
  // Of its own: each explorer of a notebook has these modules for itself, so none can count the others.
  const id = `explorer${Math.random().toString(36).slice(2)}-`;
  const explorer = new Kind(el, { ...setup, id }, told);
  const reset = button("Reset", "", () => {
    explorer.set(setup.defaults);
    told(explorer.values);
  });
  explorer.buttons = make("div", { className: "buttons" }, reset);
  (explorer.panel ?? explorer.$("controls")).append(explorer.buttons);
  for (const each of el.querySelectorAll("input, select, button, summary")) {
    each.dataset.lmSuppressShortcuts = "true"; // or JupyterLab would take the arrow keys
  }
  return explorer;
}

/** An explorer as a view of a Jupyter widget. */
export function render({ model, el }) {
  const setup = { ...model.get("setup"), values: model.get("values") };
  const explorer = explore(el, setup, (values) => {
    model.set("values", { ...values });
    model.save_changes();
  });
  const copied = make("div");
  if (setup.copies) {
    explorer.buttons.append(button("Copy as case file", "", () => model.send({ copy: true })));
    explorer.buttons.after(copied);
  }
  const take = () => { // but not what has just been given
    const values = model.get("values");
    if (Object.keys(values).some((name) => values[name] !== explorer.values[name])) explorer.set(values);
  };
  const showCopied = () => copied.replaceChildren(...model.get("copied").flatMap(([name, content]) => [
    make("p", { className: "quiet", textContent: name && `One click selects; copy into ${name}` }),
    make("pre", { textContent: content, tabIndex: 0 }),
  ]));
  model.on("change:values", take);
  model.on("change:copied", showCopied);
  return () => {
    model.off("change:values", take);
    model.off("change:copied", showCopied);
    explorer.remove();
  };
}
