"use strict";
// Pictures of fields on canvas, with colour bars and the value under the pointer.

const pictures = data.pictures;

/** The 16-bit codes of a field in a frame; 0 is no plate. */
function codes_of(frame, name) {
  frame.codes ??= {};
  if (!frame.codes[name]) {
    const bytes_of = Uint8Array.from(atob(frame.data[name]), c => c.charCodeAt(0));
    const codes = new Uint16Array(bytes_of.length / 2);
    for (let i = 0; i < codes.length; i++) codes[i] = bytes_of[2 * i] | (bytes_of[2 * i + 1] << 8);
    frame.codes[name] = codes;
  }
  return frame.codes[name];
}

/** The code at a place of the plate, between pixels; NaN where there is no plate. */
function code_at(frame, codes, x, y) {
  const { columns, rows } = frame;
  const u = Math.min(Math.max((x - frame.corner[0]) / frame.pitch - 0.5, 0), columns - 1), v = Math.min(Math.max((y - frame.corner[1]) / frame.pitch - 0.5, 0), rows - 1);
  const i = Math.min(Math.floor(u), columns - 2), j = Math.min(Math.floor(v), rows - 2), a = u - i, b = v - j, k = j * columns + i;
  let sum = 0, weight = 0;
  const add = (code, share) => {
    if (code > 0) (sum += share * code), (weight += share);
  };
  add(codes[k], (1 - a) * (1 - b)), add(codes[k + 1], a * (1 - b)), add(codes[k + columns], (1 - a) * b), add(codes[k + columns + 1], a * b);
  return weight > 0 ? sum / weight : NaN;
}

const value_of = (field, code) => field.low + ((code - 1) / 65534) * (field.high - field.low);

/** Fills the canvas with the colours of a field; returns how many pixels have one. */
function paint(context, frame, field, map) {
  const { width, height } = context.canvas, { from, to, map: colours } = colours_of(field), codes = codes_of(frame, field.name);
  const image = context.createImageData(width, height), pixels = new Uint32Array(image.data.buffer);
  const step = field.high > field.low ? (field.high - field.low) / 65534 : 0, slope = (shades - 1) / (to - from);
  let filled = 0;
  for (let row = 0; row < height; row++)
    for (let column = 0; column < width; column++) {
      const [x, y] = map.back(column + 0.5, row + 0.5);
      const code = code_at(frame, codes, x, y);
      if (Number.isNaN(code)) continue;
      const shade = Math.round((field.low + (code - 1) * step - from) * slope);
      pixels[row * width + column] = colours[shade < 0 ? 0 : shade >= shades ? shades - 1 : shade];
      filled++;
    }
  context.putImageData(image, 0, 0);
  return filled;
}

function trace(context, points, map, closed) {
  points.forEach((p, i) => (i === 0 ? context.moveTo(...map(p)) : context.lineTo(...map(p))));
  if (closed) context.closePath();
}

/** The cracks as they were at a time. */
function cracks_at(frame) {
  const table = data.tables?.cracks;
  if (!table?.crack) return plate.cracks;
  const reached = table.time ?? table.advance;
  return [...grouped(table.crack, crack => crack).values()].map(rows => rows.filter(i => !reached || reached[i] <= frame.time * (1 + 1e-9)).map(i => [table.x[i], table.y[i]])).filter(points => points.length > 1);
}

function overlay(context, frame, map, ratio) {
  context.globalCompositeOperation = "destination-in"; // nothing beyond the outline or in holes
  context.fillStyle = "#000";
  context.beginPath();
  for (const points of [plate.outline, ...plate.holes.map(hole_vertices)]) trace(context, points, map, true);
  context.fill("evenodd");
  context.globalCompositeOperation = "source-over";
  context.strokeStyle = style("--ink");
  context.lineWidth = 1.2 * ratio;
  context.stroke();
  context.lineCap = "round";
  for (const [width, colour] of [[3.6, "#fff"], [1.6, "#000"]]) {
    context.lineWidth = width * ratio;
    context.strokeStyle = colour;
    context.beginPath();
    for (const points of cracks_at(frame)) trace(context, points, map, false);
    context.stroke();
  }
}

/** A number to a hundredth of a range. */
const rounded = (x, range) => (range > 0 ? x.toFixed(Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(range))))).replace(/^-?0(\.0+)?$/, "0").replace("-", "−") : shown(x, 3));

/** The colours with their values, which count by the power of ten that is returned with them. */
function bar(field) {
  const canvas = element("canvas", { class: "bar", width: 1, height: 256 }), { from, to, map } = colours_of(field), power = thousand([from, to]);
  const context = canvas.getContext("2d"), image = context.createImageData(1, 256), pixels = new Uint32Array(image.data.buffer);
  for (let i = 0; i < 256; i++) pixels[255 - i] = map[Math.round((i / 255) * (shades - 1))];
  context.putImageData(image, 0, 0);
  const ticks = [1, 0.75, 0.5, 0.25, 0].map(t => element("span", {}, rounded((from + t * (to - from)) / 10 ** power, (to - from) / 10 ** power)));
  return { power, shape: element("div", { class: "scale" }, canvas, element("div", { class: "ticks" }, ticks)) };
}

function frame_words(frame) {
  if (["frequencies", "buckling"].includes(data.summary.analysis.kind)) return `mode ${frame.time}`;
  if (data.summary.load_cases) return data.summary.load_cases[frame.time - 1]?.name ?? "";
  if (moves) return `t = ${shown(frame.time, 4)}${unit("time") ? ` ${unit("time")}` : ""}`;
  return grows ? `advance ${frame.time}` : "";
}

/** The frame of which all fields are kept: the last, or the load case that governs. */
const last_frame = () => (data.summary.load_cases ? frame_words(pictures.frames.at(-1)) : "the last frame");

/** A field of all frames; `chosen` says which frame is wanted. */
function field_picture(field, chosen) {
  const canvas = element("canvas", { class: "field", "data-field": field.name }), readout = element("output", {}, ""), when = element("span", {});
  const box = bounds(plate.outline), size = [box.high[0] - box.low[0], box.high[1] - box.low[1]], holder = element("div", { class: "canvas" }, canvas);
  const colours = bar(field), quantity = names[field.name] ?? spaced(field.name), of = unit(field.name) ? ` ${unit(field.name)}` : "";
  const [low_share, high_share] = pictures.shares;
  const figure = element("figure", { class: "picture", "data-picture": field.name },
    element("figcaption", {}, element("b", {}, capital(quantity)), axis_words("", field.name, colours.power), " ", when),
    element("div", { class: "framed" }, holder, colours.shape),
    element("p", { class: "note" }, readout,
      `${shown(pictures.frames.length > 1 ? field.least : Math.min(field.least, field.low), 4)} to ${shown(field.largest, 4)}${of}${pictures.frames.length > 1 ? ` in ${last_frame()}` : ""}; ` +
      (field.name === "damage" ? "colours from 0 to the largest." : `colours between the percentiles ${100 * low_share} and ${100 * high_share}.`)));
  let frame = pictures.frames.at(-1), map = null;
  const draw = () => {
    frame = chosen().data[field.name] ? chosen() : pictures.frames.at(-1);
    when.textContent = frame_words(frame);
    const ratio = Math.min(2, window.devicePixelRatio || 1), pad = 3;
    const room = Math.max(160, holder.clientWidth), scale = Math.min((room - 2 * pad) / size[0], 460 / size[1]);
    const width = size[0] * scale + 2 * pad, height = size[1] * scale + 2 * pad;
    Object.assign(canvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    Object.assign(canvas.style, { width: `${width}px`, height: `${height}px` });
    colours.shape.style.height = `${height}px`;
    const k = scale * ratio, p = pad * ratio;
    map = ([x, y]) => [p + (x - box.low[0]) * k, p + (box.high[1] - y) * k];
    map.back = (column, row) => [box.low[0] + (column - p) / k, box.high[1] - (row - p) / k];
    const context = canvas.getContext("2d");
    figure.dataset.drawn = paint(context, frame, field, map) > 0 ? "yes" : "empty";
    overlay(context, frame, map, ratio);
  };
  canvas.addEventListener("pointermove", event => {
    const [x, y] = map.back(event.offsetX * (canvas.width / canvas.clientWidth), event.offsetY * (canvas.height / canvas.clientHeight));
    const code = inside([x, y]) ? code_at(frame, codes_of(frame, field.name), x, y) : NaN;
    const beyond = code >= 65534.5 && field.high < field.largest ? "≥ " : code <= 1.5 && field.low > field.least ? "≤ " : "";
    readout.textContent = Number.isNaN(code) ? "" : `${beyond}${shown(value_of(field, code), 4)}${of} at (${shown(x, 3)}, ${shown(y, 3)}). `;
  });
  canvas.addEventListener("pointerleave", () => (readout.textContent = ""));
  drawings.push(draw);
  figure.draw = draw;
  return figure;
}

function slider(frames, first, show) {
  const words = element("output", {}, frame_words(first));
  const input = element("input", { type: "range", min: 0, max: frames.length - 1, step: 1, value: frames.indexOf(first), "aria-label": "frame",
    oninput: () => { words.textContent = frame_words(frames[input.value]); show(frames[input.value]); } });
  return element("label", { class: "slider" }, "Frame ", input, " ", words);
}

function fields_section() {
  if (!pictures) return null;
  const modes = ["frequencies", "buckling"].includes(data.summary.analysis.kind);
  let frame = modes ? pictures.frames[0] : pictures.frames.at(-1);
  const wanted = modes ? pictures.fields.filter(field => pictures.frames[0].data[field.name]) : pictures.fields;
  const figures = wanted.map(field => field_picture(field, () => frame));
  const several = pictures.frames.length > 1 ? slider(pictures.frames, frame, next => { frame = next; figures.forEach(figure => figure.draw()); }) : null;
  return section("Fields", several, element("div", { class: "grid" }, figures),
    modes ? note("The largest |w| of each mode is scaled to 1, and stresses with it.") : null,
    screen_note(`${several && !modes ? `Moments are of ${last_frame()}. ` : ""}Point at a picture for values.`));
}
