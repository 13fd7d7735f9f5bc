// The colours of the scalar: viridis (perceptually uniform, readable in every common colour blindness).
import { interpolateViridis } from 'd3-scale-chromatic';
import { Color } from 'three';

const STEPS = 256;

/** CSS gradient of the whole scale, from left to right. */
export const gradient = `linear-gradient(to right, ${Array.from({ length: 10 }, (_, i) => interpolateViridis(i / 9)).join(', ')})`;

/** CSS colour of a node without a value. */
export const NO_VALUE = '#9aa3ad';

/** Turns scalars into linear RGB; `write` sets three floats of `into`. */
export class ColourScale {
  constructor(min, max) {
    this.min = min;
    this.factor = max > min ? (STEPS - 1) / (max - min) : 0;
    this.table = new Float32Array((STEPS + 1) * 3);
    for (let i = 0; i < STEPS; i++) new Color(interpolateViridis(i / (STEPS - 1))).toArray(this.table, 3 * i);
    new Color(NO_VALUE).toArray(this.table, 3 * STEPS);
  }

  write(value, into, at) {
    const share = (value - this.min) * this.factor;
    const from = 3 * (Number.isNaN(share) ? STEPS : Math.round(Math.min(Math.max(share, 0), STEPS - 1)));
    into[at] = this.table[from];
    into[at + 1] = this.table[from + 1];
    into[at + 2] = this.table[from + 2];
  }
}
