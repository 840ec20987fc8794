"use strict";
// Curves of a run: factors and energies in time or along a growth, probes, the path to a stated accuracy.

const tables = data.tables ?? {};
const grows = Boolean(data.summary?.growth), moves = data.summary?.analysis?.kind === "dynamic";
const steps = moves ? { label: "time", quantity: "time" } : { label: "advance" };

const largest = values => (values ?? []).reduce((most, x) => (Number.isFinite(x) ? Math.max(most, Math.abs(x)) : most), 0);

/** One of K1 to K3 of all tips; what is below `least` is the noise of a symmetric plate. */
function factor_plot(name, least) {
  const srif = tables.srif;
  if (!srif?.[name]) return null;
  const lines = [...grouped(srif.tip, tip => tip)].map(([tip, rows]) => ({
    label: `tip ${tip}`, number: tip, x: rows.map(i => srif.time[i]), y: rows.map(i => srif[name][i]),
  }));
  const felt = lines.filter(line => largest(line.y) > least && line.x.length > 1);
  const most = 3, peaks = data.summary.peaks ?? [];
  for (const line of felt.length <= most ? [...felt] : []) {
    const peak = peaks.find(one => one.quantity === name && one.tip === line.number);
    if (peak) felt.push({ label: `largest: ${shown(peak.value, 5)} at ${shown(peak.time, 4)}`, rings: true, number: line.number, x: [peak.time], y: [peak.value] });
  }
  return plot({ title: `${name} ${moves ? "in time" : "along the growth"}`, x: steps, y: { label: name, quantity: name }, lines: felt });
}

function history_plot(title, y, columns, x = null) {
  const from = x ? x.table : tables.history;
  const along = x ? from?.[x.column] : from?.time;
  if (!along || along.length < 2) return null;
  const lines = columns.filter(([name]) => largest(from[name]) > 0).map(([name, label]) => ({ label, x: along, y: from[name] }));
  return lines.length === 0 ? null : plot({ title, x: x ?? steps, y, lines });
}

function probe_plots() {
  const probes = tables.probes;
  if (!probes || !moves) return [];
  const lines = [...grouped(probes.probe, name => name)].map(([name, rows]) => ({
    label: String(name), x: rows.map(i => probes.time[i]), y: rows.map(i => probes.w[i]),
  }));
  if (lines[0].x.length < 2) return [];
  for (const line of lines) if (line.x.every((x, i) => x === lines[0].x[i])) line.x = lines[0].x;
  return [plot({ title: "Deflection of the probes", x: steps, y: { label: "w", quantity: "w" }, lines })];
}

/** Amplitudes of a harmonic response over its frequency. */
function response_plots() {
  const response = tables.response;
  if (!response?.amplitude) return [];
  const rows = response.frequency.map((_, i) => i), h = data.plate.section.thickness;
  const most = name => largest(rows.filter(i => response.quantity[i] === name).map(i => response.amplitude[i]));
  const least = { K1: 1e-3 * Math.max(most("K1"), most("K2"), h * most("K3")), w: 0, force: 0 };
  least.K2 = least.K1, least.K3 = least.K1 / h;
  const titles = { w: "Deflection of the probes", force: "Forces of the supports" };
  return ["w", "force", "K1", "K2", "K3"].map(name => {
    const own = rows.filter(i => response.quantity[i] === name && Number.isFinite(response.amplitude[i]));
    const lines = [...grouped(own.map(i => response.place[i]), place => place)].map(([place, which]) => ({
      label: String(place), x: which.map(n => response.frequency[own[n]]), y: which.map(n => response.amplitude[own[n]]),
    })).filter(line => line.x.length > 1 && largest(line.y) > least[name]);
    return lines.length === 0 ? null : plot({ title: `${titles[name] ?? name}: amplitude`, x: { label: "frequency", quantity: "frequency" }, y: { label: name, quantity: name, log: true }, lines });
  });
}

function growth_plots() {
  const growth = tables.growth;
  if (!growth?.crack_length || growth.crack_length.length < 2) return [];
  const length = { label: "length of the cracks", quantity: "length", table: growth, column: "crack_length" };
  if (moves) return [history_plot("Length of the cracks", { label: "length", quantity: "length" }, [["crack_length", "all cracks"]], { ...steps, table: growth, column: "time" })];
  return [
    history_plot("Load against length", { label: "load factor" }, [["load_factor", "load factor"], ["critical_load_factor", "of the next advance"]], length),
    history_plot("Energies against length", { label: "energy", quantity: "energy" },
      [["external_work", "work of the loads"], ["strain_energy", "strain"], ["fracture_energy", "fracture"], ["released_energy", "released"]], length),
    history_plot("Load against displacement", { label: "load factor" }, [["load_factor", "load factor"]], { label: "displacement of the loads", table: growth, column: "displacement" }),
  ].filter(one => one);
}

function reaction_plot() {
  const reactions = tables.reactions;
  if (!reactions?.support) return null;
  const lines = [...grouped(reactions.support, name => name)].filter(([name]) => name !== "loads" && name !== "inertia").map(([name, rows]) => ({
    label: String(name), x: rows.map(i => reactions.time[i]), y: rows.map(i => reactions.force[i]),
  }));
  if (lines.length === 0 || lines[0].x.length < 2) return null;
  return plot({ title: "Reactions of the supports", x: steps, y: { label: "force", quantity: "force" }, lines: lines.slice(0, 8) });
}

/** How far a point is from a crack, and how far along the crack. */
function place_on(crack, x, y) {
  let best = { away: Infinity, along: 0 }, before = 0;
  for (let i = 0; i + 1 < crack.length; i++) {
    const [[x0, y0], [x1, y1]] = [crack[i], crack[i + 1]], length = Math.hypot(x1 - x0, y1 - y0);
    const share = Math.min(1, Math.max(0, ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / length ** 2));
    const away = Math.hypot(x - x0 - share * (x1 - x0), y - y0 - share * (y1 - y0));
    if (away < best.away) best = { away, along: before + share * length };
    before += length;
  }
  return best;
}

/** Openings and pressures along each crack whose faces may touch, of each load case where there are several. */
function contact_plots() {
  const contact = tables.contact, { cracks } = data.plate, most = 12;
  if (!contact?.x || cracks.length === 0) return [];
  const places = contact.x.map((x, i) => {
    const found = cracks.map(crack => place_on(crack, x, contact.y[i]));
    const crack = found.reduce((best, one, n) => (one.away < found[best].away ? n : best), 0);
    return { crack, along: found[crack].along, name: `crack ${crack}${contact.case ? `, ${contact.case[i]}` : ""}` };
  });
  return [...grouped(places, place => place.name)].flatMap(([name, rows]) => {
    const order = [...rows].sort((a, b) => places[a].along - places[b].along), x = order.map(i => places[i].along);
    const of = (title, what, quantity) => plot({
      title: `${title} of ${name}`, x: { label: "along the crack", quantity: "length" }, y: { label: what, quantity },
      lines: [["top", "z = h/2"], ["bottom", "z = −h/2"]].map(([side, label]) => ({ label, x, y: order.map(i => contact[`${what}_${side}`]?.[i] ?? 0) })),
    });
    return [of("Opening", "opening", "length"), of("Contact pressure", "pressure", "shear")];
  }).slice(0, most);
}

function curves() {
  if (data.summary.load_cases) return []; // numbers of cases are no time
  const h = data.plate.section.thickness, most = Math.max(largest(tables.srif?.K1), largest(tables.srif?.K2), h * largest(tables.srif?.K3));
  const noise = { K1: 1e-3 * most, K2: 1e-3 * most, K3: (1e-3 * most) / h }; // less is no more than that of a symmetric plate
  const drawn_plots = [
    ...response_plots(), ...growth_plots(),
    ...["K1", "K2", "K3"].map(name => factor_plot(name, noise[name])),
    moves ? history_plot("Largest deflection", { label: "largest |w|", quantity: "w" }, [["max_abs_w", "largest |w|"]]) : null,
    ...probe_plots(), reaction_plot(),
    moves ? history_plot("Energies", { label: "energy", quantity: "energy" },
      [["external_work", "work of the loads"], ["strain_energy", "strain"], ["kinetic_energy", "kinetic"], ["dissipated_energy", "taken by damping"], ["fracture_energy", "fracture"]]) : null,
    moves ? history_plot("Balance of the energies", { label: "energy", quantity: "energy" }, [["energy_residual", "not accounted for"]]) : null,
  ];
  return drawn_plots;
}

/** The discretisations of a stated accuracy. */
function accuracy_section() {
  const accuracy = data.summary.accuracy;
  if (!accuracy) return null;
  const rows = accuracy.path.map((step, i) => [value(`accuracy.path[${i}].points`, 6, whole(step.points)), value(`accuracy.path[${i}].spacing`, 4),
    value(`accuracy.path[${i}].tip_spacing`, 4), seconds(step.seconds), percent(step.estimated_error)]);
  const known = accuracy.path.filter(step => step.estimated_error > 0);
  return section("Convergence to the stated accuracy",
    element("p", {}, `Asked for ${percent(accuracy.asked)}: ${accuracy.outcome}`, accuracy.reached !== undefined ? `, estimated error ${percent(accuracy.reached)}.` : "."),
    known.length > 1 ? plots([plot({
      title: "Estimated error against points", x: { label: "points", log: true }, y: { label: "estimated error [%]", log: true },
      lines: [{ label: "estimated", points: true, x: known.map(step => step.points), y: known.map(step => 100 * step.estimated_error) },
        { label: "asked for", dash: [6, 4], x: known.map(step => step.points), y: known.map(() => 100 * accuracy.asked) }],
    })]) : null,
    table([{ title: "points" }, { title: "spacing", unit: unit("length") }, { title: "at tips", unit: unit("length") }, { title: "time" }, { title: "estimated error" }], rows));
}
