// The colours of the scalar: viridis (perceptually uniform, readable in every common colour blindness).
import { interpolateViridis } from 'd3-scale-chromatic';
import { Color } from 'three';

const STEPS = 256;

/** CSS gradient of the whole scale, from left to right. */
export const gradient = `linear-gradient(to right, ${Array.from({ length: 10 }, (_, i) => interpolateViridis(i / 9)).join(', ')})`;

/** CSS colour of a node without a value. */
export const NO_VALUE = '#9aa3ad';

/** Turns scalars into rows of `table`, linear RGBA. */
export class ColourScale {
  constructor(min, max) {
    this.min = min;
    this.factor = max > min ? (STEPS - 1) / (max - min) : 0;
    this.table = new Float32Array((STEPS + 1) * 4).fill(1);
    for (let i = 0; i < STEPS; i++) new Color(interpolateViridis(i / (STEPS - 1))).toArray(this.table, 4 * i);
    new Color(NO_VALUE).toArray(this.table, 4 * STEPS);
  }

  indexOf(value) {
    const share = (value - this.min) * this.factor;
    return Number.isNaN(share) ? STEPS : Math.round(Math.min(Math.max(share, 0), STEPS - 1));
  }
}
