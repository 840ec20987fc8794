"use strict";
// Intensity factors: a recommended row per tip with its errors, the other methods folded away as comparison; peaks in time.

const factor_names = ["K1", "K2", "K3"];
const thickness = data.plate?.section.thickness ?? 1;

/** As the program prints them: what is nothing beside the largest factor of its tip is zero. */
function factor_words(one, name) {
  const size = Math.abs(one[name] ?? NaN), most = largest(factor_names.map(key => one[key])), error = one[`estimated_error_${name}`] ?? Infinity;
  if (one[name] === null || one[name] === undefined) return "not resolved";
  return size < 1e-8 * most || (size < 1e-6 * most && size <= error) ? "0" : shown(one[name], 6);
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
  const bar = typeof error === "number" && words !== "not resolved" && words !== "0" ? element("span", { class: "error" }, ` ± ${shown(error, 2)}`) : null;
  return [element("span", { class: bar && error > Math.abs(one[name]) ? "within" : null }, value(`${path}.${name}`, 6, words)), bar];
}

function error_cell(one) {
  const error = error_of(one);
  return error === undefined || error === null ? "–" : element("span", { class: error >= 0.1 ? "rough" : null }, percent(error), error >= 0.1 ? " (rough)" : "");
}

function factor_table(indices, wanted) {
  const all = data.summary.srif, normalized = factor_names.map((_, i) => `F${i + 1}`).filter(name => indices.some(i => typeof all[i][name] === "number"));
  const columns = [{ title: "tip" }, { title: "x", unit: unit("length") }, { title: "y", unit: unit("length") }, ...factor_names.map(name => ({ title: name, unit: unit(name) })),
    ...normalized.map(title => ({ title })), { title: "error" }, { title: "method", left: true }];
  const rows = indices.map(i => {
    const one = all[i], path = `srif[${i}]`;
    return [value(`${path}.tip`), value(`${path}.x`, 4), value(`${path}.y`, 4), ...factor_names.map(name => factor_cell(one, path, name)),
      ...normalized.map(name => (factor_words(one, name.replace("F", "K")) === "0" ? "0" : value(`${path}.${name}`, 5))), error_cell(one), spaced(one.method)];
  });
  return table(columns, rows, { class: wanted, "data-table": wanted });
}

const in_plane_names = ["N1", "N2"];

/** A factor of loads in the plane with its error. */
function in_plane_cell(one, path, name) {
  const error = one[`estimated_error_${name}`], size = largest(in_plane_names.map(key => one[key]));
  if (one[name] === null || one[name] === undefined) return "not resolved";
  return [value(`${path}.${name}`, 6, Math.abs(one[name]) < 1e-8 * size ? "0" : null), typeof error === "number" ? element("span", { class: "error" }, ` ± ${shown(error, 2)}`) : null];
}

/** The factors of loads in the plane. */
function in_plane_table(indices) {
  const all = data.summary.srif, there = indices.filter(i => all[i].N1 !== undefined);
  if (there.length === 0) return [];
  return [element("h3", {}, "In the plane"), table([{ title: "tip" }, ...in_plane_names.map(title => ({ title, unit: unit(title) }))],
    there.map(i => [value(`srif[${i}].tip`), ...in_plane_names.map(name => in_plane_cell(all[i], `srif[${i}]`, name))]), { "data-table": "in_plane" }),
    note("N1 = lim √(2r) N", element("sub", {}, "y′y′"), ", N2 = lim √(2r) N", element("sub", {}, "x′y′"), " of the membrane forces, without a factor π.")];
}

/** What the factors are at the faces of the plate, and how much of the toughness that takes. */
function faces_table(indices) {
  const all = data.summary.srif, there = indices.filter(i => all[i].faces);
  if (there.length === 0) return [];
  const used = there.some(i => typeof all[i].faces.utilisation === "number"), face = unit("face");
  const bar = error => (typeof error === "number" ? element("span", { class: "error" }, ` ± ${shown(error, 2)}`) : null);
  const both = there.some(i => all[i].faces.KI_top !== undefined), shown_names = both ? ["KI_top", "KI_bottom", "KII_top", "KII_bottom", "KIII", "K_eq"] : ["K_I", "K_II", "K_III", "K_eq"];
  const title_of = name => ["K", element("sub", {}, name.replace("K_", "").replace(/^K/, "").split("_")[0]), name.endsWith("top") ? ", z > 0" : name.endsWith("bottom") ? ", z < 0" : ""];
  const columns = [{ title: "tip" }, ...shown_names.map(name => ({ title: title_of(name), unit: face })), ...(used ? [{ title: "utilisation" }] : [])];
  const rows = there.map(i => {
    const { faces } = all[i], path = `srif[${i}].faces`, size = largest(shown_names.map(name => faces[name]));
    const cell = name => (faces[name] === null ? "not resolved" : Math.abs(faces[name]) < 1e-6 * size ? "0" : value(`${path}.${name}`, 5));
    const share = faces.utilisation, beyond = share >= 1 ? "rough" : null;
    return [value(`srif[${i}].tip`), ...shown_names.slice(0, -1).map(cell), [cell("K_eq"), bar(faces.estimated_error_K_eq)],
      ...(used ? [element("span", { class: beyond }, value(`${path}.utilisation`, 4), bar(faces.estimated_error_utilisation))] : [])];
  });
  const { toughness } = data.summary;
  return [element("h3", {}, "Stress intensity at the faces"), table(columns, rows, { "data-table": "faces" }),
    note(both ? "III in the middle plane. eq:" : "I and II at the face z > 0, with the other sign at z < 0; III in the middle plane. eq:", " of mode 1, with the same energy at the height where that is most.",
      toughness ? [" Utilisation: this over the toughness ", value("toughness", 4), face ? ` ${face}` : "", "."] : "")];
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
  const words = one => (one.outside === undefined ? "" : ` no nearer than ${shown(one.outside, 2)} to tips, pins and point forces`);
  const columns = [{ title: "quantity", left: true }, { title: "largest" }, { title: "", left: true }, ...(timed ? [{ title: "at time", unit: unit("time") }] : []), { title: "where", left: true }];
  const rows = all.map((one, i) => (noise(one) ? null : [names[one.quantity] ?? spaced(one.quantity), value(`${list}[${i}].value`), unit(one.quantity),
    ...(timed ? [value(`${list}[${i}].time`, 5)] : []), [place(one, i), words(one)]]));
  return section(title, table(columns, rows.filter(Boolean), { "data-table": list }));
}

/** What supports do to the plate in its plane, of every load case and combination. */
function reactions_in_plane(all) {
  const rows = all.flatMap((one, n) => (one.membrane?.reactions ?? []).map((support, i) => [one.name, support.name,
    ...["force_x", "force_y"].map(name => value(`load_cases[${n}].membrane.reactions[${i}].${name}`, 5))]));
  if (rows.length === 0) return null;
  return [element("h3", {}, "Reactions in the plane"), table([{ title: "case", left: true }, { title: "support", left: true },
    { title: "along x", unit: unit("force") }, { title: "along y", unit: unit("force") }], rows, { "data-table": "reactions_in_plane" })];
}

/** Contact of crack faces in every load case. */
function contact_of_cases(all) {
  if (!all.some(one => one.contact)) return null;
  return [element("h3", {}, "Contact of crack faces"), table([{ title: "case", left: true }, { title: "closed, % of the length" }, { title: "largest pressure", unit: si ? "N/m" : "" }, { title: "least opening", unit: unit("length") }],
    all.map((one, n) => [one.name, shown(100 * one.contact.closed_share, 3), value(`load_cases[${n}].contact.largest_pressure`, 4), value(`load_cases[${n}].contact.least_opening`, 4)]), { "data-table": "contact" })];
}

/** Factors, forces and the largest deflection of every load case and combination, and the envelope of them all. */
function load_cases_section() {
  const all = data.summary.load_cases;
  if (!Array.isArray(all) || all.length === 0) return null;
  const stretched = all.some(one => one.srif.some(srif => srif.N1 !== undefined)), in_plane = stretched ? in_plane_names : [];
  const used = all.some(one => one.srif.some(srif => typeof srif.faces?.utilisation === "number"));
  const columns = [{ title: "case", left: true }, { title: "tip" }, ...factor_names.map(name => ({ title: name, unit: unit(name) })), { title: "error" },
    ...in_plane.map(name => ({ title: name, unit: unit(name) })), ...(used ? [{ title: "utilisation" }] : [])];
  const rows = all.flatMap((one, n) => [...grouped(one.srif, srif => srif.tip).values()].map(([i]) => {
    const srif = one.srif[i], path = `load_cases[${n}].srif[${i}]`, share = srif.faces?.utilisation, error = srif.faces?.estimated_error_utilisation;
    const utilisation = typeof share !== "number" ? "–" : element("span", { class: share >= 1 ? "rough" : null }, value(`${path}.faces.utilisation`, 4),
      typeof error === "number" ? element("span", { class: "error" }, ` ± ${shown(error, 2)}`) : null);
    return [one.name, value(`${path}.tip`), ...factor_names.map(name => factor_cell(srif, path, name)), error_cell(srif),
      ...in_plane.map(name => in_plane_cell(srif, path, name)), ...(used ? [utilisation] : [])];
  }));
  const sizes = all.map((one, n) => [one.of ? [one.name, " = ", Object.entries(one.of).map(([name, x], i) => `${i ? " + " : ""}${shown(x, 6)} ${name}`)] : one.name,
    one.reactions ? value(`load_cases[${n}].reactions.loads.force`, 5) : null, ...["w", "von_mises"].map(name => {
      const at = (one.extremes ?? []).findIndex(peak => peak.quantity === name);
      return at < 0 ? null : value(`load_cases[${n}].extremes[${at}].value`, 5);
    })]);
  const { envelope } = data.summary;
  return section("Load cases", rows.length ? table(columns, rows, { "data-table": "load_cases" }) : null,
    envelope?.length ? [element("h3", {}, "Largest of all"), table([{ title: "tip" }, { title: "" , left: true }, { title: "largest" }, { title: "case", left: true }],
      envelope.map((one, i) => [value(`envelope[${i}].tip`), one.quantity, ...(one.estimated_error > Math.abs(one.value) ? ["not resolved in all", null]
        : [[value(`envelope[${i}].value`), one.estimated_error === undefined ? null : element("span", { class: "error" }, ` ± ${shown(one.estimated_error, 2)}`)], one.case])]), { "data-table": "envelope" })] : null,
    element("h3", {}, "Forces and deflections"), table([{ title: "case", left: true }, { title: "load along w", unit: unit("force") }, { title: "largest w", unit: unit("w") }, { title: "largest von Mises", unit: unit("von_mises") }], sizes),
    reactions_in_plane(all),
    contact_of_cases(all),
    all.some(one => one.superposed === false) ? note(`Combinations are solved under their own loads: states with ${all.some(one => one.contact) ? "contact of crack faces" : "large deflections"} are not superposed.`) : null,
    note("Frames and rows of tables count load cases, then combinations, from 1 in the place of time."));
}
