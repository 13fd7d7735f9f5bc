// Colours for values, as numbers 0xRRGGBB. The scales are perceptually uniform or at least ordered. Viridis and Cividis are readable with all common forms
// of colour blindness.
import {
  interpolateCividis, interpolatePlasma, interpolateRdBu, interpolateTurbo, interpolateViridis, schemeObservable10,
} from 'd3-scale-chromatic';
import { color, hsl } from 'd3-color';

const STEPS = 256;
const SCALES = {
  Viridis: interpolateViridis,
  Plasma: interpolatePlasma,
  Cividis: interpolateCividis,
  Turbo: interpolateTurbo,
  'Blue to red': (share) => interpolateRdBu(1 - share),
};
const TEN = schemeObservable10.map(packed);
// Colours of categories, by their order of appearance.
const CATEGORIES = {
  'Ten colours': (index) => TEN[((index % 10) + 10) % 10],
  // Steps by the golden angle, so that the first colours differ strongly and hundreds are distinct.
  Hues: (index) => packed(hsl((index * 137.508) % 360, 0.62, [0.5, 0.66, 0.38][((index % 3) + 3) % 3])),
};

/** Colour of a node without a value. */
export const NO_VALUE = 0x9aa3ad;

export const css = (colour) => `#${colour.toString(16).padStart(6, '0')}`;

/** The palettes for a kind of field. The first one is the default. */
export function palettesOf({ kind, order }) {
  if (kind === 'colour') return [];
  if (kind === 'number') return Object.keys(SCALES);
  return order.length > TEN.length ? Object.keys(CATEGORIES).reverse() : Object.keys(CATEGORIES);
}

/** CSS gradient of a whole scale, from left to right. */
export function gradientOf(palette) {
  return `linear-gradient(to right, ${Array.from({ length: 12 }, (_, i) => SCALES[palette](i / 11)).join(', ')})`;
}

/** Returns a function from values to colours, with a scale from `min` to `max` for numbers. */
export function colouring({ kind, order }, palette, min, max) {
  const of = { number: () => onScale(SCALES[palette], min, max), category: () => inOrder(CATEGORIES[palette], order), colour: () => (value) => value }[kind]();
  return (value) => (Number.isNaN(value) ? NO_VALUE : of(value));
}

function onScale(interpolate, min, max) {
  const table = Array.from({ length: STEPS }, (_, i) => packed(interpolate(i / (STEPS - 1))));
  const factor = max !== min ? (STEPS - 1) / (max - min) : 0;
  return (value) => table[Math.round(Math.min(Math.max((value - min) * factor, 0), STEPS - 1))];
}

function inOrder(colourOf, order) {
  const known = new Map(order.map((value, index) => [value, colourOf(index)]));
  return (value) => {
    if (!known.has(value)) known.set(value, colourOf(value));
    return known.get(value);
  };
}

function packed(text) {
  const { r, g, b } = color(text).rgb().clamp();
  return (Math.round(r) << 16) | (Math.round(g) << 8) | Math.round(b);
}
