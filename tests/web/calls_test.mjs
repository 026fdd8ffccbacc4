// SPDX-License-Identifier: BSD-3-Clause
// Every call settles, whatever becomes of the worker, which needs no module here.
import assert from "node:assert/strict";
import { Flbc } from "../../web/js/flbc.mjs";

const worker = new TextEncoder().encode(`
  require("node:worker_threads").parentPort.on("message", ({ compiled, id, name }) => {
    if (name === "hang") for (;;);
    if (name === "throw") throw new Error("thrown");
    if (name === "exit") process.exit(1);
    if (!compiled) require("node:worker_threads").parentPort.postMessage({ id, result: name });
  });`);
const start = () => Flbc.start({ wasm: Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0), worker });
const timeout = new Promise((_, fail) => { setTimeout(fail, 120000, new Error("a call does not settle")).unref(); });
const settles = (promise) => Promise.race([promise, timeout]);
const rejects = (promise, name) => settles(assert.rejects(promise, { name }));

const flbc = await start();
const waiting = flbc.call("hang");
flbc.end();
await rejects(waiting, "Ended");
await rejects(flbc.version(), "Ended");
await settles(flbc.cancel());  // starts another worker
assert.equal(await settles(flbc.version()), "version");

// A call where the cancelled one rejects goes to the next worker.
const again = assert.rejects(flbc.call("hang"), { name: "Cancelled" }).then(() => flbc.version());
await settles(flbc.cancel());
assert.equal(await settles(again), "version");

for (const name of ["throw", "exit"]) {
  const other = await start();
  await rejects(other.call(name), "Crash");
  await rejects(other.version(), "Ended");
}

// Misspelled options are refused.
for (const [name, options] of [["solve", { smoothnes: 1 }], ["makeMesh", { vertex: 9 }], ["glb", { influence: 4 }], ["weights", { of: "mesh" }],
                               ["setSolution", { points: [], options: { smoothnes: 1 } }]]) {
  await rejects(flbc[name](options), "OptionError");
}
assert.equal(await settles(flbc.solve({ smoothness: 1 })), "solve");
assert.equal(await settles(flbc.glb({ poses: [[1, 2]] })), "glb");

await rejects(flbc.call("version", { given: () => {} }), "DataCloneError");
assert.equal(await settles(flbc.version()), "version");
flbc.end();
