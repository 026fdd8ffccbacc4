// SPDX-License-Identifier: BSD-3-Clause
// The shaders for engines against flbc deform: engine_test.mjs BROWSER FOLDER
// FOLDER: the files of engines/ with sparse_weights.mtx, cage.obj, and model.obj, and for the test pose.obj
// and moved.obj.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { largestDifference, launch, pixelsOf, vertices } from "./page.mjs";

const [executablePath, folder] = process.argv.slice(2);
const files = new Set(readdirSync(folder));
const text = (name) => readFileSync(join(folder, name), "utf8");
const places = (name) => vertices(join(folder, name), 3);

function expectNear(found, expected, what) {
  const size = Math.max(...expected) - Math.min(...expected);
  const error = largestDifference(found, expected);
  assert.ok(error < 1e-6 * size, `${what}: off by ${error / size} of the size`);
}

// Pages read files beside them from a server only.
const server = createServer((request, response) => {
  const name = request.url.slice(1);
  if (!files.has(name)) return response.writeHead(404).end();
  const type = name.endsWith(".html") ? "text/html" : "application/octet-stream";
  response.writeHead(200, { "Content-Type": type }).end(readFileSync(join(folder, name)));
});
await new Promise((done) => { server.listen(0, "127.0.0.1", done); });
const browser =
  await launch(executablePath, "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader");
try {
  const tab = await browser.newPage();
  const failures = [];
  tab.on("pageerror", (error) => failures.push(error.message));
  await tab.goto(`http://127.0.0.1:${server.address().port}/webgl.html`);
  await tab.waitForFunction(() => window.example);
  // Moves the cage, and reads what the vertex shader made of all vertices.
  const movedBy = (points) => tab.evaluate((moved) => {
    const { gl, program, cage, draw } = window.example;
    cage.set(moved);
    draw();
    const size = gl.getBufferParameter(gl.ARRAY_BUFFER, gl.BUFFER_SIZE) / 32 * 3;
    gl.transformFeedbackVaryings(program, ["place"], gl.SEPARATE_ATTRIBS);
    gl.linkProgram(program);
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, buffer);
    gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, 4 * size, gl.STREAM_READ);
    gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, null);
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    gl.beginTransformFeedback(gl.POINTS);
    gl.drawArrays(gl.POINTS, 0, size / 3);
    gl.endTransformFeedback();
    const result = new Float32Array(size);
    gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, result);
    return Array.from(result);
  }, points);
  const darkPixels = async (png) =>
    (await pixelsOf(tab, png)).filter((pixel) => (pixel & 255) < 250).length;
  const canvas = await tab.$("canvas");
  assert.ok(await darkPixels(await canvas.screenshot({ encoding: "base64" })) > 5000, "nothing drawn");
  expectNear(await movedBy(places("cage.obj")), places("model.obj"), "at rest");
  expectNear(await movedBy(places("pose.obj")), places("moved.obj"), "in the pose");
  assert.deepEqual(failures, []);

  // The same in WGSL, by a program that calls the function of the vertex shader.
  const wgsl = `${text("deform.wgsl")}
    @group(0) @binding(2) var<storage, read> indices : array<vec4u>;
    @group(0) @binding(3) var<storage, read> weights : array<vec4f>;
    @group(0) @binding(4) var<storage, read_write> results : array<vec4f>;
    @compute @workgroup_size(64) fn all(@builtin(global_invocation_id) id : vec3u) {
      let v = id.x;
      if (v >= arrayLength(&results)) { return; }
      let vertex = Influences(indices[2 * v], indices[2 * v + 1], weights[2 * v], weights[2 * v + 1]);
      results[v] = vec4f(moved(vertex), toClip[0].x);
    }`;
  const result = await tab.evaluate(async (code, cage) => {
    const adapter = await navigator.gpu?.requestAdapter();
    if (!adapter) return null;
    const device = await adapter.requestDevice();
    const module = device.createShaderModule({ code });
    const { messages } = await module.getCompilationInfo();
    if (messages.length > 0) throw new Error(messages.map((m) => m.message).join("; "));
    const { indices, weights } = window.example;
    const count = weights.length / 8;
    const { STORAGE, COPY_SRC, COPY_DST, MAP_READ, UNIFORM } = GPUBufferUsage;
    const buffer = (data, usage) => {
      const made = device.createBuffer({ size: data.byteLength, usage: usage | COPY_DST });
      device.queue.writeBuffer(made, 0, data);
      return made;
    };
    const padded = new Float32Array(cage.length / 3 * 4);
    for (let k = 0; k < cage.length; ++k) padded[4 * Math.floor(k / 3) + k % 3] = cage[k];
    const results = buffer(new Float32Array(4 * count), STORAGE | COPY_SRC);
    const buffers = [buffer(padded, STORAGE), buffer(new Float32Array(16), UNIFORM),
                     buffer(Uint32Array.from(indices), STORAGE),
                     buffer(weights, STORAGE), results];
    const pipeline = device.createComputePipeline(
      { layout: "auto", compute: { module, entryPoint: "all" } });
    const group = device.createBindGroup({
      layout: pipeline.getBindGroupLayout(0),
      entries: buffers.map((made, binding) => ({ binding, resource: { buffer: made } })) });
    const read = device.createBuffer({ size: 16 * count, usage: MAP_READ | COPY_DST });
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, group);
    pass.dispatchWorkgroups(Math.ceil(count / 64));
    pass.end();
    encoder.copyBufferToBuffer(results, 0, read, 0, 16 * count);
    device.queue.submit([encoder.finish()]);
    await read.mapAsync(GPUMapMode.READ);
    return Array.from(new Float32Array(read.getMappedRange())).filter((_, k) => k % 4 < 3);
  }, wgsl, places("pose.obj"));
  if (result) expectNear(result, places("moved.obj"), "in WGSL");
  console.log(result ? "GLSL and WGSL move as flbc deform" :
                       "GLSL moves as flbc deform; this browser has no WebGPU");
} finally {
  await browser.close();
  server.close();
}
