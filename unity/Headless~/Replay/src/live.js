// The live page: an editor for the programs of a running simulation, and its controls. live-view.js shows the simulation in a frame.
import { autocompletion, completeAnyWord } from '@codemirror/autocomplete';
import { history, historyKeymap, defaultKeymap, indentWithTab } from '@codemirror/commands';
import { bracketMatching, HighlightStyle, indentUnit, StreamLanguage, syntaxHighlighting } from '@codemirror/language';
import { kotlin } from '@codemirror/legacy-modes/mode/clike';
import { lintGutter, setDiagnostics } from '@codemirror/lint';
import { searchKeymap } from '@codemirror/search';
import { Compartment, EditorState } from '@codemirror/state';
import {
  drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers,
} from '@codemirror/view';
import { tags } from '@lezer/highlight';
import { element, part } from './dom.js';

const RETRY_MS = 1000;

const COLOURS = HighlightStyle.define([
  { tag: tags.keyword, color: 'var(--keyword)' },
  { tag: [tags.string, tags.character], color: 'var(--string)' },
  { tag: tags.comment, color: 'var(--comment)', fontStyle: 'italic' },
  { tag: [tags.number, tags.bool, tags.null], color: 'var(--number)' },
  { tag: [tags.typeName, tags.meta, tags.standard(tags.variableName)], color: 'var(--type)' },
]);
const THEME = EditorView.theme({
  '&': { color: 'var(--text)', backgroundColor: 'var(--paper)' },
  '.cm-content': { caretColor: 'var(--text)' },
  '&.cm-focused': { outline: 'none' },
  '&.cm-focused .cm-content': { outline: 'none' },
  '.cm-cursor': { borderLeftColor: 'var(--text)' },
  '.cm-gutters': { backgroundColor: 'var(--paper)', color: 'var(--quiet)', border: 'none' },
  '.cm-activeLine, .cm-activeLineGutter': { backgroundColor: 'var(--hover)' },
  '.cm-selectionBackground, &.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground': {
    backgroundColor: 'color-mix(in srgb, var(--accent), transparent 75%)',
  },
  '.cm-tooltip, .cm-panels': { backgroundColor: 'var(--background)', color: 'var(--text)' },
});

/** The files of the programs. One of them is open in the editor. */
class Files {
  constructor(onSave) {
    // name -> { state, saved, sent, problem, problems }: `saved` is the text on the disk that was changed here, `sent` the text that was saved last.
    // A file with a problem cannot be edited.
    this.files = new Map();
    this.name = null;
    this.editable = new Compartment();
    this.readOnly = false;
    this.onSave = onSave;
    this.view = new EditorView({ parent: element('editor') });
    element('file').addEventListener('change', (event) => this.open(event.target.value));
    element('save').addEventListener('click', () => this.save());
  }

  get text() {
    return this.view.state.doc.toString();
  }

  /** Whether a file has changes that are not saved. */
  get isChanged() {
    return [...this.files.keys()].some((name) => this.isFileChanged(name));
  }

  isFileChanged(name) {
    const { state, saved } = this.files.get(name);
    return (name === this.name ? this.text : state.doc.toString()) !== saved;
  }

  /** Removes all files with their changes. */
  clear() {
    this.files.clear();
    this.name = null;
    this.setProblems([]);
  }

  /** Updates the files from disk, except files with unsaved changes. Other editors may remove a file for a moment while they replace it. */
  update(files) {
    for (const name of this.files.keys()) if (!(name in files) && !this.isFileChanged(name)) this.files.delete(name);
    for (const [name, file] of Object.entries(files)) this.updateFile(name, file);
    element('file').replaceChildren(...[...this.files.keys()].map((name) => part('option', name, { value: name })));
    if (!this.files.has(this.name)) this.open(this.files.keys().next().value);
    element('file').value = this.name;
    this.setReadOnly(this.readOnly);
  }

  updateFile(name, { text, problem }) {
    const known = this.files.get(name);
    if (!known) {
      this.files.set(name, { state: this.stateOf(text), saved: text, problem, problems: [] });
      return;
    }
    const shown = name === this.name ? this.view.state : known.state;
    const isChanged = this.isFileChanged(name);
    known.problem = problem;
    // A change from another editor becomes the base of the changes here only after a warning.
    if (!isChanged || text === known.sent || text === shown.doc.toString()) known.saved = text;
    if (isChanged || shown.doc.toString() === text) return;
    const change = { changes: { from: 0, to: shown.doc.length, insert: text } };
    if (name === this.name) this.view.dispatch(change);
    else known.state = shown.update(change).state;
  }

  /** Another editor has written `text`, which the next save replaces. */
  conflict(name, text) {
    this.files.get(name).saved = text;
    this.describe();
  }

  stateOf(text) {
    return EditorState.create({
      doc: text,
      extensions: [
        lineNumbers(), lintGutter(), highlightActiveLine(), highlightActiveLineGutter(), drawSelection(), history(), bracketMatching(),
        StreamLanguage.define(kotlin), syntaxHighlighting(COLOURS), THEME, indentUnit.of('    '), EditorState.tabSize.of(4),
        autocompletion({ override: [completeAnyWord], activateOnTyping: false }),
        EditorView.contentAttributes.of({ 'aria-label': 'Program', spellcheck: 'false', tabindex: '0' }),
        this.editable.of(EditorState.readOnly.of(this.readOnly)),
        keymap.of([{ key: 'Mod-s', run: () => { this.save(); return true; }, preventDefault: true }, ...defaultKeymap, ...historyKeymap, ...searchKeymap,
          indentWithTab]),
        EditorView.updateListener.of((update) => { if (update.docChanged) this.describe(); }),
      ],
    });
  }

  open(name) {
    if (name === undefined) return;
    const before = this.files.get(this.name);
    if (before) before.state = this.view.state;
    this.name = name;
    this.view.setState(this.files.get(name).state);
    this.setReadOnly(this.readOnly);
    this.underline();
    this.describe();
  }

  save() {
    if (this.isReadOnly || this.name === null) return;
    this.onSave(this.name, this.text);
  }

  describe() {
    const isChanged = this.name !== null && this.text !== this.files.get(this.name).saved;
    element('save').disabled = this.isReadOnly || !isChanged;
    const problem = this.files.get(this.name)?.problem;
    element('problem').hidden = !problem;
    element('problem').textContent = problem ? `Read-only: ${problem}` : '';
  }

  get isReadOnly() {
    return this.readOnly || Boolean(this.files.get(this.name)?.problem);
  }

  setReadOnly(readOnly) {
    this.readOnly = readOnly;
    this.view.dispatch({ effects: this.editable.reconfigure(EditorState.readOnly.of(this.isReadOnly)) });
    this.describe();
  }

  /** Underlines the errors of the compiler. Each has `file`, `line`, `column` and `message`. */
  setProblems(problems) {
    for (const [name, file] of this.files) file.problems = problems.filter((problem) => problem.file === name);
    this.underline();
    const first = problems.find(({ file }) => file === this.name);
    if (first) this.view.dispatch({ effects: EditorView.scrollIntoView(this.placeOf(first)) });
    element('problems').replaceChildren(...problems.map((problem) => {
      const item = part('li', '');
      const button = part('button', `${problem.file}:${problem.line}:${problem.column}: ${problem.message}`);
      button.addEventListener('click', () => this.show(problem));
      item.append(button);
      return item;
    }));
  }

  underline() {
    const { doc } = this.view.state;
    const problems = this.files.get(this.name)?.problems ?? [];
    this.view.dispatch(setDiagnostics(this.view.state, problems.map((problem) => {
      const from = this.placeOf(problem);
      const rest = doc.sliceString(from, doc.lineAt(from).to);
      return { from, to: from + Math.min(/^\w+/.exec(rest)?.[0].length ?? 1, rest.length), message: problem.message, severity: problem.severity };
    })));
  }

  /** Returns the range of a problem in the open file. */
  placeOf({ line, column }) {
    const { doc } = this.view.state;
    const { from, to } = doc.line(Math.min(Math.max(line, 1), doc.lines));
    return Math.min(from + Math.max(column - 1, 0), to);
  }

  show(problem) {
    if (!this.files.has(problem.file)) return;
    element('file').value = problem.file;
    this.open(problem.file);
    this.view.dispatch({ selection: { anchor: this.placeOf(problem) }, scrollIntoView: true });
    this.view.focus();
  }
}

class Live {
  constructor() {
    this.view = null;
    this.waiting = []; // events before the view was loaded
    this.controls = false;
    this.restarted = true;
    this.changes = {}; // keys of the scenario that the next start sets
    this.files = new Files((file, text) => {
      const known = this.files.files.get(file);
      known.sent = text;
      this.report('compiling …', '');
      this.send({ save: file, text, base: known.saved });
    });
    this.bind();
    this.connect();
  }

  /** Called by the page in the frame. */
  attach(view) {
    this.view = view.connect((command) => this.send(command));
    for (const [event, bytes] of this.waiting.splice(0)) this.pass(event, bytes);
  }

  connect() {
    const url = new URL('socket', window.location);
    url.protocol = 'ws:';
    const socket = new WebSocket(url);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    socket.addEventListener('message', ({ data }) => this.receive(data));
    socket.addEventListener('close', () => {
      this.setControl(false);
      this.setState('connection lost: trying again', true);
      setTimeout(() => this.connect(), RETRY_MS);
    });
  }

  send(command) {
    if (this.socket.readyState !== WebSocket.OPEN) return;
    if (!this.controls && !('select' in command)) {
      this.notify('Another page controls the simulation. Close it to control the simulation here.');
      return;
    }
    this.socket.send(JSON.stringify(command));
  }

  receive(data) {
    if (typeof data === 'string') {
      const event = JSON.parse(data);
      this.on[event.event].call(this, event);
      return;
    }
    const bytes = new Uint8Array(data);
    const end = bytes.indexOf(0);
    this.pass(JSON.parse(new TextDecoder().decode(bytes.subarray(0, end))), data.slice(end + 1));
  }

  /** Passes an event to the view. */
  pass(event, bytes) {
    if (!this.view) {
      this.waiting = [...this.waiting.filter(([each]) => each.event === 'header'), [event, bytes]].slice(-2);
      return;
    }
    if (event.event === 'header') {
      this.view.header({ ...event, restarted: this.restarted });
      this.restarted = false;
      return;
    }
    this.view.frame(event, bytes);
    if (this.controls && !this.isStopped) {
      this.setState(event.error ? `running, with ${event.errors.toLocaleString('en')} errors; the last one: ${event.error.split('\n')[0]}`
        : event.running ? 'running' : 'paused', event.error !== '');
    }
  }

  /** Event handlers, by the names of events. */
  on = {
    welcome({ controls, title, scenario, files, editable, examples, command, seed }) {
      element('name').textContent = title;
      document.title = `${title}, live`;
      if (this.scenario !== scenario) {
        this.scenario = scenario;
        this.files.clear();
        this.report('', '');
        this.showExamples(examples, title);
      }
      this.setControl(controls);
      this.editable = editable;
      this.files.setReadOnly(!controls || !editable);
      this.files.update(files);
      element('command').value = command;
      element('seed').value = seed;
      if (!editable) this.report('The programs are in a jar and cannot be edited here.', '');
    },
    started() {
      this.restarted = true;
      this.isStopped = false;
      this.changes = {};
      element('warning').hidden = true;
    },
    header(header) {
      this.pass(header);
      this.showControls(header);
    },
    files({ files }) {
      this.files.update(files);
    },
    compiled({ problems, messages, milliseconds }) {
      this.files.setProblems(problems);
      if (problems.some(({ severity }) => severity === 'error') || messages) {
        this.report(`Not compiled; the previous programs continue.${problems.length === 0 ? `\n${messages}` : ''}`, 'bad');
      } else this.report(`compiled in ${milliseconds} ms`, '');
    },
    reload({ error, kept, stored }) {
      if (error) this.report(`Not reloaded; the previous programs continue: ${error}`, 'bad');
      else this.report(`reloaded: kept ${kept.toLocaleString('en')} of ${stored.toLocaleString('en')} stored values`, 'good');
    },
    conflict({ file, text }) {
      this.files.conflict(file, text);
      this.report('', '');
    },
    warning({ message }) {
      this.notify(message);
    },
    stopped({ message }) {
      this.isStopped = true;
      this.setState('stopped', true);
      this.notify(`The simulation stopped: ${message}\nFix the cause, then press Restart.`);
    },
  };

  /** Lists the lessons and samples. */
  showExamples(examples, current) {
    element('examples').hidden = false;
    element('examples').open = false;
    element('examples').querySelector('ul').replaceChildren(...examples.map(({ name, title, text, question }) => {
      const item = part('li', '');
      const button = part('button', title);
      button.setAttribute('aria-current', String(name === current));
      button.addEventListener('click', () => {
        if (this.files.isChanged && !window.confirm('Discard the changes that are not saved?')) return;
        this.setState(`opening ${title} …`, false);
        this.send({ open: name });
      });
      item.append(button, part('p', text), ...(question ? [part('p', `Question: ${question}`, { className: 'quiet' })] : []));
      return item;
    }));
  }

  setState(text, isBad) {
    element('state').textContent = text;
    element('state').classList.toggle('bad', isBad);
  }

  setControl(controls) {
    this.controls = controls;
    this.files.setReadOnly(!controls || this.editable === false);
    const all = document.querySelectorAll(':is(#panels, #examples) :is(input, button, select)');
    for (const control of all) control.disabled = !controls && control.id !== 'copy';
    if (!controls) this.setState('watching: another page controls the simulation', false);
  }

  report(text, kind) {
    element('outcome').textContent = text;
    element('outcome').className = kind;
  }

  notify(text) {
    element('warning').textContent = text;
    element('warning').hidden = false;
  }

  /** Shows a control for each parameter, field of the scene and value of the network. */
  showControls({ programs, parameters, program, sceneFields, network }) {
    const rows = (programs[program] ?? []).map(({ name, default: initial, description }) => this.rowOf({
      key: `parameters.${program}.${name}`, name, value: single(parameters[program]?.[name] ?? initial), hint: description, initial,
      apply: (value) => this.send({ parameter: name, program, value: String(value) }),
    }));
    this.fill('parameters', rows);
    this.fill('network', ['loss', 'delay', 'jitter', 'lossPerMetre'].map((name) => this.rowOf({
      key: `network.${name}`, name, value: network[name], most: name === 'delay' || name === 'jitter' ? 2 : 1,
    })));
    this.fill('fields', Object.entries(sceneFields).filter(([, value]) => typeof value !== 'object')
      .map(([name, value]) => this.rowOf({ key: `fields.${name}`, name, value })));
    this.setControl(this.controls);
  }

  fill(id, rows) {
    element(id).hidden = rows.length === 0;
    element(id).querySelector('.grid').replaceChildren(...rows.flat());
  }

  /** Creates the row of a control. `apply` applies a value immediately; without `apply`, the value takes effect at the next start. */
  rowOf({ key, name, value, hint = '', initial = value, most, apply }) {
    const id = `control-${key}`;
    const holder = part('span', '');
    const use = (changed) => {
      if (apply) apply(changed);
      else {
        this.changes[key] = changed;
        note.textContent = 'at restart';
      }
    };
    // A header, for example after a reload of the programs, must not hide a change that takes effect at the next start.
    const isChanged = !apply && key in this.changes;
    if (isChanged) value = this.changes[key];
    const note = part('span', isChanged ? 'at restart' : '', { className: 'quiet' });
    const number = Number(value);
    let input;
    if (value === true || value === false || value === 'true' || value === 'false') {
      input = part('input', '', { type: 'checkbox', checked: String(value) === 'true' });
      input.addEventListener('change', () => use(input.checked));
      holder.append(input);
    } else if (String(value).trim() !== '' && Number.isFinite(number)) {
      input = part('input', '', { type: 'number', step: 'any', value: String(value) });
      const greatest = most ?? (Math.max(2 * Math.abs(number), 2 * Math.abs(Number(initial))) || 1);
      const slider = part('input', '', { type: 'range', min: String(number < 0 ? -greatest : 0), max: String(greatest), step: String(
        Number.isInteger(number) && greatest >= 10 ? 1 : greatest / 100) });
      slider.value = String(number);
      slider.setAttribute('aria-label', `${name}, slider`);
      slider.addEventListener('input', () => { input.value = slider.value; });
      slider.addEventListener('change', () => use(slider.valueAsNumber));
      input.addEventListener('change', () => {
        if (!input.checkValidity() || input.value === '') return;
        slider.value = input.value;
        use(input.valueAsNumber);
      });
      holder.append(slider, input);
    } else {
      input = part('input', '', { type: 'text', value: String(value) });
      input.addEventListener('change', () => use(input.value));
      holder.append(input);
    }
    input.id = id;
    const label = part('label', name, { htmlFor: id, title: hint });
    holder.append(note);
    return [label, holder];
  }

  bind() {
    const count = () => element('count').valueAsNumber;
    element('add').addEventListener('click', () => {
      if (element('count').reportValidity()) this.send({ add: count(), at: this.view.centre });
    });
    const clicks = element('click-adds');
    const setAdding = (adding) => {
      clicks.setAttribute('aria-pressed', String(adding));
      this.view?.setAdding(adding ? count() : 0);
    };
    clicks.addEventListener('click', () => setAdding(clicks.getAttribute('aria-pressed') === 'false'));
    element('count').addEventListener('change', () => setAdding(clicks.getAttribute('aria-pressed') === 'true'));
    element('restart').addEventListener('click', () => {
      if (!element('seed').reportValidity()) return;
      this.setState('restarting', false);
      this.send({ restart: this.changes, seed: element('seed').value });
    });
    element('save-scenario').addEventListener('click', () => this.send({ scenario: element('scenario').value, set: this.changes }));
    element('save-record').addEventListener('click', () => this.send({ record: element('record').value }));
    element('copy').addEventListener('click', () => {
      element('command').select();
      navigator.clipboard.writeText(element('command').value);
    });
    element('warning').addEventListener('click', () => { element('warning').hidden = true; });
    window.addEventListener('keydown', (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.key !== 's') return;
      event.preventDefault();
      if (!event.defaultPrevented) this.files.save();
    });
    this.bindDivider();
  }

  bindDivider() {
    const divider = element('divider');
    const setWidth = (percent) => {
      const width = Math.min(Math.max(percent, 20), 80);
      document.documentElement.style.setProperty('--width', `${width}%`);
      divider.setAttribute('aria-valuenow', String(Math.round(width)));
    };
    const width = () => Number(divider.getAttribute('aria-valuenow'));
    divider.addEventListener('pointerdown', (event) => {
      divider.setPointerCapture(event.pointerId);
      element('page').classList.add('dragging');
    });
    divider.addEventListener('pointermove', (event) => {
      if (divider.hasPointerCapture(event.pointerId)) setWidth((100 * event.clientX) / window.innerWidth);
    });
    divider.addEventListener('pointerup', () => element('page').classList.remove('dragging'));
    divider.addEventListener('keydown', ({ key }) => {
      if (key === 'ArrowLeft' || key === 'ArrowRight') setWidth(width() + (key === 'ArrowLeft' ? -2 : 2));
    });
    setWidth(40);
  }
}

/** Returns the value that all nodes share, or else the first value. */
function single(value) {
  return Array.isArray(value) ? value[0] : value;
}

window.live = new Live();
const frame = element('view');
if (frame.contentWindow.replay?.connect) window.live.attach(frame.contentWindow.replay);
