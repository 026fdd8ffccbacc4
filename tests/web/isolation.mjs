// SPDX-License-Identifier: BSD-3-Clause
// Runs isolation.cpp: node isolation.mjs BUILD_FOLDER
import { readFileSync } from "node:fs";
import { runInThisContext } from "node:vm";

const [folder] = process.argv.slice(2);
const createFlbc = runInThisContext(`${readFileSync(`${folder}/isolation.js`, "utf8")}\ncreateFlbc`);
const compiled = new WebAssembly.Module(readFileSync(`${folder}/isolation.wasm`));
const glue = {
  print: (line) => { console.log(line); process.exitCode = line === "isolation holds" ? 0 : 1; },
  printErr: () => {},
  wasmModule: compiled,
  instantiateWasm(imports, done) {
    glue.wasmImports = imports;
    const instance = new WebAssembly.Instance(compiled, imports);
    done(instance);
    return instance.exports;  // newer versions of Emscripten take these
  },
};
process.exitCode = 1;
createFlbc(glue);
