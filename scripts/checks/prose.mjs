// Prints the grammar errors in pages, and exits with 1 if it finds any: prose.mjs PAGE...
import { webcrypto } from "node:crypto";
import fs from "node:fs";
import { pathToFileURL } from "node:url";

// The linter needs this object, which Node.js 18 lacks.
globalThis.crypto ??= webcrypto;
const harper = pathToFileURL(`${process.env.COLLEKTIVE_NODE_MODULES}/harper.js/dist/`);
const { Dialect, LocalLinter } = await import(`${harper}index.js`);
const { slimBinaryInlined: binary } = await import(`${harper}slimBinaryInlined.js`);

// The linter's other kinds of errors are matters of taste or false positives on names and units.
const KINDS = new Set(["Agreement", "BoundaryError", "Eggcorn", "Grammar", "Malapropism", "Nonstandard", "Redundancy", "Repetition", "Usage"]);

const linter = new LocalLinter({ binary, dialect: Dialect.British });
await linter.setLintConfig({ ...(await linter.getDefaultLintConfig()), SpellCheck: false });
let errors = 0;
for (const page of process.argv.slice(2)) {
  const text = fs.readFileSync(page, "utf8");
  for (const lint of await linter.lint(text, { language: "markdown" })) {
    if (!KINDS.has(lint.lint_kind())) continue;
    errors++;
    const line = text.slice(0, lint.span().start).split("\n").length;
    console.log(`${page}:${line}: ${lint.lint_kind()}: "${lint.get_problem_text()}": ${lint.message()}`);
  }
}
process.exit(errors > 0 ? 1 : 0);
