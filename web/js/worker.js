// SPDX-License-Identifier: BSD-3-Clause
// The worker: one session of the module, whose calls it answers one after the other. It follows the
// glue code of Emscripten, createFlbc(), in one script, which browsers and Node.js take alike.
const port = typeof importScripts === "function" ? self : require("node:worker_threads").parentPort;
let glue = null;
let session = null;

async function begin(compiled) {
  glue = {
    print: () => {},
    printErr: () => {},
    wasmModule: compiled,
    instantiateWasm(imports, done) {
      glue.wasmImports = imports;  // meshers start in a copy: isolated_process_web.cpp
      WebAssembly.instantiate(compiled, imports).then(done);
      return {};
    },
  };
  session = createFlbc(glue).then((made) => new made.Session());
}

function warmUp(given) {
  const other = new glue.Session();
  for (const [name, options] of [["readModel", given], ["makeCage", {}], ["makeMesh", { vertices: 800 }],
                                 ["solve", {}], ["content", {}]]) other.call(name, options, undefined);
  other.delete();
  return {};
}

// The arrays in an object, which are handed over instead of copied.
function buffersOf(value) {
  if (ArrayBuffer.isView(value)) return [value.buffer];
  return value && typeof value === "object" ? Object.values(value).flatMap(buffersOf) : [];
}

async function answer({ id, name, given }) {
  const report = (stage, done) => port.postMessage({ id, stage, done });
  let reply;
  try {
    const made = await session;
    reply = name === "warmUp" ? warmUp(given) : made.call(name, given, report);
  } catch (error) {
    reply = { error: { kind: "Crash", message: `the module failed: ${error.message ?? error}` } };
  }
  if (name === "solve") glue.copyMemory = undefined;  // no mesher comes after it
  port.postMessage({ id, ...reply }, buffersOf(reply.result));
}

port.addEventListener("message", ({ data }) => (data.compiled ? begin(data.compiled) : answer(data)));
port.start?.();
