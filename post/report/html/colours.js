"use strict";
// Colour maps that are perceptually uniform by construction: lightness in OKLab (Ottosson 2020) changes by the same
// amount with every step; hue and chroma follow smoothly.

/** OKLab to sRGB, 0 to 255. */
function rgb(L, a, b) {
  const l = (L + 0.3963377774 * a + 0.2158037573 * b) ** 3, m = (L - 0.1055613458 * a - 0.0638541728 * b) ** 3, s = (L - 0.0894841775 * a - 1.291485548 * b) ** 3;
  const linear = [4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s, -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s];
  return linear.map(x => Math.min(1, Math.max(0, x))).map(x => 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
}

const polar = (L, chroma, degrees) => rgb(L, chroma * Math.cos((degrees * Math.PI) / 180), chroma * Math.sin((degrees * Math.PI) / 180));
const shades = 1024;

function shades_of(colour) {
  const table = new Uint32Array(shades);
  for (let i = 0; i < shades; i++) {
    const [r, g, b] = colour(i / (shades - 1)).map(Math.round);
    table[i] = (255 << 24) | (b << 16) | (g << 8) | r;
  }
  return table;
}

/** From dark blue over green to light yellow. */
const sequential = shades_of(t => polar(0.24 + 0.71 * t, 0.055 + 0.27 * t * (1 - t) + 0.07 * t, 290 - 185 * t));
/** From blue over white to red, for values of both signs. */
const diverging = shades_of(t => {
  const side = Math.abs(2 * t - 1);
  return polar(0.97 - 0.52 * side, 0.17 * Math.sin((Math.PI / 2) * side), t < 0.5 ? 255 : 32);
});

/** The range of colours of a field, and its map: values of both signs are symmetric about zero. */
function colours_of(field) {
  const [from, to] = field.range, both = from < 0 && to > 0 && Math.min(-from, to) > 0.05 * Math.max(-from, to);
  const size = Math.max(-from, to);
  if (both) return { from: -size, to: size, map: diverging };
  return { from, to: to > from ? to : from + (Math.abs(from) || 1) * 1e-6, map: sequential };
}
