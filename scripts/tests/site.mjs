// Tests the site in headless Chromium: node [TEST OPTIONS] site.mjs SITE PICTURES
// Tests every page at three widths, and some pages also in the dark theme. Writes screenshots of a few pages to PICTURES.
import assert from 'node:assert/strict';
import { mkdirSync, readdirSync, readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import suite from 'node:test';
import { pathToFileURL } from 'node:url';
import { launch } from '../../unity/Headless~/Replay/browser.mjs';

const WIDTHS = [390, 820, 1440];
const PICTURED = ['index.html', 'way-of-a-tick.html', 'tutorial-first-swarm.html', 'reference/csharp-unity.html'];

const [site, pictures] = process.argv.slice(2).map((path) => resolve(path));
mkdirSync(pictures, { recursive: true });
const pages = readdirSync(site, { recursive: true }).map(String).filter((name) => name.endsWith('.html') && name !== '404.html').sort();
const browser = await launch();

const address = (page) => pathToFileURL(join(site, page)).href;

async function open(page, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, ...options });
  const tab = await context.newPage();
  const complaints = [];
  tab.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  tab.on('pageerror', (error) => complaints.push(error.message));
  tab.on('request', (request) => /^https?:/.test(request.url()) && complaints.push(`fetched ${request.url()}`));
  await tab.goto(address(page));
  return { tab, complaints, close: () => context.close() };
}

/** Waits for the theme's animations, and returns the elements that are wider than the window or cannot be scrolled into view. */
async function overflowing(tab) {
  let found = [];
  for (let tries = 0; tries < 20 && (tries === 0 || found.length > 0); tries++) {
    if (tries > 0) await tab.waitForTimeout(100);
    found = await overflowingNow(tab);
  }
  return found;
}

const overflowingNow = (tab) => tab.evaluate(() => {
  const wide = document.documentElement.scrollWidth;
  if (wide > window.innerWidth + 1) return [`the page is ${wide} pixels wide, the window ${window.innerWidth}`];
  const scrolls = (element) => element && element !== document.body
    && (/auto|scroll/.test(getComputedStyle(element).overflowX) || scrolls(element.parentElement));
  return [...document.querySelectorAll('article *')]
    .filter((element) => !element.closest('svg') && element.getBoundingClientRect().right > window.innerWidth + 1 && !scrolls(element))
    .map((element) => `${element.tagName} ${element.textContent.slice(0, 60)}`);
});

const shared = await open('index.html');
for (const page of pages) {
  suite.test(`${page} fits three widths and fetches nothing`, async () => {
    shared.complaints.length = 0;
    await shared.tab.goto(address(page));
    for (const width of WIDTHS) {
      await shared.tab.setViewportSize({ width, height: 900 });
      assert.deepEqual(await overflowing(shared.tab), [], `${width} pixels`);
    }
    assert.deepEqual(shared.complaints, []);
  });
}

for (const page of PICTURED) {
  for (const colorScheme of ['light', 'dark']) {
    suite.test(`${page} is pictured in ${colorScheme}`, async () => {
      const { tab, close } = await open(page, { colorScheme });
      assert.equal(await tab.evaluate(() => document.body.dataset.mdColorScheme), colorScheme === 'dark' ? 'slate' : 'default');
      for (const width of WIDTHS) {
        await tab.setViewportSize({ width, height: 900 });
        await tab.waitForTimeout(150);
        await tab.screenshot({ path: join(pictures, `${page.replace('.html', '').replace('/', '-')}-${colorScheme}-${width}.png`) });
      }
      await close();
    });
  }
}

for (const page of pages.filter((name) => readFileSync(join(site, name), 'utf8').includes('<pre class="mermaid">'))) {
  suite.test(`${page} has its diagrams drawn`, async () => {
    const { tab, close } = await open(page);
    // Material replaces the source of a diagram with a closed shadow tree. If a diagram has an error, its drawing is small.
    await tab.waitForFunction(() => [...document.querySelectorAll('.mermaid')]
      .every((diagram) => diagram.tagName === 'DIV' && diagram.getBoundingClientRect().height > 100));
    await close();
  });
}

suite.test('search finds a page without a server', async () => {
  const { tab, close } = await open('index.html');
  await tab.fill('input[name=query]', 'alignment');
  await tab.waitForSelector('.md-search-result__item a[href*="aggregate-computing"]', { state: 'attached' });
  await close();
});

suite.after(() => browser.close());
