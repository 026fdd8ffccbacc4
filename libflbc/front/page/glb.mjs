// SPDX-License-Identifier: BSD-3-Clause
// The keys as an animation in glTF. Every key is a morph target, because readers interpolate targets
// along straight lines, and need no limit of influences.
import { decodeBytes } from "./data.mjs";
import { Deformer } from "./deformer.mjs";
import { atVertices, sumNormals } from "./surface_normals.mjs";

export const kSizes = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };

// The binary chunk of a .glb file, part by part.
export class GlbBuffer {
  parts = [];
  byteLength = 0;

  // \return the buffer view of the bytes
  put(bytes) {
    const byteOffset = this.byteLength, padding = -bytes.byteLength & 3;
    this.parts.push(bytes, new Uint8Array(padding));
    this.byteLength += bytes.byteLength + padding;
    return { buffer: 0, byteOffset, byteLength: bytes.byteLength };
  }

  // \param document  whose buffer views are in this buffer
  file(document) {
    const { byteLength } = this;
    const text = new TextEncoder().encode(JSON.stringify({ ...document, buffers: [{ byteLength }] }));
    const padding = -text.length & 3, length = text.length + padding;
    return new Blob([Uint32Array.of(0x46546C67, 2, 28 + length + byteLength, length, 0x4E4F534A), text, " ".repeat(padding),
                     Uint32Array.of(byteLength, 0x004E4942), ...this.parts]);
  }
}

// The smallest and largest numbers of each column of an accessor.
export function extremes(numbers, size) {
  const extreme = (best) => Array.from({ length: size }, (_, k) =>
    numbers.reduce((far, value, j) => (j % size === k ? best(far, value) : far), numbers[k]));
  return { min: extreme(Math.min), max: extreme(Math.max) };
}

// Places and normals of the vertices in a pose.
function shapeOf({ sources, triangles, groups, numVertices }, deformer, pose) {
  deformer.move(pose);
  const places = atVertices(deformer.points, sources, 3, new Float32Array(3 * numVertices)).slice();
  const normals = new Float32Array(3 * numVertices);
  sumNormals(places, triangles, groups, normals);
  for (let v = 0; v < normals.length; v += 3) {
    const normal = normals.subarray(v, v + 3), length = Math.hypot(...normal);
    normal.set(length > 0 ? normal.map((value) => value / length) : [0, 0, 1]);
  }
  return { POSITION: places, NORMAL: normals };
}

// From sRGB, as glTF has colors.
const linear = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);

function materialOf({ color, opacity = 1, blends = opacity < 1, cutoff = 0, picture = -1 }) {
  const factor = [...(color ?? [1, 1, 1]).map(linear), opacity];
  return { doubleSided: true, pbrMetallicRoughness: { metallicFactor: 0, baseColorFactor: factor, ...(picture >= 0 && { baseColorTexture: { index: picture } }) },
           ...(blends && { alphaMode: "BLEND" }), ...(cutoff > 0 && { alphaMode: "MASK", alphaCutoff: cutoff }) };
}

// \param basis  right, up and toward the viewer
export function glbOf({ center, poses, rest, surface, title, weights, base }, basis) {
  const accessors = [], bufferViews = [], buffer = new GlbBuffer();
  const putBytes = (bytes) => bufferViews.push(buffer.put(bytes)) - 1;
  const put = (numbers, type = "SCALAR") => {
    const size = kSizes[type];
    return accessors.push({ bufferView: putBytes(numbers), type, count: numbers.length / size,
                            componentType: numbers instanceof Uint32Array ? 5125 : 5126, ...extremes(numbers, size) }) - 1;
  };
  const putShape = ({ POSITION, NORMAL }) => ({ POSITION: put(POSITION, "VEC3"), NORMAL: put(NORMAL, "VEC3") });
  const deformer = new Deformer(weights, base, rest);
  const atRest = shapeOf(surface, deformer, rest);
  const targets = poses.map(({ points }) => {
    const shape = shapeOf(surface, deformer, points);
    for (const name in shape) shape[name].forEach((value, k) => { shape[name][k] = value - atRest[name][k]; });
    return putShape(shape);
  });
  const attributes = putShape(atRest);
  if (surface.textureCoordinates) attributes.TEXCOORD_0 = put(surface.textureCoordinates, "VEC2");
  if (surface.colors) attributes.COLOR_0 = put(Float32Array.from(surface.colors, (byte) => linear(byte / 255)), "VEC3");
  const primitives = surface.parts.map(({ first, count }, material) =>
    ({ attributes, targets, material, indices: put(Uint32Array.from(surface.triangles.subarray(first, first + count))) }));
  const images = surface.pictures.map((address) =>
    ({ mimeType: /:(.*);/.exec(address)[1], bufferView: putBytes(decodeBytes(address.split(",")[1])) }));
  const input = put(Float32Array.from(poses, ({ time }) => time));
  const output = put(Float32Array.from({ length: poses.length ** 2 }, (_, k) => Number(k % (poses.length + 1) === 0)));
  // Of a node with children, because an animation has no node with a matrix.
  const matrix = [0, 1, 2].flatMap((k) => [...basis.map((axis) => axis[k]), 0]);
  return buffer.file({
    asset: { version: "2.0" }, bufferViews, accessors, scene: 0, scenes: [{ nodes: [0] }],
    nodes: [{ children: [1], matrix: [...matrix, 0, 0, 0, 1] }, { mesh: 0, translation: center }],
    meshes: [{ name: title, primitives, extras: { targetNames: poses.map(({ name }) => name) } }],
    materials: surface.parts.map(materialOf),
    ...(images.length > 0 && { images, textures: images.map((_, source) => ({ source })) }),
    animations: [{ samplers: [{ input, output }], channels: [{ sampler: 0, target: { node: 1, path: "weights" } }] }],
  });
}
