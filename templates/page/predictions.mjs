// Predictions: questions whose choice is locked before the answer is on show.
import { button, make } from "./controls.mjs";

/**
 * Ask questions, as `questions` returns them.
 *
 * gate, list: elements for the first question until it is answered or skipped, and for all others;
 * reveal(revealed, words): called when what the first question hides is to be shown, with
 *   what there is to say about it, or hidden again; show(place): called to show what one is about;
 * key: under which the browser remembers what was locked, where it does.
 */
export function predictions(asked, { gate, list, reveal, show, key }) {
  let memory = remembered();
  ask();
  return { startAgain };

  /** What was locked before: { choices: by number of the question, skipped }. */
  function remembered() {
    const choices = {};
    try {
      const kept = JSON.parse(localStorage.getItem(key));
      asked.forEach((question, number) => {
        if (kept.choices[number] in question.choices) choices[number] = kept.choices[number];
      });
      return { choices, skipped: kept.skipped === true };
    } catch { // nothing, nothing that fits, or nothing allowed
      return { choices, skipped: false };
    }
  }

  function remember() {
    try {
      localStorage.setItem(key, JSON.stringify(memory));
    } catch { /* it works without */ }
  }

  function startAgain() {
    memory = { choices: {}, skipped: false };
    remember();
    ask();
    gate.querySelector("input").focus({ preventScroll: true });
  }

  /** Put each question in its place. */
  function ask(words = null) {
    const revealed = memory.skipped || 0 in memory.choices;
    const fields = asked.map(fieldset);
    gate.replaceChildren(...(revealed ? [] : [fields.shift()]));
    gate.hidden = revealed;
    list.replaceChildren(...fields);
    reveal(revealed, words);
  }

  function lock(number, choice) {
    memory.choices[number] = choice;
    remember();
    const field = document.getElementById(`question-${number}`);
    if (gate.contains(field)) {
      ask(verdict(asked[number], choice));
    } else {
      const locked = fieldset(asked[number], number);
      field.replaceWith(locked);
      locked.querySelector(".verdict").focus();
    }
  }

  function skip() {
    memory.skipped = true;
    remember();
    ask(["Move the slider: the marks stand for this pier, the lines for all the others. "
      + "Each point of a line is a whole collision."]);
  }

  /** A question as a field set; once it is locked, with its answer. */
  function fieldset(question, number) {
    const locked = number in memory.choices, chosen = memory.choices[number];
    const right = locked ? question.answer().right : null;
    const id = `question-${number}`;
    const choices = question.choices.map(([words], n) => {
      const checked = chosen === n;
      const input = make("input", { type: "radio", name: id, value: n, checked, disabled: locked });
      const label = make("label", {}, input, make("span", { textContent: words }));
      if (n === right) label.className = "right";
      const note = n === chosen ? "your prediction" : n === right ? "what happens" : "";
      if (note) label.append(make("small", { textContent: `${n === right ? "✓" : "✗"} ${note}` }));
      return label;
    });
    const group = make("div", { className: "choices" }, ...choices);
    const buttons = make("div", { className: "buttons" });
    const legend = make("legend", { textContent: `${number + 1}. ${question.words}` });
    const field = make("fieldset", { id }, legend, group);
    if (locked) {
      const words = verdict(question, chosen);
      field.append(make("p", { className: "verdict", tabIndex: -1 }, ...words));
      if (question.show) buttons.append(button("Show it above", "", () => show(question.show)));
    } else {
      const locks = button("Lock my prediction", "main", () =>
        lock(number, Number(group.querySelector(":checked").value)));
      locks.disabled = true;
      group.onchange = () => { locks.disabled = false; };
      buttons.append(locks);
      if (number === 0 && !memory.skipped) {
        buttons.append(button("Show the lines without predicting", "plain", skip));
      }
    }
    field.append(buttons);
    return field;
  }
}

/** What there is to say to a choice: whether it is right, what it may come from, and why. */
function verdict(question, choice) {
  const { right, reason } = question.answer(), misconception = question.choices[choice][1];
  if (choice === right) return [make("strong", { textContent: "As you predicted. " }), reason];
  const quoted = make("em", { textContent: `“${misconception}”` });
  const named = ["A common misconception: ", quoted, " "];
  return [make("strong", { textContent: "Not so. " }), ...(misconception ? named : []), reason];
}
