// SPDX-License-Identifier: BSD-3-Clause
// A model, its cage and its weights, computed in a worker. See flbc.d.ts.
import { unpacked } from "./unpacked.mjs";

// The module and the worker, which the build puts into this file.
const assets = /*{{assets}}*/ {};

export class FlbcError extends Error {
  constructor({ kind, message, controlPoints }) {
    super(message);
    this.name = kind;
    this.controlPoints = controlPoints ?? [];
  }
}

async function makeWorker(script) {
  if (typeof Worker === "function") {
    return new Worker(URL.createObjectURL(new Blob([script], { type: "text/javascript" })));
  }
  const name = "node:worker_threads";  // which bundlers are not to look for
  const { Worker: NodeWorker } = await import(/* @vite-ignore */ /* webpackIgnore: true */ name);
  return new NodeWorker(script, { eval: true, execArgv: [] });
}

export class Flbc {
  // \param wasm  bytes, a Response or an address of the module, where it is not inside this file
  // \param worker  bytes of the worker's script, likewise
  static async start({ wasm, worker } = {}) {
    const flbc = new Flbc();
    const given = typeof wasm === "string" || wasm instanceof URL ? await fetch(wasm) : await wasm;
    const bytes = given?.arrayBuffer ? await given.arrayBuffer() : given ?? await unpacked(assets.wasm);
    flbc.compiled = await WebAssembly.compile(bytes);
    flbc.script = new TextDecoder().decode(worker ?? await unpacked(assets.worker));
    await flbc.restart();
    return flbc;
  }

  async restart() {
    this.waiting = new Map();
    this.next = 0;
    this.worker = await makeWorker(this.script);
    const take = (event) => this.take(event.data ?? event);
    if (this.worker.on) {
      this.worker.on("message", take);
      this.worker.on("error", (error) => this.end(error));
    } else {
      this.worker.addEventListener("message", take);
      this.worker.addEventListener("error", (event) => this.end(event));
    }
    this.worker.postMessage({ compiled: this.compiled });
  }

  take({ id, stage, done, result, error }) {
    const call = this.waiting.get(id);
    if (!call) return;
    if (stage !== undefined) return call.onProgress?.(stage, done);
    this.waiting.delete(id);
    if (error) call.fail(new FlbcError(error));
    else call.done(result);
  }

  // Ends the worker. \param error  what the calls that wait are told
  end(error = new FlbcError({ kind: "Ended", message: "the worker has been ended" })) {
    this.worker?.terminate();
    for (const { fail } of this.waiting.values()) fail(error);
    this.waiting.clear();
  }

  // Ends what is being computed; the next call starts with nothing.
  async cancel() {
    this.end(new FlbcError({ kind: "Cancelled", message: "cancelled" }));
    await this.restart();
  }

  call(name, given = {}, onProgress = undefined) {
    return new Promise((done, fail) => {
      const id = this.next++;
      this.waiting.set(id, { done, fail, onProgress });
      this.worker.postMessage({ id, name, given });
    });
  }

  addFile(name, bytes) { return this.call("addFile", { name, bytes: new Uint8Array(bytes) }); }

  async readModel(name, bytes, files = {}) {
    for (const [other, content] of Object.entries(files)) await this.addFile(other, content);
    await this.addFile(name, bytes);
    return this.call("readModel", { name });
  }

  async readCage(name, bytes) {
    await this.addFile(name, bytes);
    return this.call("readCage", { name });
  }

  // \param locality  what a locality file has, or the bytes of one
  async protect(locality) {
    const isFile = locality instanceof ArrayBuffer || ArrayBuffer.isView(locality);
    await this.addFile("locality.json", isFile ? locality : new TextEncoder().encode(JSON.stringify(locality)));
    return this.call("protect");
  }

  // Lets the engine compile what it will need, with a small model that is forgotten.
  warmUp(name, bytes) { return this.call("warmUp", { name, bytes }); }
  setModel(points, triangles) { return this.call("setModel", { points, triangles }); }
  setCage(points, facets) { return this.call("setCage", { points, facets }); }
  setMesh(points, cells) { return this.call("setMesh", { points, cells }); }
  deform(points) { return this.call("deform", { points }); }
  modelFile(points, extension) { return this.call("modelFile", { points, extension }); }
  glb({ poses = [], ...options } = {}) { return this.call("glb", { ...options, poses: poses.map((pose) => Array.from(pose)) }); }
}

// The others take an object of options.
for (const name of ["makeCage", "repairCage", "makeMesh", "solve", "solution", "setSolution", "reduce", "move",
                    "points", "cage", "weights", "harmonicWeights", "content", "page", "weightFile",
                    "cageFile", "meshFile", "memory", "version"]) {
  Flbc.prototype[name] = function (options, onProgress) { return this.call(name, options, onProgress); };
}
