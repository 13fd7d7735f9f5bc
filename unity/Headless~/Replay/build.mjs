// Builds the pages: node build.mjs FOLDER [NODE_MODULES] writes replay.html, the template of replay pages, live.html and live-view.html. Libraries and esbuild
// come from NODE_MODULES, or else from COLLEKTIVE_NODE_MODULES.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [out, modules = process.env.COLLEKTIVE_NODE_MODULES] = process.argv.slice(2);
if (!out || !modules) {
  console.error('Usage: node build.mjs FOLDER [NODE_MODULES] (or set COLLEKTIVE_NODE_MODULES to the folder of three and esbuild)');
  process.exit(2);
}

const PLACEHOLDER = '@@REPLAY@@';
const source = resolve(dirname(fileURLToPath(import.meta.url)), 'src');
const { buildSync } = createRequire(resolve(modules, 'x.js'))('esbuild');

const bundle = (entry) => buildSync({
  entryPoints: [resolve(source, entry)], bundle: true, minify: true, write: false, format: 'esm', target: 'es2022',
  nodePaths: [resolve(modules)], legalComments: 'inline', charset: 'utf8',
}).outputFiles[0].text.trim();

function write(name, html, css, script, placeholder) {
  const parts = { '/*STYLE*/': bundle(css), '/*PLACEHOLDER*/': placeholder, '/*SCRIPT*/': bundle(script).replaceAll('</script', '<\\/script') };
  const page = readFileSync(resolve(source, html), 'utf8').replace(/\/\*[A-Z]+\*\//g, (part) => parts[part]);
  if (page.split(PLACEHOLDER).length !== (placeholder ? 2 : 1)) throw new Error(`${name} must contain ${PLACEHOLDER} once if it is a template.`);
  writeFileSync(join(out, name), page);
}

mkdirSync(out, { recursive: true });
write('replay.html', 'page.html', 'page.css', 'main.js', PLACEHOLDER);
write('live-view.html', 'page.html', 'page.css', 'live-view.js', '');
write('live.html', 'live.html', 'live.css', 'live.js', '');
