// Builds the page template: node build.mjs OUT.html [NODE_MODULES]
// three and esbuild come from NODE_MODULES, else from COLLEKTIVE_NODE_MODULES.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [out, modules = process.env.COLLEKTIVE_NODE_MODULES] = process.argv.slice(2);
if (!out || !modules) {
  console.error('Usage: node build.mjs OUT.html [NODE_MODULES] (or set COLLEKTIVE_NODE_MODULES to the folder of three and esbuild)');
  process.exit(2);
}

const PLACEHOLDER = '@@REPLAY@@';
const source = resolve(dirname(fileURLToPath(import.meta.url)), 'src');
const { buildSync } = createRequire(resolve(modules, 'x.js'))('esbuild');

const bundle = (entry) => buildSync({
  entryPoints: [resolve(source, entry)], bundle: true, minify: true, write: false, format: 'esm', target: 'es2022',
  nodePaths: [resolve(modules)], legalComments: 'inline', charset: 'utf8',
}).outputFiles[0].text.trim();

const parts = { '/*STYLE*/': bundle('page.css'), '/*PLACEHOLDER*/': PLACEHOLDER, '/*SCRIPT*/': bundle('main.js') };
const page = readFileSync(resolve(source, 'page.html'), 'utf8').replace(/\/\*[A-Z]+\*\//g, (name) => parts[name]);
if (page.split(PLACEHOLDER).length !== 2) throw new Error(`The page must hold ${PLACEHOLDER} once.`);
mkdirSync(dirname(resolve(out)), { recursive: true });
writeFileSync(out, page);
