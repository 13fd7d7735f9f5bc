// Unpacks the Chromium of @sparticuz/chromium beside its archives. `node unpack-chromium.mjs NODE_MODULES`
// The package's own code would unpack it to /tmp and asks for a newer Node than Debian 12 has.
import { execFileSync } from 'node:child_process';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { basename, resolve } from 'node:path';
import { brotliDecompressSync } from 'node:zlib';

const folder = resolve(process.argv[2], '@sparticuz/chromium/bin');
for (const archive of readdirSync(folder).filter((name) => name.endsWith('.br'))) {
  const name = basename(archive, '.br');
  const content = brotliDecompressSync(readFileSync(resolve(folder, archive)));
  if (name.endsWith('.tar')) execFileSync('tar', ['--extract', '--no-same-owner', '--directory', folder], { input: content });
  else writeFileSync(resolve(folder, name), content, { mode: 0o755 });
}
// The package's own fonts.conf names folders of AWS Lambda.
writeFileSync(resolve(folder, 'fonts.conf'), `<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig>
  <dir prefix="relative">fonts</dir>
  <cachedir prefix="xdg">fontconfig</cachedir>
</fontconfig>
`);
