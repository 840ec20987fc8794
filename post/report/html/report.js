"use strict";
// Puts the page together. The root's data-state says how far it is: loading, drawn, or failed and why.

function sections() {
  if (data.kind !== "run") return study_sections();
  const curve_plots = plots(curves());
  const governing = governing_section();
  return [header(), warnings_section(), governing ? element("div", { class: "pair" }, governing, plate_section()) : plate_section(), factors_section(), load_cases_section(), largest_section("peaks", "Largest in time"), largest_section("extremes", "Largest values"), probes_section(), lines_section(), contact_section(), frequencies_section(), buckling_section(), load_steps_section(), growth_section(),
    curve_plots ? section("Curves", curve_plots, data.summary.response?.some(one => one.quantity === "K1") ? note("K1 changes its sign in every period: amplitudes hold while a static load keeps the crack faces apart.") : null, screen_note("Drag over a plot to zoom, double click to go back; the values under the pointer stand below it.")) : null,
    accuracy_section(), fields_section(), reactions_section(), edges_section(), energy_section(), other_section(), cost_section(), case_section()];
}

/** Dark or light as the reader's system wants it, unless the address ends in #dark or #light; paper is light. */
function scheme() {
  const wanted = location.hash.slice(1), dark = wanted === "dark" || (wanted !== "light" && matchMedia("(prefers-color-scheme: dark)").matches);
  document.documentElement.dataset.scheme = dark && !document.documentElement.classList.contains("paper") ? "dark" : "light";
}

/** Makes tables that are wider than the paper so small that they fit; on screens a fifth smaller at most. */
function fit_tables() {
  const least = document.documentElement.classList.contains("paper") ? 0 : 800;
  for (const table of document.querySelectorAll(".scroll > table")) {
    table.style.zoom = "";
    const room = table.parentElement.clientWidth, width = table.scrollWidth;
    if (width > room) table.style.zoom = Math.max(least, Math.floor((1000 * room) / width)) / 1000;
  }
}

function start() {
  scheme();
  document.getElementById("report").replaceChildren(...sections().filter(Boolean));
  redraw();
  fit_tables();
  const again = () => (scheme(), redraw());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
  addEventListener("hashchange", again);
  let width = innerWidth, waiting = 0;
  addEventListener("resize", () => {
    if (innerWidth === width) return;
    width = innerWidth;
    clearTimeout(waiting);
    waiting = setTimeout(() => (redraw(), fit_tables()), 150);
  });
  addEventListener("beforeprint", () => {
    document.documentElement.classList.add("paper");
    document.querySelectorAll("details:not([open])").forEach(one => (one.open = one.dataset.shut = true));
    again();
    fit_tables();
  });
  addEventListener("afterprint", () => {
    document.documentElement.classList.remove("paper");
    document.querySelectorAll("details[data-shut]").forEach(one => (one.open = false));
    again();
    fit_tables();
  });
  const drawn = () => (document.documentElement.dataset.state = "drawn");
  if (location.hash !== "#check") return drawn();
  const soon = work => queueMicrotask(() => queueMicrotask(work)); // plots are drawn in microtasks
  soon(() => (check(), drawn()));
}

/** For tests: how many colours there are on each canvas, in data-colours. */
function check() {
  for (const canvas of document.querySelectorAll("canvas")) {
    const { data: pixels } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height), colours = new Set();
    for (let i = 0; i < pixels.length; i += 4) if (pixels[i + 3] > 0) colours.add((pixels[i] << 16) | (pixels[i + 1] << 8) | pixels[i + 2]);
    canvas.dataset.colours = colours.size;
  }
}

try {
  start();
} catch (error) {
  document.documentElement.dataset.state = "failed";
  document.getElementById("report").append(element("p", { class: "warnings" }, `This report could not be drawn: ${error}`));
  throw error;
}
