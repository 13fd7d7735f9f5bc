// The metrics over time, one small chart for each, with a line where the clock is.
import './language.js';
import uPlot from 'uplot';
import { short } from './fields.js';
import { part } from './legend.js';

const HEIGHT = 74;
const AXIS = 42;

export class Charts {
  /** `onSeek` is called with the time of a click. */
  constructor(holder, { times, series }, onSeek) {
    this.times = times;
    // The counts of a network without losses say nothing.
    this.series = times.length < 2 ? [] : series.filter(({ values }) => values.some((value) => value !== 0 && value !== null));
    this.charts = this.series.map(({ name, values }) => {
      const figure = part('figure', '');
      const caption = part('figcaption', name.replaceAll('_', ' '));
      const value = part('output', '');
      caption.append(value);
      const canvas = part('div', '');
      figure.append(caption, canvas);
      holder.append(figure);
      const plot = new uPlot(this.options(holder), [times, values], canvas);
      plot.root.setAttribute('role', 'img');
      plot.root.setAttribute('aria-label', describe(name, times, values));
      const line = part('div', '');
      line.className = 'now';
      plot.over.append(line);
      plot.over.addEventListener('click', (event) => onSeek(plot.posToVal(event.offsetX, 'x')));
      return { plot, values, value, line };
    });
  }

  options(holder) {
    const style = (name) => () => getComputedStyle(holder).getPropertyValue(name);
    const axis = {
      stroke: style('--quiet'), font: '10px system-ui, "Open Sans", sans-serif', grid: { stroke: style('--line'), width: 1 }, ticks: { show: false },
    };
    return {
      width: this.widthOf(holder), height: HEIGHT, legend: { show: false }, padding: [6, 6, 0, 0],
      cursor: { drag: { x: false, y: false }, points: { show: false }, y: false, x: false },
      scales: { x: { time: false } },
      axes: [{ ...axis, size: 16, gap: 0, space: 50 }, { ...axis, size: AXIS, gap: 3, space: 22, values: (_, splits) => splits.map(short) }],
      series: [{}, { stroke: style('--strong'), width: 1.5, points: { show: false } }],
    };
  }

  widthOf(holder) {
    return Math.max(holder.clientWidth - 24, 120);
  }

  /** Moves the lines to a time, and shows the values last measured by then. */
  show(time) {
    let row = 0;
    while (row < this.times.length - 1 && this.times[row + 1] <= time + 1e-9) row++;
    for (const { plot, values, value, line } of this.charts) {
      value.value = values[row] === null ? 'none' : short(values[row]);
      line.style.transform = `translateX(${plot.valToPos(Math.min(Math.max(time, this.times[0]), this.times.at(-1)), 'x')}px)`;
    }
  }

  /** Draws again, in the colours of the theme and the width of the panel. */
  redraw(holder) {
    for (const { plot } of this.charts) {
      plot.setSize({ width: this.widthOf(holder), height: HEIGHT });
      plot.redraw(false); // before the first picture it would forget the scale
    }
  }
}

function describe(name, times, values) {
  const some = values.filter((value) => value !== null);
  return `${name.replaceAll('_', ' ')} from ${short(times[0])} to ${short(times.at(-1))} s: first ${short(some[0])}, last ${short(some.at(-1))}, `
    + `least ${short(Math.min(...some))}, greatest ${short(Math.max(...some))}`;
}
