// Connects recordings, their views and the controls.
import { Charts } from './charts.js';
import { element, part } from './dom.js';
import { canRecord, compose, save, Video } from './exports.js';
import { clock, conflicting, fieldsOf, historyOf, slotOf } from './fields.js';
import { bindKeys } from './keys.js';
import { Legend } from './legend.js';
import { open, ReplayError } from './recording.js';
import { Run } from './run.js';
import { neighboursOf } from './swarm.js';

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8];
const MAX_LISTED = 60; // neighbours with a button
const READABLE_PIXELS = 4; // minimum initial radius of a node in pixels

export class Player {
  constructor(recording) {
    this.runs = [new Run(recording, element('side'))]; // a second one while two are compared
    this.waits = 0;
    this.time = recording.times[0];
    this.speed = 1;
    this.playing = false;
    this.linksVisible = true;
    this.selected = null; // id of a node

    this.bindView();
    this.describeRun();
    this.drawCharts();
    this.legend = new Legend(this.fields, () => this.recolour());
    this.legend.choose(0);
    this.bind();
    const shows = this.charts.charts.length > 0 && window.innerWidth >= 1000 && window.innerHeight >= 600;
    this.showCharts(shows);
    this.setFactor(Math.min(Math.max(Math.ceil((4 * READABLE_PIXELS) / this.view.nodePixels) / 4, 1), 3));
    this.resize(); // the panels now have their texts
  }

  bindView() {
    this.view.onFrame = (now) => this.tick(now);
    this.view.onDrawn = () => this.video?.frame();
  }

  get other() {
    return this.runs[1];
  }

  get recording() {
    return this.runs[0].recording;
  }

  get view() {
    return this.runs[0].view;
  }

  get fields() {
    return this.runs[0].fields;
  }

  /** The current frame of the first run. */
  get here() {
    return this.runs[0].here;
  }

  /** The recording that ends last. The playback bar shows its frames. */
  get clock() {
    return this.runs.reduce((last, run) => (run.lastTime > last.lastTime ? run : last)).recording;
  }

  get lastTime() {
    return this.clock.times.at(-1);
  }

  get clockText() {
    return this.timeText(this.time);
  }

  timeText(time) {
    return clock(time, this.recording.metadata.deltaTime);
  }

  /**
   * Shows a time. Positions of nodes are interpolated between two frames; all other data belongs to the earlier frame. The returned
   * promise resolves when this request or a later one is shown.
   */
  show(time) {
    this.time = Math.min(Math.max(time, this.recording.times[0]), this.lastTime);
    if (this.refresh()) return undefined;
    const arrival = this.arrive(this.time);
    arrival.catch(() => {}); // reported on the page
    return arrival;
  }

  async arrive(time) {
    this.waits++;
    try {
      await Promise.all(this.runs.map((run) => run.load(time)));
      if (this.time === time) this.refresh();
    } catch (error) {
      this.pause();
      showMessage(error.message);
      throw error;
    } finally {
      this.waits--;
    }
  }

  /** Shows the current time if its frames are loaded. */
  refresh() {
    const how = { links: this.links, factor: this.factor, trails: element('trails').checked };
    const shown = this.runs.map((run) => run.show(this.time, this.selected, how));
    if (shown.includes(false)) return false;
    const { here } = this;
    this.legend.show(here);
    this.charts.show(this.time);
    this.history?.show(this.time);
    this.describeTime();
    element('clock').textContent = `t = ${this.clockText} s`;
    element('node-count').textContent = plural(here.slots.length, 'node');
    element('link-count').textContent = linksOf(here);
    if (this.other) element('other-counts').textContent = `${plural(this.other.here.slots.length, 'node')} · ${linksOf(this.other.here)}`;
    this.describeSelection();
    return true;
  }

  /** Shows the time on the playback bar. */
  describeTime() {
    const { recording, clock: { count } } = this;
    const frame = this.clock.frameAt(this.time);
    element('scrub').value = frame;
    element('scrub').setAttribute('aria-valuetext', `${this.clockText} seconds`);
    const tick = Math.round(this.time / recording.metadata.deltaTime).toLocaleString('en');
    element('position').value = `${this.clockText} / ${this.timeText(this.lastTime)} s · tick ${tick} · frame ${frame + 1} / ${count}`;
  }

  get links() {
    if (!this.linksVisible) return 'none';
    return element('links-selected').checked ? 'selected' : 'all';
  }

  /** Colours the nodes as in the legend. */
  recolour() {
    const { legend } = this;
    for (const run of this.runs) run.colour(legend.field, legend.of);
    this.showHistory();
    this.resize(); // the height of the legend has changed
    if (this.here) this.refresh();
  }

  /** Shows a chart of the legend's field for the selected node, once all frames have been read. */
  async showHistory() {
    const { runs, selected } = this;
    const { field } = this.legend;
    if (this.historyOf?.field === field && this.historyOf.selected === selected && this.historyOf.runs === runs) return;
    const wanted = { field, selected, runs };
    this.historyOf = wanted;
    this.history = null;
    element('history').hidden = true;
    if (selected === null || field.kind === 'colour') return;
    const values = await Promise.all(runs.map((run) => historyOf(run, field, selected, () => this.historyOf === wanted)));
    if (this.historyOf !== wanted) return;
    element('history').hidden = false;
    this.history = new Charts(element('history'), runs.map(({ recording: { times } }, i) => ({ times, series: [{ ...field, values: values[i] }] })),
      (time) => this.show(time), this.time);
  }

  describeSelection() {
    element('selection').hidden = this.selected === null;
    if (this.selected === null) return;
    const frame = this.here;
    const selected = slotOf(frame, this.selected);
    element('selected-name').textContent = `Node ${this.selected}`;
    const isPresent = selected >= 0;
    element('selected-position').textContent = isPresent
      ? `at ${this.view.swarm.placeOf(selected, [0, 0, 0]).map((x) => x.toFixed(2)).join(', ')} m` : 'not in the scene at this time';
    const described = [this.selected, ...this.runs.map((run) => run.here)];
    if (described.every((each, i) => this.described?.[i] === each) && this.described.length === described.length) return;
    this.described = described;
    element('selected-values').replaceChildren(...this.fields.filter(({ name }) => name !== 'node' && name !== 'neighbours').flatMap((field) => [
      part('dt', field.name), part('dd', this.runs.map((run) => run.textAt(field, this.selected)).join(' | ')),
    ]));
    const neighbours = isPresent ? neighboursOf(frame, selected).sort((a, b) => frame.ids[a.slot] - frame.ids[b.slot]) : [];
    const some = frame.linksInAll > frame.links ? ' (of the links shown)' : '';
    element('selected-neighbours').textContent = isPresent ? plural(neighbours.length, 'neighbour') + some : '';
    element('neighbour-list').replaceChildren(...neighbours.slice(0, MAX_LISTED).map(({ slot, way }) => {
      const id = frame.ids[slot];
      const button = part('button', ['to ', 'from ', ''][way - 1] + id);
      button.title = `Node ${id} ${['receives from this node', 'sends to this node', 'sends and receives'][way - 1]}`;
      button.setAttribute('aria-label', `${button.textContent}: select node ${id}`);
      button.addEventListener('click', () => this.selectId(id));
      return button;
    }), ...(neighbours.length > MAX_LISTED ? [part('span', `and ${neighbours.length - MAX_LISTED} more`)] : []));
  }

  tick(now) {
    if (!this.playing) return;
    const passed = Math.min((now - this.lastTick) / 1000, 0.25); // no jump after a suspended tab
    this.lastTick = now;
    if (this.waits > 0) this.view.request();
    else this.show(this.time + passed * this.speed);
    if (this.time >= this.lastTime) this.pause();
  }

  seek(frame) {
    const { times } = this.clock;
    return this.show(times[Math.min(Math.max(Math.round(frame), 0), times.length - 1)]);
  }

  play() {
    if (this.playing) return;
    if (this.time >= this.lastTime) this.seek(0);
    this.lastTick = performance.now();
    this.setPlaying(true);
    this.view.request();
  }

  pause() {
    this.setPlaying(false);
  }

  setPlaying(playing) {
    this.playing = playing;
    if (!playing && this.video) {
      this.video.stop();
      this.video = null;
      this.setRecording(false);
    }
    document.body.classList.toggle('playing', playing);
    element('play').setAttribute('aria-label', playing ? 'Pause' : 'Play');
  }

  setSpeed(speed) {
    if (!SPEEDS.includes(speed)) throw new RangeError(`unknown speed ${speed}; use one of ${SPEEDS.join(', ')}`);
    this.speed = speed;
    element('speed').value = String(speed);
  }

  setLinks(visible) {
    this.linksVisible = visible;
    element('links').checked = visible;
    this.refresh();
  }

  setFactor(factor) {
    this.factor = factor;
    element('factor').value = factor;
    element('factor-text').value = `${factor}×`;
    element('scales').textContent = `Grid ${this.view.gridStep} m · nodes drawn ${factor === 1 ? 'at real size' : `${factor}× real size`}`;
    this.show(this.time);
  }

  /** Selects the node with the given id; null deselects. */
  select(id) {
    this.selected = id;
    element('find').value = id ?? '';
    this.showHistory();
    this.refresh();
  }

  /** Selects the visible node with the next greater or lesser id. */
  selectNext(by) {
    const order = Array.from(this.here.slots, (slot) => this.here.ids[slot]).sort((a, b) => a - b);
    if (order.length === 0) return;
    const at = order.indexOf(this.selected);
    const first = by > 0 ? 0 : order.length - 1;
    this.select(order[at < 0 ? first : (at + by + order.length) % order.length]);
  }

  selectId(id) {
    this.select(this.recording.has(id) ? id : null);
  }

  describeRun() {
    const { metadata, nodes } = this.recording;
    document.title = metadata.title;
    element('title').textContent = metadata.title;
    element('title').title = `seed ${metadata.seed}, ${plural(nodes, 'node')} in all`;
    element('scrub').max = this.clock.count - 1;
  }

  /** Shows the run of another page beside this one. `page` is the HTML of the other page; null ends the comparison. */
  async compare(page) {
    this.pause();
    if (page !== null) {
      const data = /<script id="replay"[^>]*>([^<]*)</.exec(page);
      if (!data) throw new ReplayError('This file is not a replay page. Choose a replay.html.');
      const recording = await open(data[1].trim());
      const field = conflicting(this.runs[0].fields, fieldsOf(recording));
      if (field) throw new ReplayError(`The field "${field.name}" has another meaning in this replay. Compare runs of the same schema.`);
      await recording.load(0);
      this.compare(null);
      const holder = element('side').cloneNode(true);
      holder.removeAttribute('id');
      holder.firstElementChild.removeAttribute('id');
      holder.firstElementChild.setAttribute('aria-label', '3D view of the other run');
      holder.lastElementChild.replaceChildren();
      element('side').after(holder);
      const [first] = this.runs;
      const other = new Run(recording, holder);
      this.runs = [first, other];
      other.view.arena = first.view.arena; // one camera for both
      other.view.setTheme(this.theme);
      [first, other].forEach(({ view }, i) => { view.onMoved = () => this.runs[1 - i]?.view.lookAs(view); });
      this.bindPicking(other);
      element('other-title').textContent = recording.metadata.title;
    } else if (this.other) {
      this.other.view.dispose();
      this.runs = this.runs.slice(0, 1);
    }
    this.legend.compare(this.other?.fields ?? []);
    element('compare').setAttribute('aria-pressed', String(page !== null));
    element('other-summary').hidden = page === null;
    this.describeRun();
    this.drawCharts();
    this.resize();
    return this.show(this.time);
  }

  drawCharts() {
    // Skips series of zeros in all runs, such as losses of ideal networks.
    const all = this.runs.map(({ recording: { metrics } }) => metrics);
    const names = new Set(all.flatMap(({ series }) => series.filter(({ values }) => values.some((value) => value)).map(({ name }) => name)));
    const shown = all.map(({ times, series }) => ({
      times, series: series.filter(({ name }) => names.has(name)).map((each) => ({ kind: 'number', ...each })),
    }));
    this.charts = new Charts(element('charts'), shown, (time) => this.show(time), this.time);
  }

  showKeys(visible) {
    element('keys').hidden = !visible;
    element('help').setAttribute('aria-expanded', String(visible));
    this.resize();
  }

  showCharts(visible) {
    element('charts-shown').setAttribute('aria-pressed', String(visible));
    element('charts-shown').hidden = this.charts.charts.length === 0;
    element('charts').hidden = !visible;
    this.resize();
  }

  /** Returns the current view as a file. */
  async savePicture() {
    this.view.draw();
    const canvas = compose(document.createElement('canvas'), this.legend);
    save(await new Promise((resolve) => { canvas.toBlob(resolve); }), `${this.fileName()}-${this.clockText}s.png`);
  }

  /** Starts recording a video, which ends at the end of the run, at a pause or at the next call. */
  async toggleVideo() {
    if (this.video) {
      this.pause();
      return;
    }
    this.view.draw();
    this.video = new Video(this.legend);
    this.setRecording(true);
    this.play();
    const { video } = this;
    const file = await video.done;
    save(file, `${this.fileName()}.${video.extension}`);
  }

  setRecording(recording) {
    element('video').setAttribute('aria-pressed', String(recording));
    element('video').textContent = recording ? 'Stop' : 'Video';
  }

  fileName() {
    const { title, seed } = this.recording.metadata;
    return `${title.replace(/[^\w-]+/g, '-')}-seed${seed}`;
  }

  resize() {
    const picture = document.body.classList.contains('picture');
    const controls = element('controls').getBoundingClientRect();
    const bottom = picture ? 16 : window.innerHeight - controls.top;
    const charts = element('charts');
    const summary = element('summary').getBoundingClientRect();
    charts.style.top = `${summary.bottom + 10}px`;
    charts.style.maxHeight = `${controls.top - summary.bottom - 20}px`;
    document.body.style.setProperty('--controls', `${picture ? 0 : window.innerHeight - controls.top}px`);
    // Panels are beside the picture in a wide window and above it in a narrow one.
    const wide = window.innerWidth >= 1000;
    const legend = element('legend').getBoundingClientRect();
    const left = picture || charts.hidden || !wide ? 0 : charts.getBoundingClientRect().right;
    const right = wide ? window.innerWidth - legend.left : 0;
    const top = wide ? 28 : Math.min(Math.max(summary.bottom, legend.bottom) + 8, window.innerHeight / 2 - bottom / 2);
    if (this.other) {
      const width = (window.innerWidth - left - right) / 2;
      Object.assign(element('other-summary').style, { left: `${left + width + 14}px`, top: wide ? '' : `${top}px` });
      this.runs.forEach(({ view }, i) => view.resize(left + i * width, width, window.innerHeight, { top, bottom, left: 0, right: 0 }));
    } else this.view.resize(0, window.innerWidth, window.innerHeight, { top, bottom, left, right });
    if (!charts.hidden) this.charts.redraw();
  }

  /** Hides the controls for pictures. */
  setControls(visible) {
    document.body.classList.toggle('picture', !visible);
    this.resize();
  }

  bind() {
    element('play').addEventListener('click', () => (this.playing ? this.pause() : this.play()));
    element('scrub').addEventListener('input', (event) => {
      this.pause();
      this.seek(Number(event.target.value));
    });
    element('speed').addEventListener('change', (event) => this.setSpeed(Number(event.target.value)));
    element('links').addEventListener('change', (event) => this.setLinks(event.target.checked));
    element('factor').addEventListener('input', (event) => this.setFactor(Number(event.target.value)));
    element('find').addEventListener('change', (event) => {
      const id = event.target.value === '' ? null : Number(event.target.value);
      event.target.setCustomValidity(id === null || this.recording.has(id) ? '' : 'No node of this run has that id.');
      if (event.target.reportValidity()) this.select(id);
    });
    element('deselect').addEventListener('click', () => {
      this.select(null);
      element('canvas').focus(); // because the focused button was removed
    });
    element('step-back').addEventListener('click', () => this.step(-1));
    element('step-on').addEventListener('click', () => this.step(1));
    for (const id of ['links-selected', 'trails']) element(id).addEventListener('change', () => this.refresh());
    element('follow').addEventListener('change', (event) => this.view.setFollows(event.target.checked));
    element('charts-shown').addEventListener('click', () => this.showCharts(element('charts').hidden));
    element('picture').addEventListener('click', () => this.savePicture());
    element('video').addEventListener('click', () => this.toggleVideo());
    element('video').hidden = !canRecord();
    element('view-above').addEventListener('click', () => this.view.frame('above'));
    element('view-top').addEventListener('click', () => this.view.frame('top'));
    element('help').addEventListener('click', () => this.showKeys(element('keys').hidden));
    element('compare').addEventListener('click', () => (this.other ? this.compare(null) : element('other-file').click()));
    element('other-file').addEventListener('change', () => this.openOther());
    this.bindPicking(this.runs[0]);
    window.addEventListener('resize', () => this.resize());
    bindKeys(this);
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const theme = () => {
      this.theme = dark.matches ? 'dark' : 'light';
      for (const { view } of this.runs) view.setTheme(this.theme);
      this.charts.redraw();
      this.history?.redraw();
    };
    dark.addEventListener('change', theme);
    theme();
  }

  /** Compares with the page of a chosen file. */
  async openOther() {
    const [file] = element('other-file').files;
    element('other-file').value = ''; // the same file may be chosen again
    const error = await file.text().then((page) => this.compare(page)).then(() => '', ({ message }) => `${file.name}: ${message}`);
    element('compare-error').textContent = error;
    element('compare-error').hidden = error === '';
    this.resize();
  }

  bindPicking(run) {
    const { canvas } = run.view;
    let down = null;
    canvas.addEventListener('pointerdown', (event) => {
      down = event.isPrimary && event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
    });
    canvas.addEventListener('pointerup', (event) => {
      // Only a click, not the end of a rotation.
      if (!down || Math.hypot(event.clientX - down.x, event.clientY - down.y) > 4) return;
      this.select(run.here.ids[run.view.pick(event.offsetX, event.offsetY)] ?? null);
    });
  }

  step(frames) {
    this.pause();
    this.seek(this.clock.frameAt(this.time) + frames);
  }

  changeSpeed(by) {
    const at = SPEEDS.indexOf(this.speed) + by;
    if (at >= 0 && at < SPEEDS.length) this.setSpeed(SPEEDS[at]);
  }
}

export function plural(count, noun) {
  return `${count.toLocaleString('en')} ${noun}${count === 1 ? '' : 's'}`;
}

/** Returns a text with the number of links of a frame, each direction counted. If some are hidden, it also contains the number of visible links. */
function linksOf({ linksInAll, links }) {
  return (linksInAll > links ? `${links.toLocaleString('en')} of ` : '') + plural(linksInAll, 'link');
}

/** Throws an error that the page can show if the browser has no 3D graphics. */
export function requireGraphics() {
  if (!document.createElement('canvas').getContext('webgl2')) {
    throw new Error('This browser cannot show 3D graphics (WebGL 2). Enable hardware acceleration in its settings, or open the page in another browser.');
  }
}

export function showMessage(text) {
  element('message-text').textContent = text;
  element('message').hidden = false;
  for (const id of ['summary', 'legend', 'charts', 'controls']) element(id).hidden = true;
}
