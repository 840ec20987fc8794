"use strict";
// Plots by uPlot: drag to zoom, double click to go back, values under the pointer below.

/** The power of a thousand by which an axis counts. */
function thousand(values) {
  const size = values.reduce((most, x) => (Number.isFinite(x) ? Math.max(most, Math.abs(x)) : most), 0);
  if (size === 0 || (size >= 0.01 && size < 1e4)) return 0;
  return 3 * Math.floor(Math.log10(size) / 3);
}

function axis_words(label, quantity, power) {
  const ten = power ? `10${superscripts(String(power))}` : "";
  const [, words, stated] = label.match(/^(.*?)(?: \[(.*)\])?$/), inside = [ten, stated || unit(quantity)].filter(Boolean).join(" ");
  return inside ? `${words} [${inside}]` : words;
}

/** One to nine of every decade in a range. */
function decades(low, high) {
  const result = [];
  for (let power = Math.floor(Math.log10(low)); 10 ** power <= high; power++)
    for (let i = 1; i < 10; i++) if (i * 10 ** power >= low && i * 10 ** power <= high) result.push(i * 10 ** power);
  return result;
}

/** Texts about places along a line [px], without those that would overlap one before. */
function apart(texts, places) {
  const character = 6.5, gap = 8;
  let end = -Infinity;
  return texts.map((text, i) => {
    const half = character * text.length / 2;
    if (text === "" || places[i] - half < end + gap) return "";
    end = places[i] + half;
    return text;
  });
}

function axis_of(words, log, power) {
  const of_decade = (x, wide) => (wide ? /^1e/ : /^[125]e/).test(Number(x.toPrecision(6)).toExponential());
  const texts_of = ticks => {
    const shown_ticks = ticks.filter(x => x !== null), wide = log && shown_ticks.at(-1) > 2000 * shown_ticks[0];
    return ticks.map(x => (x === null || (log && !of_decade(x, wide)) ? "" : shown(Number((x / 10 ** power).toPrecision(6)), 6)));
  };
  const words_of = (chart, ticks, axis) => (axis === 0 ? apart(texts_of(ticks), ticks.map(x => (x === null ? 0 : chart.valToPos(x, "x")))) : texts_of(ticks));
  return {
    label: words, labelSize: 22, labelFont: "13px system-ui, sans-serif", font: "12px system-ui, sans-serif", stroke: style("--soft"), size: null,
    grid: { stroke: style("--grid"), width: 1 }, ticks: { stroke: style("--grid"), width: 1 }, values: words_of, filter: (_, ticks) => ticks, splits: log ? (_u, _axis, low, high) => decades(low, high) : undefined,
  };
}

/** A range of a logarithmic axis: a little more than what there is. */
const wider = (_, low, high) => (low === null ? [0.1, 10] : [low / 1.5, high * 1.5]);

/** The columns of uPlot: one x for all, a column per line. */
function columns_of(lines) {
  if (lines.every(line => line.x === lines[0].x)) return [lines[0].x, ...lines.map(line => line.y)];
  return uPlot.join(lines.map(line => [line.x, line.y]));
}

function series_of(line, number, power) {
  const colour = line_colour(line.number ?? number);
  return {
    label: line.label, stroke: colour, width: line.rings ? 0 : 1.8, dash: line.dash ?? ((line.number ?? number) >= 8 ? [6, 4] : []), spanGaps: false,
    paths: line.rings ? () => null : undefined,
    points: { show: line.points || line.rings || line.x.length < 2, size: line.rings ? 9 : 6, fill: line.rings ? "transparent" : colour, stroke: colour, width: line.rings ? 2 : 1 },
    value: (_, y) => (y === null || y === undefined ? "" : shown(y, 5)),
  };
}

/**
 * A plot: `x` and `y` are {label, quantity, log}, `lines` a list of {label, x, y, points, rings, dash, number}. Lines that
 * share the array x may have an x twice; others are joined at all of their x. Without `legend` another place names the
 * lines.
 */
function plot({ title, x, y, lines, legend = true }) {
  const wanted = lines.filter(line => line.y.some(value => Number.isFinite(value)));
  if (wanted.length === 0) return null;
  const box = element("div", { class: "canvas" });
  const figure = element("figure", { class: "plot", "data-plot": title }, element("figcaption", {}, title), box);
  const power_x = x.log ? 0 : thousand(wanted.flatMap(line => line.x));
  const power_y = y.log ? 0 : thousand(wanted.flatMap(line => line.y));
  let made = null;
  const draw = () => {
    made?.destroy();
    const small = document.documentElement.classList.contains("paper"), width = Math.max(small ? 190 : 240, Math.floor(box.clientWidth || 480));
    const axes = [axis_of(axis_words(x.label, x.quantity, power_x), x.log, power_x), axis_of(axis_words(y.label, y.quantity, power_y), y.log, power_y)];
    axes[0].size = 34;
    axes[1].size = (_, values) => 24 + 7 * Math.max(3, ...(values ?? []).map(text => text?.length ?? 0));
    made = new uPlot({
      width, height: Math.round(Math.min(320, Math.max(small ? 150 : 220, 0.58 * width))), axes,
      scales: { x: { time: false, distr: x.log ? 3 : 1, range: x.log ? wider : undefined }, y: { distr: y.log ? 3 : 1, range: y.log ? wider : undefined } },
      cursor: { drag: { x: true, y: true, uni: 40 }, points: { size: 8 } },
      legend: { show: legend, live: true, markers: { width: 2 } },
      series: [{ label: x.label, value: (_, value) => (value === null ? "" : shown(value, 5)) }, ...wanted.map((line, i) => series_of(line, i, power_y))],
    }, columns_of(wanted), box);
    figure.dataset.drawn = "yes";
  };
  drawings.push(draw);
  return figure;
}

const plots = (list, look = "grid") => {
  const there = list.filter(Boolean);
  return there.length === 0 ? null : element("div", { class: look }, there);
};
