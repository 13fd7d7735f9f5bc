// The panel that explains and selects colours.
import { colouring, css, gradientOf, NO_VALUE, palettesOf } from './colours.js';
import { extent, short, textOf } from './fields.js';

const MOST_CATEGORIES = 8;
const element = (id) => document.getElementById(id);

export class Legend {
  /** `onChange` is called with what colours a value after each choice. */
  constructor(fields, onChange) {
    this.fields = fields;
    this.onChange = onChange;
    element('field').replaceChildren(...fields.map((field) => option(nameOf(field))));
    element('field').addEventListener('change', () => this.choose(element('field').selectedIndex));
    element('palette').addEventListener('change', () => this.colour());
    for (const id of ['range-min', 'range-max']) element(id).addEventListener('change', () => this.setRange(...this.typedRange()));
    element('fit').addEventListener('click', () => this.fit());
    element('whole-range').addEventListener('click', () => this.setRange(...this.wholeRange()));
    element('no-value').querySelector('i').style.background = css(NO_VALUE);
  }

  /** Colours by a field, on the range of the whole run or, if that is unknown, of the frame on show. */
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

  wholeRange() {
    const { min, max, least, greatest } = this.field;
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
    element('range-min').value = Number(min.toPrecision(4));
    element('range-max').value = Number(max.toPrecision(4));
    this.colour();
  }

  colour() {
    const palette = element('palette').value;
    if (this.field.kind === 'number') {
      element('gradient').style.background = gradientOf(palette);
      this.ticks = [this.min, (this.min + this.max) / 2, this.max].map(short);
      element('ticks').replaceChildren(...this.ticks.map((text) => part('span', text)));
    }
    this.of = colouring(this.field, palette, this.min, this.max);
    this.shown = null;
    if (this.frame) this.show(this.frame);
    this.onChange();
  }

  /** Describes the frame: its categories with most nodes first, and whether some nodes have no value. */
  show(frame) {
    this.frame = frame;
    if (this.shown === frame) return;
    this.shown = frame;
    const values = this.field.valuesOf(frame);
    element('no-value').hidden = !frame.slots.some((slot) => Number.isNaN(values[slot]));
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

  countCategories(frame, values) {
    const counts = new Map();
    for (const slot of frame.slots) if (!Number.isNaN(values[slot])) counts.set(values[slot], (counts.get(values[slot]) ?? 0) + 1);
    const all = [...counts].sort(([a, n], [b, m]) => m - n || a - b);
    const rest = all.slice(MOST_CATEGORIES);
    this.others = rest.length ? `and ${rest.length.toLocaleString('en')} more` : '';
    return all.slice(0, MOST_CATEGORIES).map(([value, count]) => ({
      colour: this.of(value), text: `${textOf(this.field, value)} · ${count.toLocaleString('en')} node${count === 1 ? '' : 's'}`,
    }));
  }
}

function nameOf({ name, unit }) {
  return name + (unit ? ` (${unit})` : '');
}

function option(text) {
  const made = part('option', text);
  made.value = text;
  return made;
}

export function part(tag, text) {
  const made = document.createElement(tag);
  made.textContent = text;
  return made;
}
