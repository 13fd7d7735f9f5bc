// The panel that explains and selects colours.
import { colouring, css, gradientOf, NO_VALUE, palettesOf } from './colours.js';
import { element, part } from './dom.js';
import { digitsOf, extent, nameOf, short, textOf } from './fields.js';

const MAX_CATEGORIES = 8;
const BARS = 24;

export class Legend {
  /** `onChange` is called after each choice, with the function that returns the colour of a value. */
  constructor(fields, onChange) {
    this.onChange = onChange;
    this.otherFields = [];
    this.setFields(fields);
    element('field').addEventListener('change', () => this.choose(element('field').selectedIndex));
    element('palette').addEventListener('change', () => this.colour());
    for (const id of ['range-min', 'range-max']) element(id).addEventListener('change', () => this.setRange(...this.typedRange()));
    element('fit').addEventListener('click', () => this.fit());
    element('whole-range').addEventListener('click', () => this.setRange(...this.wholeRange()));
    element('histogram').replaceChildren(...Array.from({ length: BARS }, () => part('i', '')));
    element('no-value').querySelector('i').style.background = css(NO_VALUE);
  }

  /** Replaces the fields that the legend offers. Call `choose` for one of them afterwards. */
  setFields(fields) {
    this.fields = fields;
    element('field').replaceChildren(...fields.map((field) => option(nameOf(field))));
  }

  /** Selects the field that colours the nodes. The scale has the range of the whole run or, if that is unknown, of the current frame. */
  choose(index) {
    this.field = this.fields[index];
    element('field').selectedIndex = index;
    const palettes = palettesOf(this.field);
    element('palette').replaceChildren(...palettes.map(option));
    element('palette-choice').hidden = palettes.length === 0;
    const { kind, name, unit } = this.field;
    element('scalar-name').textContent = nameOf({ name, unit });
    for (const id of ['scale', 'range']) element(id).hidden = kind !== 'number';
    element('colouring').hidden = kind === 'colour';
    element('categories').hidden = kind === 'number';
    this.setRange(...this.wholeRange());
  }

  /** Shares scales and categories with the fields of another run that have the same names. */
  compare(others) {
    this.otherFields = others;
    this.choose(this.fields.indexOf(this.field));
  }

  /** Returns a field's range and categories over all compared runs. */
  wholeOf({ name, least, greatest, order }) {
    const same = this.otherFields.filter((each) => each.name === name);
    const all = [{ least, greatest, order }, ...same];
    return {
      least: all.some((each) => each.least === undefined) ? undefined : Math.min(...all.map((each) => each.least)),
      greatest: Math.max(...all.map((each) => each.greatest)),
      order: order && [...new Set(all.flatMap((each) => each.order))],
    };
  }

  wholeRange() {
    const { min, max } = this.field;
    const { least, greatest } = this.wholeOf(this.field);
    element('whole-range').hidden = least === undefined;
    return least === undefined ? this.rangeOnShow() : [min ?? least, max ?? greatest];
  }

  rangeOnShow() {
    if (!this.frame) return [0, 0];
    const values = this.field.valuesOf(this.frame);
    const { least, greatest } = extent(Array.from(this.frame.slots, (slot) => values[slot]));
    return [least, greatest];
  }

  fit() {
    this.setRange(...this.rangeOnShow());
  }

  typedRange() {
    return ['range-min', 'range-max'].map((id) => element(id).valueAsNumber || 0);
  }

  setRange(min, max) {
    [this.min, this.max] = [min, max];
    const step = (max - min) / 100;
    element('range-min').value = Number(min.toPrecision(digitsOf(min, step)));
    element('range-max').value = Number(max.toPrecision(digitsOf(max, step)));
    this.colour();
  }

  colour() {
    const palette = element('palette').value;
    if (this.field.kind === 'number') {
      element('gradient').style.background = gradientOf(palette);
      const step = (this.max - this.min) / 10;
      this.ticks = [short(this.min, step), short((this.min + this.max) / 2, step), textOf(this.field, this.max, step)];
      element('ticks').replaceChildren(...this.ticks.map((text) => part('span', text)));
    }
    this.of = colouring({ ...this.field, order: this.wholeOf(this.field).order }, palette, this.min, this.max);
    this.shown = null;
    if (this.frame) this.show(this.frame);
    this.onChange();
  }

  /** Shows the histogram of the frame, or its categories, sorted by their number of nodes. Also shows whether some nodes have no value. */
  show(frame) {
    this.frame = frame;
    if (this.shown === frame) return;
    this.shown = frame;
    const values = this.field.valuesOf(frame);
    element('no-value').hidden = !frame.slots.some((slot) => Number.isNaN(values[slot]));
    if (this.field.kind === 'number') this.drawHistogram(frame, values);
    this.others = '';
    this.categories = this.field.kind === 'number' ? [] : this.countCategories(frame, values);
    const rows = this.categories.map(({ colour, text }) => {
      const row = part('li', text);
      const dot = part('i', '');
      dot.style.background = css(colour);
      row.prepend(dot);
      return row;
    });
    if (this.others) rows.push(part('li', this.others));
    element('categories').replaceChildren(...rows);
  }

  /** Draws a histogram over the scale. Like the outermost colours, the outermost bars include values beyond the scale. */
  drawHistogram({ slots }, values) {
    const counts = new Array(BARS).fill(0);
    const scale = this.max !== this.min ? BARS / (this.max - this.min) : 0;
    for (const slot of slots) {
      const bar = Math.min(Math.max(Math.floor((values[slot] - this.min) * scale), 0), BARS - 1);
      if (!Number.isNaN(bar)) counts[bar]++;
    }
    const most = Math.max(...counts);
    counts.forEach((count, i) => {
      const bar = element('histogram').children[i];
      bar.style.height = `${most && (100 * count) / most}%`;
      bar.style.background = css(this.of(this.min + ((i + 0.5) / BARS) * (this.max - this.min)));
    });
    const [from, to] = [0, 1].map((end) => this.min + ((counts.indexOf(most) + end) / BARS) * (this.max - this.min));
    const words = `Histogram: at most ${most.toLocaleString('en')} nodes in a bar, from ${short(from, to - from)} to ${textOf(this.field, to, to - from)}`;
    element('histogram').setAttribute('aria-label', words);
    element('histogram').title = words;
  }

  countCategories(frame, values) {
    const counts = new Map();
    for (const slot of frame.slots) if (!Number.isNaN(values[slot])) counts.set(values[slot], (counts.get(values[slot]) ?? 0) + 1);
    const all = [...counts].sort(([a, n], [b, m]) => m - n || a - b);
    const rest = all.slice(MAX_CATEGORIES);
    this.others = rest.length ? `and ${rest.length.toLocaleString('en')} more` : '';
    return all.slice(0, MAX_CATEGORIES).map(([value, count]) => ({
      colour: this.of(value), text: `${textOf(this.field, value)} · ${count.toLocaleString('en')} node${count === 1 ? '' : 's'}`,
    }));
  }
}

function option(text) {
  const made = part('option', text);
  made.value = text;
  return made;
}
