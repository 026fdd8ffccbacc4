// SPDX-License-Identifier: BSD-3-Clause
// The data of the page, as typed arrays. Points have three coordinates in both
// dimensions. Those of the model are seen from `center`, because single precision has digits enough
// there; control points are where they are.
import { curvesOf } from "./curves.mjs";
import { setPoint } from "./vectors.mjs";

export function decodeBytes(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = binary.charCodeAt(k);
  return bytes;
}

export function decodeFloats(text) {
  return new Float32Array(decodeBytes(text).buffer);
}

export function decodeDoubles(text) {
  return new Float64Array(decodeBytes(text).buffer);
}

export function decodeIndices(packed) {
  const bytes = decodeBytes(packed.data);
  if (packed.bytes === 1) return bytes;
  return packed.bytes === 2 ? new Uint16Array(bytes.buffer) : new Uint32Array(bytes.buffer);
}

// From dim coordinates per point to three.
export function inSpace(numbers, dim) {
  const count = numbers.length / dim;
  const result = new numbers.constructor(3 * count);
  for (let i = 0; i < count; ++i) {
    const place = [0, 0, 0];
    for (let k = 0; k < dim; ++k) place[k] = numbers[dim * i + k];
    setPoint(result, i, place);
  }
  return result;
}

// Their coordinates in the dimension of the model, as files have them.
export function inFile(places, dim) {
  return [...places].filter((_, k) => k % 3 < dim);
}

function decodeWeights(packed) {
  const counts = decodeBytes(packed.counts);
  const starts = new Uint32Array(counts.length + 1);
  for (let p = 0; p < counts.length; ++p) starts[p + 1] = starts[p] + counts[p];
  return { starts, controlPoints: decodeIndices(packed.controlPoints),
           values: decodeFloats(packed.values) };
}

// \param picture  in place of all materials
function decodeSurface(packed, numPoints, picture, dim) {
  const surface = { triangles: decodeIndices(packed.triangles), parts: packed.parts, pictures: packed.pictures, sources: null, groups: null };
  if (packed.sources?.data) {  // points without triangles have no corners
    surface.sources = decodeIndices(packed.sources);
    surface.groups = decodeIndices(packed.groups);
  }
  surface.numVertices = surface.sources ? surface.sources.length : numPoints;
  surface.textureCoordinates = packed.textureCoordinates ? decodeFloats(packed.textureCoordinates) : null;
  surface.colors = packed.colors ? decodeBytes(packed.colors) : null;
  if (picture || surface.parts.length === 0) {
    const blends = Boolean(picture) && dim === 2;  // nothing is behind it
    surface.parts = [{ first: 0, count: surface.triangles.length, blends, cutoff: picture && !blends ? 0.5 : 0, picture: picture ? 0 : -1 }];
    surface.pictures = picture ? [picture] : [];
  }
  return surface;
}

// The poses by their times; the first of them is rest unless another one is at the start.
function decodePoses(packed, dim, rest) {
  const poses = packed.map((pose) => ({ name: pose.name, time: pose.time,
                                        points: inSpace(decodeDoubles(pose.points), dim) }));
  if (poses.length > 0 && poses[0].time > 0) poses.unshift({ name: "rest", time: 0, points: rest });
  return poses;
}

export function decodeContent(json) {
  const { dim } = json;
  const center = [0, 0, 0];
  json.points.center.forEach((value, k) => { center[k] = value; });
  const base = inSpace(decodeFloats(json.points.offsets), dim);
  const given = decodeDoubles(json.cage.points);
  const rest = inSpace(given, dim);
  const facets = decodeIndices(json.cage.facets);
  return {
    dim, center, base, rest, given,
    title: json.title, up: json.up, front: json.front, files: json.files, cageText: json.cage.text,
    facets, curves: json.cage.isCurved ? curvesOf(facets, rest.length / 3) : [], edges: decodeIndices(json.cage.edges),
    weights: decodeWeights(json.weights), palette: decodeBytes(json.palette),
    surface: decodeSurface(json.surface, base.length / 3, json.picture, dim),
    poses: decodePoses(json.poses, dim, rest),
  };
}
