// Draws charts of values over time, with a line for each run and a mark at the current time.
import './language.js';
import uPlot from 'uplot';
import { part } from './dom.js';
import { drawable, extent, isolated, lastAt, nameOf, short, textOf } from './fields.js';

const HEIGHT = 80;

export class Charts {
  /** Each run has `times` and `series`. A series is a field with `values` (null: missing). `onSeek` is called with the time that the user clicks. */
  constructor(holder, runs, onSeek, time) {
    this.time = time; // of the clock
    this.axis = 0; // pixels, the same for all charts
    holder.replaceChildren();
    const all = runs.flatMap(({ times, series }) => (times.length < 2 ? [] : series.filter(({ values }) => values.some((value) => value !== null))));
    this.charts = [...new Set(all.map(({ name }) => name))].map((name) => {
      const field = all.find((each) => each.name === name);
      const lines = runs.map(({ times, series }) => ({ times, values: series.find((each) => each.name === name)?.values ?? times.map(() => null) }));
      const figure = part('figure', '');
      const caption = part('figcaption', nameOf({ ...field, name: name.replaceAll('_', ' ') }));
      const value = part('output', '');
      caption.append(value);
      const canvas = part('div', '');
      figure.append(caption, canvas);
      holder.append(figure);
      const plot = new uPlot(this.options(figure, field, lines), uPlot.join(lines.map(({ times, values }) => [times, values.map(drawable)])), canvas);
      plot.root.setAttribute('role', 'img');
      plot.root.setAttribute('aria-label', `${caption.firstChild.data} ${lines.map((line) => describe(field, line)).join('; other run ')}`);
      const line = part('div', '');
      line.className = 'now';
      plot.over.append(line);
      plot.over.addEventListener('click', (event) => onSeek(plot.posToVal(event.offsetX, 'x')));
      return { figure, plot, field, lines, value, line };
    });
  }

  options(figure, field, lines) {
    const style = (name) => () => getComputedStyle(figure).getPropertyValue(name);
    const axis = {
      stroke: style('--quiet'), font: '10px system-ui, "Open Sans", sans-serif', grid: { stroke: style('--line'), width: 1 }, ticks: { show: false },
    };
    // A value without neighbours has no line, so it is drawn as a point.
    const points = { show: false, size: 4, filter: (plot, i) => isolated(plot.data[i]) };
    const paths = field.kind === 'number' ? undefined : uPlot.paths.stepped({ align: 1 });
    return {
      width: this.widthOf(figure), hooks: { draw: [() => this.show(this.time)] }, height: HEIGHT, legend: { show: false }, padding: [6, 6, 0, 0],
      cursor: { drag: { x: false, y: false }, points: { show: false }, y: false, x: false },
      scales: { x: { time: false } },
      axes: [
        { ...axis, size: 20, gap: 4, space: 50, values: (_, splits, number, space, step) => splits.map((value) => `${short(value, step)} s`) },
        {
          ...axis, size: (plot, words) => this.widen(plot, words ?? []), gap: 3, space: 22,
          values: (_, splits, number, space, step) => splits.map((value) => plain(field, value, step)),
        },
      ],
      series: [{}, ...lines.map((_, i) => ({ stroke: style(i ? '--accent' : '--strong'), width: 1.5, dash: i ? [5, 3] : [], points, paths }))],
    };
  }

  /** Returns the width of an axis with the given labels. */
  widen(plot, words) {
    [plot.ctx.font] = plot.axes[1].font;
    for (const text of words) this.axis = Math.max(this.axis, Math.ceil(plot.ctx.measureText(text).width / devicePixelRatio) + 6);
    return this.axis;
  }

  widthOf(figure) {
    return Math.max(figure.clientWidth, 120);
  }

  /** Moves the marks to a time, and shows the last values measured up to that time. */
  show(time) {
    this.time = time;
    for (const { plot, field, lines, value, line } of this.charts) {
      value.value = lines.map(({ times, values }) => {
        const now = values[lastAt(times, time)];
        return now === null ? 'none' : plain(field, now);
      }).join(' | ');
      line.style.transform = `translateX(${plot.valToPos(Math.min(Math.max(time, plot.data[0][0]), plot.data[0].at(-1)), 'x')}px)`;
    }
  }

  /** Redraws in the colours of the theme and the width of the panel. */
  redraw() {
    for (const { plot, figure } of this.charts) {
      plot.setSize({ width: this.widthOf(figure), height: HEIGHT });
      plot.redraw(false, true); // rebuilding paths before the first drawing would reset the scale
    }
  }
}

/** Formats a value without its unit, which is in the caption. */
function plain(field, value, step) {
  return field.kind === 'number' ? short(value, step) : textOf(field, value);
}

function describe(field, { times, values }) {
  const some = values.filter((value) => value !== null);
  const { least, greatest } = extent(some);
  const [first, last, low, high] = [some[0] ?? NaN, some.at(-1) ?? NaN, least, greatest].map((value) => textOf(field, value));
  return `from ${short(times[0])} to ${short(times.at(-1))} s: first ${first}, last ${last}, minimum ${low}, maximum ${high}`;
}
