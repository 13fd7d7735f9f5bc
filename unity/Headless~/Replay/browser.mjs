// Starts headless Chromium for pictures.mjs and test.mjs, with WebGL on the processor and without network access.
import { createRequire } from 'node:module';
import { resolve } from 'node:path';

const FLAGS = [
  '--headless', '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
  '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--hide-scrollbars', '--force-color-profile=srgb',
];

/**
 * Starts the browser. `modules` is the folder with playwright-core and the browser, which `./collektive setup` creates. CHROMIUM selects another browser.
 * The browser uses the libraries and fonts in the same folder, so that pictures are the same on all systems.
 */
export function launch(modules = process.env.COLLEKTIVE_NODE_MODULES, extraFlags = []) {
  if (!modules) {
    console.error('Set COLLEKTIVE_NODE_MODULES to the folder of playwright-core and @sparticuz/chromium.');
    process.exit(2);
  }
  const { chromium } = createRequire(resolve(modules, 'x.js'))('playwright-core');
  const args = [...FLAGS, ...extraFlags];
  if (process.env.CHROMIUM) return chromium.launch({ executablePath: process.env.CHROMIUM, args });
  const folder = resolve(modules, '@sparticuz/chromium/bin');
  const env = { ...process.env, LD_LIBRARY_PATH: resolve(folder, 'lib'), FONTCONFIG_PATH: folder, XDG_CACHE_HOME: resolve(folder, 'cache') };
  return chromium.launch({ executablePath: resolve(folder, 'chromium'), env, args });
}
