// Runs the Khronos validator over the files on the command line, prints every error, and exits 1
// if there was one. With -v warnings are printed too; with -q nothing but errors.
import { readFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { validateBytes } from "gltf-validator";

const severities = ["error", "warning", "info", "hint"];
const options = process.argv.slice(2).filter((a) => a.startsWith("-"));
const files = process.argv.slice(2).filter((a) => !a.startsWith("-"));
const shown = options.includes("-v") ? 1 : 0;
let failed = files.length === 0;
if (failed) console.error("usage: node validate.mjs [-v] [-q] FILE...");

for (const file of files) {
  try {
    const report = await validateBytes(new Uint8Array(await readFile(file)), {
      uri: file,
      maxIssues: 0,
      externalResourceFunction: async (uri) =>
        new Uint8Array(await readFile(join(dirname(file), decodeURIComponent(uri)))),
    });
    for (const message of report.issues.messages) {
      if (message.severity > shown) continue;
      const where = message.pointer ?? `byte ${message.offset}`;
      console.log(`${file}: ${severities[message.severity]} ${message.code} at ${where}: ${message.message}`);
    }
    const { numErrors, numWarnings } = report.issues;
    if (!options.includes("-q")) console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings`);
    if (numErrors > 0) failed = true;
  } catch (problem) {
    console.log(`${file}: error: ${problem}`);
    failed = true;
  }
}
process.exit(failed ? 1 : 0);
