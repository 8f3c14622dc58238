// SPDX-License-Identifier: Apache-2.0
// Typesets formulas: reads one JSON object {tex, display} per line, answers each with a line {html} or {error}.
// usage: node formulas.js KATEX   KATEX: the script katex.js
"use strict";
const katex = require(require("path").resolve(process.argv[2]));
const lines = require("readline").createInterface({ input: process.stdin });

function typeset({ tex, display }) {
  try {
    // What LaTeX would refuse is an error here, too: other viewers of the pages are stricter than KaTeX.
    return { html: katex.renderToString(tex, { displayMode: display, fleqn: true, strict: "error" }) };
  } catch (error) {
    return { error: error.message };
  }
}

lines.on("line", (line) => process.stdout.write(`${JSON.stringify(typeset(JSON.parse(line)))}\n`));
