"use strict";
// The table of piers: sorted, filtered, and shown a hundred rows at a time.
const { headings, columns, words, sheets } = JSON.parse(document.getElementById("data").textContent);
const at = (id) => document.getElementById(id);
if (at("piers")) {
  const SHOWN = 100;
  const count = columns[0].length;
  let order = [...Array(count).keys()], first = 0, by = 0, down = false;

  const head = at("piers").tHead.rows[0], body = at("piers").tBodies[0];
  headings.forEach((heading, i) => {
    const cell = document.createElement("th"), button = document.createElement("button");
    cell.scope = "col";
    cell.className = words[i] ? "" : "number";
    button.textContent = heading;
    button.addEventListener("click", () => {
      // The largest number is what one looks for first, but for the rank.
      down = by === i ? !down : !words[i] && i > 0;
      by = i;
      update();
    });
    cell.append(button);
    head.append(cell);
    if (!words[i]) at("column").append(new Option(heading, i));
  });

  const compare = (a, b) => {
    const x = columns[by][a], y = columns[by][b];
    if (x === null || y === null) return (x === null) - (y === null) || a - b;
    const sign = words[by] ? String(x).localeCompare(String(y), "en", { numeric: true }) : x - y;
    return (down ? -sign : sign) || a - b;
  };

  function update() {
    const text = at("search").value.trim().toLowerCase(), numbers = columns[+at("column").value];
    const from = at("from").value === "" ? null : +at("from").value;
    const to = at("to").value === "" ? null : +at("to").value;
    order = [];
    for (let i = 0; i < count; i++) {
      const value = numbers[i];
      if (from !== null && !(value !== null && value >= from)) continue;
      if (to !== null && !(value !== null && value <= to)) continue;
      if (text && !columns.some((column, k) => words[k] && column[i].toLowerCase().includes(text))) continue;
      order.push(i);
    }
    order.sort(compare);
    first = 0;
    show();
  }

  function show() {
    body.replaceChildren(...order.slice(first, first + SHOWN).map((i) => {
      const row = document.createElement("tr");
      columns.forEach((column, k) => {
        const cell = row.insertCell();
        cell.className = words[k] ? "" : "number";
        const value = column[i];
        if (headings[k] === "id" && sheets[i]) {
          const link = document.createElement("a");
          link.href = sheets[i];
          link.textContent = value;
          cell.append(link);
        } else cell.textContent = value ?? "";
      });
      return row;
    }));
    [...head.cells].forEach((cell, k) => {
      if (k === by) cell.setAttribute("aria-sort", down ? "descending" : "ascending");
      else cell.removeAttribute("aria-sort");
    });
    const last = Math.min(first + SHOWN, order.length);
    at("status").textContent = order.length ? `Rows ${first + 1} to ${last} of ${order.length}` : "No pier is like that";
    at("before").disabled = first === 0;
    at("after").disabled = last === order.length;
  }

  at("before").addEventListener("click", () => { first -= SHOWN; show(); });
  at("after").addEventListener("click", () => { first += SHOWN; show(); });
  at("filters").addEventListener("input", update);
  at("filters").addEventListener("submit", (event) => event.preventDefault());
  at("filters").addEventListener("reset", () => setTimeout(update));
  update();
}
