// The colours of the scalar: viridis (perceptually uniform, readable in every common colour blindness), by points a ninth apart.
const VIRIDIS = ['440154', '482878', '3e4989', '31688e', '26828e', '1f9e89', '35b779', '6ece58', 'b5de2b', 'fde725'];

const STEPS = 256;

/** sRGB triple, 0..1 each, for a share 0..1 of the range. */
function viridis(share) {
  const at = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1);
  const low = Math.min(Math.floor(at), VIRIDIS.length - 2);
  const channel = (hex, i) => parseInt(hex.slice(2 * i, 2 * i + 2), 16) / 255;
  return [0, 1, 2].map((i) => {
    const a = channel(VIRIDIS[low], i);
    return a + (channel(VIRIDIS[low + 1], i) - a) * (at - low);
  });
}

const toLinear = (c) => (c < 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);

/** CSS gradient of the whole scale, from left to right. */
export const gradient = `linear-gradient(to right, ${VIRIDIS.map((hex) => `#${hex}`).join(', ')})`;

/** CSS colour of a node without a value. */
export const NO_VALUE = '#9aa3ad';

/** Turns scalars into linear RGB; `write` sets three floats of `into`. */
export class ColourScale {
  constructor(min, max) {
    this.min = min;
    this.factor = max > min ? (STEPS - 1) / (max - min) : 0;
    this.table = new Float32Array((STEPS + 1) * 3);
    for (let i = 0; i < STEPS; i++) this.table.set(viridis(i / (STEPS - 1)).map(toLinear), 3 * i);
    this.table.set([1, 3, 5].map((i) => toLinear(parseInt(NO_VALUE.slice(i, i + 2), 16) / 255)), 3 * STEPS);
  }

  write(value, into, at) {
    const share = (value - this.min) * this.factor;
    const from = 3 * (Number.isNaN(share) ? STEPS : Math.round(Math.min(Math.max(share, 0), STEPS - 1)));
    into[at] = this.table[from];
    into[at + 1] = this.table[from + 1];
    into[at + 2] = this.table[from + 2];
  }
}
