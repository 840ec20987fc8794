"use strict";
// Studies: errors against run time and points, values along the axes, orders; tables of extremes with their verdicts.

const csv = data.study ?? data.extremes ?? data.papers ?? {};
const length_of = columns => Math.max(0, ...Object.values(columns ?? {}).map(column => column.length));
const cell_of = (name, i) => csv[name]?.[i] ?? null;

const axes = (data.axes ?? []).filter(axis => csv[axis]);
const number_in = label => (typeof label === "number" ? label : label !== null && label !== "" && Number.isFinite(Number(label)) ? Number(label) : null);
const differs = name => new Set(csv[name] ?? []).size > 1;
const refined = data.along ?? axes.at(-1) ?? null;

/** Rows of a quantity at a place, in lines: one for each combination of the axes but one, and of the methods. */
function lines_along(rows, axis) {
  const others = axes.filter(name => name !== axis && new Set(rows.map(i => cell_of(name, i))).size > 1), methods = new Set(rows.map(i => cell_of("srif_method", i))).size > 1;
  const label = i => [...others.map(name => (number_in(cell_of(name, i)) === null ? cell_of(name, i) : `${name} ${shown(number_in(cell_of(name, i)), 4)}`)),
    methods ? spaced(cell_of("srif_method", i) ?? "first method") : null].filter(Boolean).join(", ");
  return [...grouped(rows, label)].map(([name, indices]) => ({ name, rows: indices.map(k => rows[k]) }));
}

const order_along = (line, first) => {
  const { orders } = data;
  if (!orders) return "";
  const same = k => ["quantity", "place", "srif_method", ...axes.filter(axis => axis !== refined)].every(name => !orders[name] || !csv[name] || orders[name][k] === csv[name][first]);
  const k = [...Array(length_of(orders)).keys()].find(same);
  const straight = 0.1; // decades
  return k === undefined || typeof orders.order?.[k] !== "number" || !(orders.misfit?.[k] < straight) ? "" : ` (order ${shown(orders.order[k], 3)})`;
};

function sorted(line) {
  const order = line.x.map((_, i) => i).filter(i => Number.isFinite(line.x[i]) && Number.isFinite(line.y[i])).sort((a, b) => line.x[a] - line.x[b]);
  return { ...line, x: order.map(i => line.x[i]), y: order.map(i => line.y[i]) };
}

const described = (quantity, place) => `${quantity}${place ? ` at ${place}` : ""}`;
const look_numbers = new Map();
const look = name => (look_numbers.has(name) || look_numbers.set(name, look_numbers.size), look_numbers.get(name));

function quantities() {
  const rows = [...Array(length_of(csv)).keys()].filter(i => cell_of("quantity", i));
  return [...grouped(rows, i => described(cell_of("quantity", i), cell_of("place", i)))].map(([name, indices]) => ({ name, rows: indices.map(k => rows[k]) }));
}

/** More lines than these are named by the table of methods, in its colours, and not below each plot. */
const few = 4;

function error_plots(column, label) {
  return quantities().map(({ name, rows }) => {
    const lines = lines_along(rows, refined).map(line => sorted({
      label: `${line.name || "error"}${order_along(line, line.rows[0])}`, number: look(line.name), points: true, x: line.rows.map(i => cell_of(column, i)),
      y: line.rows.map(i => (cell_of("error", i) ? 100 * Math.abs(cell_of("error", i)) : NaN)),
    })).filter(line => line.x.length > 0);
    return lines.length === 0 ? null : plot({ title: `Error of ${name} against ${label.short}`, x: { label: label.words, log: true }, y: { label: "|error| [%]", log: true }, lines, legend: lines.length <= few });
  });
}

/** The label of the axis that refines with the most points; null in studies that refine along none. */
function finest_label() {
  const points = csv.points ?? [], most = largest(points);
  return data.along && most > 0 && differs(data.along) ? cell_of(data.along, points.findIndex(x => x === most)) : null;
}

function value_plots(axis) {
  const places = [...new Set((csv[axis] ?? []).map(number_in))];
  if (places.length < 2 || places.includes(null)) return [];
  const log = Math.min(...places) > 0 && Math.max(...places) > 20 * Math.min(...places);
  const own = axis === refined, finest = own ? null : finest_label(); // the lines are those of the table of methods
  return quantities().map(({ name, rows: all }) => {
    const rows = finest === null ? all : all.filter(i => cell_of(refined, i) === finest);
    const lines = lines_along(rows, axis).map((line, i) => sorted({ label: line.name || "computed", number: own ? look(line.name) : i, points: true,
      x: line.rows.map(k => number_in(cell_of(axis, k))), y: line.rows.map(k => cell_of("computed", k)) })).filter(line => line.x.length > 1);
    if (lines.length === 0) return null;
    const known = grouped(rows, i => `${cell_of(axis, i)} ${cell_of("reference", i)}`), first = [...known.values()].map(k => rows[k[0]]).filter(i => typeof cell_of("reference", i) === "number");
    if (first.length) lines.push(sorted({ label: "reference", rings: true, number: 6, x: first.map(i => number_in(cell_of(axis, i))), y: first.map(i => cell_of("reference", i)) }));
    return plot({ title: `${name} against ${axis}${finest === null ? "" : ` (${number_in(finest) === null ? finest : `${refined} ${shown(number_in(finest), 4)}`})`}`, x: { label: axis, log }, y: { label: name }, lines, legend: lines.length <= (own ? few : 2 * few) + 1 });
  });
}

/** What each method comes to: mean and largest error, fitted order, time. A method is a line of the plots. */
function methods_section() {
  const known = quantities().flatMap(({ name, rows }) => lines_along(rows, refined).map(line => ({ name, line })));
  if (known.length < 2 || !csv.error) return null;
  const several = quantities().length > 1, mean = list => list.reduce((sum, x) => sum + x, 0) / list.length;
  const range = list => (list.length ? `${shown(Math.min(...list), 3)} to ${shown(Math.max(...list), 3)}` : null);
  const rows = known.map(({ name, line }) => {
    const of = column => line.rows.map(i => cell_of(column, i)).filter(x => typeof x === "number"), errors = of("error").map(Math.abs), taken = of("seconds"), used = of("processor_seconds");
    const order = order_along(line, line.rows[0]).match(/order (.*)\)/);
    return [[element("span", { class: "key", style: `background: var(--line${look(line.name) % 8})` }), ` ${line.name || "all runs"}`], ...(several ? [name] : []), `${line.rows.length}`,
      errors.length ? percent(mean(errors)) : null, errors.length ? percent(largest(errors)) : null, order ? order[1] : null, range(taken), ...(csv.processor_seconds ? [range(used)] : [])];
  });
  return section("Methods", table([{ title: "method", left: true }, ...(several ? [{ title: "quantity", left: true }] : []), { title: "runs" }, { title: "mean |error|" }, { title: "largest |error|" },
    { title: `order in ${refined ?? "–"}` }, { title: "run time [s]" }, ...(csv.processor_seconds ? [{ title: "of processors [s]" }] : [])], rows, { "data-table": "methods" }),
  note("Colours as in the plots. The order is the slope of log |error| over the log of the length by least squares, where the errors lie on a line."));
}

const cell_words = (name, x) => (x === null ? "–" : typeof x !== "number" ? String(x) : name === "error" || name === "estimated_error" ? `${shown(100 * x, 3)} %` : name.includes("seconds") ? shown(x, 3) : shown(x, 6));

/** A cell of study.csv or extremes.csv, with its place: the tests compare them. */
function csv_cell(name, i) {
  const x = cell_of(name, i);
  return element("span", { class: "number", "data-cell": `${name}[${i}]`, "data-value": x ?? "" }, cell_words(name, x));
}

function csv_table(columns, rows, kind = () => null) {
  const words = columns.some(name => (csv[name] ?? []).some(x => typeof x === "string"));
  const some = (name, is) => (csv[name] ?? []).some(x => typeof x === "string" && is(x));
  return table(columns.map(name => ({ title: spaced(name), left: words && some(name, () => true), long: words && some(name, x => x.length > 24) })).concat(note_title()),
    rows.map(i => ({ kind: kind(i), cells: columns.map((name, k) => (k === 0 && report_of(i) ? element("a", { href: `${encodeURIComponent(report_of(i))}/report.html` }, csv_cell(name, i)) : csv_cell(name, i))).concat(note_title().map(() => notes_of([i]))) })), { "data-table": data.kind });
}

/** The messages of a study, each once; rows give their numbers. */
const notes = () => (data.kind === "study" ? [...new Set((csv.message ?? []).filter(Boolean))] : []);
const note_title = () => (notes().length ? [{ title: "note" }] : []);

function notes_of(rows) {
  const own = rows.filter(i => cell_of("message", i));
  return own.map((i, n) => [n ? ", " : "", element("span", { class: "number", "data-cell": `message[${i}]`, "data-value": cell_of("message", i) }, `${notes().indexOf(cell_of("message", i)) + 1}`)]);
}

/** A row for each run and quantity: what differs between methods stands in a column for each method. */
function table_of_methods(columns, rows) {
  const found = rows.filter(i => cell_of("computed", i) !== null), methods = [...new Set((found.length ? found : rows).map(i => cell_of("srif_method", i)))], runs = [...grouped(rows, i => [...axes, "quantity", "place"].map(name => cell_of(name, i)).join("\n")).values()].map(found => found.map(k => rows[k]));
  const row_of = (run, method) => run.find(i => cell_of("srif_method", i) === method);
  const own = columns.filter(name => name !== "srif_method" && runs.some(run => new Set(run.map(i => cell_of(name, i)).filter(x => x !== null)).size > 1)), shared = columns.filter(name => name !== "srif_method" && !own.includes(name));
  const [before, behind] = [shared.filter(name => axes.includes(name) || name === "quantity" || name === "place"), shared.filter(name => !axes.includes(name) && name !== "quantity" && name !== "place")];
  const title = name => ({ title: spaced(name), left: (csv[name] ?? []).some(x => typeof x === "string") });
  const cell = (name, run, k) => (k === 0 && report_of(run[0]) ? element("a", { href: `${encodeURIComponent(report_of(run[0]))}/report.html` }, csv_cell(name, run[0])) : csv_cell(name, run[0]));
  return table([...before.map(title), ...own.flatMap(name => methods.map(method => ({ title: [spaced(name), " ", element("span", { class: "unit" }, spaced(method ?? "first method"))] }))), ...behind.map(title), ...note_title()],
    runs.map(run => [...before.map((name, k) => cell(name, run, k)), ...own.flatMap(name => methods.map(method => (row_of(run, method) === undefined ? "–" : csv_cell(name, row_of(run, method))))), ...behind.map(name => csv_cell(name, run[0])), ...note_title().map(() => notes_of(run))]), { class: "methods", "data-table": data.kind });
}

/** The report of the run that a row is of. */
function report_of(i) {
  const name = axes.map(axis => cell_of(axis, i)).join("_");
  return (data.runs ?? []).includes(name) ? name : null;
}

const link_to = name => element("a", { href: `${encodeURIComponent(name)}/report.html` }, name);
const links = names => (names.length ? section("Reports of the runs", element("p", { class: "links" }, names.map((name, i) => [i ? ", " : "", link_to(name)]))) : null);

function study_header() {
  const count = length_of(csv), runs = grouped([...Array(count).keys()], i => axes.map(axis => cell_of(axis, i)).join("\n"));
  const took = column => [...runs.values()].reduce((sum, rows) => sum + (cell_of(column, rows[0]) ?? 0), 0), messages = (csv.message ?? []).filter(Boolean);
  return [element("header", {}, element("h1", {}, data.title), facts([
    ["Study", `${runs.size} runs, ${seconds(took("seconds"))} in total${csv.processor_seconds ? `, ${seconds(took("processor_seconds"))} of processors` : ""}`],
    ["Axes", axes.map(axis => `${axis}: ${[...new Set(csv[axis])].slice(0, 8).map(x => (typeof x === "number" ? shown(x, 4) : x)).join(", ")}${new Set(csv[axis]).size > 8 ? ", ..." : ""}`).join("; ")],
    ["Quantities", listed(quantities().map(one => one.name).slice(0, 12))],
    ["Largest error", csv.error ? percent(largest(csv.error)) : null],
  ])), messages.length ? element("section", { class: "warnings" }, element("h2", {}, `${messages.length} messages`), element("ul", {}, [...new Set(messages)].slice(0, 8).map(text => element("li", {}, text)))) : null];
}

function extremes_sections() {
  const count = length_of(csv), rows = [...Array(count).keys()], missed = rows.filter(i => cell_of("holds", i) !== "yes");
  const columns = ["row", "oracle", "computed", "expected", "deviation", "allowed", "holds", "seconds", "message"].filter(name => csv[name]);
  const kind = i => (cell_of("holds", i) === "yes" ? null : "missed");
  return [element("header", {}, element("h1", {}, data.title), facts([
    ["Outcome", element("b", { class: missed.length ? "failed" : "done" }, `${count - missed.length} of ${count} oracles hold`)],
    ["Cases", `${new Set(csv.row).size} in ${new Set(csv.group).size} ${new Set(csv.group).size === 1 ? "group" : "groups"}`],
  ])), missed.length ? element("section", { class: "warnings" }, element("h2", {}, "Missed"), csv_table(columns, missed)) : null,
  ...[...grouped(rows, i => cell_of("group", i))].map(([group, indices]) => section(capital(String(group)), csv_table(columns, indices.map(k => rows[k]), kind))), links(data.runs ?? [])];
}

/** Plots of panels of curves; references are dashed. On a logarithmic axis what is not positive is left out. */
function panel_plots() {
  const drawn = (panel, one) => one.x.map((_, i) => i).filter(i => (!panel.log_x || one.x[i] > 0) && (!panel.log_y || one.y[i] > 0));
  return data.panels.map(panel => plot({ title: capital(panel.y.replace(/ \[.*\]$/, "")), x: { label: panel.x, log: panel.log_x }, y: { label: panel.y, log: panel.log_y },
    lines: panel.series.map((one, i) => ({ ...one, x: drawn(panel, one).map(k => one.x[k]), y: drawn(panel, one).map(k => one.y[k]), label: one.label || "computed", dash: one.reference ? [7, 5] : [], number: one.reference ? [6, 7, 4][i % 3] : i })).filter(line => line.x.length > 0) }));
}

/** The numbers of a paper by figure, table or example, which an item names before its first comma: an overview, then their rows. */
function papers_groups(rows, rows_table) {
  const groups = [...grouped(rows, i => String(cell_of("item", i)).split(",")[0])].map(([name, indices]) => [name, indices.map(k => rows[k])]);
  if (groups.length === 1) return rows_table(rows);
  const count = (some, name) => some.filter(i => cell_of(name, i) !== null).length, sizes = some => some.map(i => cell_of("difference", i)).filter(x => typeof x === "number").map(Math.abs);
  const cells = ([name, some]) => [name, String(some.length), String(count(some, "published")), count(some, "claim") ? `${some.filter(i => cell_of("claim_holds", i) === "yes").length} of ${count(some, "claim")}` : "",
    sizes(some).length ? shown(Math.max(...sizes(some)), 2) : "", csv.s ? shown(Math.max(...some.map(i => cell_of("s", i) ?? 0)), 2) : ""];
  return [table([{ title: "example", left: true }, { title: "numbers" }, { title: "published" }, { title: "claims that hold" }, { title: "largest difference" }, { title: "longest, s" }], groups.map(cells)),
    groups.map(([name, some]) => folded(`${name}: ${some.length} ${some.length === 1 ? "number" : "numbers"}`, rows_table(some)))];
}

/** Numbers of papers beside ours and those of other means. */
function papers_sections() {
  const rows = [...Array(length_of(csv)).keys()], seconds_of = csv.processor_seconds;
  csv.difference = csv.difference.map(x => (typeof x === "number" ? Number(x.toPrecision(2)) : x));
  csv.paper_says = rows.map(i => (cell_of("claim", i) === null ? null : `${cell_of("claim", i)}: ${cell_of("claim_holds", i) === "yes" ? "holds" : "does not hold"}`));
  csv.s = seconds_of?.map(x => (typeof x === "number" ? Number(x.toPrecision(2)) : x));
  const columns_of = some => ["item", "quantity", "published", "ours", "reference", "difference", "reference_is", "paper_says", "s"].filter(name => csv[name] && some.some(i => cell_of(name, i) !== null));
  const kind = i => (cell_of("claim_holds", i) === "no" ? "missed" : null), claims = rows.filter(i => cell_of("claim_holds", i) !== null);
  return [element("header", {}, element("h1", {}, data.title), facts([
    ["Numbers", `${rows.length}`],
    ["Claims of the papers", claims.length ? `${claims.filter(i => cell_of("claim_holds", i) === "yes").length} of ${claims.length} hold` : null],
  ])), ...[...grouped(rows, i => cell_of("paper", i))].map(([paper, indices]) => section(paper, papers_groups(indices.map(k => rows[k]), some => csv_table(columns_of(some), some, kind)))),
  note("Difference: ours less the reference over the reference, or ours where that is 0. s: seconds of a processor, of the whole example."),
  data.panels.length ? section("Curves", plots(panel_plots()), screen_note("Drag over a plot to zoom, double click to go back.")) : null, links(data.runs ?? [])];
}

/** A run against reference curves. */
function comparison_sections() {
  const panels = panel_plots();
  return [element("header", {}, element("h1", {}, data.title)), section("Against reference curves", element("pre", { class: "wide" }, data.table), plots(panels),
    screen_note("Drag over a plot to zoom, double click to go back; the values under the pointer stand below it."))];
}

function study_sections() {
  if (data.kind === "comparison") return comparison_sections();
  if (data.kind === "papers") return papers_sections();
  if (data.kind === "extremes") return extremes_sections();
  const rows = [...Array(length_of(csv)).keys()], wanted = ["quantity", "place", "srif_method", "computed", "reference", "error", "estimated_error", "points", "iterations", "seconds", "processor_seconds"];
  const columns = [...axes, ...wanted.filter(name => csv[name] && (differs(name) || name === "error" || name === "computed"))];
  const errors = plots([...error_plots("seconds", { short: "run time", words: "run time [s]" }), ...error_plots("points", { short: "points", words: "points of the plate" })], "grid small");
  const values = plots(axes.flatMap(value_plots), "grid small"), reported = new Set(rows.map(report_of));
  const runs_table = differs("srif_method") ? table_of_methods(columns, rows) : csv_table(columns, rows), told = notes(), count = runs_table.querySelectorAll("tbody tr").length;
  return [...study_header(), methods_section(), errors ? section("Errors", errors, screen_note("Drag over a plot to zoom, double click to go back.")) : null,
    values ? section("Values along the axes", values) : null,
    section("All runs", count > 60 ? folded(`${count} rows`, runs_table) : runs_table,
      told.length ? element("ol", { class: "notes" }, told.map(text => element("li", {}, text))) : null), links((data.runs ?? []).filter(name => !reported.has(name)))];
}
