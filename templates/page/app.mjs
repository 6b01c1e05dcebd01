// The form of `pierimpact app`: fields, what they come to, and files to open and to save.

/** Make an element with properties, attributes (those with a dash or of ARIA) and children. */
function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.includes("-") || name === "role" || name === "for") element.setAttribute(name, value);
    else element[name] = value;
  }
  element.append(...children);
  return element;
}

/** One field: label, input, help, and a place for its error. */
class Field {
  constructor(key, setup, changed) {
    const id = `field-${key}`;
    this.key = key;
    this.setup = setup;
    this.kept = ""; // what was last sent or received
    this.help = make("p", { id: `${id}-help`, className: "help", textContent: setup.help });
    this.error = make("p", { id: `${id}-error`, className: "error", hidden: true });
    if (setup.choices.length) {
      const empty = setup.required ? [] : [make("option", { value: "", textContent: "as by default" })];
      const options = setup.choices.map((each) => make("option", { value: each, textContent: each }));
      this.input = make("select", { id }, ...empty, ...options);
    } else if (setup.lines) {
      this.input = make("textarea", { id, rows: 3 });
    } else {
      this.input = make("input", { id, type: "text", autocomplete: "off", spellcheck: false });
    }
    this.input.setAttribute("aria-describedby", `${id}-help ${id}-error`);
    if (setup.required) this.input.setAttribute("aria-required", "true");
    const label = make("label", { for: id, textContent: setup.label });
    if (setup.required) label.append(make("span", { className: "quiet", textContent: " (required)" }));
    this.element = make("div", { className: "field" }, label, this.input, this.error, this.help);
    if (setup.suggestions.length) {
      const list = make("datalist", { id: `${id}-list` });
      list.append(...setup.suggestions.map((value) => make("option", { value })));
      this.input.setAttribute("list", list.id);
      this.element.append(list);
    }
    this.input.addEventListener("change", changed);
    this.input.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && this.input.type === "text") changed();
    });
  }

  get value() { return this.input.value; }

  /** Set the value; a choice that is none is shown beside the others. */
  set value(text) {
    if (this.input.tagName === "SELECT" && ![...this.input.options].some(({ value }) => value === text)) {
      this.input.append(make("option", { value: text, textContent: text || "—" }));
    }
    this.input.value = text;
  }

  say(line) {
    this.error.hidden = !line;
    this.error.textContent = line ?? "";
    this.input.setAttribute("aria-invalid", String(Boolean(line)));
  }
}

/** The form as a view of a Jupyter widget. */
export function render({ model, el }) {
  const setup = model.get("setup");
  const fields = new Map();
  let [busy, waiting, saved, text, announced] = [false, null, "", "", ""];
  let [silence, shownBefore] = [0, false];

  const status = make("p", { role: "status", className: "status", textContent: "Calculating…" });
  const alert = make("div", { role: "alert", className: "alert", hidden: true });
  const results = make("div", { className: "results" });
  const progress = make("progress", { max: 1, value: 0, hidden: true, "aria-label": "Progress of the report" });
  const reported = make("p", { role: "status", className: "quiet" });
  const name = new Field("file_name", {
    label: "File name", help: "Name of the case file and of its report.", required: false,
    choices: [], suggestions: [], lines: false, examples: {},
  }, () => changed());
  const unknown = make("fieldset", { hidden: true }, make("legend", { textContent: "Unknown keys of the file" }),
    make("p", { className: "help", textContent: "Empty a field to leave its key out." }));

  const ask = (content, buffers = []) => {
    busy = true;
    status.textContent = "Calculating…";
    results.setAttribute("aria-busy", "true");
    clearTimeout(silence);
    silence = setTimeout(() => {
      status.textContent = "There is no answer. If the program has ended, start it again and open the page that it names; "
        + "Save still gives the case as it was last calculated.";
    }, 60000);
    model.send(content, undefined, buffers);
  };
  /** Ask once the answer before has come; of several changes the last is asked alone. */
  const soon = (content, buffers) => {
    if (busy) waiting = [content, buffers];
    else ask(typeof content === "function" ? content() : content, buffers);
  };
  const typed = () => Object.fromEntries(
    [...fields].map(([key, field]) => [key, field.element.hidden ? "" : field.value]));
  const change = () => {
    for (const field of fields.values()) field.kept = field.value;
    return { do: "change", name: name.value, typed: typed() };
  };
  function changed() {
    shape();
    soon(change);
  }

  /** Show the fields of the shape, and examples in the units that are chosen. */
  function shape() {
    const [form, units] = ["column_shape", "units"].map((key) => fields.get(key).value);
    const own = setup.shapes[form] ?? [];
    for (const [key, field] of fields) {
      const example = field.setup.examples[units] ?? field.setup.examples.SI ?? "";
      if (typeof example === "object") {
        field.element.hidden = !own.includes(key);
        field.input.placeholder = example[form] ? `e.g. ${example[form]}` : "";
      } else if (field.input.tagName !== "SELECT") {
        field.input.placeholder = example && example !== "—" ? `e.g. ${example}` : "";
      }
    }
  }

  const groups = setup.groups.map(({ title, keys, more }) => {
    const add = (key) => {
      fields.set(key, new Field(key, setup.fields[key], changed));
      return fields.get(key).element;
    };
    const group = make("fieldset", {}, make("legend", { textContent: title }), ...keys.map(add));
    if (more.length) {
      const words = keys.length ? `More: ${title.toLowerCase()}` : title;
      const drawer = make("details", {}, make("summary", { textContent: words }), ...more.map(add));
      group.append(drawer);
    }
    return group;
  });

  /** Give the files that are chosen to `take`. */
  const chooser = (words, accept, multiple, take) => {
    const input = make("input", { type: "file", accept, multiple, hidden: true, "aria-label": words });
    input.addEventListener("change", async () => {
      for (const file of input.files) take(file.name, [new DataView(await file.arrayBuffer())]);
      input.value = "";
    });
    return [make("button", { type: "button", textContent: words, onclick: () => input.click() }), input];
  };
  const download = (filename, content, type) => {
    const url = URL.createObjectURL(new Blob([content], { type }));
    make("a", { href: url, download: filename }).click();
    setTimeout(() => URL.revokeObjectURL(url), 60000);
  };
  const save = () => {
    if (!/^[^./][^/]*\.ya?ml$/i.test(name.value)) { // what is wrong with it is said beside it
      name.input.focus();
      return;
    }
    download(name.value, text, "application/yaml");
    saved = text;
  };
  const discard = () => text === saved || window.confirm("The case has changes that are not saved. Leave them?");
  const fresh = ["SI", "US"].map((units) => make("button", {
    type: "button", textContent: `New (${units})`,
    onclick: () => discard() && soon({ do: "new", units }),
  }));
  const open = chooser("Open…", ".yaml,.yml", false, (filename, content) =>
    discard() && soon({ do: "open", name: filename }, content));
  const add = chooser("Add file…", ".toml,.png,.jpg,.jpeg,.svg,.csv,.yaml,.yml", false, (filename, content) =>
    soon({ do: "add", name: filename }, content));
  add[0].title = "A truck file, a logo, the case before or pierimpact.toml, which the case names";
  const writers = Object.entries({ PDF: ".pdf", HTML: ".html", Word: ".docx" }).map(([words, ending]) =>
    make("button", { type: "button", className: "report", textContent: words, disabled: true, "aria-label": `Report as ${words}`,
      onclick: () => {
        for (const each of writers) each.disabled = true;
        [progress.hidden, progress.value] = [false, 0];
        reported.textContent = "Writing the report…";
        model.send({ do: "report", ending });
      } }));

  /** Show what a case comes to; without a result, that before stays and is said to be. */
  function showResult(result) {
    results.setAttribute("aria-busy", "false");
    results.classList.toggle("earlier", !result && shownBefore);
    for (const each of writers) each.disabled = !result || !progress.hidden;
    if (!result) {
      status.textContent = shownBefore
        ? "Not up to date: drawing and results are of the earlier inputs."
        : "Nothing to show until the inputs are complete.";
      return;
    }
    shownBefore = true;
    status.textContent = "Up to date.";
    const drawing = make("img", { alt: result.alt, src: `data:image/svg+xml,${encodeURIComponent(result.svg)}` });
    const verdict = make("p", { className: `verdict ${result.kind}`, textContent: result.statement });
    const headline = make("dl", { className: "headline" }, ...result.results.slice(0, 2).map(([label, value]) =>
      make("div", {}, make("dt", { textContent: label }), make("dd", { textContent: value }))));
    const rows = result.results.map(([label, value, remark]) => make("tr", {},
      make("th", { scope: "row", textContent: label }), make("td", { className: "value", textContent: value }),
      make("td", { className: "quiet", textContent: remark })));
    const ratios = result.utilisations.map(([of, ratio, words, share]) => make("div", { className: "ratio" },
      make("p", { textContent: `Utilisation in ${of}: ` }, make("strong", { textContent: ratio }), ` — ${words}`),
      make("div", { className: `bar ${share > 1 ? "exceeds" : "holds"}`, "aria-hidden": "true" },
        make("i", { style: `width: ${Math.min(100, 100 * share / 1.25)}%` }))));
    const warnings = make("section", { className: "warnings" }, make("h2", { textContent: "Before you rely on this" }),
      make("ul", {}, ...result.warnings.map((line) => make("li", { textContent: line }))));
    const table = make("table", {}, make("caption", { textContent: "Results" }), make("tbody", {}, ...rows));
    const situation = make("div", { className: "situation" }, make("figure", {}, drawing),
      make("div", {}, headline, ...ratios));
    results.replaceChildren(verdict, situation, table,
      ...(result.warnings.length ? [warnings] : []));
  }

  function showErrors(errors, general) {
    for (const [key, field] of [...fields, ["file_name", name]]) {
      field.say(errors[key]);
      if (!errors[key]) continue;
      field.element.hidden = false;
      const drawer = field.element.closest("details");
      if (drawer) drawer.open = true;
    }
    const linked = Object.entries(errors).filter(([key]) => fields.has(key) || key === "file_name");
    const others = Object.entries(errors).filter(([key]) => !fields.has(key) && key !== "file_name");
    const lines = [
      ...linked.map(([key, line]) => make("li", {}, make("a", { href: `#field-${key}`, textContent: line,
        onclick: (event) => { event.preventDefault(); (fields.get(key) ?? name).input.focus(); } }))),
      ...[...others.map(([, line]) => line), ...general].map((line) => make("li", { textContent: line })),
    ];
    const now = lines.map((line) => line.textContent).join("\n");
    alert.hidden = !lines.length;
    if (now === announced) return; // nothing new to be read out
    announced = now;
    alert.replaceChildren(...(lines.length ? [make("p", { textContent: "Please look at:" }), make("ul", {}, ...lines)] : []));
  }

  function take(answer) {
    const all = answer.to !== "change" || !text;
    for (const field of [...fields.values()].filter(({ stranger }) => stranger)) {
      if (all || !(field.key in answer.typed)) {
        fields.delete(field.key);
        field.element.remove();
      }
    }
    for (const key of Object.keys(answer.typed).filter((each) => !fields.has(each))) {
      const field = new Field(key, { label: key, help: "", required: false, choices: [], suggestions: [], lines: false, examples: {} }, changed);
      field.stranger = true;
      fields.set(key, field);
      unknown.append(field.element);
    }
    unknown.hidden = ![...fields.values()].some(({ stranger }) => stranger);
    for (const [key, field] of fields) {
      const value = answer.typed[key] ?? "";
      // What is being typed, or was changed while this was calculated, stays.
      if (all || (!field.element.hidden && field.value === field.kept && value !== field.value.trim())) field.value = value;
      field.kept = field.value;
      const drawer = field.element.closest("details");
      if (all && drawer && value && key !== "damping_ratio" && key !== "assumed" && key !== "sources") drawer.open = true;
    }
    if (all) {
      name.value = answer.name;
      if (answer.to !== "add") saved = answer.text;
    }
    text = answer.text;
    shape();
    const errors = { ...answer.errors };
    const general = [...answer.general, ...(answer.note ? [answer.note] : [])];
    if (answer.refused?.startsWith("file name")) errors.file_name = answer.refused;
    else if (answer.refused) general.unshift(answer.refused);
    showErrors(errors, general);
    showResult(answer.result);
  }

  const TYPES = { pdf: "application/pdf", html: "text/html" };
  const hear = (told, buffers) => {
    if (told.kind === "progress") progress.value = told.share;
    if (told.kind === "failed" || told.kind === "file") {
      progress.hidden = true;
      for (const each of writers) each.disabled = results.classList.contains("earlier");
      reported.textContent = told.kind === "file" ? `${told.name} is downloaded.` : told.words;
    }
    if (told.kind === "file") download(told.name, buffers[0], TYPES[told.name.split(".").pop()] ?? "");
    if (told.kind !== "answer") return;
    clearTimeout(silence);
    busy = false;
    take(told);
    if (waiting) {
      const [content, content2] = waiting;
      waiting = null;
      soon(content, content2);
    }
  };
  const warn = (event) => { if (text !== saved) event.preventDefault(); };

  const toolbar = make("div", { className: "toolbar" },
    make("div", { className: "buttons", role: "group", "aria-label": "Case file" }, ...fresh, ...open,
      make("button", { type: "button", textContent: "Save", onclick: save }), ...add),
    name.element,
    make("div", { className: "buttons", role: "group", "aria-label": "Report" },
      make("span", { textContent: "Report:" }), ...writers, progress), reported);
  const root = make("main", { className: "pierimpact-app" },
    make("header", {}, make("h1", { textContent: "Truck collision with a bridge pier" }), toolbar),
    make("div", { className: "columns" },
      make("form", { onsubmit: (event) => event.preventDefault(), "aria-label": "Case" }, unknown, ...groups),
      make("section", { className: "right", "aria-label": "Results" }, status, alert, results)));
  el.append(root);
  model.on("msg:custom", hear);
  window.addEventListener("beforeunload", warn);
  ask({ do: "start" });
  return () => {
    model.off("msg:custom", hear);
    window.removeEventListener("beforeunload", warn);
    clearTimeout(silence);
  };
}
