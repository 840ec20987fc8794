"use strict";
// A drawing of the plate: how it is held and loaded, its holes, cracks and tips with their numbers.

const plate = data.plate;

/** The longer side of the plate. */
const extent = () => (({ low, high }) => Math.max(high[0] - low[0], high[1] - low[1]))(bounds(plate.outline));

function bounds(points) {
  const xs = points.map(p => p[0]), ys = points.map(p => p[1]);
  return { low: [Math.min(...xs), Math.min(...ys)], high: [Math.max(...xs), Math.max(...ys)] };
}

/** From plate to drawing: y up becomes y down. */
function map_of({ low, high }, longest, margin) {
  const size = [high[0] - low[0], high[1] - low[1]], scale = longest / Math.max(...size);
  const map = ([x, y]) => [margin.left + (x - low[0]) * scale, margin.top + (high[1] - y) * scale];
  return { map, scale, width: size[0] * scale + margin.left + margin.right, height: size[1] * scale + margin.top + margin.bottom };
}

/** The vertices of a hole, round ones as many sides. */
function hole_vertices(hole) {
  if (hole.vertices) return hole.vertices;
  return Array.from({ length: 96 }, (_, i) => {
    const angle = (-2 * Math.PI * i) / 96;
    return [hole.centre[0] + hole.radius * Math.cos(angle), hole.centre[1] + hole.radius * Math.sin(angle)];
  });
}

/** Straight pieces with the plate on the left; round holes among them. */
function all_edges() {
  const round = plate.holes.filter(hole => hole.centre).flatMap(hole => {
    const vertices = hole_vertices(hole);
    return vertices.map((from, i) => ({ name: hole.name, from, to: vertices[(i + 1) % vertices.length] }));
  });
  return [...plate.edges, ...round];
}

/** The cracks as they are at the end: those of a growth, else those of the case. */
function cracks_at_end() {
  const table = data.tables?.cracks;
  if (!table?.crack) return plate.cracks;
  return [...grouped(table.crack, crack => crack).values()].map(rows => rows.map(i => [table.x[i], table.y[i]]));
}

/** Where each tip is: its number and place, as summary.json has them. */
function tips() {
  const result = new Map();
  for (const one of data.summary.srif?.length ? data.summary.srif : data.summary.load_cases?.[0]?.srif ?? []) if (!result.has(one.tip)) result.set(one.tip, [one.x, one.y]);
  return result;
}

const path_of = (points, map, closed) => `M${points.map(p => map(p).map(x => x.toFixed(2)).join(",")).join("L")}${closed ? "Z" : ""}`;

/** Steps along the straight pieces of a name: places in the drawing with the direction out of the plate. */
function along(edges, map, step) {
  const places = [];
  let rest = step / 2;
  for (const { from, to } of edges) {
    const a = map(from), b = map(to), length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    if (length === 0) continue;
    const t = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    for (; rest < length; rest += step) places.push({ at: [a[0] + rest * t[0], a[1] + rest * t[1]], out: [-t[1], t[0]], t });
    rest -= length;
  }
  return places;
}

const line = (a, b, kind) => drawn("line", { x1: a[0], y1: a[1], x2: b[0], y2: b[1], class: kind });
const shifted = (p, d, by) => [p[0] + by * d[0], p[1] + by * d[1]];

/** The straight pieces along which a support holds, or a beam or a spring acts. */
const held_by = support => support.along ? support.along.slice(1).map((to, i) => ({ from: support.along[i], to })) : all_edges().filter(edge => support.edges.includes(edge.name));

function support_marks(support, map) {
  if (support.kind === "hub")
    return (support.patch ? [support.patch] : plate.holes.filter(hole => support.edges.includes(hole.name))).map(disc => drawn("path", { d: path_of(hole_vertices(disc), map, true), class: "hub" }));
  if (support.patch) return [drawn("path", { d: path_of(hole_vertices(support.patch), map, true), class: "patch" }), drawn("path", { d: path_of(hole_vertices(support.patch), map, true), class: "mirror" })];
  const edges = held_by(support);
  const kind = support.kind;
  if (kind === "free") return [];
  const base = edges.map(({ from, to }) => line(map(from), map(to), "held"));
  if (kind.startsWith("clamped"))
    return [base, along(edges, map, 7).map(({ at, out, t }) => line(at, shifted(shifted(at, out, 8), t, 5), "hatch"))];
  if (kind === "symmetry")
    return [edges.map(({ from, to }) => line(map(from), map(to), "mirror")), along(edges, map, 40).map(({ at, out }) => line(shifted(at, out, 3), shifted(at, out, 10), "hatch"))];
  const triangles = along(edges, map, 18).map(({ at, out, t }) => {
    const foot = shifted(at, out, 9), points = [at, shifted(foot, t, 4.5), shifted(foot, t, -4.5)];
    return drawn("path", { d: path_of(points, p => p, true), class: "roller" });
  });
  const hard = kind.includes("hard") ? along(edges, map, 18).map(({ at, out, t }) => line(shifted(shifted(at, out, 12), t, -6), shifted(shifted(at, out, 12), t, 6), "hatch")) : [];
  return [base, triangles, hard];
}

/** Where the section has numbers of its own, the plate lies on soil, beams stiffen it and springs hold it. */
function elastic_marks({ map }) {
  const regions = (plate.section.regions ?? []).map(shape => drawn("path", { d: path_of(hole_vertices(shape), map, true), class: "patch" }));
  const beams = plate.stiffeners.map(one => held_by(one).map(({ from, to }) => line(map(from), map(to), "mirror")));
  const soil = plate.foundations.map(one => drawn("path", { d: path_of(one.patch ? hole_vertices(one.patch) : plate.outline, map, true), class: "patch" }));
  const coil = (at, t, out) => drawn("path", { d: path_of([0, 1, 2, 3, 4].map(n => shifted(shifted(at, out, 2 + 3 * n), t, n % 2 ? 3 : -3)), p => p), class: "hatch" });
  return [regions, soil, beams, plate.springs.map(one => {
    const edges = held_by(one);
    return [along(edges, map, 24).map(({ at, out, t }) => coil(at, t, out)), one.position ? [coil(map(one.position), [1, 0], [0, 1])] : []];
  })].flat(4);
}

/** An arrow that comes out of the page (a dot) or goes into it (a cross). */
function page_arrow([x, y], towards, radius = 5) {
  const cross = 0.7 * radius;
  return drawn("g", { class: "load" }, drawn("circle", { cx: x, cy: y, r: radius, class: "rim" }), towards
    ? drawn("circle", { cx: x, cy: y, r: 0.32 * radius, class: "dot" })
    : [line([x - cross, y - cross], [x + cross, y + cross]), line([x - cross, y + cross], [x + cross, y - cross])]);
}

function within(vertices, point) {
  return vertices.reduce((odd, a, i) => {
    const b = vertices[(i + 1) % vertices.length];
    return (a[1] > point[1]) !== (b[1] > point[1]) && point[0] < a[0] + ((point[1] - a[1]) / (b[1] - a[1])) * (b[0] - a[0]) ? !odd : odd;
  }, false);
}

function inside(point) {
  return within(plate.outline, point) && !plate.holes.some(hole => within(hole_vertices(hole), point));
}

function pressure_marks(load, plate_box, map) {
  const clamped = point => point.map((x, c) => Math.min(Math.max(x, plate_box.low[c]), plate_box.high[c]));
  const patch = load.patch ? hole_vertices(load.patch).map(clamped) : null, marks = [];
  const side = (end, axis) => Math[end](...patch.map(point => point[axis]));
  const box = patch ? { low: [side("min", 0), side("min", 1)], high: [side("max", 0), side("max", 1)] } : plate_box;
  const step = Math.max(box.high[0] - box.low[0], box.high[1] - box.low[1]) / (patch ? 4 : 6);
  const pressure = ([x, y]) => load.level !== undefined ? (y < load.level ? load.value : 0) : load.value + (load.gradient ? load.gradient[0] * (x - load.from[0]) + load.gradient[1] * (y - load.from[1]) : 0);
  for (let x = box.low[0] + step / 2; x < box.high[0]; x += step)
    for (let y = box.low[1] + step / 2; y < box.high[1]; y += step)
      if (inside([x, y]) && (!patch || within(patch, [x, y])) && pressure([x, y])) marks.push(page_arrow(map([x, y]), pressure([x, y]) > 0, 4));
  return drawn("g", { class: "pressure" }, patch ? drawn("path", { d: path_of(patch, map, true), class: "patch" }) : null, marks);
}

function line_marks(load, map) {
  const marks = load.along.slice(1).flatMap((to, i) => {
    const a = map(load.along[i]), b = map(to), count = Math.max(2, Math.round(Math.hypot(b[0] - a[0], b[1] - a[1]) / 24));
    return [...Array(count).keys()].map(n => page_arrow([0, 1].map(c => a[c] + (n + 0.5) / count * (b[c] - a[c])), load.value > 0, 4));
  });
  return drawn("g", {}, drawn("path", { d: path_of(load.along, map), class: "patch" }), marks);
}

/** A moment as an arc about the edge, with its head where it turns to. */
function moment_mark({ at, out, t }, positive) {
  const turn = positive ? 1 : -1, a = shifted(shifted(at, out, 6), t, -7 * turn), b = shifted(shifted(at, out, 6), t, 7 * turn), top = shifted(at, out, 22);
  const head = [b, shifted(shifted(b, out, 6), t, -3.5 * turn), shifted(shifted(b, out, 4.5), t, 4 * turn)];
  return drawn("g", { class: "load" }, drawn("path", { d: `M${a}Q${top} ${b}`, class: "arc" }), drawn("path", { d: path_of(head, p => p, true), class: "head" }));
}

/** An arrow along a force in the plane, which begins 4 away from a place. */
function flat_arrow(at, [fx, fy]) {
  const size = Math.hypot(fx, fy);
  if (size === 0) return null;
  const way = [fx / size, -fy / size], aside = [-way[1], way[0]], end = shifted(at, way, 24), head = [end, shifted(shifted(end, way, -7), aside, 3.5), shifted(shifted(end, way, -7), aside, -3.5)];
  return drawn("g", { class: "load" }, drawn("path", { d: path_of([shifted(at, way, 4), end], p => p), class: "arc" }), drawn("path", { d: path_of(head, p => p, true), class: "head" }));
}

/** The force per length of a traction on an edge with this outward normal. */
function traction_on({ tensor, value = 0, shear = 0 }, [x, y]) {
  if (tensor) return [tensor[0] * x + tensor[2] * y, tensor[2] * x + tensor[1] * y];
  return [value * x - shear * y, value * y + shear * x];
}

function load_marks(load, box, { map, scale }) {
  if (load.path) {
    const { path, ...still } = load;
    return [drawn("path", { d: path_of(path, map), class: "patch" }), load_marks(still, box, { map, scale })];
  }
  if (load.kind === "pressure") return pressure_marks(load, box, map);
  if (load.kind === "line_load") return line_marks(load, map);
  if (load.kind === "point_force") return [load.value || !load.vector ? page_arrow(map(load.position), load.value > 0, 6) : null, load.vector ? flat_arrow(map(load.position), load.vector) : null].filter(Boolean);
  if (load.kind === "body_force") return flat_arrow(map([0, 1].map(c => (box.low[c] + box.high[c]) / 2)), load.vector);
  if (load.kind === "settlement") {
    const support = plate.supports[load.support], towards = load.value > 0;
    return [...support.points.map(p => shifted(map(p), [0, -9], 1)), ...(support.patch ? [map(hole_vertices(support.patch)[0])] : along(held_by(support), map, 36).map(({ at, out }) => shifted(at, out, -8)))].map(at => page_arrow(at, towards, 4));
  }
  const edges = all_edges().filter(edge => load.edges.includes(edge.name));
  if (load.kind === "edge_traction") return along(edges, map, 46).map(({ at, out }) => flat_arrow(at, traction_on(load, [out[0], -out[1]]))).filter(Boolean);
  if (load.kind === "edge_shear") return along(edges, map, 24).map(({ at, out }) => page_arrow(shifted(at, out, 8), load.value > 0, 4.5));
  return along(edges, map, 46).map(place => moment_mark(place, (load.tensor ? load.tensor.find(x => x !== 0) ?? 1 : load.value || load.twist) > 0));
}

function dimension(a, b, offset, text, upright) {
  const [p, q] = [shifted(a, offset, 1), shifted(b, offset, 1)], middle = [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
  const place = upright ? shifted(middle, [-6, 0], 1) : shifted(middle, [0, 14], 1);
  return drawn("g", { class: "dimension" }, line(p, q), line(shifted(p, upright ? [-4, 0] : [0, -4], 1), shifted(p, upright ? [4, 0] : [0, 4], 1)),
    line(shifted(q, upright ? [-4, 0] : [0, -4], 1), shifted(q, upright ? [4, 0] : [0, 4], 1)),
    drawn("text", { x: place[0], y: place[1], "text-anchor": "middle", transform: upright ? `rotate(-90 ${place[0]} ${place[1]})` : null }, text));
}

function tip_marks(map, box) {
  const middle = map([(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2]);
  return [...tips()].map(([number, place]) => {
    const [x, y] = map(place), side = x >= middle[0] ? 1 : -1;
    return drawn("g", { class: "tip" }, drawn("circle", { cx: x, cy: y, r: 3.2 }), drawn("text", { x: x + 8 * side, y: y - 7, "text-anchor": side > 0 ? "start" : "end" }, `tip ${number}`));
  });
}

function plate_drawing() {
  const box = bounds([...plate.outline]), margin = { left: 52, right: 30, top: 30, bottom: 50 };
  const frame = map_of(box, 420, margin), { map } = frame;
  const outline = [plate.outline, ...plate.holes.map(hole_vertices)].map(points => path_of(points, map, true)).join("");
  const low = map(box.low), high = map(box.high), end = cracks_at_end();
  const m = unit("length") ? ` ${unit("length")}` : "";
  return drawn("svg", { viewBox: `0 0 ${frame.width.toFixed(1)} ${frame.height.toFixed(1)}`, role: "img", "aria-label": "The plate with supports, loads, holes, cracks and tips", class: "plate" },
    drawn("path", { d: outline, class: "surface", "fill-rule": "evenodd" }),
    elastic_marks(frame),
    plate.loads.map(load => load_marks(load, box, frame)).flat(3),
    plate.supports.map(support => support_marks(support, map)).flat(3),
    plate.supports.flatMap(support => support.points).map(p => drawn("path", { d: path_of([map(p), shifted(map(p), [5, 9], 1), shifted(map(p), [-5, 9], 1)], q => q, true), class: "roller pin" })),
    end === plate.cracks ? [] : end.map(points => drawn("path", { d: path_of(points, map), class: "crack grown" })),
    plate.cracks.map(points => drawn("path", { d: path_of(points, map), class: "crack" })),
    Object.entries(data.probes ?? {}).map(([name, p]) => {
      const [x, y] = map(p);
      return drawn("g", { class: "probe" }, line([x - 4, y], [x + 4, y]), line([x, y - 4], [x, y + 4]), drawn("text", { x: x + 6, y: y + 14 }, name));
    }),
    tip_marks(map, box),
    dimension([low[0], low[1]], [high[0], low[1]], [0, 24], `${shown(box.high[0] - box.low[0], 5)}${m}`, false),
    dimension([low[0], low[1]], [low[0], high[1]], [-26, 0], `${shown(box.high[1] - box.low[1], 5)}${m}`, true));
}

/** What the drawing shows, in words. */
function plate_words() {
  const { section: s } = plate, on = edges => (edges.length ? ` on ${listed(edges)}` : "");
  const support = one => `${one.kind}${one.points.length ? ` at ${one.points.length} ${one.points.length === 1 ? "point" : "points"}` : one.along ? " along a line" : one.patch ? " on a part" : on(one.edges)}${one.kind === "hub" ? (one.k_phi === undefined ? " that does not turn" : one.k_phi === 0 ? " free to turn" : `, k_phi ${shown(one.k_phi)}`) + (one.k_w ? `, k_w ${shown(one.k_w)}` : "") : ""}${one.pushes ? `, pushes ${one.pushes} only` : ""}${one.in_plane ? `, in the plane ${one.in_plane}` : ""}`;
  const load = one => {
    const value_of = one.tensor ? `${one.kind === "edge_traction" ? "Nxx, Nyy, Nxy" : "Mxx, Myy, Mxy"} = ${one.tensor.map(x => shown(x)).join(", ")}` : one.vector ? `${one.value ? `${shown(one.value)} along w and ` : ""}(${one.vector.map(x => shown(x)).join(", ")})` : one.kind === "temperature" && one.mean !== undefined ? `${one.value ? `${shown(one.value)}, ` : ""}mean ${shown(one.mean)}` : one.expression ?? shown(one.value);
    const twist = (one.twist ? `, twist ${shown(one.twist)}` : "") + (one.shear ? `, shear ${shown(one.shear)}` : ""), pair = ([x, y]) => `(${shown(x)}, ${shown(y)})`;
    const place = (one.position ? ` at ${pair(one.position)}` : "") + (one.gradient ? ` at ${pair(one.from)} with the gradient ${pair(one.gradient)}` : "") + (one.patch ? (one.patch.centre ? ` on a circle about ${pair(one.patch.centre)}` : ` on ${one.patch.vertices.map(pair).join(" ")}`) : "") + (one.along ? ` along ${one.along.map(pair).join(" ")}` : "") + (one.path ? ` that moves along ${one.path.map(pair).join(" ")} with ${shown(one.speed)}` : "") + (one.kind === "settlement" ? `${one.rotation ? `, rotation ${shown(one.rotation)}` : ""} of ${support(plate.supports[one.support])}` : "");
    return `${spaced(one.kind)} ${value_of}${unit(one.kind) ? ` ${unit(one.kind)}` : ""}${twist}${on(one.edges)}${place}${one.history ? `, ${one.history}` : ""}`;
  };
  const of = (x, quantity) => {
    const { factor, name } = prefixed(quantity, [x]);
    return `${shown(x / factor)}${name ? ` ${name}` : ""}`;
  };
  const of_case = i => (plate.cases?.[i] ? `${plate.cases[i]}: ` : "");
  return facts([
    ["Material", s.material ?? `E ${of(s.young, "stress")}, ν ${shown(s.poisson)}${s.density > 0 ? `, ρ ${shown(s.density)}${unit("density") ? ` ${unit("density")}` : ""}` : ""}`],
    ["Thickness", of(s.thickness, "length")],
    ["Supports", plate.supports.length ? plate.supports.map(support).join("; ") : "none"],
    ...plate.foundations.map(one => ["Foundation", `modulus ${shown(one.modulus)}${one.shear ? `, shear ${shown(one.shear)}` : ""}${one.patch ? " beneath a part" : ""}${one.lifts_off ? ", the plate may lift off" : ""}`]),
    ...plate.stiffeners.map(one => ["Stiffener", `${["bending", "torsion", "axial", "eccentricity", "mass"].filter(key => one[key]).map(key => `${key} ${shown(one[key])}`).join(", ")}${on(one.edges)}${one.along ? " along a line" : ""}`]),
    ...plate.springs.map(one => ["Springs", `${["deflection", "rotation_normal", "rotation_tangential", "rotation", "opening", "sliding"].filter(key => one[key]).map(key => `${spaced(key)} ${shown(one[key])}`).join(", ")}${on(one.edges)}${one.position ? ` at (${one.position.map(x => shown(x)).join(", ")})` : ""}${one.along ? " along a line" : ""}${one.cracks ? `${one.depth ? `depth ${one.depth}` : ""} on crack ${one.cracks.join(", ")}` : ""}`]),
    ["Loads", plate.loads.length ? plate.loads.map((one, i) => of_case(i) + load(one)).join("; ") : "none"],
    ...(plate.beginning ? [["Beginning", plate.beginning]] : []),
    ["Cracks", plate.cracks.length ? `${plate.cracks.length}${grows ? ` at the start (bold), ${cracks_at_end().length} at the end` : ""}` : "none"],
    ["Tips", [...tips()].map(([number, [x, y]]) => `${number} at (${shown(x, 4)}, ${shown(y, 4)})`).slice(0, 8).join("; ")],
  ]);
}
