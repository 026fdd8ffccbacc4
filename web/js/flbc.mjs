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

const ended = () => new FlbcError({ kind: "Ended", message: "the worker has been ended" });

export class Flbc {
  waiting = new Map();
  next = 0;

  // \param wasm  bytes, a Response or an address of the module, where it is not inside this file
  // \param worker  bytes of the worker's script, likewise
  // \param page  what page() needs, packed: { shell, viewer }
  static async start({ wasm, worker, page = assets.page } = {}) {
    const flbc = new Flbc();
    flbc.pageParts = page;
    const given = typeof wasm === "string" || wasm instanceof URL ? await fetch(wasm) : await wasm;
    const bytes = given?.arrayBuffer ? await given.arrayBuffer() : given ?? await unpacked(assets.wasm);
    flbc.compiled = await WebAssembly.compile(bytes);
    flbc.script = new TextDecoder().decode(worker ?? await unpacked(assets.worker));
    await flbc.restart();
    return flbc;
  }

  // Calls from now on go to another worker.
  restart() {
    const ready = makeWorker(this.script).then((worker) => {
      const take = (event) => this.take(event.data ?? event);
      const fail = (event) => {
        const message = `the worker failed: ${event.message ?? event}`;
        if (this.ready === ready) this.end(new FlbcError({ kind: "Crash", message }));
      };
      if (worker.on) worker.on("message", take).on("error", fail).on("exit", fail);
      else Object.assign(worker, { onmessage: take, onerror: fail });
      worker.postMessage({ compiled: this.compiled });
      return worker;
    });
    this.ready = ready;
    return ready;
  }

  take({ id, stage, done, result, error }) {
    const call = this.waiting.get(id);
    if (!call) return;
    if (stage !== undefined) return call.onProgress?.(stage, done);
    this.waiting.delete(id);
    if (error) call.fail(new FlbcError(error));
    else call.done(result);
  }

  // Ends the worker. \param error  with which the calls that wait are rejected
  end(error = ended()) {
    this.ready?.then((worker) => worker.terminate());
    this.ready = undefined;
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
      if (!this.ready) return fail(ended());
      const id = this.next++;
      this.waiting.set(id, { done, fail, onProgress });
      this.ready.then((worker) => worker.postMessage({ id, name, given })).catch((error) => {
        this.waiting.delete(id);
        fail(error);
      });
    });
  }

  addFile(name, bytes) { return this.call("addFile", { name, bytes: new Uint8Array(bytes) }); }

  async readModel(name, bytes, files = {}) {
    for (const [other, content] of Object.entries(files)) await this.addFile(other, content);
    return this.call("readModel", { name, bytes: new Uint8Array(bytes) });
  }

  // \param locality  what a locality file has, or the bytes of one
  async protect(locality) {
    const isFile = locality instanceof ArrayBuffer || ArrayBuffer.isView(locality);
    await this.addFile("locality.json", isFile ? locality : new TextEncoder().encode(JSON.stringify(locality)));
    return this.call("protect");
  }

  // Lets the engine compile what it will need, with a small model that is forgotten.
  warmUp(name, bytes) { return this.call("warmUp", { name, bytes }); }
  readCage(name, bytes) { return this.call("readCage", { name, bytes: new Uint8Array(bytes) }); }
  setModel(points, triangles) { return this.call("setModel", { points, triangles }); }
  setCage(points, facets) { return this.call("setCage", { points, facets }); }
  setMesh(points, cells) { return this.call("setMesh", { points, cells }); }
  deform(points) { return this.call("deform", { points }); }
  modelFile(points, extension) { return this.call("modelFile", { points, extension }); }
  drawing(text, placing, points) { return this.call("drawing", { text, placing, points }); }

  async page(options = {}) {
    const content = await this.content(options);
    const shell = new TextDecoder().decode(await unpacked(this.pageParts.shell));
    const [begin, middle, end] = shell.split(/\{\{data\}\}|\{\{script\}\}/);
    return new Uint8Array(await new Blob([begin, content, middle, await unpacked(this.pageParts.viewer), end]).arrayBuffer());
  }
}

// The others take an object of these options. Other options are misspelled.
const kOptions = {
  makeCage: "controlPoints offset symmetry density", repairCage: "", compose: "points facets starts controlPoints values isCurved", makeMesh: "vertices", solve: "smoothness tolerance distances precision",
  solution: "", setSolution: "points cells starts controlPoints values options", reduce: "influences", move: "points refine seconds",
  points: "", cage: "", weights: "", harmonicWeights: "", content: "picture", glb: "influences rigid times poses",
  picture: "pixels size poses scale sheet fps", weightFile: "format of", cageFile: "", meshFile: "", memory: "", version: "",
};

function checkOptions(name, options) {
  for (const key of Object.keys(options)) {
    if (kOptions[name].split(" ").includes(key)) continue;
    const message = `${name}: there is no option "${key}"; there are: ${kOptions[name] || "none"}`;
    throw new FlbcError({ kind: "OptionError", message });
  }
}

for (const name of Object.keys(kOptions)) {
  Flbc.prototype[name] = async function (options = {}, onProgress = undefined) {
    checkOptions(name, options);
    if (options.options) checkOptions("solve", options.options);
    return this.call(name, options, onProgress);
  };
}
