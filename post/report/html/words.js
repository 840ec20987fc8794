"use strict";
// The data of the report, and how numbers, units and names are written.
const data = JSON.parse(document.getElementById("data").textContent);
const si = data.units === "SI";

const units = {
  K1: "N √m", K2: "N √m", K3: "N/√m", w: "m", von_mises: "Pa", Mxx: "N", Myy: "N", Mxy: "N", Qx: "N/m", Qy: "N/m",
  stress: "Pa", length: "m", time: "s", energy: "J", force: "N", moment: "N m", pressure: "Pa", frequency: "Hz",
  speed: "m/s", face: "Pa √m", K_eq: "Pa √m", G: "N/m", density: "kg/m³", shear: "N/m", edge_moment: "N", edge_shear: "N/m", point_force: "N", settlement: "m",
  sigma1_top: "Pa", sigma2_top: "Pa", sigma1_bottom: "Pa", sigma2_bottom: "Pa",
  u: "m", v: "m", Nxx: "N/m", Nyy: "N/m", Nxy: "N/m", N1: "N/√m", N2: "N/√m", edge_traction: "N/m", body_force: "N/m²",
};
const unit = quantity => (si && units[quantity]) || "";
const with_unit = (words, quantity) => (unit(quantity) ? `${words} [${unit(quantity)}]` : words);

const names = {
  w: "deflection w", von_mises: "von Mises stress, top face", Mxx: "moment Mxx", Myy: "moment Myy", Mxy: "twisting moment Mxy",
  sigma1_top: "largest principal stress, z > 0", sigma2_top: "smallest principal stress, z > 0", angle_top: "angle of the largest from x, z > 0 [°]",
  sigma1_bottom: "largest principal stress, z < 0", sigma2_bottom: "smallest principal stress, z < 0", angle_bottom: "angle of the largest from x, z < 0 [°]",
  u: "displacement u", v: "displacement v", Nxx: "membrane force Nxx", Nyy: "membrane force Nyy", Nxy: "membrane force Nxy",
  damage: "damage", utilisation: "utilisation of the toughness",
};

const superscripts = text => text.replace(/[-0-9]/g, c => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));

/** A number with so many digits; very large and very small ones with a power of ten. */
function shown(x, digits = 6) {
  if (x === null || x === undefined || Number.isNaN(x)) return "–";
  if (typeof x !== "number") return String(x);
  if (x === 0) return "0";
  if (!Number.isFinite(x)) return x > 0 ? "∞" : "−∞";
  const size = Math.abs(x);
  const plain = size >= 1e-3 && size < 10 ** Math.max(6, digits);
  const [mantissa, power] = x.toExponential(digits - 1).split("e");
  const trimmed = text => (text.includes(".") ? text.replace(/\.?0+$/, "") : text);
  const text = plain ? trimmed(Number(x.toPrecision(digits)).toString()) : `${trimmed(mantissa)}·10${superscripts(String(Number(power)))}`;
  return text.replace("-", "−");
}

/** A number with as many digits as its error has meaning: two of the error. */
function measured(x, error, most = 6) {
  if (typeof error !== "number" || !(error > 0) || typeof x !== "number" || x === 0) return shown(x, most);
  const decimals = 1 - Math.floor(Math.log10(error)), digits = Math.floor(Math.log10(Math.abs(x))) + decimals + 1;
  const fixed = digits > 0 && digits <= most && decimals >= 0 && Math.abs(x) >= 1e-3 && Math.abs(x) < 1e6;
  return fixed ? x.toFixed(decimals).replace("-", "−") : shown(x, Math.max(1, Math.min(most, digits)));
}

const prefixes = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"]];

/** The unit of a quantity with the prefix that suits numbers of this size: its factor, and its name. */
function prefixed(quantity, values) {
  const size = (values ?? []).reduce((most, x) => (Number.isFinite(x) ? Math.max(most, Math.abs(x)) : most), 0), plain = { factor: 1, name: unit(quantity) };
  if (!unit(quantity) || size === 0 || (size >= 0.1 && size < 1e4)) return plain;
  const found = prefixes.find(([factor]) => size >= factor);
  return found ? { factor: found[0], name: found[1] + unit(quantity) } : plain;
}

const percent = x => (x === null || x === undefined ? "–" : x >= 1 ? "> 100 %" : `${shown(100 * x, 2)} %`);
const seconds = x => (x < 0.0995 ? `${shown(1000 * x, 2)} ms` : x < 120 ? `${shown(x, 3)} s` : x < 7200 ? `${shown(x / 60, 3)} min` : `${shown(x / 3600, 3)} h`);
const bytes = x => (x < 1e6 ? `${shown(x / 1e3, 3)} kB` : x < 1e9 ? `${shown(x / 1e6, 3)} MB` : `${shown(x / 1e9, 3)} GB`);
const whole = x => x.toLocaleString("en-US");
const spaced = name => name.replaceAll("_", " ");
const listed = words => (words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} and ${words.at(-1)}`);
const capital = text => text.charAt(0).toUpperCase() + text.slice(1);

/** Indices of a list by a key, in order of appearance. */
function grouped(list, key) {
  const groups = new Map();
  list.forEach((element, i) => {
    const name = key(element, i);
    if (!groups.has(name)) groups.set(name, []);
    groups.get(name).push(i);
  });
  return groups;
}
