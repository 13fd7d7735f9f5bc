// Tests the live page in headless Chromium: node [TEST OPTIONS] live-test.mjs COLLEKTIVE FOLDER
// Runs `COLLEKTIVE live` in the folder, and saves pictures of the page there.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { existsSync, lstatSync, mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { request } from 'node:http';
import { join } from 'node:path';
import suite from 'node:test';
import { launch } from './browser.mjs';

const [collektive, folder] = process.argv.slice(2);
if (!folder) {
  console.error('Usage: node live-test.mjs COLLEKTIVE FOLDER');
  process.exit(2);
}
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const axe = readFileSync(join(process.env.COLLEKTIVE_NODE_MODULES, 'axe-core/axe.min.js'), 'utf8');
const program = join(folder, 'out/live/GradientAscent/programs/GradientAscent.kt');
const browser = await launch(undefined, ['--webgl-antialiasing-mode=none']);

/** Starts the command and waits for its address. */
async function start(...words) {
  const child = spawn(collektive, ['live', '--no-browser', '--set', 'nodes=60', ...words], { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'] });
  const command = { child, output: '', address: null, ended: once(child, 'close') };
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (data) => { command.output += data; });
  while (!command.address && child.exitCode === null) {
    await new Promise((resolve) => { setTimeout(resolve, 50); });
    command.address = /http:\/\/\S+/.exec(command.output)?.[0] ?? null;
  }
  return command;
}

async function stop({ child, ended }) {
  child.kill('SIGINT');
  return (await ended)[0];
}

/** Opens the page and waits for its first frame. */
async function open(address, options = {}) {
  // Half of the resolution and no antialiasing, because drawing is slow without a graphics card. No test compares pictures.
  const context = await browser.newContext({ viewport: { width: 1120, height: 720 }, deviceScaleFactor: 0.5, ...options });
  const tab = await context.newPage();
  const complaints = [];
  tab.on('console', (message) => {
    if (['error', 'warning'].includes(message.type()) && !message.text().includes('GPU stall')) complaints.push(message.text());
  });
  tab.on('pageerror', (error) => complaints.push(error.message));
  await tab.goto(address);
  const view = tab.frame({ url: /\/view$/ });
  await view.waitForFunction(() => window.replay.state?.().nodes.length > 0, null, { timeout: 30000, polling: 100 }).catch(async (error) => {
    await context.close(); // otherwise it would control the simulation
    throw error;
  });
  return { tab, view, complaints, close: () => context.close() };
}

const state = (view) => view.evaluate(() => {
  const { nodes } = window.replay.state();
  const { player } = window.replay;
  const field = player.fields.find(({ name }) => name === 'speed');
  const speeds = Array.from(player.here.slots, (slot) => field.valuesOf(player.here)[slot]).filter((speed) => !Number.isNaN(speed));
  const { tick, running } = player.recording.latest;
  return { nodes: nodes.length, tick, running, speed: speeds.reduce((sum, speed) => sum + speed, 0) / speeds.length };
});

async function eventually(read, holds, message, milliseconds = 15000) {
  let now;
  for (const end = Date.now() + milliseconds; Date.now() < end; await new Promise((resolve) => { setTimeout(resolve, 30); })) {
    now = await read();
    if (holds(now)) return now;
  }
  throw new Error(`${message}; it is ${JSON.stringify(now)}`);
}

const outcome = (tab) => tab.textContent('#outcome');

/** Replaces text of the program in the editor, and saves it with the keyboard. */
async function edit(tab, from, to) {
  await tab.evaluate(([before, after]) => {
    const { view } = window.live.files;
    const at = view.state.doc.toString().indexOf(before);
    if (at < 0) throw new Error(`the program does not contain ${before}`);
    view.dispatch({ changes: { from: at, to: at + before.length, insert: after } });
  }, [from, to]);
  await tab.focus('.cm-content');
  await tab.keyboard.press('Control+s');
}

async function inaccessible(tab) {
  for (const each of tab.frames()) await each.evaluate(axe);
  const { violations } = await tab.evaluate(() => window.axe.run());
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target, failureSummary }) => `${target} ${failureSummary}`).join('; ')}`);
}

/** Saves a picture, if possible. While the simulation runs, a browser without a graphics card may be too busy. */
const picture = (tab, name) => tab.screenshot({ path: join(folder, `${name}.png`), timeout: 5000 })
  .catch((error) => console.error(`${name}: ${error.message}`));

/** Returns the status code of a request with the given headers. */
const statusOf = (address, headers, path = '') => new Promise((resolve, reject) => {
  const url = new URL(path, address);
  request(url, { headers }, (response) => {
    response.resume();
    resolve(response.statusCode);
  }).on('error', reject).end();
});
const HANDSHAKE = { Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': '13', 'Sec-WebSocket-Key': 'AAAAAAAAAAAAAAAAAAAAAA==' };

suite('live', { timeout: 600000 }, async (t) => {
  let live = await start('--set', 'timing.period=0.1');
  assert.ok(live.address, live.output);
  let page = await open(live.address);
  const { tab, view } = page;
  const original = readFileSync(program, 'utf8');

  await t.test('shows the running case study and its program', async () => {
    const first = await state(view);
    assert.equal(first.nodes, 60);
    await eventually(() => state(view), ({ tick }) => tick > first.tick + 20, 'the simulation should run');
    assert.match(await tab.textContent('.cm-content'), /gradientAscent/);
    assert.equal(await tab.textContent('#state'), 'running');
    await picture(tab, 'running');
  });

  await t.test('changes the running swarm within 3 s of saving a constant', async () => {
    await tab.click('#fields summary');
    await tab.fill('[id="control-fields.nodes"]', '61');
    await tab.press('[id="control-fields.nodes"]', 'Tab');
    // The first compilation loads the compiler.
    await edit(tab, 'var x = 0.0', 'var x = 0.00');
    await eventually(() => outcome(tab), (text) => text.startsWith('reloaded'), 'the program should be reloaded', 60000);
    // A reload does not hide a change that waits for the next start.
    assert.equal(await tab.inputValue('[id="control-fields.nodes"]'), '61');
    assert.match(await tab.textContent('#fields'), /at restart/);
    const [moving, still] = ['TOO_SMALL', '1e9'].map((limit) => `if (length < ${limit}) 0.0 else device`);
    // On a busy machine, a single time may be longer.
    let seconds = Infinity;
    for (let attempt = 0; attempt < 3 && seconds >= 3; attempt++) {
      if (attempt > 0) await edit(tab, still, moving);
      await eventually(() => state(view), ({ speed }) => speed > 0.3, 'the swarm should move');
      const began = Date.now();
      const { tick } = await state(view);
      await edit(tab, moving, still);
      await eventually(() => state(view), (now) => now.speed < 0.1 && now.tick > tick, 'the swarm should stand still, and the simulation should run');
      seconds = (Date.now() - began) / 1000;
      t.diagnostic(`time from saving to the changed field: ${seconds} s`);
    }
    assert.ok(seconds < 3, `it took ${seconds} s`);
    assert.match(await outcome(tab), /^reloaded: kept /);
    assert.match(readFileSync(program, 'utf8'), /length < 1e9/);
    await picture(tab, 'edited');
  });

  await t.test('underlines an error while the swarm continues', async () => {
    await edit(tab, 'val obstacle = Vector3()', 'val obstacle = Vector9()');
    await tab.waitForSelector('.cm-lintRange-error', { timeout: 15000 });
    assert.equal(await tab.textContent('.cm-lintRange-error'), 'Vector9');
    assert.match(await outcome(tab), /^Not compiled; the previous programs continue/);
    assert.match(await tab.textContent('#problems'), /^GradientAscent\.kt:\d+:\d+: /);
    const { tick } = await state(view);
    await eventually(() => state(view), (now) => now.tick > tick + 10, 'the simulation should run');
    await picture(tab, 'error');
  });

  await t.test('picks up a change of another editor, and removes the error', async () => {
    writeFileSync(program, original);
    await eventually(() => tab.evaluate(() => window.live.files.text), (text) => text === original, 'the editor should show the file');
    await eventually(() => outcome(tab), (text) => text.startsWith('reloaded'), 'the program should be reloaded');
    assert.equal(await tab.locator('.cm-lintRange-error').count(), 0);
    await eventually(() => state(view), ({ speed }) => speed > 0.3, 'the swarm should move');
  });

  await t.test('replaces a change of another editor only after a warning', async () => {
    await tab.evaluate(() => window.live.files.view.dispatch({ changes: { from: 0, insert: '// here\n' } }));
    writeFileSync(program, `// elsewhere\n${original}`);
    await tab.focus('.cm-content');
    await tab.keyboard.press('Control+s');
    await tab.waitForSelector('#warning >> text=changed in another editor');
    assert.match(readFileSync(program, 'utf8'), /^\/\/ elsewhere/);
    await tab.keyboard.press('Control+s');
    await eventually(() => readFileSync(program, 'utf8'), (text) => text === `// here\n${original}`, 'the second save should replace the file');
    await eventually(() => tab.isDisabled('#save'), (disabled) => disabled, 'the file should be saved');
    writeFileSync(program, original);
    await eventually(() => tab.evaluate(() => window.live.files.text), (text) => text === original, 'the editor should show the file');
  });

  await t.test('keeps unsaved changes of a file that another editor removes for a moment', async () => {
    const other = join(folder, 'out/live/GradientAscent/programs/Other.kt');
    const hasFiles = (count) => eventually(() => tab.locator('#file option').count(), (now) => now === count, `${count} files should be listed`);
    await tab.evaluate(() => window.live.files.view.dispatch({ changes: { from: 0, insert: '// unsaved\n' } }));
    rmSync(program);
    writeFileSync(other, '');
    await hasFiles(2);
    writeFileSync(program, original);
    rmSync(other);
    await hasFiles(1);
    assert.equal(await tab.evaluate(() => window.live.files.text), `// unsaved\n${original}`);
    await tab.evaluate(() => window.live.files.view.dispatch({ changes: { from: 0, to: '// unsaved\n'.length } }));
  });

  await t.test('pauses, steps and changes the speed', async () => {
    await view.evaluate(() => window.replay.player.showCharts(true));
    await view.click('#play');
    const paused = await eventually(() => state(view), ({ running }) => !running, 'the simulation should pause');
    await tab.waitForTimeout(300);
    assert.equal((await state(view)).tick, paused.tick);
    await view.click('#step-on');
    await eventually(() => state(view), ({ tick }) => tick === paused.tick + 1, 'the simulation should run one tick');
    const [label, time] = await view.evaluate(() => [
      document.querySelector('#charts .uplot').ariaLabel, window.replay.player.recording.metrics.times.at(-1),
    ]);
    assert.ok(Math.abs(Number(/ to ([\d.]+) s/.exec(label)[1]) - time) < 1e-3, `the charts lack the last row at ${time} s: ${label}`);
    await view.evaluate(() => window.replay.player.showCharts(false));
    await view.selectOption('#speed', '4');
    await view.click('#play');
    const began = Date.now();
    await tab.waitForTimeout(2000);
    const ticks = (await state(view)).tick - paused.tick;
    const expected = (4 * (Date.now() - began)) / 50;
    assert.ok(ticks > 0.5 * expected && ticks < 1.2 * expected, `${ticks} ticks instead of ${expected}`);
    await view.selectOption('#speed', '1');
    // A higher speed does not wait for a tick that is still due at the lower one, here after 5 s.
    await tab.evaluate(() => window.live.send({ speed: 0.01 }));
    await tab.waitForTimeout(500);
    const slow = (await state(view)).tick;
    await tab.evaluate(() => window.live.send({ speed: 1 }));
    await eventually(() => state(view), ({ tick }) => tick > slow, 'the simulation should run at the new speed', 3000);
  });

  await t.test('applies a parameter at once', async () => {
    const slider = tab.getByLabel('step, slider');
    await slider.press('Home');
    await eventually(() => state(view), ({ speed }) => speed < 0.1, 'the swarm should stand still', 3000);
    assert.equal(await tab.inputValue('[id="control-parameters.gradient-ascent.step"]'), '0');
    await picture(tab, 'parameter');
    await tab.fill('[id="control-parameters.gradient-ascent.step"]', '1');
    await tab.keyboard.press('Tab');
    await eventually(() => state(view), ({ speed }) => speed > 0.2, 'the swarm should move', 3000);
  });

  await t.test('inspects, adds and removes nodes', async () => {
    await view.evaluate(() => window.replay.select(7));
    await view.waitForFunction(() => /Intensity/.test(document.getElementById('inspection').textContent), null, { polling: 100 });
    assert.match(await view.textContent('#inspection'), /Sensors.*Position\.X.*Answer.*Receives from(node \d+[\d.]+ m|valueno node)/s);
    await view.waitForFunction(() => /Last roundduration[\d.,]+ µs/.test(document.getElementById('inspection').textContent), null, { polling: 100 });
    assert.match(await view.textContent('#inspection'), /Statevalueempty/); // a program without stored values
    await picture(tab, 'inspected');
    await tab.click('#add');
    await eventually(() => state(view), ({ nodes }) => nodes === 110, '50 nodes should join');
    await view.getByRole('button', { name: 'Remove node' }).click();
    await eventually(() => state(view), ({ nodes }) => nodes === 109, 'the node should be removed');
    await tab.fill('#count', '3');
    await tab.click('#click-adds');
    await view.click('#canvas', { position: { x: 200, y: 300 } });
    await eventually(() => state(view), ({ nodes }) => nodes === 112, 'three nodes should join');
    await tab.click('#click-adds');
    await picture(tab, 'added');
  });

  await t.test('a second page watches, and controls the simulation when the first one has gone', async () => {
    // Pause first: drawing two running simulations without a graphics card takes a long time.
    await view.click('#play');
    const second = await open(live.address);
    await view.click('#play');
    await second.tab.waitForSelector('text=watching');
    assert.ok(await second.tab.isDisabled('#add'));
    const { tick } = await state(second.view);
    await second.view.click('#play');
    await second.tab.waitForSelector('text=Another page controls the simulation');
    await eventually(() => state(second.view), (now) => now.tick > tick + 10, 'the simulation should run');
    await page.close();
    await second.tab.waitForFunction(() => !document.getElementById('add').disabled, null, { polling: 100 });
    page = second;
  });

  await t.test('starts again with another seed and another scene', async () => {
    await page.tab.click('#fields summary');
    await page.tab.fill('[id="control-fields.nodes"]', '20');
    await page.tab.press('[id="control-fields.nodes"]', 'Tab');
    await page.tab.waitForSelector('#fields >> text=at restart');
    await page.tab.fill('#seed', '5');
    await page.tab.click('#restart');
    await eventually(() => state(page.view), ({ nodes }) => nodes === 20, 'the scene should have 20 nodes', 30000);
    assert.match(await page.tab.inputValue('#command'), /--seed 5 .*fields\.nodes=20/);
    await picture(page.tab, 'restarted');
  });

  await t.test('accessibility', async () => {
    assert.deepEqual(await inaccessible(page.tab), []);
    await page.tab.emulateMedia({ colorScheme: 'dark' });
    assert.deepEqual(await inaccessible(page.tab), []);
    await picture(page.tab, 'dark');
    await page.tab.emulateMedia({ colorScheme: 'light' });
  });

  await t.test('a program that throws in every round', async () => {
    await edit(page.tab, 'val obstacle = Vector3()', 'check(sensors.intensity() < 0) { "no intensity" }\n    val obstacle = Vector3()');
    await page.tab.waitForSelector('#state >> text=no intensity');
    const { tick } = await state(page.view);
    await eventually(() => state(page.view), (now) => now.tick > tick + 10, 'the simulation should run');
  });

  await t.test('a program that disappears or has another schema is not loaded', async () => {
    await edit(page.tab, '@Program("gradient-ascent"', '@Program("other"');
    await eventually(() => outcome(page.tab), (text) => /^Not reloaded; .*gradient-ascent/.test(text), 'the error should be reported');
    const { tick } = await state(page.view);
    await eventually(() => state(page.view), (now) => now.tick > tick + 10, 'the simulation should run');
    writeFileSync(program, original);
    await eventually(() => outcome(page.tab), (text) => text.startsWith('reloaded'), 'the program should be reloaded');
  });

  await t.test('a program that never returns stops the simulation, and a restart continues', async () => {
    await edit(page.tab, 'val obstacle = Vector3()', 'while (position.x() < 1e9) Thread.onSpinWait()\n    val obstacle = Vector3()');
    await page.tab.waitForSelector('text=The simulation stopped', { timeout: 30000 });
    assert.match(await page.tab.textContent('#warning'), /rounds did not finish within the time limit of 4000 ms/);
    await picture(page.tab, 'stopped');
    writeFileSync(program, original);
    await eventually(() => page.tab.evaluate(() => window.live.files.text), (text) => text === original, 'the editor should show the file');
    await page.tab.click('#restart');
    await eventually(() => page.tab.textContent('#state'), (text) => text === 'running', 'the simulation should run again', 30000);
  });

  await t.test('a page that sends too many commands is disconnected, and connects again', async () => {
    await page.tab.evaluate(() => { for (let i = 0; i < 1000; i++) window.live.send({ select: i }); });
    await page.tab.waitForSelector('#state >> text=connection lost');
    await eventually(() => page.tab.textContent('#state'), (text) => text === 'running', 'the page should connect again');
  });

  await t.test('a page that reads nothing does not slow the simulation down', async () => {
    await page.view.click('#play');
    const slow = await open(live.address);
    await page.view.click('#play');
    const done = slow.tab.evaluate(() => { for (const end = Date.now() + 4000; Date.now() < end;); });
    const before = await state(page.view);
    await page.tab.waitForTimeout(3000);
    const { tick } = await state(page.view);
    await done;
    assert.ok(tick - before.tick > 40, `only ${tick - before.tick} ticks in 3 s`);
    await slow.close();
  });

  await t.test('saves a scenario', async () => {
    const file = join(folder, 'out/live/GradientAscent/scenario.json');
    writeFileSync(file, `// Scenarios may contain comments.\n${readFileSync(file, 'utf8')}`);
    await page.tab.click('#keep summary');
    await page.tab.click('#save-scenario');
    await page.tab.waitForSelector('#warning >> text=saved as');
    const saved = JSON.parse(readFileSync(join(folder, 'out/live/GradientAscent/live.json'), 'utf8'));
    assert.deepEqual([saved.seed, saved.fields.nodes, saved.timing.period], [5, 20, 0.1]);
    await page.tab.fill('#scenario', 'folder/live.json');
    await page.tab.click('#save-scenario');
    await page.tab.waitForSelector('#warning >> text=enter a file name that ends in .json');
    const elsewhere = join(folder, 'elsewhere.json');
    symlinkSync(elsewhere, join(folder, 'out/live/GradientAscent/linked.json'));
    await page.tab.fill('#scenario', 'linked.json');
    await page.tab.click('#save-scenario');
    await page.tab.waitForSelector('#warning >> text=already exists');
    assert.ok(!existsSync(elsewhere), 'no file is written through a link');
  });

  await t.test('saves a record that can be replayed, while the run continues', async () => {
    const save = async (name, message) => {
      await page.tab.fill('#record', name);
      await page.tab.click('#save-record');
      await page.tab.waitForSelector(`#warning >> text=${message}`);
    };
    await save('run.txt', 'enter a file name that ends in .clkrec');
    await save('linked.json', 'enter a file name that ends in .clkrec');
    await edit(page.tab, 'var x = 0.0', 'var x = 0.00'); // the record contains a reload
    await eventually(() => outcome(page.tab), (text) => text.startsWith('reloaded'), 'the program should be reloaded');
    await save('live.clkrec', 'saved; replay it');
    await save('live.clkrec', 'already exists');
    const replay = spawn(collektive, ['replay', 'out/live/GradientAscent/live.clkrec'], { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'] });
    let output = '';
    for (const stream of [replay.stdout, replay.stderr]) stream.on('data', (data) => { output += data; });
    assert.equal((await once(replay, 'close'))[0], 0, output);
    assert.match(output, /all digests equal the record/);
    writeFileSync(program, original);
  });

  await t.test('keeps line ends, the byte-order mark and links of sources, and does not edit other files', async () => {
    const programs = join(folder, 'out/live/GradientAscent/programs');
    const target = join(folder, 'out/live/GradientAscent/Shared.kt');
    const outside = join(folder, 'Outside.kt');
    writeFileSync(target, '\ufeffpackage gradientascent\r\n\r\nconst val SHARED = 1\r\n');
    writeFileSync(outside, 'package gradientascent\n\nconst val OUTSIDE = 1\n');
    symlinkSync('../Shared.kt', join(programs, 'Shared.kt'));
    symlinkSync(outside, join(programs, 'Outside.kt'));
    writeFileSync(join(programs, 'Latin.kt'), Buffer.from('package gradientascent\n\n// caf\xe9\n', 'latin1'));
    const choose = async (name) => {
      await page.tab.waitForSelector(`#file option[value="${name}"]`, { state: 'attached' });
      await page.tab.selectOption('#file', name);
    };
    await choose('Shared.kt');
    assert.ok(await page.tab.isDisabled('#save'), 'an unchanged file has nothing to save');
    await edit(page.tab, 'SHARED = 1', 'SHARED = 2');
    await eventually(() => readFileSync(target, 'utf8'), (text) => text === '\ufeffpackage gradientascent\r\n\r\nconst val SHARED = 2\r\n', 'saved');
    assert.ok(lstatSync(join(programs, 'Shared.kt')).isSymbolicLink());
    for (const [name, reason] of [['Outside.kt', "the file is a link to '"], ['Latin.kt', 'the file is not UTF-8 (byte 30)']]) {
      await choose(name);
      await page.tab.waitForSelector(`#problem >> text=Read-only: ${reason}`);
      const before = readFileSync(join(programs, name));
      await page.tab.focus('.cm-content');
      await page.tab.keyboard.type('x');
      assert.ok(await page.tab.isDisabled('#save'));
      await page.tab.evaluate((file) => window.live.send({ save: file, text: 'changed', base: '' }), name);
      await page.tab.waitForSelector(`#warning >> text=${reason}`);
      assert.deepEqual(readFileSync(join(programs, name)), before);
    }
    await picture(page.tab, 'read-only');
    for (const name of ['Shared.kt', 'Outside.kt', 'Latin.kt']) rmSync(join(programs, name));
    await page.tab.waitForSelector('#problem', { state: 'hidden' });
  });

  await t.test('opens a lesson in place of the scenario, and asks before it discards changes', async () => {
    const current = page.tab;
    const opened = (name) => eventually(() => current.textContent('#name'), (text) => text === name, `${name} should be open`, 60000);
    await current.click('#examples summary');
    assert.equal(await current.locator('#examples li').count(), 11);
    assert.match(await current.textContent('#examples li'), /^GradientA gradient is the distance .*Question: replace hopDistanceTo/);
    await picture(current, 'examples');
    await current.evaluate(() => {
      const { view: editor } = window.live.files;
      editor.dispatch({ changes: { from: 0, insert: '// unsaved\n' } });
    });
    const answers = ['dismiss', 'accept'];
    current.on('dialog', (dialog) => dialog[answers.shift()]());
    await current.click('#examples >> text="Healing"');
    assert.equal(answers.length, 1);
    assert.match(await current.evaluate(() => window.live.files.text), /^\/\/ unsaved/);
    await current.click('#examples >> text="Healing"');
    await opened('healing');
    assert.match(await current.evaluate(() => window.live.files.text), /^\/\/ Aggregate programs heal/);
    assert.match(await current.inputValue('#command'), /live out\/live\/healing\/scenario.json$/);
    await eventually(() => state(page.view), ({ nodes, tick }) => nodes === 100 && tick > 2, 'the lesson should run');
    await page.view.evaluate(() => window.replay.select(3));
    await page.view.waitForFunction(() => /State(?!value).+ > .+\d/.test(document.getElementById('inspection').textContent), null, { polling: 100 });
    // Long values wrap, and leave room for the names.
    assert.ok(await page.view.evaluate(() => [...document.querySelectorAll('#inspection dt')].every((term) => term.offsetWidth > 50)));
    await picture(current, 'lesson');
    await current.evaluate(() => window.live.send({ open: 'nothing' }));
    await current.waitForSelector('#warning >> text=unknown example');
    // A program that cannot be compiled can also be opened.
    const broken = join(folder, 'out/live/channel');
    mkdirSync(join(broken, 'programs'), { recursive: true });
    const lesson = new URL('../../../scripts/lessons/channel/', import.meta.url);
    writeFileSync(join(broken, 'scenario.json'), readFileSync(new URL('scenario.json', lesson)));
    const source = readFileSync(new URL('programs/Channel.kt', lesson), 'utf8');
    writeFileSync(join(broken, 'programs/Channel.kt'), source.replace('length > 0', 'nothing > 0'));
    await current.click('#examples summary');
    await current.click('#examples >> text="Channel"');
    await opened('channel');
    await current.waitForSelector('#warning >> text=The simulation stopped');
    await current.waitForSelector('.cm-lintRange-error', { timeout: 15000 });
    await edit(current, 'nothing > 0', 'length > 0');
    await eventually(() => outcome(current), (text) => text.startsWith('compiled'), 'the program should be compiled');
    await current.click('#restart');
    await eventually(() => current.textContent('#state'), (text) => text === 'running', 'the lesson should run', 30000);
    assert.deepEqual(page.complaints, []);
  });

  await t.test('refuses other hosts, origins and tokens, and answers the page only', async () => {
    const { host } = new URL(live.address);
    assert.equal(await statusOf(live.address, {}), 200);
    assert.equal(await statusOf(live.address, { Host: 'example.org' }), 403);
    assert.equal(await statusOf(live.address, {}, '/wrong-token/'), 403);
    assert.equal(await statusOf(live.address, {}, 'other'), 404);
    assert.equal(await statusOf(live.address, { ...HANDSHAKE, Origin: 'http://example.org' }, 'socket'), 403);
    assert.equal(await statusOf(live.address, HANDSHAKE, 'socket'), 403);
    assert.equal(await statusOf(live.address, { ...HANDSHAKE, Origin: `http://${host}` }, '/wrong-token/socket'), 403);
  });

  await t.test('reports a port in use', async () => {
    const other = await start('--port', new URL(live.address).port);
    assert.equal((await other.ended)[0], 1);
    assert.match(other.output, /port \d+ is in use: choose another one/);
  });

  await t.test('Ctrl-C ends the command and its processes; the page reports it', async () => {
    assert.equal(await stop(live), 0);
    await page.tab.waitForSelector('#state >> text=connection lost');
    assert.ok(existsSync(program));
    live = null;
    await page.close();
  });

  if (live) await stop(live);
  await browser.close();
});
