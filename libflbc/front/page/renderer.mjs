// SPDX-License-Identifier: BSD-3-Clause
// Draws the model and its cage with WebGL2.
import { bernstein } from "./curves.mjs";
import { atVertices, edgesOf, sumNormals } from "./surface_normals.mjs";
import { kDotShader, kEdgeShader, kSurfaceShader, kWireShader, onCard } from "./shaders.mjs";

const kPieces = Array.from({ length: 17 }, (_, k) => bernstein(k / 16));  // of a curve that is drawn

function compile(gl, source) {
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, source.vertex],
                              [gl.FRAGMENT_SHADER, source.fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
      throw new Error(gl.getShaderInfoLog(shader) || "a shader does not compile");
    }
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    throw new Error(gl.getProgramInfoLog(program) || "a program does not link");
  }
  const places = {};
  const count = gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
  for (let k = 0; k < count; ++k) {
    const { name } = gl.getActiveUniform(program, k);
    places[name] = gl.getUniformLocation(program, name);
  }
  return { program, places };
}

export class Renderer {
  // \param weights  null, or what weightsForCard() gives: then the card moves the model
  // \throws Error where there is no WebGL2
  constructor(canvas, content, weights = null) {
    this.canvas = canvas;
    this.content = content;
    this.weights = weights;
    this.images = [];
    const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: false });
    if (!gl) throw new Error("there is no WebGL2");
    this.gl = gl;
    this.prepare();
  }

  // Everything on the card; again after the card was lost.
  prepare() {
    const { gl } = this;
    const variant = (shader) => (this.weights ? onCard(shader) : shader);
    this.surfaceProgram = compile(gl, variant(kSurfaceShader));
    this.edgeProgram = compile(gl, variant(kEdgeShader));
    this.wireProgram = compile(gl, kWireShader);
    this.dotProgram = compile(gl, kDotShader);
    this.makeSurface();
    this.makeCage();
    this.makeTextures();
    this.edgeBuffer = null;
  }

  buffer(target, data, usage) {
    const { gl } = this;
    const buffer = gl.createBuffer();
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, data, usage);
    return buffer;
  }

  attribute(location, buffer, size, type = this.gl.FLOAT, normalized = false) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, size, type, normalized, 0, 0);
  }

  makeSurface() {
    const { gl } = this;
    const { surface } = this.content;
    const count = surface.numVertices;
    this.places = new Float32Array(3 * count);
    this.normals = new Float32Array(3 * count);
    this.values = new Float32Array(count);
    this.surfaceArray = gl.createVertexArray();
    gl.bindVertexArray(this.surfaceArray);
    if (this.weights) atVertices(this.content.base, surface.sources, 3, this.places);
    const atRest = this.weights && !surface.sources ? this.content.base : this.places;
    this.placeBuffer = this.buffer(gl.ARRAY_BUFFER, atRest, gl.DYNAMIC_DRAW);
    this.attribute(0, this.placeBuffer, 3);
    if (this.weights) this.makeWeights();
    this.normalBuffer = this.buffer(gl.ARRAY_BUFFER, this.normals, gl.DYNAMIC_DRAW);
    this.attribute(1, this.normalBuffer, 3);
    this.valueBuffer = this.buffer(gl.ARRAY_BUFFER, this.values, gl.DYNAMIC_DRAW);
    this.attribute(2, this.valueBuffer, 1);
    if (surface.textureCoordinates) {
      this.attribute(3, this.buffer(gl.ARRAY_BUFFER, surface.textureCoordinates, gl.STATIC_DRAW), 2);
    }
    gl.vertexAttrib3f(4, 1, 1, 1);
    if (surface.colors) {
      const buffer = this.buffer(gl.ARRAY_BUFFER, surface.colors, gl.STATIC_DRAW);
      this.attribute(4, buffer, 3, gl.UNSIGNED_BYTE, true);
    }
    const triangles = Uint32Array.from(surface.triangles);
    this.triangleBuffer = this.buffer(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
  }

  makeWeights() {
    const { gl } = this;
    const { sources, numVertices } = this.content.surface;
    const spread = (data) => atVertices(data, sources, 8, new data.constructor(8 * numVertices));
    const indices = this.buffer(gl.ARRAY_BUFFER, spread(this.weights.indices), gl.STATIC_DRAW);
    const weights = this.buffer(gl.ARRAY_BUFFER, spread(this.weights.weights), gl.STATIC_DRAW);
    this.cardBuffers = { indices, weights };
    this.attachWeights();
    this.cage = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.cage);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
  }

  attachWeights() {
    const { gl } = this;
    for (const half of [0, 1]) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.cardBuffers.indices);
      gl.enableVertexAttribArray(5 + half);
      gl.vertexAttribIPointer(5 + half, 4, gl.UNSIGNED_SHORT, 16, 8 * half);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.cardBuffers.weights);
      gl.enableVertexAttribArray(7 + half);
      gl.vertexAttribPointer(7 + half, 4, gl.FLOAT, false, 32, 16 * half);
    }
  }

  // Gives the displacements of the control points to the card.
  setSteps(steps) {
    const { gl } = this;
    const rows = Math.ceil(steps.length / 3072);
    const texels = new Float32Array(3072 * rows);
    texels.set(steps);
    gl.bindTexture(gl.TEXTURE_2D, this.cage);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB32F, 1024, rows, 0, gl.RGB, gl.FLOAT, texels);
  }

  // To be called once a program is in use that moves the model.
  useCage(places) {
    const { gl } = this;
    if (!this.weights) return;
    gl.activeTexture(gl.TEXTURE2);
    gl.bindTexture(gl.TEXTURE_2D, this.cage);
    gl.uniform1i(places.cage, 2);
    gl.activeTexture(gl.TEXTURE0);
  }

  makeCage() {
    const { gl } = this;
    const { edges, curves, rest } = this.content;
    // First the outline, then the lines to handles.
    const isCurved = curves?.length > 0;
    this.numLines = isCurved ? [(kPieces.length - 1) * curves.length, 2 * curves.length] : [edges.length / 2, 0];
    this.wire = new Float32Array(6 * (this.numLines[0] + this.numLines[1]));
    this.wireBuffer = this.buffer(gl.ARRAY_BUFFER, this.wire, gl.DYNAMIC_DRAW);
    this.wireArrays = [0, 24 * this.numLines[0]].map((offset) => {
      const array = gl.createVertexArray();
      gl.bindVertexArray(array);
      gl.bindBuffer(gl.ARRAY_BUFFER, this.wireBuffer);
      for (const location of [0, 1]) {
        gl.enableVertexAttribArray(location);
        gl.vertexAttribPointer(location, 3, gl.FLOAT, false, 24, offset + 12 * location);
        gl.vertexAttribDivisor(location, 1);
      }
      return array;
    });
    this.dots = new Float32Array(rest.length);
    this.states = new Float32Array(rest.length / 3);
    this.dotArray = gl.createVertexArray();
    gl.bindVertexArray(this.dotArray);
    this.dotBuffer = this.buffer(gl.ARRAY_BUFFER, this.dots, gl.DYNAMIC_DRAW);
    this.attribute(0, this.dotBuffer, 3);
    this.stateBuffer = this.buffer(gl.ARRAY_BUFFER, this.states, gl.DYNAMIC_DRAW);
    this.attribute(1, this.stateBuffer, 1);
    gl.bindVertexArray(null);
  }

  makeTextures() {
    const { gl } = this;
    this.palette = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.palette);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, 256, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, this.content.palette);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    this.pictures = [];
    this.images.forEach((image, k) => this.setPicture(k, image));
  }

  setPicture(k, image) {
    const { gl } = this;
    this.images[k] = image;
    this.pictures[k] = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.pictures[k]);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
    gl.generateMipmap(gl.TEXTURE_2D);
  }

  upload(buffer, data) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, data);
  }

  // Shows the model where the cage takes it.
  setModel(deformer) {
    if (this.weights) return this.setSteps(deformer.steps);
    const { points } = deformer;
    const { triangles, sources, groups } = this.content.surface;
    const places = atVertices(points, sources, 3, this.places);
    this.upload(this.placeBuffer, places);
    if (this.content.dim === 2) return;
    sumNormals(places, triangles, groups, this.normals);
    this.upload(this.normalBuffer, this.normals);
  }

  setValues(values) {
    this.upload(this.valueBuffer, atVertices(values, this.content.surface.sources, 1, this.values));
  }

  // \param shares  of a step that control points take, by their number
  setCage(points, shares, hovered) {
    const { center, edges, curves } = this.content;
    for (let k = 0; k < points.length; ++k) this.dots[k] = points[k] - center[k % 3];
    if (curves?.length > 0) {
      this.setCurves(curves);
    } else {
      for (let k = 0; k < edges.length; ++k) {
        for (let c = 0; c < 3; ++c) this.wire[3 * k + c] = this.dots[3 * edges[k] + c];
      }
    }
    for (let i = 0; i < this.states.length; ++i) {
      const isHandle = curves?.length > 0 && i >= curves.length;
      this.states[i] = (shares.get(i) ?? 0) + (i === hovered ? 2 : 0) + (isHandle ? 4 : 0);
    }
    this.upload(this.wireBuffer, this.wire);
    this.upload(this.dotBuffer, this.dots);
    this.upload(this.stateBuffer, this.states);
  }

  setCurves(curves) {
    const { wire, dots } = this;
    let end = 0;
    const put = (curve, shares) => {
      for (let c = 0; c < 3; ++c) wire[end++] = curve.reduce((sum, i, m) => sum + shares[m] * dots[3 * i + c], 0);
    };
    for (const curve of curves) {
      for (let k = 1; k < kPieces.length; ++k) {
        put(curve, kPieces[k - 1]);
        put(curve, kPieces[k]);
      }
    }
    for (const [a, first, second, b] of curves) for (const i of [a, first, second, b]) put([i], [1]);
  }

  // Fits the canvas to its place on the page. \return whether that changed its size
  resize() {
    const { canvas } = this;
    this.ratio = Math.min(2, window.devicePixelRatio || 1);
    const width = Math.max(1, Math.round(this.ratio * canvas.clientWidth));
    const height = Math.max(1, Math.round(this.ratio * canvas.clientHeight));
    if (canvas.width === width && canvas.height === height) return false;
    canvas.width = width;
    canvas.height = height;
    return true;
  }

  // \param look  coloring, showsCage, showsEdges, and the colours of the theme
  draw(camera, look) {
    const { gl, canvas } = this;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...look.background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    if (this.content.dim === 3) gl.enable(gl.DEPTH_TEST);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const matrix = camera.matrix(this.content.center);
    gl.enable(gl.BLEND);
    this.drawSurface(matrix, camera, look);
    if (look.showsEdges) this.drawEdges(matrix, look);
    if (look.showsCage) this.drawCage(matrix, camera, look);
    gl.disable(gl.BLEND);
  }

  drawSurface(matrix, camera, look) {
    const { gl } = this;
    const { program, places } = this.surfaceProgram;
    const { right, up, toward } = camera.axes();
    gl.useProgram(program);
    gl.uniformMatrix4fv(places.toClip, false, matrix);
    gl.uniformMatrix3fv(places.toView, true, [...right, ...up, ...toward]);
    gl.uniform1i(places.isLit, this.content.dim === 3 ? 1 : 0);
    gl.uniform1i(places.hasIsolines, look.coloring === "weight" ? 1 : 0);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.palette);
    gl.uniform1i(places.palette, 0);
    gl.uniform1i(places.picture, 1);
    this.useCage(places);
    gl.bindVertexArray(this.surfaceArray);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    for (const part of this.content.surface.parts) this.drawPart(part, places, look);
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.bindVertexArray(null);
  }

  // Triangles of one material. Without triangles, all points.
  drawPart({ first, count, color, opacity = 1, blends = opacity < 1, cutoff = 0, picture = -1 }, places, { coloring, plain }) {
    const { gl } = this;
    const { colors, numVertices, textureCoordinates } = this.content.surface;
    const isOwn = coloring === "materials";
    const hasPicture = isOwn && textureCoordinates && this.pictures[picture];
    gl.uniform1i(places.coloring, hasPicture ? 2 : isOwn || coloring === "shaded" ? 0 : 1);
    const own = color ?? (hasPicture || colors ? [1, 1, 1] : plain);
    gl.uniform4fv(places.tint, isOwn ? [...own, opacity] : [...(colors ? [1, 1, 1] : plain), 1]);
    gl.uniform1f(places.cutoff, isOwn ? cutoff : 0);
    gl.uniform1i(places.blends, isOwn && blends ? 1 : 0);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, this.pictures[picture] ?? null);
    gl.activeTexture(gl.TEXTURE0);
    if (count > 0) gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 4 * first);
    else gl.drawArrays(gl.POINTS, 0, numVertices);
  }

  makeEdges() {
    const { gl } = this;
    const { triangles, numVertices } = this.content.surface;
    const ends = edgesOf(triangles, numVertices);
    this.numEdgeEnds = ends.length;
    this.edgeArray = gl.createVertexArray();
    gl.bindVertexArray(this.edgeArray);
    this.attribute(0, this.placeBuffer, 3);
    if (this.weights) this.attachWeights();
    this.edgeBuffer = this.buffer(gl.ELEMENT_ARRAY_BUFFER, ends, gl.STATIC_DRAW);
    gl.bindVertexArray(null);
  }

  drawEdges(matrix, look) {
    const { gl } = this;
    if (!this.edgeBuffer) this.makeEdges();
    const { program, places } = this.edgeProgram;
    gl.useProgram(program);
    gl.uniformMatrix4fv(places.toClip, false, matrix);
    gl.uniform4f(places.ink, ...look.edgeInk, 0.35);
    this.useCage(places);
    gl.bindVertexArray(this.edgeArray);
    gl.drawElements(gl.LINES, this.numEdgeEnds, gl.UNSIGNED_INT, 0);
    gl.bindVertexArray(null);
  }

  // First what the model hides, pale, then the rest.
  drawCage(matrix, camera, look) {
    const { gl } = this;
    const passes = this.content.dim === 3 ? [[gl.GREATER, 0.28], [gl.LEQUAL, 1]] : [[gl.LEQUAL, 1]];
    gl.depthMask(false);
    for (const [test, opacity] of passes) {
      gl.depthFunc(test);
      this.drawWire(matrix, look, opacity);
    }
    for (const [test, opacity] of look.showsDots ? passes : []) {
      gl.depthFunc(test);
      this.drawDots(matrix, camera, look, opacity);
    }
    gl.depthFunc(gl.LESS);
    gl.depthMask(true);
  }

  drawWire(matrix, look, opacity) {
    const { gl, canvas } = this;
    const { program, places } = this.wireProgram;
    gl.useProgram(program);
    gl.uniformMatrix4fv(places.toClip, false, matrix);
    gl.uniform2f(places.halfViewport, canvas.width / 2, canvas.height / 2);
    gl.uniform1f(places.halfWidth, 0.75 * this.ratio);
    this.wireArrays.forEach((array, k) => {
      gl.uniform4f(places.ink, ...look.ink, (k === 0 ? 0.8 : 0.35) * opacity);
      gl.bindVertexArray(array);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.numLines[k]);
    });
    gl.bindVertexArray(null);
  }

  drawDots(matrix, camera, look, opacity) {
    const { gl } = this;
    const { program, places } = this.dotProgram;
    gl.useProgram(program);
    gl.uniformMatrix4fv(places.toClip, false, matrix);
    gl.uniform1f(places.size, look.dotSize * this.ratio);
    gl.uniform3f(places.pointer, ...look.pointer, camera.width / camera.height);
    gl.uniform4f(places.ink, ...look.ink, Math.min(1, 1.4 * opacity));
    gl.uniform4f(places.highlight, ...look.highlight, Math.min(1, 2.2 * opacity));
    gl.uniform3fv(places.rim, look.background);
    gl.uniform2f(places.depth, camera.depthFactor(camera.sphere.center), camera.shrinking() * camera.sphere.radius);
    gl.bindVertexArray(this.dotArray);
    gl.drawArrays(gl.POINTS, 0, this.states.length);
    gl.bindVertexArray(null);
  }
}
