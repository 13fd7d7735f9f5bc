// Starts headless Chromium for pictures.mjs and test.mjs, with WebGL drawn by the processor and nothing fetched.
import { createRequire } from 'node:module';
import { resolve } from 'node:path';

const FLAGS = [
  '--headless', '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
  '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--hide-scrollbars', '--force-color-profile=srgb',
];

/** `modules` is the folder of playwright-core, CHROMIUM the browser (default: Debian's). */
export function launch(modules = process.env.COLLEKTIVE_NODE_MODULES, extraFlags = []) {
  if (!modules) {
    console.error('Set COLLEKTIVE_NODE_MODULES to the folder of playwright-core.');
    process.exit(2);
  }
  const { chromium } = createRequire(resolve(modules, 'x.js'))('playwright-core');
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: [...FLAGS, ...extraFlags] });
}
