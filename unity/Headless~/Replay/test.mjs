// Tests a replay page in headless Chromium: node [TEST OPTIONS] test.mjs replay.html [expected.json]
// expected.json contains frames of a page of SampleReplay: [{ frame, time, nodes: [[id, x, y, z, scalar]], links: [[from, to]] }]. With it, only its
// content is tested.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import suite from 'node:test';
import { pathToFileURL } from 'node:url';
import { gunzipSync, gzipSync } from 'node:zlib';
import { launch } from './browser.mjs';

const [file, expected] = process.argv.slice(2);
if (!file) {
  console.error('Usage: node test.mjs replay.html [expected.json]');
  process.exit(2);
}

// Small pictures, because drawing is slow without a graphics card.
const SIZE = { width: 1040, height: 600 };
const folder = mkdtempSync(join(tmpdir(), 'replay-test-'));
const html = readFileSync(file, 'utf8');
const axe = readFileSync(join(process.env.COLLEKTIVE_NODE_MODULES, 'axe-core/axe.min.js'), 'utf8');
const DATA = /(<script id="replay"[^>]*>)([^<]*)(<\/script>)/;
const browser = await launch();
const blind = await launch(undefined, ['--disable-3d-apis']);

/** Opens a page and collects its errors and requests. */
async function open(path, { in: where = browser, ...options } = {}) {
  const context = await where.newContext({ viewport: SIZE, ...options });
  const tab = await context.newPage();
  const url = pathToFileURL(resolve(path)).href;
  // The texts of charts, and where they begin in their canvas.
  await tab.addInitScript(() => {
    const { prototype } = window.CanvasRenderingContext2D;
    const { fillText } = prototype;
    window.texts = [];
    prototype.fillText = function record(text, x, y) {
      window.texts.push({ text, left: this.getTransform().e + x - this.measureText(text).actualBoundingBoxLeft });
      fillText.call(this, text, x, y);
    };
  });
  const complaints = [];
  tab.on('console', (message) => {
    const complains = ['error', 'warning'].includes(message.type()) && !message.text().includes('GPU stall due to ReadPixels');
    if (complains) complaints.push(message.text());
  });
  tab.on('pageerror', (error) => complaints.push(error.message));
  tab.on('request', (request) => request.url() !== url && !request.url().startsWith('data:') && complaints.push(`fetched ${request.url()}`));
  await tab.goto(url);
  return { tab, complaints, close: () => context.close() };
}

const state = (tab) => tab.evaluate(() => {
  const { frame, time, playing, nodes, links, other } = window.replay.state();
  return { frame, time, playing, nodes: nodes.length, links: links.length, other };
});

const seek = (tab, frame) => tab.evaluate((i) => window.replay.seek(i), frame);

/** Waits until the page shows a frame. */
const arrives = (tab, frame, message) => eventually(tab, (now) => now.frame === frame, message);

/** Returns the current content of the canvas. */
const canvas = (tab) => tab.evaluate(() => {
  window.replay.draw();
  return document.getElementById('canvas').toDataURL();
});

const colours = (tab) => tab.evaluate(() => {
  window.replay.draw();
  const from = document.getElementById('canvas');
  const to = new OffscreenCanvas(from.width, from.height).getContext('2d');
  to.drawImage(from, 0, 0);
  return new Set(new Uint32Array(to.getImageData(0, 0, from.width, from.height).data.buffer)).size;
});

/** Returns points of the page where a click selects a node, one for every four square pixels. The middle one comes first. */
const placesOf = (tab, node) => tab.evaluate((id) => {
  const found = [];
  for (let x = 0; x < window.innerWidth; x += 2) for (let y = 0; y < window.innerHeight; y += 2) if (window.replay.at(x, y) === id) found.push([x, y]);
  return [[0, 1].map((axis) => found.reduce((sum, point) => sum + point[axis], 0) / found.length), ...found];
}, node);

/** Returns the number of pixels of the picture with nearly a given colour. `element` limits the search to the pixels below it. */
const pixels = (tab, wanted, element = '#canvas') => tab.evaluate(([rgb, selector]) => {
  window.replay.draw();
  const from = document.getElementById('canvas');
  const { x, y, width, height } = document.querySelector(selector).getBoundingClientRect();
  const to = new OffscreenCanvas(width, height).getContext('2d');
  to.drawImage(from, -x, -y);
  const { data } = to.getImageData(0, 0, width, height);
  let count = 0;
  for (let i = 0; i < data.length; i += 4) if (rgb.every((value, channel) => Math.abs(data[i + channel] - value) < 24)) count++;
  return { count, share: count / (data.length / 4) };
}, [wanted, element]);
const ACCENT = [0xd6, 0x33, 0x6c];
const BACKGROUND = [0xee, 0xf1, 0xf4];

/** Waits until `holds(state)` is true. */
async function eventually(tab, holds, message) {
  let now;
  for (const end = Date.now() + 15000; Date.now() < end; await tab.waitForTimeout(50)) {
    now = await state(tab);
    if (holds(now)) return;
  }
  throw new Error(`${message}; it is ${JSON.stringify(now)}`);
}

/** Resizes the window and waits for its picture. */
async function resize(tab, size) {
  await tab.setViewportSize(size);
  await tab.waitForFunction(({ width, height }) => {
    const c = document.getElementById('canvas');
    return c.width === width * devicePixelRatio && c.height === height * devicePixelRatio;
  }, size, { timeout: 5000 });
}

/** Returns violations of WCAG 2.2 A and AA and of axe-core's best practices. */
async function inaccessible(tab) {
  await tab.evaluate(axe);
  const { violations } = await tab.evaluate(() => window.axe.run());
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target, failureSummary }) => `${target} ${failureSummary}`).join('; ')}`);
}

/** Returns the file that a click downloads. */
async function download(tab, button) {
  const [file] = await Promise.all([tab.waitForEvent('download'), tab.click(button)]);
  return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
}

/** Returns a copy of the page with a changed header or changed segments. */
const withHeader = (name, change) => withData(name, (data) => {
  const [first, ...segments] = data.split('\n');
  const header = JSON.parse(gunzipSync(Buffer.from(first, 'base64')));
  change(header, segments);
  header.length = segments.reduce((sum, segment) => sum + 1 + segment.length, 0);
  return [gzipSync(JSON.stringify(header)).toString('base64'), ...segments].join('\n');
});

/** Returns a copy of the page with changed data. */
function withData(name, change) {
  const path = join(folder, `${name}.html`);
  writeFileSync(path, html.replace(DATA, (_, before, data, after) => before + change(data) + after));
  return path;
}

async function expectMessage(path, words, options) {
  const { tab, complaints, close } = await open(path, options);
  const error = await tab.evaluate(async () => {
    try {
      await window.replay.ready;
      for (let i = 0; i < window.replay.frames; i++) await window.replay.seek(i);
      return null;
    } catch (e) {
      return e.message;
    }
  });
  const shown = await tab.locator('#message').isVisible() ? await tab.locator('#message').innerText() : '(nothing)';
  const controls = await tab.locator('#controls').isVisible();
  await close();
  assert.ok(error !== null, 'all frames are shown');
  assert.ok(words.test(shown), `the page shows: ${shown}`);
  assert.ok(!controls, 'the controls are there');
  assert.deepEqual(complaints, []);
}

/** Runs the tests that need a run with known content. */
async function testSample(test, tab) {
  await resize(tab, SIZE);
  if (await tab.locator('#charts').isHidden()) await tab.click('#charts-shown');

  await test('chart labels are not cut off and have units', async () => {
    const texts = await tab.evaluate(() => window.texts);
    assert.ok(texts.some(({ text }) => text.includes('00,000')), 'no large number');
    assert.deepEqual(texts.filter(({ left }) => left < 0), []);
    assert.ok(texts.some(({ text }) => text === '10 s'), `no seconds: ${texts.map(({ text }) => text).join()}`);
    assert.match(await tab.innerText('#ticks'), / lx$/);
  });

  await test('show(t) shows the frame of that time', async () => {
    for (let frame = 0; frame < 200; frame++) {
      await tab.evaluate((time) => window.replay.show(time), Number((0.1 * frame).toFixed(1)));
      assert.equal((await state(tab)).frame, frame);
    }
  });

  await test('header and chart have the same number of links', async () => {
    await seek(tab, 50);
    const { links } = await state(tab);
    assert.equal(await tab.innerText('#link-count'), `${links} links`);
    assert.equal(await tab.innerText('#charts figure:last-child output'), String(links));
  });

  await test('categories have colours far apart', async () => {
    await tab.selectOption('#field', 'leader');
    const found = await tab.$$eval('#categories i', (dots) => dots.map((dot) => getComputedStyle(dot).backgroundColor.match(/\d+/g).map(Number)));
    assert.equal(found.length, 8);
    for (const a of found) for (const b of found) assert.ok(a === b || Math.hypot(...a.map((value, i) => value - b[i])) > 60, `${a} and ${b}`);
    await tab.selectOption('#field', { index: 0 });
  });

  await test('the histogram counts the nodes of each part of the scale', async () => {
    const { values, range, label, heights } = await tab.evaluate(() => ({
      values: window.replay.state().nodes.map(({ scalar }) => scalar).filter((value) => !Number.isNaN(value)),
      range: ['range-min', 'range-max'].map((id) => document.getElementById(id).valueAsNumber),
      label: document.getElementById('histogram').getAttribute('aria-label'),
      heights: [...document.getElementById('histogram').children].map(({ style }) => parseFloat(style.height)),
    }));
    const counts = new Array(heights.length).fill(0);
    for (const value of values) counts[Math.min(Math.floor(((value - range[0]) / (range[1] - range[0])) * counts.length), counts.length - 1)]++;
    const most = Math.max(...counts);
    assert.match(label, new RegExp(`at most ${most} nodes`));
    assert.deepEqual(heights.map((height) => Math.round((height * most) / 100)), counts);
  });

  await test('the selected node shows a chart and the directions of its links', async () => {
    await tab.evaluate(() => window.replay.select(5));
    await tab.locator('#history figure').waitFor();
    for (const frame of [10, 150]) {
      await seek(tab, frame);
      const value = await tab.evaluate(() => window.replay.state().nodes.find(({ id }) => id === 5).scalar);
      assert.ok(Math.abs(Number(await tab.innerText('#history output')) - value) < 0.01, `frame ${frame}`);
    }
    assert.match(await tab.getAttribute('#history .uplot', 'aria-label'), /^brightness \(lx\) from 0 to 19.9 s: .*minimum .* lx/);
    const words = await tab.$$eval('#neighbour-list button', (buttons) => buttons.map((button) => button.textContent));
    // Links of SampleReplay, in which node 7 is missing.
    assert.deepEqual(words, ['3', 'from 4', 'to 6']);
  });

  await test('following a node moves the camera close to it', async () => {
    const far = await placesOf(tab, 5);
    await tab.check('#follow');
    const near = await placesOf(tab, 5);
    assert.ok(near.length > 100 && near.length > 1.3 * far.length, `4 x ${near.length} pixels, ${far.length} before`);
    await tab.uncheck('#follow');
  });

  await test('Escape closes the list of keys, then deselects', async () => {
    await tab.click('#help');
    await tab.keyboard.press('Escape');
    assert.deepEqual([await tab.locator('#keys').isVisible(), await tab.getAttribute('#help', 'aria-expanded')], [false, 'false']);
    assert.ok(await tab.locator('#selection').isVisible(), 'it deselects');
    await tab.keyboard.press('Escape');
    assert.ok(await tab.locator('#selection').isHidden(), 'it does not deselect');
  });

  await test('a focused view shows a hint instead of an outline', async () => {
    await tab.focus('#field');
    await tab.keyboard.press('Shift+Tab');
    assert.equal(await tab.evaluate(() => document.activeElement.id), 'canvas');
    assert.equal(await tab.locator('#canvas').evaluate((view) => getComputedStyle(view).outlineStyle), 'none');
    assert.ok(await tab.locator('#hint').isVisible(), 'the hint is hidden');
  });

  await test('the legend does not cover the arena', async () => {
    await tab.keyboard.press('r');
    for (const [width, height] of [[1280, 720], [400, 800]]) {
      await resize(tab, { width, height });
      for (const field of [0, 1]) {
        await tab.selectOption('#field', { index: field });
        assert.equal((await pixels(tab, BACKGROUND, '#legend')).share, 1, `${width} pixels, field ${field}`);
      }
    }
    await tab.selectOption('#field', { index: 0 });
    await resize(tab, SIZE);
  });

  await test('capsules are drawn as capsules', async () => {
    const pictures = new Set();
    for (const [name, change] of [
      ['upright', () => {}], ['ball', (header) => { header.metadata.nodeHeight = 0; }], ['lying', (header) => { header.metadata.shapes[2].axis = 0; }],
      ['short', (header) => { header.metadata.shapes[2].height = 2; }],
    ]) {
      const page = await open(withHeader(name, change));
      await page.tab.evaluate(() => window.replay.ready);
      pictures.add(await canvas(page.tab));
      await page.close();
    }
    assert.equal(pictures.size, 4);
  });

  await test('two runs are shown side by side on one clock', async () => {
    await resize(tab, { width: 1000, height: 500 });
    const alone = await canvas(tab);
    await tab.setInputFiles('#other-file', withHeader('shorter', (header, segments) => {
      header.times.length = 60;
      segments.length = 60 / header.framesPerSegment;
      header.metrics.series[0].values.fill(0);
      header.fields[0].name = 'other';
    }));
    await tab.locator('.side >> nth=1').waitFor();
    await eventually(tab, (now) => now.other !== null, 'the other run did not load');
    for (const [time, frame, otherFrame] of [[3, 30, 30], [10, 100, 59]]) {
      await tab.evaluate((t) => window.replay.show(t), time);
      const now = await state(tab);
      assert.deepEqual([now.frame, now.other.frame], [frame, otherFrame]);
    }
    assert.equal((await state(tab)).other.nodes, await tab.innerText('#other-counts').then((text) => parseInt(text.replace(',', ''), 10)));
    assert.match(await tab.$eval('#charts output', (output) => output.value), / \| 0$/);
    const [left, right] = await tab.$$eval('.side', (sides) => sides.map((side) => side.getBoundingClientRect()));
    assert.ok(left.x + left.width <= right.x && right.x + right.width <= 1000, 'the views overlap');
    const second = () => tab.evaluate(() => document.querySelectorAll('.side canvas')[1].toDataURL());
    const [firstBefore, secondBefore] = [await canvas(tab), await second()];
    await tab.mouse.move(right.x + 100, 200);
    await tab.mouse.down();
    await tab.mouse.move(right.x + 160, 220, { steps: 4 });
    await tab.mouse.up();
    await tab.waitForTimeout(300);
    assert.notEqual(await canvas(tab), firstBefore, 'the first view does not turn with the second');
    assert.notEqual(await second(), secondBefore);
    await tab.evaluate(() => window.replay.select(8));
    await tab.waitForFunction(() => document.querySelector('#history output')?.value.endsWith(' | none'));
    assert.match(await tab.innerText('#selected-values'), / \| /);
    const { bytes } = await download(tab, '#picture');
    assert.equal(bytes.readUInt32BE(16), 1000);
    assert.deepEqual(await inaccessible(tab), []);
    await tab.click('#compare');
    await tab.evaluate(() => {
      window.replay.select(NaN);
      window.replay.view('above');
      return window.replay.seek(150);
    });
    assert.equal(await tab.locator('.side').count(), 1);
    assert.equal(await canvas(tab), alone, 'the single view is not restored');
  });

  await test('the key End shows the end of a longer run', async () => {
    const short = await open(join(folder, 'shorter.html'));
    await short.tab.evaluate(([page]) => window.replay.ready.then(() => window.replay.compare(page)), [html]);
    await short.tab.keyboard.press('End');
    await eventually(short.tab, (now) => now.other.frame === 199, 'the longer run is not at its end');
    await short.close();
  });

  await test('a file that is not a replay page is rejected with a message', async () => {
    await tab.setInputFiles('#other-file', expected);
    await tab.locator('#compare-error').waitFor();
    assert.match(await tab.innerText('#compare-error'), /not a replay page/);
  });
}

await suite('replay page', async (page) => {
  const test = page.test.bind(page);
  page.after(async () => {
    await Promise.all([browser.close(), blind.close()]);
    rmSync(folder, { recursive: true });
  });
  // Small pictures are sufficient for comparisons.
  const { tab, complaints, close } = await open(file, expected ? { viewport: { width: 480, height: 270 } } : {});
  try {
    const loaded = await tab.evaluate(() => window.replay.ready.then(() => performance.now()));
    const frames = await tab.evaluate(() => window.replay.frames);
    const middle = Math.floor((frames - 1) / 2);
    await seek(tab, middle);
    const { nodes, links } = await state(tab);

    if (expected) {
      await test('frames contain the written data', async () => {
        for (const wanted of JSON.parse(readFileSync(expected, 'utf8'))) {
          await seek(tab, wanted.frame);
          const found = await tab.evaluate(() => window.replay.state());
          assert.equal(found.time, wanted.time, `frame ${wanted.frame}`);
          assert.equal(found.nodes.length, wanted.nodes.length, `nodes of frame ${wanted.frame}`);
          const byId = new Map(found.nodes.map((node) => [node.id, node]));
          for (const [id, x, y, z, scalar] of wanted.nodes) {
            const node = byId.get(id);
            const same = ([a, b]) => Math.abs(a - b) < 0.005 || (Number.isNaN(a) && Number.isNaN(b));
            const near = node && [[node.x, x], [node.y, y], [node.z, z], [node.scalar, scalar ?? NaN]].every(same);
            assert.ok(near, `frame ${wanted.frame}: node ${id} is ${JSON.stringify(node)}`);
          }
          const links = (pairs) => pairs.map((pair) => pair.join('-')).sort().join(' ');
          assert.equal(links(found.links), links(wanted.links), `links of frame ${wanted.frame}`);
        }
      });
      if (nodes >= 9000) {
        // Half of a frame's time in a browser with a graphics card. Drawing is not counted, because this browser renders on the CPU.
        await test('scripts take under 6 ms per frame at 60 frames per second', async () => {
          const { mean, greatest } = await tab.evaluate(async () => {
            let [sum, most] = [0, 0];
            for (let picture = 0; picture < 240; picture++) {
              const start = performance.now();
              const wait = window.replay.show(picture / 60);
              const took = performance.now() - start;
              await wait;
              sum += took;
              most = Math.max(most, took);
            }
            return { mean: sum / 240, greatest: most };
          });
          console.log(`      ${mean.toFixed(2)} ms a picture, ${greatest.toFixed(1)} ms at most`);
          assert.ok(mean < 6, `${mean.toFixed(2)} ms`);
        });

        await test('a frame of a large run is the same after seeking forwards or backwards', async () => {
          const found = await tab.evaluate(async ([wanted, last]) => {
            const texts = [];
            for (const from of [0, wanted - 1, last, wanted + 1]) {
              await window.replay.seek(from);
              await window.replay.seek(wanted);
              texts.push(JSON.stringify(window.replay.state()));
            }
            return new Set(texts).size;
          }, [middle, frames - 1]);
          assert.equal(found, 1, 'different states');
        });

        await test('a large run shows a picture', async () => {
          const found = await colours(tab);
          assert.ok(found > 200, `${found} colours`);
        });

        await test('the selected node is visible among thousands', async () => {
          const before = await pixels(tab, ACCENT);
          await tab.evaluate(() => window.replay.select(4001));
          const marked = (await pixels(tab, ACCENT)).count - before.count;
          assert.ok(marked > 60, `${marked} pixels`);
        });

        await test('the chart of the selected node appears within five seconds', async () => {
          await tab.locator('#history figure').waitFor({ state: 'attached', timeout: 5000 });
        });
      } else await testSample(test, tab);
      await test('no error, no warning, nothing fetched', async () => assert.deepEqual(complaints, []));
      await test('the page loads within six seconds', async () => {
        // Two seconds in a browser with a graphics card on an idle machine.
        assert.ok(loaded < 6000, `${loaded.toFixed(0)} ms`);
        console.log(`      loaded in ${loaded.toFixed(0)} ms`);
      });
      return;
    }

    await test('the canvas shows a picture', async () => {
      const found = await colours(tab);
      assert.ok(found > 200, `${found} colours`);
    });

    // Shorter runs would end before this test can observe them.
    await seek(tab, frames - 1);
    const plays = (await state(tab)).time >= 1;

    if (plays) {
      await test('play advances the time and pause stops it', async () => {
        await tab.selectOption('#speed', '0.25');
        await seek(tab, 0);
        const start = (await state(tab)).time;
        await tab.click('#play');
        await eventually(tab, (now) => now.time > start, 'the time does not advance');
        await tab.click('#play');
        const paused = await state(tab);
        await tab.waitForTimeout(300);
        assert.ok(!paused.playing && (await state(tab)).time === paused.time, 'the time still advances');
      });

      await test('the run stops at its end and starts again', async () => {
        await seek(tab, frames - 2);
        await tab.evaluate(() => window.replay.play());
        await eventually(tab, (now) => !now.playing && now.frame === frames - 1, 'it does not stop at the last frame');
        await tab.evaluate(() => window.replay.play());
        await eventually(tab, (now) => now.frame < frames - 1, 'it does not start again');
        await tab.evaluate(() => window.replay.pause());
      });

      await test('space plays and pauses, on the page and on the play button', async () => {
        for (const focus of ['document.activeElement.blur()', 'document.getElementById("play").focus()']) {
          await tab.evaluate(focus);
          await seek(tab, 0);
          await tab.keyboard.press(' ');
          assert.ok((await state(tab)).playing, `space does not play after ${focus}`);
          await tab.keyboard.press(' ');
          assert.ok(!(await state(tab)).playing, `space does not pause after ${focus}`);
        }
        await tab.selectOption('#speed', '1');
      });
    }

    if (frames > 1) {

      await test('the scrub bar reaches every frame and changes the picture', async () => {
        await tab.locator('#scrub').fill('0');
        await arrives(tab, 0, 'not at the first frame');
        const first = await canvas(tab);
        await tab.locator('#scrub').fill(String(frames - 1));
        await arrives(tab, frames - 1, 'not at the last frame');
        assert.ok(nodes === 0 || (await canvas(tab)) !== first, 'first and last frame look the same');
      });

      await test('a frame does not depend on how it was reached', async () => {
        const all = (order) => tab.evaluate(async ([indices, wanted]) => {
          let found;
          for (const i of indices) {
            await window.replay.seek(i);
            if (i === wanted) found = JSON.stringify(window.replay.state());
          }
          return found;
        }, [order, middle]);
        const forward = await all(Array.from({ length: middle + 1 }, (_, i) => i));
        const backward = await all(Array.from({ length: frames - middle }, (_, i) => frames - 1 - i));
        assert.ok(forward === backward && forward === await all([0, frames - 1, middle]), 'the states differ');
      });

      await test('seeking is instant', async () => {
        const each = await tab.evaluate(async (count) => {
          const start = performance.now();
          for (let i = 0; i < 100; i++) await window.replay.seek((i * 7919) % count);
          return (performance.now() - start) / 100;
        }, frames);
        assert.ok(each < 50, `${each.toFixed(1)} ms`);
        console.log(`      ${each.toFixed(2)} ms a seek, ${frames} frames, ${nodes} nodes and ${links} links in the middle`);
      });

      await test('keyboard shortcuts work', async () => {
        await tab.evaluate(() => document.activeElement.blur());
        await seek(tab, 0);
        await tab.keyboard.press('ArrowRight');
        await arrives(tab, 1, 'ArrowRight does not seek to the next frame');
        await tab.keyboard.press('ArrowLeft');
        await arrives(tab, 0, 'ArrowLeft does not seek to the previous frame');
        await tab.keyboard.press('End');
        await arrives(tab, frames - 1, 'End does not seek to the last frame');
        await tab.keyboard.press('Home');
        await arrives(tab, 0, 'Home does not seek to the first frame');
        await tab.keyboard.press('l');
        assert.ok(!(await tab.isChecked('#links')), 'l does not hide the links');
        await tab.keyboard.press('l');
        await tab.keyboard.press('.');
        assert.ok((await tab.inputValue('#speed')) === '2', '. is not faster');
        await tab.keyboard.press(',');
        assert.ok((await tab.inputValue('#speed')) === '1', ', is not slower');
      });
    }

    if (links > 0) {
      await test('links can be hidden and shown', async () => {
        await seek(tab, middle);
        const shown = await canvas(tab);
        await tab.uncheck('#links');
        const hidden = await canvas(tab);
        await tab.check('#links');
        assert.ok(shown !== hidden, 'the picture stays the same');
        assert.ok(shown === await canvas(tab), 'the links are not shown again');
      });
    }

    if (nodes > 0) {
      await test('a node is selected by its id, shows its neighbours, and is deselected', async () => {
        await seek(tab, middle);
        const { id, neighbours } = await tab.evaluate(() => {
          const { nodes: all, links: pairs } = window.replay.state();
          const some = pairs.length ? pairs[0][0] : all[0].id;
          return { id: some, neighbours: new Set(pairs.filter((pair) => pair.includes(some)).flat()).size - 1 };
        });
        const before = await canvas(tab);
        await tab.fill('#find', String(id));
        await tab.keyboard.press('Enter');
        const text = await tab.innerText('#selection');
        assert.ok(text.includes(`Node ${id}`) && text.includes(`${neighbours.toLocaleString('en')} neighbour`), `the page shows: ${text}`);
        assert.ok((await canvas(tab)) !== before, 'the node is not highlighted');
        await tab.click('#deselect');
        assert.ok((await canvas(tab)) === before, 'the highlight stays');
      });

      await test('a click selects a node', async () => {
        await seek(tab, 0);
        const id = await tab.evaluate(() => {
          window.replay.select(window.replay.state().nodes[0].id);
          return document.getElementById('selected-name').textContent;
        });
        await tab.evaluate(() => window.replay.select(NaN));
        assert.ok(await tab.locator('#selection').isHidden(), `${id} stays selected`);
        let found = false;
        for (let y = 120; y < 380 && !found; y += 12) {
          for (let x = 260; x < 780 && !found; x += 12) {
            await tab.mouse.click(x, y);
            found = await tab.locator('#selection').isVisible();
          }
        }
        assert.ok(found, 'no click finds a node');
        await tab.evaluate(() => document.activeElement.blur());
        await tab.keyboard.press('Escape');
        assert.ok(await tab.locator('#selection').isHidden(), 'Escape does not deselect');
      });
    }

    await resize(tab, { width: 800, height: 500 });

    if (nodes > 0) {
      await test('another field colours the nodes and fills the legend', async () => {
        await seek(tab, middle);
        const before = await canvas(tab);
        const fields = await tab.evaluate(() => window.replay.fields);
        assert.ok(['node', 'neighbours', 'speed', 'height'].every((name) => fields.includes(name)), fields.join());
        await tab.selectOption('#field', 'node');
        assert.notEqual(await canvas(tab), before);
        assert.match(await tab.innerText('#categories'), /\d+ · 1 node\n.*and \d+ more/s);
        assert.ok(await tab.locator('#scale').isHidden());
        await tab.selectOption('#field', { index: 0 });
        assert.equal(await canvas(tab), before);
      });

      await test('palette and range change the colours', async () => {
        await tab.selectOption('#field', 'neighbours');
        await tab.click('#colouring summary');
        const before = await canvas(tab);
        await tab.selectOption('#palette', 'Plasma');
        const plasma = await canvas(tab);
        assert.notEqual(plasma, before, 'palette');
        await tab.fill('#range-max', '1000');
        await tab.keyboard.press('Enter');
        assert.notEqual(await canvas(tab), plasma, 'range');
        assert.match(await tab.innerText('#ticks'), /1,000/);
        await tab.click('#fit');
        assert.equal(await canvas(tab), plasma, 'the range of the current frame');
        await tab.click('#colouring summary');
        await tab.selectOption('#field', { index: 0 });
      });

      await test('keys step through the nodes, and a button selects a neighbour', async () => {
        await tab.evaluate(() => document.activeElement.blur());
        const ids = await tab.evaluate(() => window.replay.state().nodes.map(({ id }) => id).sort((a, b) => a - b));
        const selected = () => tab.innerText('#selected-name');
        for (const id of ids.slice(0, 3)) {
          await tab.keyboard.press('n');
          assert.equal(await selected(), `Node ${id}`);
        }
        await tab.keyboard.press('b');
        assert.equal(await selected(), `Node ${ids[1]}`);
        const linked = await tab.evaluate(() => window.replay.state().links[0]);
        if (linked) {
          await tab.evaluate((id) => window.replay.select(id), linked[0]);
          await tab.click(`#neighbour-list button[aria-label$=": select node ${linked[1]}"]`);
          assert.equal(await selected(), `Node ${linked[1]}`);
        }
        await tab.keyboard.press('Escape');
      });

      if (links > 0) {
        await test('links can be limited to those of the selected node', async () => {
          const all = await canvas(tab);
          await tab.uncheck('#links');
          const none = await canvas(tab);
          await tab.check('#links');
          await tab.check('#links-selected');
          assert.equal(await canvas(tab), none, 'trails without a selected node');
          const linked = await tab.evaluate(() => window.replay.state().links[0][0]);
          await tab.evaluate((id) => window.replay.select(id), linked);
          const some = await canvas(tab);
          await tab.uncheck('#links');
          assert.notEqual(await canvas(tab), some);
          await tab.check('#links');
          await tab.uncheck('#links-selected');
          await tab.evaluate(() => window.replay.select(NaN));
          assert.equal(await canvas(tab), all);
        });
      }
    }

    if (plays && nodes > 0) {
      await test('trails show earlier positions of the nodes', async () => {
        await seek(tab, frames - 1);
        const without = await canvas(tab);
        await tab.check('#trails');
        await tab.waitForTimeout(300);
        assert.notEqual(await canvas(tab), without);
        await tab.uncheck('#trails');
        assert.equal(await canvas(tab), without);
      });

      await test('the camera follows the selected node', async () => {
        await seek(tab, 0);
        if (await tab.getAttribute('#charts-shown', 'aria-pressed') === 'true') await tab.click('#charts-shown');
        const id = await tab.evaluate(() => window.replay.state().nodes[0].id);
        await tab.evaluate((some) => window.replay.select(some), id);
        await tab.check('#follow');
        const [first] = await placesOf(tab, id);
        for (const frame of [0, middle, frames - 1]) {
          await seek(tab, frame);
          await canvas(tab);
          assert.equal(await tab.evaluate(([x, y]) => window.replay.at(x, y), first), id, `frame ${frame}`);
        }
        await tab.uncheck('#follow');
        await tab.click('#deselect');
        await tab.keyboard.press('r');
      });

      await test('the step buttons move by one frame', async () => {
        await seek(tab, 1);
        await tab.click('#step-on');
        await arrives(tab, 2, 'not the next frame');
        await tab.click('#step-back');
        await arrives(tab, 1, 'not the frame before');
        assert.match(await tab.innerText('#position'), /tick [1-9]/);
      });

      await test('a video plays to the end and is saved', async () => {
        await seek(tab, frames - 30);
        const { name, bytes } = await download(tab, '#video');
        assert.match(name, /-seed\d+\.webm$/);
        assert.equal(bytes.readUInt32BE(0), 0x1a45dfa3, 'WebM');
        assert.ok(bytes.length > 10000, `${bytes.length} bytes`);
        assert.equal((await state(tab)).frame, frames - 1);
      });
    }

    if (await tab.locator('#charts-shown').isVisible()) {
      await test('charts follow the clock, and a click on one sets it', async () => {
        await seek(tab, 0);
        if (await tab.locator('#charts').isHidden()) await tab.keyboard.press('c');
        const line = () => tab.locator('#charts .now').first().evaluate((now) => now.getBoundingClientRect().left);
        const start = await line();
        await seek(tab, frames - 1);
        assert.ok(await line() > start + 100, 'the line does not move');
        const over = await tab.locator('#charts .u-over').first().boundingBox();
        await tab.mouse.click(over.x + over.width / 2, over.y + over.height / 2);
        await eventually(tab, (now) => Math.abs(now.frame - frames / 2) < frames / 20 + 1, 'the click does not set the clock');
      });
    }

    await test('the current view can be saved as a picture', async () => {
      const { name, bytes } = await download(tab, '#picture');
      assert.match(name, /-seed\d+-[\d.]+s\.png$/);
      assert.deepEqual([bytes.readUInt32BE(0), bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [0x89504e47, 800, 500]);
    });

    await test('Tab reaches every control and is never trapped', async () => {
      await tab.evaluate(() => document.activeElement.blur());
      const wanted = await tab.evaluate(() => [...document.querySelectorAll('canvas[tabindex], button, select, input, summary')]
        .filter((each) => each.checkVisibility()).map(({ id, tagName }) => id || tagName));
      const reached = [];
      for (let i = 0; i < wanted.length + 8; i++) {
        await tab.keyboard.press('Tab');
        reached.push(await tab.evaluate(() => document.activeElement.id || document.activeElement.tagName));
      }
      assert.deepEqual(wanted.filter((id) => !reached.includes(id)), []);
    });

    for (const colorScheme of ['light', 'dark']) {
      await test(`accessible by the rules of axe-core, ${colorScheme}`, async () => {
        await tab.emulateMedia({ colorScheme });
        await tab.evaluate(() => {
          window.replay.select(window.replay.state().nodes[0]?.id);
          document.getElementById('colouring').open = true;
          document.getElementById('keys').hidden = false;
        });
        const found = await inaccessible(tab);
        await tab.evaluate(() => {
          window.replay.select(NaN);
          document.getElementById('colouring').open = false;
          document.getElementById('keys').hidden = true;
        });
        await tab.emulateMedia({ colorScheme: 'light' });
        assert.deepEqual(found, []);
      });
    }

    await resize(tab, SIZE);

    await test('dragging turns the view and R resets it', async () => {
      await seek(tab, middle);
      await tab.keyboard.press('r');
      await tab.waitForTimeout(300);
      const before = await canvas(tab);
      await tab.mouse.move(520, 200);
      await tab.mouse.down();
      await tab.mouse.move(640, 240, { steps: 4 });
      await tab.mouse.up();
      await tab.waitForTimeout(300);
      assert.ok((await canvas(tab)) !== before, 'the picture stays the same');
      await tab.keyboard.press('t');
      await tab.keyboard.press('a');
      await tab.keyboard.press('r');
      await tab.waitForTimeout(300);
      assert.ok((await canvas(tab)) === before, 'the first view is not restored');
    });

    await test('the view fills the window after a resize', async () => {
      for (const size of [{ width: 700, height: 900 }, { width: 400, height: 300 }, { width: 1280, height: 720 }]) {
        await resize(tab, size);
        assert.ok(await tab.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `the page is wider than ${size.width}`);
        assert.ok((await colours(tab)) > 50, `blank at ${JSON.stringify(size)}`);
      }
    });

    await test('the dark scheme looks different', async () => {
      const light = await canvas(tab);
      await tab.emulateMedia({ colorScheme: 'dark' });
      await tab.waitForTimeout(500); // the page receives it with its next frame
      const dark = await canvas(tab);
      await tab.emulateMedia({ colorScheme: 'light' });
      assert.ok(light !== dark, 'the picture stays the same');
    });

    await test('no error, no warning, nothing fetched', async () => {
      assert.deepEqual(complaints, []);
    });
  } finally {
    await close();
  }

  await test('truncated data is reported', () =>
    expectMessage(withData('short', (data) => data.slice(0, data.length >> 1)), /damaged or truncated/));
  for (const [part, from, to] of [['header', 0, 0.01], ['recording', 0.4, 0.6]]) {
    await test(`a corrupt character in the ${part} is reported`, () => expectMessage(withData(part, (data) => {
      const at = data.indexOf('A', from * data.length);
      assert.ok(at >= 0 && at < to * data.length, 'A is missing');
      return `${data.slice(0, at)}B${data.slice(at + 1)}`;
    }), /damaged or truncated/));
  }
  await test('invalid data is reported', () => expectMessage(withData('text', () => 'not base64!'), /damaged or truncated/));
  await test('the empty template is reported', () => expectMessage(withData('empty', () => '@@' + 'REPLAY@@'), /does not contain a run/));
  await test('missing WebGL support is reported', () => expectMessage(file, /3D graphics/, { in: blind }));
});
