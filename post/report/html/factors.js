"use strict";
// Intensity factors: a recommended row per tip with its errors, the other methods folded away as comparison; peaks in time.

const factor_names = ["K1", "K2", "K3"];
const thickness = data.plate?.section.thickness ?? 1;

/** As the program prints them: what is nothing beside the largest factor of its tip is zero. */
function factor_words(one, name) {
  const size = Math.abs(one[name] ?? NaN), most = largest(factor_names.map(key => one[key])), error = one[`estimated_error_${name}`] ?? Infinity;
  if (one[name] === null || one[name] === undefined) return "not resolved";
  return size < 1e-8 * most || (size < 1e-6 * most && size <= error) ? "0" : measured(one[name], error);
}

/** The largest error of the factors that are resolved, relative to the largest of them. */
function error_of(one) {
  const scaled = (name, x) => Math.abs(x) * (name === "K3" ? thickness : 1);
  const there = factor_names.filter(name => typeof one[name] === "number");
  const known = there.filter(name => typeof one[`estimated_error_${name}`] === "number");
  const most = largest(there.map(name => scaled(name, one[name])));
  if (known.length === 0 || most === 0) return one.estimated_error;
  return largest(known.map(name => scaled(name, one[`estimated_error_${name}`]))) / most;
}

function factor_cell(one, path, name) {
  const error = one[`estimated_error_${name}`], words = factor_words(one, name);
  const known = typeof error === "number" && words !== "not resolved" && words !== "0";
  if (!known) return value(`${path}.${name}`, 6, words);
  return element("span", { class: error > Math.abs(one[name]) ? "within" : null }, with_error(`${path}.${name}`, error));
}

function error_cell(one) {
  const error = error_of(one);
  return error === undefined || error === null ? "–" : element("span", { class: error >= 0.1 ? "rough" : null }, percent(error), error >= 0.1 ? " (rough)" : "");
}

function factor_table(indices, wanted) {
  const all = data.summary.srif, normalized = factor_names.map((_, i) => `F${i + 1}`).filter(name => indices.some(i => typeof all[i][name] === "number"));
  const columns = [{ title: "tip" }, { title: "x", unit: unit("length"), minor: true }, { title: "y", unit: unit("length"), minor: true }, ...factor_names.map(name => ({ title: name, unit: unit(name) })),
    ...normalized.map(title => ({ title, minor: true })), { title: "error" }, { title: "method", left: true, minor: true }];
  const rows = indices.map(i => {
    const one = all[i], path = `srif[${i}]`;
    return [value(`${path}.tip`), value(`${path}.x`, 4), value(`${path}.y`, 4), ...factor_names.map(name => factor_cell(one, path, name)),
      ...normalized.map(name => (factor_words(one, name.replace("F", "K")) === "0" ? "0" : value(`${path}.${name}`, 5))), error_cell(one), spaced(one.method)];
  });
  return table(columns, rows, { class: wanted, "data-table": wanted });
}

const in_plane_names = ["N1", "N2"];

/** A factor of loads in the plane with its error. */
function in_plane_cell(one, path, name, factor) {
  const size = largest(in_plane_names.map(key => one[key]));
  if (one[name] === null || one[name] === undefined) return "not resolved";
  return Math.abs(one[name]) < 1e-8 * size ? value(`${path}.${name}`, 6, "0") : with_error(`${path}.${name}`, one[`estimated_error_${name}`], factor);
}

/** The factors of loads in the plane. */
function in_plane_table(indices) {
  const all = data.summary.srif, there = indices.filter(i => all[i].N1 !== undefined);
  if (there.length === 0) return [];
  const { factor, name: of_unit } = prefixed("N1", there.flatMap(i => in_plane_names.map(name => all[i][name])));
  return [element("h3", {}, "In the plane"), table([{ title: "tip" }, ...in_plane_names.map(title => ({ title, unit: of_unit }))],
    there.map(i => [value(`srif[${i}].tip`), ...in_plane_names.map(name => in_plane_cell(all[i], `srif[${i}]`, name, factor))]), { "data-table": "in_plane" }),
    note("N1 = lim √(2r) N", element("sub", {}, "y′y′"), ", N2 = lim √(2r) N", element("sub", {}, "x′y′"), " of the membrane forces, without a factor π.")];
}

/** What the factors are at the faces of the plate, and how much of the toughness that takes. */
function faces_table(indices) {
  const all = data.summary.srif, there = indices.filter(i => all[i].faces);
  if (there.length === 0) return [];
  const used = there.some(i => typeof all[i].faces.utilisation === "number");
  const both = there.some(i => all[i].faces.KI_top !== undefined), shown_names = both ? ["KI_top", "KI_bottom", "KII_top", "KII_bottom", "KIII", "K_eq"] : ["K_I", "K_II", "K_III", "K_eq"];
  const { factor, name: face } = prefixed("face", there.flatMap(i => shown_names.map(name => all[i].faces[name])));
  const title_of = name => ["K", element("sub", {}, name.replace("K_", "").replace(/^K/, "").split("_")[0]), name.endsWith("top") ? ", z > 0" : name.endsWith("bottom") ? ", z < 0" : ""];
  const columns = [{ title: "tip" }, ...shown_names.map(name => ({ title: title_of(name), unit: face })), { title: "at" }, ...(used ? [{ title: "utilisation" }] : [])];
  const rows = there.map(i => {
    const { faces } = all[i], path = `srif[${i}].faces`, size = largest(shown_names.map(name => faces[name]));
    const none = name => faces[name] === null || faces[name] === undefined;
    const known = faces.estimated_error_K_eq / factor; // none of the others is known better
    const cell = name => (none(name) ? "not resolved" : Math.abs(faces[name]) < 1e-6 * size ? "0" : value(`${path}.${name}`, 4, measured(faces[name] / factor, known, 4), factor, faces.estimated_error_K_eq));
    return [value(`srif[${i}].tip`), ...shown_names.slice(0, -1).map(cell), none("K_eq") ? "not resolved" : with_error(`${path}.K_eq`, faces.estimated_error_K_eq, factor, 4), height_of(faces.K_eq_height),
      ...(used ? [utilisation_cell(path, faces)] : [])];
  });
  const { toughness } = data.summary;
  return [element("h3", {}, "Stress intensity at the faces"), table(columns, rows, { "data-table": "faces" }),
    note(both ? "III in the middle plane. eq:" : "I and II at the face z > 0, with the other sign at z < 0; III in the middle plane. eq:", " of mode 1, with the same energy at the height where that is most.",
      toughness ? [" Utilisation: this over the toughness ", value("toughness", 4, null, factor), face ? ` ${face}` : "", "."] : "")];
}

/** Where the equivalent factor acts: a face, the middle plane, or z over the thickness h. */
function height_of(share) {
  if (typeof share !== "number") return "–";
  if (share === 0) return "middle";
  return Math.abs(share) === 0.5 ? (share > 0 ? "z > 0" : "z < 0") : `z = ${share.toFixed(2)} h`;
}

/** The share of the toughness that is taken; red from 1 on. */
function utilisation_cell(path, faces) {
  if (typeof faces?.utilisation !== "number") return "–";
  return element("span", { class: faces.utilisation >= 1 ? "rough" : null }, with_error(`${path}.utilisation`, faces.estimated_error_utilisation, 1, 4));
}

function second_formulations(indices) {
  return indices.filter(i => data.summary.srif[i].second_formulation).map(i => {
    const one = data.summary.srif[i], second = one.second_formulation, path = `srif[${i}].second_formulation`;
    return element("li", {}, `Tip ${one.tip}, ${second.formulation} by ${spaced(second.method)}: `, factor_names.map(name => [`${name} `, value(`${path}.${name}`, 6), ", "]),
      `${percent(second.difference)} apart`,
      "difference_in_plane" in second ? ["; ", ["N1", "N2"].map(name => [`${name} `, value(`${path}.${name}`, 6), ", "]), `${percent(second.difference_in_plane)} apart`] : "");
  });
}

function factors_section() {
  const all = data.summary.srif ?? [];
  if (all.length === 0) return null;
  const groups = [...grouped(all, one => one.tip).values()], first = groups.map(rows => rows[0]), others = groups.flatMap(rows => rows.slice(1));
  const second = second_formulations(first);
  return section(moves ? "Intensity factors at the end" : "Intensity factors", factor_table(first, "recommended"),
    note("The method that is recommended for each tip. ± is the estimated error of each factor in its unit; the column error is the largest of them, relative to the largest factor of the tip."),
    second.length ? element("ul", {}, second) : null, in_plane_table(first), faces_table(first),
    others.length ? folded("For comparison: other methods", factor_table(others, "comparison"),
      note("By other ways from the same solution. They are here to judge by, not to be used in the place of the recommended ones.")) : null,
    folded("What K1, K2 and K3 are", note("K1 = lim √(2r) M", element("sub", {}, "y′y′"), ", K2 = lim √(2r) M", element("sub", {}, "x′y′"), ", K3 = lim √(2r) Q", element("sub", {}, "y′"),
      " straight ahead of the tip, x′ along the crack out of the material it has cut, without a factor π. K1 > 0 opens the face z > 0, and the faces overlap at z < 0 unless contact is asked for.")));
}

/** Where K, w and stresses are largest: over a motion, or at the end of statics. */
function largest_section(list, title) {
  const all = data.summary[list];
  if (!Array.isArray(all) || all.length === 0) return null;
  const size = one => Math.abs(one.value) * (one.quantity === "K3" ? thickness : 1), is_factor = one => /^K[123]$/.test(one.quantity);
  const noise = one => is_factor(one) && all.some(other => is_factor(other) && other.tip === one.tip && size(one) < 1e-5 * size(other));
  const timed = all.some(one => one.time !== undefined);
  const place = (one, i) => (one.tip !== undefined ? `tip ${one.tip}` : one.x === undefined ? "anywhere" : ["(", value(`${list}[${i}].x`, 4, rounded(one.x)), ", ", value(`${list}[${i}].y`, 4, rounded(one.y)), ")"]);
  const rounded = x => (Math.abs(x) < 1e-9 * extent() ? "0" : null);
  const words = one => (one.outside === undefined ? "" : ` no nearer than ${shown(one.outside, 2)} to tips, sharp corners, pins and point forces`);
  const columns = [{ title: "quantity", left: true }, { title: "largest" }, { title: "", left: true }, ...(timed ? [{ title: "at time", unit: unit("time") }] : []), { title: "where", left: true }];
  const rows = all.map((one, i) => {
    const { factor, name } = prefixed(one.quantity, [one.value]);
    return noise(one) ? null : [names[one.quantity] ?? spaced(one.quantity), with_error(`${list}[${i}].value`, one.estimated_error, factor, 5), name,
      ...(timed ? [value(`${list}[${i}].time`, 5)] : []), [place(one, i), words(one)]];
  });
  return section(title, table(columns, [...rows.filter(Boolean), ...(list === "extremes" ? stress_near_rows() : [])], { "data-table": list }));
}

/** Rows of the stress at a distance from places where it has no limit. */
function stress_near_rows() {
  return (data.summary.stress_near ?? []).map((one, i) => {
    const { factor, name } = prefixed("von_mises", [one.von_mises]), at = `stress_near[${i}]`;
    return [names.von_mises, with_error(`${at}.von_mises`, one.estimated_error, factor, 5), name, ["(", value(`${at}.at_x`, 4), ", ", value(`${at}.at_y`, 4), `), ${shown(one.distance, 3)} from ${one.place} (${shown(one.x, 4)}, ${shown(one.y, 4)})`]];
  });
}

/** What `of` gives of all load cases and combinations, those first that take most of the toughness. */
function of_cases(all, of) {
  const share = one => Math.max(0, ...(one.srif ?? []).map(srif => srif.faces?.utilisation ?? 0));
  return all.map((one, n) => ({ one, n })).sort((a, b) => share(b.one) - share(a.one)).flatMap(({ one, n }) => of(one, n));
}

/** Tables of a row for each load case: so many columns as fit side by side in each. */
function tables_of_cases(all, columns, cell, name) {
  const most = 6, result = [];
  for (let begin = 0; begin < columns.length; begin += most) {
    const some = columns.slice(begin, begin + most);
    result.push(table([{ title: "case", left: true }, ...some.map(title => ({ title }))], of_cases(all, (one, n) => [[one.name, ...some.map((_, k) => cell(n, begin + k))]]), { "data-table": name }));
  }
  return result;
}

/** What every support carries in every load case and combination: a column for each support. */
function reactions_of_cases(all) {
  const supports = all.find(one => one.reactions?.supports)?.reactions.supports ?? [];
  if (supports.length === 0) return null;
  const { factor, name } = prefixed("force", all.flatMap(one => [one.reactions?.loads?.force, ...(one.reactions?.supports ?? []).map(support => support.force)]));
  const size = 1e-5 * largest(all.flatMap(one => (one.reactions?.supports ?? []).map(support => support.force)));
  const force = (path, error) => (Math.abs(at(path) ?? 0) <= size ? value(path, 5, "0") : with_error(path, error, factor, 5));
  const same = name => supports.filter(one => one.support === name).length > 1, titles = supports.map((one, i) => one.support + (same(one.support) ? ` ${i}` : ""));
  const cell = (n, i) => (!all[n].reactions ? "–" : force(`load_cases[${n}].reactions.${i === 0 ? "loads" : `supports[${i - 1}]`}.force`, all[n].reactions.supports[i - 1]?.estimated_error));
  const tables = tables_of_cases(all, ["loads", ...titles], cell, "reactions_of_cases");
  return [element("h3", {}, name ? `Forces of the supports along w [${name}]` : "Forces of the supports along w"), tables];
}

/** Moments of hubs and pins about their own centres in every load case and combination, where there are some. */
function moments_of_cases(all) {
  const supports = all.find(one => one.reactions?.supports)?.reactions.supports ?? [], parts = ["moment_x", "moment_y"];
  const own = supports.flatMap((one, i) => (one.x === undefined ? [] : parts.map(part => ({ i, part, title: `${one.support} ${part.replace("moment_", "")}` }))));
  const of = (n, { i, part }) => all[n].reactions?.supports[i][part] ?? 0, moments = all.flatMap((_, n) => own.map(one => of(n, one)));
  const least = 1e-5 * extent() * largest(all.flatMap(one => (one.reactions?.supports ?? []).map(support => support.force)));
  if (!(largest(moments) > least)) return null;
  const { factor, name } = prefixed("moment", moments);
  const cell = (n, k) => { const path = `load_cases[${n}].reactions.supports[${own[k].i}].${own[k].part}`; return Math.abs(of(n, own[k])) <= least ? value(path, 4, "0") : with_error(path, all[n].reactions.supports[own[k].i][`estimated_error_${own[k].part}`], factor, 4); };
  return [element("h3", {}, name ? `Moments of the supports about their own centres [${name}]` : "Moments of the supports about their own centres"), tables_of_cases(all, own.map(one => one.title), cell, "moments_of_cases")];
}

/** What supports do to the plate in its plane, of every load case and combination that has such forces. */
function reactions_in_plane(all) {
  const forces = all.flatMap(one => (one.membrane?.reactions ?? []).flatMap(support => [support.force_x, support.force_y]));
  const { factor, name: of_unit } = prefixed("force", forces), least = 1e-9 * largest(forces);
  const rows = of_cases(all, (one, n) => (one.membrane?.reactions ?? []).map((support, i) => (Math.max(Math.abs(support.force_x), Math.abs(support.force_y)) <= least ? null : [one.name, support.name,
    ...["force_x", "force_y"].map(name => value(`load_cases[${n}].membrane.reactions[${i}].${name}`, 5, Math.abs(support[name]) <= least ? "0" : null, factor))]))).filter(Boolean);
  if (rows.length === 0) return null;
  return [element("h3", {}, "Forces of the supports in the plane"), table([{ title: "case", left: true }, { title: "support", left: true },
    { title: "along x", unit: of_unit }, { title: "along y", unit: of_unit }], rows, { "data-table": "reactions_in_plane" })];
}

/** Deflections of the probes in every load case and combination: how many there are, and a cell of each. */
function probes_of_cases(all) {
  const { probes } = tables, places = [...new Set(probes?.probe ?? [])];
  if (places.length === 0) return { columns: [], cells: () => [], blocks: null };
  const { factor, name: of_unit } = prefixed("w", probes.w);
  const row = (n, place) => (all[n].probes ?? []).findIndex(one => one.probe === String(place) && one.quantity === "w");
  const cell = (n, i) => { const k = row(n, places[i]); return k < 0 ? "–" : with_error(`load_cases[${n}].probes[${k}].value`, all[n].probes[k].estimated_error, factor, 4); };
  const few_places = 3;
  if (places.length <= few_places) return { columns: places.map(place => ({ title: `w at ${place}`, unit: of_unit })), cells: n => places.map((_, i) => cell(n, i)), blocks: null };
  return { columns: [], cells: () => [], blocks: [element("h3", {}, of_unit ? `Deflection w of the probes [${of_unit}]` : "Deflection w of the probes"), tables_of_cases(all, places.map(String), cell, "probes_of_cases")] };
}

/** Contact of crack faces in every load case. */
function contact_of_cases(all) {
  if (!all.some(one => one.contact)) return null;
  return [element("h3", {}, "Contact of crack faces"), table([{ title: "case", left: true }, { title: "closed, % of the length" }, { title: "largest pressure", unit: si ? "N/m" : "" }, { title: "least opening", unit: unit("length") }],
    of_cases(all, (one, n) => [[one.name, shown(100 * one.contact.closed_share, 3), value(`load_cases[${n}].contact.largest_pressure`, 4), value(`load_cases[${n}].contact.least_opening`, 4)]]), { "data-table": "contact" }), plots(contact_plots())];
}

/** The largest factors of every tip, and the load case that gives each; how much of the toughness is taken comes first. */
function envelope_table() {
  const { envelope = [], load_cases } = data.summary;
  if (!Array.isArray(load_cases) || load_cases.length === 0) return null;
  const rows = envelope.map((one, i) => {
    const lost = one.estimated_error > Math.abs(one.value), beyond = one.quantity === "utilisation" && one.value >= 1;
    const { factor, name } = prefixed(one.quantity, [one.value]);
    const what = one.quantity === "utilisation" ? "of the toughness" : [one.quantity === "K_eq" ? ["K", element("sub", {}, "eq")] : one.quantity, name && !lost ? element("span", { class: "unit" }, ` ${name}`) : null];
    return [what, ["tip ", value(`envelope[${i}].tip`)],
      lost ? "not resolved in all" : element("span", { class: beyond ? "rough" : null }, with_error(`envelope[${i}].value`, one.estimated_error, factor, one.estimated_error === undefined ? 4 : 6)), lost ? "–" : one.case];
  });
  return table([{ title: "largest", left: true }, { title: "where" }, { title: "of all" }, { title: "in case", left: true }], [...rows, ...largest_of_cases(data.summary.load_cases)], { "data-table": "envelope" });
}

const index_of_peak = (one, name) => (one.extremes ?? []).findIndex(found => found.quantity === name);

/** Rows of the largest deflection, stress and force of a support, with the load case that gives each. */
function largest_of_cases(all) {
  const candidates = (words, quantity, of) => [words, quantity, all.flatMap((one, n) => of(one, n)).filter(one => Number.isFinite(at(one.path)))];
  const peaks = name => (one, n) => (index_of_peak(one, name) < 0 ? [] : [{ n, one: one.extremes[index_of_peak(one, name)], path: `load_cases[${n}].extremes[${index_of_peak(one, name)}].value` }]);
  const forces = (one, n) => (one.reactions?.supports ?? []).map((support, i) => ({ n, one: support, path: `load_cases[${n}].reactions.supports[${i}].force` }));
  const place = one => one.support ?? `(${shown(one.x, 3)}, ${shown(one.y, 3)})`;
  return [candidates("deflection w", "w", peaks("w")), candidates("von Mises stress", "von_mises", peaks("von_mises")), candidates("force of a support", "force", forces)].map(([words, quantity, found]) => {
    const most = found.reduce((best, one) => (!best || Math.abs(at(one.path)) > Math.abs(at(best.path)) ? one : best), null);
    if (!most || !at(most.path)) return null;
    const { factor, name } = prefixed(quantity, [at(most.path)]);
    return [[words, name ? element("span", { class: "unit" }, ` ${name}`) : null], place(most.one), with_error(most.path, most.one.estimated_error, factor, 5), all[most.n].name];
  }).filter(Boolean);
}

/** What governs of all load cases and combinations. */
function governing_section() {
  return envelope_table() ? section("Governing load cases", envelope_table()) : null;
}

/** Factors of every tip in every load case and combination, with how much of the toughness that takes. */
function factors_of_cases(all) {
  const equivalent = all.flatMap(one => one.srif.map(srif => srif.faces?.K_eq)), faces = equivalent.some(x => typeof x === "number");
  const used = all.some(one => one.srif.some(srif => typeof srif.faces?.utilisation === "number")), { factor, name: of_unit } = prefixed("face", equivalent);
  const columns = [{ title: "case", left: true }, { title: "tip" }, ...(used ? [{ title: "of the toughness" }] : []), ...factor_names.map(name => ({ title: name, unit: unit(name) })),
    ...(faces ? [{ title: ["K", element("sub", {}, "eq")], unit: of_unit, minor: true }] : [])];
  const rows = of_cases(all, (one, n) => [...grouped(one.srif, srif => srif.tip).values()].map(([i]) => {
    const srif = one.srif[i], path = `load_cases[${n}].srif[${i}]`, K = srif.faces?.K_eq;
    return [one.name, value(`${path}.tip`), ...(used ? [utilisation_cell(`${path}.faces`, srif.faces)] : []), ...factor_names.map(name => factor_cell(srif, path, name)),
      ...(faces ? [typeof K === "number" ? with_error(`${path}.faces.K_eq`, srif.faces.estimated_error_K_eq, factor, 4) : "not resolved"] : [])];
  }));
  return rows.length ? table(columns, rows, { class: "recommended cases", "data-table": "load_cases" }) : null;
}

/** Factors of loads in the plane in every load case and combination. */
function in_plane_of_cases(all) {
  const values = all.flatMap(one => one.srif.flatMap(srif => in_plane_names.map(name => srif[name]))), { factor, name: of_unit } = prefixed("N1", values);
  const rows = of_cases(all, (one, n) => [...grouped(one.srif, srif => srif.tip).values()].map(([i]) => (one.srif[i].N1 === undefined ? null
    : [one.name, value(`load_cases[${n}].srif[${i}].tip`), ...in_plane_names.map(name => in_plane_cell(one.srif[i], `load_cases[${n}].srif[${i}]`, name, factor))]))).filter(Boolean);
  return rows.length ? [element("h3", {}, "In the plane"), table([{ title: "case", left: true }, { title: "tip" }, ...in_plane_names.map(title => ({ title, unit: of_unit }))], rows, { "data-table": "in_plane" })] : null;
}

/** Load cases and combinations: what governs first, then all of them. */
function load_cases_section() {
  const all = data.summary.load_cases;
  if (!Array.isArray(all) || all.length === 0) return null;
  const peak = index_of_peak, probes = probes_of_cases(all);
  const scale = name => prefixed(name, all.map(one => one.extremes?.[peak(one, name)]?.value)), scales = { w: scale("w"), von_mises: scale("von_mises") };
  const sizes = of_cases(all, (one, n) => [[one.name, one.of ? Object.entries(one.of).map(([name, x], i) => `${i ? " + " : ""}${shown(x, 6)} ${name}`).join("") : "",
    ...["w", "von_mises"].map(name => (peak(one, name) < 0 ? null : with_error(`load_cases[${n}].extremes[${peak(one, name)}].value`, one.extremes[peak(one, name)].estimated_error, scales[name].factor, 5))), ...probes.cells(n)]]);
  return section("Every load case", factors_of_cases(all), in_plane_of_cases(all),
    element("h3", {}, "Deflections and stresses"), table([{ title: "case", left: true }, { title: "is", long: true, minor: true }, { title: "largest w", unit: scales.w.name }, { title: "largest von Mises", unit: scales.von_mises.name }, ...probes.columns], sizes, { "data-table": "extremes_of_cases" }),
    probes.blocks, reactions_of_cases(all), moments_of_cases(all), reactions_in_plane(all), contact_of_cases(all),
    all.some(one => one.superposed === false) ? note(`Combinations are solved under their own loads: states with ${all.some(one => one.contact) ? "contact of crack faces" : "large deflections"} are not superposed.`) : null,
    note("Frames and rows of tables count load cases, then combinations, from 1 in the place of time."));
}
