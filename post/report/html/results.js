"use strict";
// What was run, warnings, energies, frequencies, growth, stages and memory.

function header() {
  const s = data.summary, a = s.analysis, failed = s.outcome !== "done", stopped = !failed && s.growth?.resolved === false;
  const solved = a.iterations !== undefined ? `${whole(a.iterations)} iterations` : a.steps !== undefined ? `${whole(a.steps)} steps` : "";
  return element("header", {}, element("h1", {}, data.title || s.title || "Untitled case"), data.source && data.source !== "none" ? note(data.source) : null,
    facts([
      ["Project", data.project], ["Author", data.author], ["Date", data.date],
      ["Outcome", element("b", { class: failed ? "failed" : stopped ? "rough" : "done" }, failed ? s.outcome : stopped ? s.growth.outcome : s.growth ? `done: ${s.growth.outcome}` : "done")],
      ["Analysis", `${a.kind}, ${spaced(a.method)}${a.preconditioner ? ` with ${spaced(a.preconditioner)}` : ""}${solved ? `, ${solved}` : ""}${s.membrane && a.iterations === 0 ? ": loaded in its plane alone" : a.stop_reason && !failed ? `: ${a.stop_reason}` : ""}`],
      ["Formulation", s.formulation === "galerkin" ? "Galerkin plate" : s.formulation === "ordinary" ? "bonds over a horizon" : s.formulation, ` (${s.formulation_reason})`],
      ["Recipe", s.recipe?.replace(/: .*?(?=; the case has instead|$)/, "")],  // its keys stand in the case, below
      ["Plate", value("points", 6, whole(s.points)), ` points, spacing ${shown(s.spacing, 4)}${unit("length") ? ` ${unit("length")}` : ""}, ${whole(s.bonds)} bonds`],
      ["Time", value("seconds.total", 3, seconds(s.seconds.total)), `, ${bytes(s.peak_memory_bytes)} of memory`],
      ["Units", si ? "SI" : "those of the case, any that are consistent"],
      ["Program", `pdplate ${s.version}, settings ${s.digest}`],
    ]));
}

function warnings_section() {
  const { warnings } = data.summary;
  if (!warnings || warnings.length === 0) return null;
  const items = warnings.map((_, i) => element("li", {}, value(`warnings[${i}]`)));
  const most = 6;
  return element("section", { class: "warnings", id: "warnings" }, element("h2", {}, warnings.length === 1 ? "A warning" : `${warnings.length} warnings`),
    element("ul", {}, items.slice(0, most)), items.length > most ? folded(`${items.length - most} more`, element("ul", {}, items.slice(most))) : null);
}

function plate_section() {
  return section("The plate", element("div", { class: "sides" }, element("figure", { class: "drawing" }, plate_drawing()), plate_words()));
}

const energy_names = {
  strain: "strain energy", bending: "of it in bending", stretching: "of it in the plane", coupling: "of it by their coupling", attached: "of it in foundations, springs and stiffeners", kinetic: "kinetic energy", external_work: "work of the loads", dissipated: "taken by damping and contact", contact: "of it by crack faces that meet", fracture: "fracture energy", released: "released as the crack ran",
  residual: "not accounted for", frozen: "left in pieces without bonds",
};

function energy_section() {
  const { energy } = data.summary, entries = Object.keys(energy ?? {});
  if (entries.length === 0) return null;
  const work = Math.abs(energy.external_work ?? 0);
  return section(moves ? "Energies at the end" : "Energies", table([{ title: "energy", left: true }, { title: "value", unit: unit("energy") }, { title: "of the work" }],
    entries.map(name => [energy_names[name] ?? spaced(name), value(`energy.${name}`), work > 0 ? `${shown((100 * energy[name]) / work, 4)} %` : "–"]), { "data-table": "energy" }));
}

/** Factors of the loads at which a plate buckles. */
function buckling_section() {
  const { buckling } = data.summary;
  if (!buckling) return null;
  return section("Buckling loads", table([{ title: "mode" }, { title: "load factor" }, { title: "error" }, { title: "residual" }],
    buckling.map((one, i) => [value(`buckling[${i}].mode`), value(`buckling[${i}].factor`, 6), one.estimated_error === undefined ? "–" : value(`buckling[${i}].estimated_error`, 2), value(`buckling[${i}].residual`, 3)]), { "data-table": "buckling" }));
}

/** Load factor and deflection along a path that steps of arc length follow. */
function path_plots(steps) {
  if (steps.length < 2 || steps[0].arc_length === undefined) return null;
  const along = steps.map(step => step.arc_length), line = (label, y) => ({ label, x: along, y, points: true });
  return plots([["Load factor", "factor", null], ["Deflection", "deflection", "w"]].map(([title, column, quantity]) => plot({
    title: `${title} along the path`, x: { label: "length of the path" }, y: { label: title.toLowerCase(), quantity }, lines: [line(title.toLowerCase(), steps.map(step => step[column]))] })));
}

/** Equilibria on the way to the full load. */
function load_steps_section() {
  const { load_steps } = data.summary;
  if (!load_steps) return null;
  const at = i => `load_steps[${i}]`, cases = load_steps[0].case !== undefined;
  return section("Steps of the load", path_plots(load_steps), table([...(cases ? [{ title: "case", left: true }] : []), { title: "load factor" }, { title: "largest w", unit: unit("length") }, { title: "iterations" }, { title: "residual" }, { title: "stable" }, { title: "snapped" }],
    load_steps.map((step, i) => [...(cases ? [step.case] : []), value(`${at(i)}.factor`, 5), value(`${at(i)}.largest_deflection`, 6), value(`${at(i)}.iterations`), value(`${at(i)}.residual`, 3), step.stable, step.snapped]), { "data-table": "load_steps" }));
}

/** Faces of cracks that touch. */
function contact_section() {
  const { contact } = data.summary;
  if (!contact) return null;
  return section("Contact of crack faces", facts([
    ["Closed", `${shown(100 * contact.closed_share, 3)} % of the length of the cracks`],
    ["Largest pressure", value("contact.largest_pressure", 4), ` ${si ? "N/m" : ""} along the crack`],
    ["Least opening", value("contact.least_opening", 4), si ? " m" : ""],
  ]), plots(contact_plots()), note("contact.csv has every place on the faces."));
}

function frequencies_section() {
  const { frequencies } = data.summary;
  if (!frequencies) return null;
  const both = frequencies.some(one => "share_in_plane" in one);
  return section("Frequencies", table([{ title: "mode" }, { title: "frequency", unit: unit("frequency") }, { title: "ω", unit: si ? "1/s" : "" }, { title: "residual" }, ...(both ? [{ title: "share in plane" }] : [])],
    frequencies.map((_, i) => [value(`frequencies[${i}].mode`), with_error(`frequencies[${i}].frequency`, frequencies[i].estimated_error, 1, 7), value(`frequencies[${i}].omega`, 7), value(`frequencies[${i}].residual`, 3), ...(both ? [value(`frequencies[${i}].share_in_plane`, 3)] : [])]), { "data-table": "frequencies" }));
}

function growth_section() {
  const { growth } = data.summary;
  if (!growth) return null;
  const of = (name, words, quantity, digits = 5) => (growth[name] === undefined ? null : [words, value(`growth.${name}`, digits), unit(quantity) ? ` ${unit(quantity)}` : ""]);
  const lengths = growth.lengths ?? [], most = 12;
  return section("Growth of the cracks", facts([
    ["How it ended", growth.outcome], of("advances", "Advances"), of("first_load_factor", "Load factor at the first advance"), of("largest_load_factor", "Largest load factor"),
    of("spent", "Energy taken over the fracture energy"), of("largest_speed", "Largest speed", "speed"), of("broken_bonds", "Broken bonds"),
    ["Lengths of the cracks", lengths.slice(0, most).map((_, i) => [i ? ", " : "", value(`growth.lengths[${i}]`, 4)]), lengths.length > most ? `, ... (${lengths.length} in all)` : "", lengths.length && unit("length") ? ` ${unit("length")}` : ""],
  ]));
}

/** What holds the plate, and its balance with the loads. */
function reactions_section() {
  const { reactions } = data.summary;
  if (!reactions?.supports) return null;
  const parts = ["force", "moment_x", "moment_y"], most = reactions.supports.some(one => one.largest_force !== undefined), most_of = name => largest([reactions.loads, ...reactions.supports].map(one => one?.[name])), size = name => 1e-9 * Math.max(most_of(name), name === "force" ? 0 : extent() * most_of("force"));
  const error = { force: "estimated_error", moment_x: "estimated_error_moment_x", moment_y: "estimated_error_moment_y" };
  const cells = (path, one) => parts.map(name => (Math.abs(one[name]) <= size(name) ? "0" : with_error(`${path}.${name}`, one[error[name]])));
  const rows = reactions.supports.map((one, i) => [one.x === undefined ? one.support : `${one.support} at (${shown(one.x, 4)}, ${shown(one.y, 4)})`, ...cells(`reactions.supports[${i}]`, one),
    ...(most ? [value(`reactions.supports[${i}].largest_force`), value(`reactions.supports[${i}].time_of_largest_force`, 5)] : [])]);
  const total = (name, words) => (reactions[name] ? [{ kind: "total", cells: [words, ...cells(`reactions.${name}`, reactions[name]), ...(most ? ["", ""] : [])] }] : []);
  return section("Reactions and balance", table([{ title: "support", left: true }, { title: "force", unit: unit("force") }, { title: "moment x", unit: unit("moment") }, { title: "moment y", unit: unit("moment") },
    ...(most ? [{ title: "largest force", unit: unit("force") }, { title: moves ? "at time" : "at advance", unit: moves ? unit("time") : "" }] : [])],
  [...rows, ...total("sum", "all supports"), ...total("loads", "loads"), ...total("inertia", "mass times acceleration")], { "data-table": "reactions" }),
  note("On the plate, along w; moments about the x and y axes through the origin. What is left of the balance: ", value("reactions.residual", 3), " of the largest part",
    reactions.largest_residual === undefined ? "" : [", at most ", value("reactions.largest_residual", 3), " at any time"], "."));
}

/** Reactions along edges, of the first load case where there are some, and the forces at corners of all. */
function edges_section() {
  const edges = tables.edge_reactions, { load_cases } = data.summary;
  if (!edges?.support) return null;
  const first = edges.support.map((_, i) => i).filter(i => edges.time[i] === edges.time[0]), name = load_cases ? `, ${load_cases[0].name}` : "";
  const own = [...grouped(first, i => edges.support[i])].map(([support, found]) => [support, found.map(k => first[k])]);
  const size = column => largest(first.map(i => edges[column][i])), most = 12;
  const drawn = [["kirchhoff_force", "Force", "V", "shear", size("force_per_length")], ["moment_per_length", "Moment", "Mnn", "Mxx", extent() * size("force_per_length")], ["twist_per_length", "Twist", "Mns", "Mxx", extent() * size("force_per_length")]]
    .filter(([column, , , , beside]) => size(column) > 1e-6 * beside && size(column) > 0)
    .map(([column, title, label, quantity]) => plot({ title: `${title} along the edges${name}`, x: { label: "along the edge", quantity: "length" }, y: { label, quantity },
      lines: own.slice(0, most).map(([support, rows]) => ({ label: String(support), x: rows.map(i => edges.s[i]), y: rows.map(i => edges[column][i]) })) }));
  const runs_of = name => (load_cases ? of_cases(load_cases, (one, n) => [{ name: one.name, path: `load_cases[${n}].reactions.${name}`, all: one.reactions?.[name] ?? [] }])
    : [{ path: `reactions.${name}`, all: data.summary.reactions?.[name] ?? [] }]);
  const case_column = load_cases ? [{ title: "case", left: true }] : [], runs = runs_of("corner_forces");
  const { factor, name: of_unit } = prefixed("force", runs.flatMap(run => run.all.map(one => one.force)));
  const rows = runs.flatMap(run => run.all.map((one, i) => [...(load_cases ? [run.name] : []), one.corner, shown(one.x, 4), shown(one.y, 4), with_error(`${run.path}[${i}].force`, one.estimated_error, factor)]));
  const corners = rows.length === 0 ? null : table([...case_column, { title: "corner", left: true }, { title: "x", unit: unit("length") }, { title: "y", unit: unit("length") }, { title: "force", unit: of_unit }], rows, { "data-table": "corner_forces" });
  const symbols = { kirchhoff_force: ["V", "shear"], moment_per_length: ["Mnn", "Mxx"], twist_per_length: ["Mns", "Mxx"] };
  const peaks = runs_of("edge_reactions").flatMap(run => run.all.flatMap((one, i) => {
    const [symbol, quantity] = symbols[one.quantity];
    return Math.abs(one.value) <= 1e-6 * largest(run.all.map(other => other.value)) ? []
      : [[...(load_cases ? [run.name] : []), one.support, symbol, with_error(`${run.path}[${i}].value`, one.estimated_error), unit(quantity), shown(one.s, 4), shown(one.x, 4), shown(one.y, 4)]];
  }));
  const most_of = peaks.length === 0 ? null : table([...case_column, { title: "edge", left: true }, { title: "", left: true }, { title: "largest" }, { title: "", left: true },
    { title: "s", unit: unit("length") }, { title: "x", unit: unit("length") }, { title: "y", unit: unit("length") }], peaks, { "data-table": "edge_reactions" });
  return section("Reactions along the edges", plots(drawn), most_of, corners,
    note("On the plate, along w, per length; s runs with the plate on the left. The force has the twist as forces (Kirchhoff); what it leaves out next to corners is the force at the corner."));
}

/** Values of a plate at rest at its probes: a column for each. */
function probes_section() {
  const all = data.summary.probes;
  if (!Array.isArray(all) || all.length === 0) return null;
  const places = [...new Set(all.map(one => one.probe))], quantities = [...new Set(all.map(one => one.quantity))], most = 4, blocks = [];
  const index = (probe, quantity) => all.findIndex(one => one.probe === probe && one.quantity === quantity);
  const rows = some => quantities.map(quantity => {
    const { factor, name } = prefixed(quantity, all.filter(one => one.quantity === quantity).map(one => one.value));
    return [names[quantity] ?? spaced(quantity), ...some.map(probe => with_error(`probes[${index(probe, quantity)}].value`, all[index(probe, quantity)].estimated_error, factor, 5)), name];
  });
  for (let begin = 0; begin < places.length; begin += most) {
    const some = places.slice(begin, begin + most);
    blocks.push(table([{ title: "quantity", left: true }, ...some.map(title => ({ title })), { title: "", left: true }], rows(some), { "data-table": "probes" }));
  }
  return section("Values at the probes", blocks);
}

/** Sums along lines and springs on cracks, of every load case where there are some. */
function sums_along() {
  const { load_cases } = data.summary, words = { moment: "Mnn", twist: "Mns", shear: "Qn", normal_force: "Nnn", tangential_force: "Nns", K_front: "largest K" };
  const of = { moment: "moment", twist: "moment", shear: "force", normal_force: "force", tangential_force: "force", K_front: "face" };
  const runs = load_cases ? of_cases(load_cases, (one, n) => [{ name: one.name, path: `load_cases[${n}].lines`, all: one.lines ?? [] }]) : [{ path: "lines", all: data.summary.lines ?? [] }];
  const values = runs.flatMap(run => run.all), quantities = [...new Set(values.map(one => one.quantity))];
  if (values.length === 0) return null;
  const scales = Object.fromEntries(quantities.map(quantity => [quantity, prefixed(of[quantity], values.filter(one => one.quantity === quantity).map(one => one.value))]));
  const cell = (run, line, quantity) => {
    const i = run.all.findIndex(one => one.line === line && one.quantity === quantity);
    return i < 0 ? "–" : with_error(`${run.path}[${i}].value`, run.all[i].estimated_error, scales[quantity].factor, 5);
  };
  const rows = runs.flatMap(run => [...new Set(run.all.map(one => one.line))].map(line => [...(load_cases ? [run.name] : []), line, ...quantities.map(quantity => cell(run, line, quantity))]));
  return [table([...(load_cases ? [{ title: "case", left: true }] : []), { title: "across", left: true }, ...quantities.map(quantity => ({ title: words[quantity], unit: scales[quantity].name }))], rows, { "data-table": "lines" }),
    note("Sums along the way. The normal n points to the right of it along a line, to the left along a crack with springs; s along n turned by +90 degrees.", values.some(one => one.quantity === "K_front") ? " K is that of the front of a crack through a part of the thickness." : "")];
}

/** Values along lines and along cracks with springs: of the first load case where there are some. */
function lines_section() {
  const first = data.summary.load_cases ? `, ${data.summary.load_cases[0].name}` : "";
  const curves = (rows, name, along, of) => {
    const own = rows[name]?.map((_, i) => i).filter(i => rows.time[i] === rows.time[0]) ?? [];
    return [...grouped(own, i => rows[name][i])].flatMap(([line, found]) => of.map(([columns, title, quantity]) => {
      const places = found.map(k => own[k]), x = along(rows, places), order = places.map((_, k) => k).sort((a, b) => x[a] - x[b]);
      const felt = columns.filter(column => largest(places.map(i => rows[column]?.[i])) > 0);
      return felt.length === 0 ? null : plot({ title: `${title} along ${line}${first}`, x: { label: "along it", quantity: "length" }, y: { label: title, quantity },
        lines: felt.map(column => ({ label: column, x: order.map(k => x[k]), y: order.map(k => rows[column][places[k]] ?? 0) })) });
    }));
  };
  const s = (rows, places) => places.map(i => rows.s[i]);
  const on_crack = (rows, places) => places.map(i => data.plate.cracks.map(crack => place_on(crack, rows.x[i], rows.y[i])).reduce((best, one) => (one.away < best.away ? one : best)).along);
  const drawn = [...curves(tables.lines ?? {}, "line", s, [[["w"], "Deflection", "w"], [["Mxx", "Myy", "Mxy"], "Moments", "Mxx"], [["Nxx", "Nyy", "Nxy"], "Membrane forces", "Nxx"]]),
    ...curves(tables.crack_springs ?? {}, "spring", on_crack, [[["moment", "twist"], "Moments", "Mxx"], [["shear"], "Shear force", "shear"], [["normal_force", "tangential_force"], "Membrane forces", "Nxx"], [["K_front"], "K of the front", "face"]])];
  return section("Along lines", sums_along(), plots(drawn));
}

function bars(entries, words) {
  const most = Math.max(...entries.map(([, x]) => x), 1e-300);
  return element("div", { class: "bars" }, entries.map(([name, x, cell]) => element("div", {}, element("span", {}, spaced(name)),
    element("span", { class: "track" }, element("span", { style: `width:${(100 * Math.max(0, x)) / most}%` })), element("span", {}, cell ?? words(x)))));
}

function cost_section() {
  const s = data.summary, stages = Object.entries(s.seconds).filter(([name]) => name !== "total");
  return section("Time and memory", element("p", {}, "In total ", value("seconds.total", 4, seconds(s.seconds.total)), "; ", value("peak_memory_bytes", 4, bytes(s.peak_memory_bytes)), " of memory at most."),
    bars(stages.map(([name, x]) => [name, x, value(`seconds.${name}`, 3, seconds(x))]), seconds),
    s.scene?.length ? element("div", { class: "screen" }, folded("Parts of the program that this case uses", table([{ title: "part", left: true }, { title: "bytes per point" }, { title: "share of the time" }],
      s.scene.map((part, i) => [spaced(part.name), value(`scene[${i}].bytes_per_point`, 4), `${shown(100 * part.time_share, 2)} %`])))) : null);
}

const case_section = () => (data.case ? section("The case", note("As it was run, with all defaults: running it gives the same result."), folded("case.resolved.toml", element("pre", {}, data.case))) : null);

/** What summary.json has that no section above knows. */
const known = new Set(["title", "outcome", "formulation", "formulation_reason", "recipe", "points", "bonds", "fictitious_points", "fictitious_bonds", "spacing", "horizon", "position_aware", "analysis", "seconds",
  "peak_memory_bytes", "srif", "peaks", "accuracy", "frequencies", "buckling", "load_steps", "contact", "growth", "energy", "scene", "warnings", "units", "version", "digest", "toughness", "extremes", "stress_near", "probes", "lines", "estimated_error_energy", "reactions", "overlaps", "load_cases", "envelope"]);

const titles = { sanity: "Validity of the theory", membrane: "In the plane", targets: "Accuracy of results" };

function other_section() {
  const others = Object.entries(data.summary).filter(([name]) => !known.has(name));
  const cell = (path, what) => (typeof what === "number" ? value(path) : typeof what === "object" && what !== null ? nested(path, what) : String(what));
  const nested = (path, what) => {
    const list = Array.isArray(what);
    if (list && what.length > 0 && what.every(one => typeof one === "object" && one !== null)) {
      const columns = [...new Set(what.flatMap(Object.keys))];
      return table(columns.map(title => ({ title: spaced(title) })), what.map((one, i) => columns.map(name => (one[name] === undefined ? "" : cell(`${path}[${i}].${name}`, one[name])))));
    }
    if (list) return what.map((one, i) => [i ? ", " : "", cell(`${path}[${i}]`, one)]);
    return facts(Object.entries(what).map(([name, one]) => [capital(spaced(name)), cell(`${path}.${name}`, one)]));
  };
  return section("Further results", others.map(([name, what]) => [element("h3", {}, titles[name] ?? capital(spaced(name))), element("div", {}, nested_or_text(what, name))]));
  function nested_or_text(what, name) {
    return typeof what === "object" && what !== null ? nested(name, what) : cell(name, what);
  }
}
