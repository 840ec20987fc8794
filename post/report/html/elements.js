"use strict";
// Pieces of the page.

/** Gives an element attributes and children; null children are left out. */
function filled(result, attributes, children) {
  for (const [key, value] of Object.entries(attributes))
    if (key.startsWith("on")) result.addEventListener(key.slice(2), value);
    else if (value !== null && value !== undefined) result.setAttribute(key, value);
  result.append(...children.flat(Infinity).filter(child => child !== null && child !== undefined));
  return result;
}

const element = (name, attributes = {}, ...children) => filled(document.createElement(name), attributes, children);
/** The same in SVG. */
const drawn = (name, attributes = {}, ...children) => filled(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);

/** What stands at a path in summary.json, as in "srif[0].K1". */
const at = path => path.split(/[.[\]]+/).filter(Boolean).reduce((value, key) => value?.[key], data.summary);

/** A number of summary.json, with its path and the error that its digits are for: the tests compare them. */
function value(path, digits = 6, text = null, factor = 1, error = null) {
  const x = at(path);
  return element("span", { class: "number", "data-from": path, "data-value": x ?? "", "data-factor": factor === 1 ? null : factor, "data-error": error, title: typeof x === "number" ? String(x) : null },
    text ?? shown(typeof x === "number" ? x / factor : x, digits));
}

/** A number of summary.json with its error, in a unit that is `factor` times its own. */
function with_error(path, error, factor = 1, most = 6) {
  const x = at(path), known = typeof error === "number" && error > 0;
  return [value(path, most, typeof x === "number" ? measured(x / factor, known ? error / factor : null, most) : null, factor, known ? error : null),
    known ? element("span", { class: "error" }, ` ± ${shown(error / factor, 2)}`) : null];
}

function section(title, ...children) {
  const content = children.flat(Infinity).filter(child => child !== null && child !== undefined);
  if (content.length === 0) return null;
  return element("section", { id: title.toLowerCase().replace(/[^a-z0-9]+/g, "-") }, element("h2", {}, title), content);
}

const screen_note = (...children) => element("p", { class: "note screen" }, ...children);
const note = (...children) => element("p", { class: "note" }, ...children);

/** A table: `columns` of {title, unit, left, long, minor}; rows of cells. Minor columns are not on narrow screens. */
function table(columns, rows, attributes = {}) {
  const look = column => [column.left || column.long ? "left" : "", column.minor ? "minor" : ""].filter(Boolean).join(" ") || null;
  const head = columns.map(column => element("th", { class: look(column), scope: "col" }, column.title,
    column.unit ? element("span", { class: "unit" }, ` ${column.unit}`) : null));
  const body = rows.map(row => element("tr", { class: row.kind ?? null },
    (row.cells ?? row).map((cell, i) => element("td", { class: columns[i].long ? `${look(columns[i])} long` : look(columns[i]) }, cell ?? "–"))));
  return element("div", { class: "scroll" }, element("table", attributes, element("thead", {}, element("tr", {}, head)), element("tbody", {}, body)));
}

/** Names and what they are. */
function facts(pairs) {
  return element("dl", { class: "facts" }, pairs.filter(pair => pair && pair[1] !== null && pair[1] !== undefined && pair[1] !== "")
    .map(([name, ...what]) => element("div", {}, element("dt", {}, name), element("dd", {}, ...what))));
}

const folded = (title, ...children) => element("details", {}, element("summary", {}, title), ...children);

/** All that is drawn on canvas, drawn again where colours or sizes change. */
const drawings = [];
function redraw() {
  for (const drawing of drawings) drawing();
}

const style = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
/** Okabe and Ito's colours, that the colour-blind can tell from each other, as the scheme has them. */
const line_colour = number => style(`--line${number % 8}`);
