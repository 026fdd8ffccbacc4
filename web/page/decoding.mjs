// SPDX-License-Identifier: BSD-3-Clause
// Compressed glTF files become plain ones, which the library reads.
import { extremes, GlbBuffer, kSizes } from "../../libflbc/front/page/glb.mjs";
import { unpacked } from "../js/unpacked.mjs";

const kDraco = "KHR_draco_mesh_compression", kMeshopt = "EXT_meshopt_compression";
const kKtx = "Its pictures are KTX2, which this page does not show; saved files keep them";
const kJson = 0x4e4f534a, kBinary = 0x4e4942;  // chunks of .glb

const align = (size) => 4 * Math.ceil(size / 4);

// \return the document, and its binary chunk or null
function parsed(name, bytes) {
  if (/gltf$/i.test(name)) return { json: JSON.parse(new TextDecoder().decode(bytes)), binary: null };
  const words = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const chunks = {};
  for (let at = 12; at + 8 <= bytes.length;) {
    const length = words.getUint32(at, true);
    chunks[words.getUint32(at + 4, true)] ??= bytes.subarray(at + 8, at + 8 + length);
    at += 8 + align(length);
  }
  return { json: JSON.parse(new TextDecoder().decode(chunks[kJson])), binary: chunks[kBinary] ?? null };
}

// The bytes of all buffers; empty for those that only stand for what is compressed.
async function buffersOf({ json, binary }, files) {
  return Promise.all((json.buffers ?? []).map(async ({ uri, extensions }, k) => {
    if (extensions?.[kMeshopt]?.fallback) return new Uint8Array();
    if (uri === undefined) return k === 0 && binary ? binary : new Uint8Array();
    if (uri.startsWith("data:")) return Uint8Array.from(atob(uri.slice(uri.indexOf(",") + 1)), (c) => c.charCodeAt(0));
    const file = files[decodeURIComponent(uri).replace(/^.*\//, "")];
    if (!file) throw new Error(`${uri} is missing; drop all files of the model together`);
    return new Uint8Array(file);
  }));
}

const sourceOf = async (packed) => new TextDecoder().decode(await unpacked(packed));

async function makeMeshopt({ meshopt }) {
  const decoder = new Function(`${(await sourceOf(meshopt)).replace(/^export .*$/m, "")}\nreturn MeshoptDecoder;`)();
  await decoder.ready;
  return decoder;
}

async function makeDraco({ draco, dracoWasm }) {
  const make = new Function("module", "exports", `${await sourceOf(draco)}\nreturn DracoDecoderModule;`)();
  return make({ wasmBinary: await unpacked(dracoWasm) });
}

const arraysOf = (draco) => ({
  5120: [Int8Array, draco.DT_INT8], 5121: [Uint8Array, draco.DT_UINT8], 5122: [Int16Array, draco.DT_INT16],
  5123: [Uint16Array, draco.DT_UINT16], 5125: [Uint32Array, draco.DT_UINT32], 5126: [Float32Array, draco.DT_FLOAT32] });

// Copies what a function of Draco writes to its memory.
function copied(draco, Type, length, write) {
  const size = length * Type.BYTES_PER_ELEMENT, at = draco._malloc(size);
  try {
    if (!write(size, at)) throw new Error("the compressed mesh is damaged");
    return new Uint8Array(draco.HEAPU8.slice(at, at + size).buffer);
  } finally {
    draco._free(at);
  }
}

// \param add  takes bytes, the rest of their buffer view, and maybe its number; returns this number
function decodeDraco(draco, json, primitive, bytes, add) {
  const { attributes, bufferView } = primitive.extensions[kDraco];
  const decoder = new draco.Decoder(), mesh = new draco.Mesh();
  try {
    if (!decoder.DecodeArrayToMesh(bytes, bytes.length, mesh).ok()) throw new Error("the compressed mesh is damaged");
    const corners = 3 * mesh.num_faces();
    primitive.indices ??= json.accessors.push({ type: "SCALAR" }) - 1;
    delete primitive.mode;  // strips, too, are decoded as triangles
    const indices = copied(draco, Uint32Array, corners, (size, at) => decoder.GetTrianglesUInt32Array(mesh, size, at));
    Object.assign(json.accessors[primitive.indices], { bufferView: add(indices, { target: 34963 }, bufferView), byteOffset: 0,
                                                        componentType: 5125, count: corners });
    for (const [name, id] of Object.entries(attributes)) {
      const accessor = json.accessors[primitive.attributes[name]];
      const [Type, kind] = arraysOf(draco)[accessor.componentType];
      const columns = kSizes[accessor.type], stride = align(columns * Type.BYTES_PER_ELEMENT), count = mesh.num_points();
      const dense = copied(draco, Type, columns * count, (size, at) => decoder.GetAttributeDataArrayForAllPoints(
        mesh, decoder.GetAttributeByUniqueId(mesh, id), kind, size, at));
      const rows = new Uint8Array(stride * count), row = columns * Type.BYTES_PER_ELEMENT;
      for (let v = 0; v < count; ++v) rows.set(dense.subarray(v * row, (v + 1) * row), v * stride);
      Object.assign(accessor, { bufferView: add(rows, { byteStride: stride, target: 34962 }), byteOffset: 0, count });
      // Quantization moves the smallest and largest numbers, too.
      if (accessor.min) Object.assign(accessor, extremes(new Type(dense.buffer), columns));
    }
  } finally {
    draco.destroy(mesh);
    draco.destroy(decoder);
  }
  delete primitive.extensions[kDraco];
}

// \param model  { name, bytes, files } of a glTF model \param assets  packed decoders
// \return the same, or the decoded .glb; the library says what is wrong with other files
export async function decoded(model, assets) {
  let document;
  try {
    document = parsed(model.name, new Uint8Array(model.bytes));
  } catch {
    return model;
  }
  if (document.json?.extensionsUsed?.includes?.("KHR_texture_basisu")) model.note = kKtx;
  if (!document.json?.extensionsRequired?.some?.((name) => name === kDraco || name === kMeshopt)) return model;
  try {
    return await decodedDocument(model, document, assets);
  } catch ({ message }) {
    throw new Error(`${model.name}: ${message}`);
  }
}

async function decodedDocument(model, document, assets) {
  const { json } = document;
  const needs = (name) => json.extensionsRequired.includes(name);
  const buffers = await buffersOf(document, model.files);
  const buffer = new GlbBuffer();
  const primitives = (json.meshes ?? []).flatMap(({ primitives }) => primitives).filter(({ extensions }) => extensions?.[kDraco]);
  const sources = primitives.map(({ extensions }) => extensions[kDraco].bufferView);
  const free = new Set(sources);
  const add = (bytes, rest, source) => {
    const view = { ...buffer.put(bytes), ...rest };
    if (!free.delete(source)) return json.bufferViews.push(view) - 1;
    json.bufferViews[source] = view;
    return source;
  };
  const bytesOf = ({ buffer = 0, byteOffset = 0, byteLength }) => buffers[buffer].subarray(byteOffset, byteOffset + byteLength);
  const compressed = sources.map((source) => bytesOf(json.bufferViews[source]));
  const meshopt = needs(kMeshopt) ? await makeMeshopt(assets) : null;
  json.bufferViews?.forEach((view, k) => {
    const { [kMeshopt]: packed, ...extensions } = view.extensions ?? {};
    if (sources.includes(k)) return;  // becomes that of the indices
    if (!packed || !meshopt) {
      Object.assign(view, buffer.put(bytesOf(view)));
      return;
    }
    const bytes = new Uint8Array(packed.count * packed.byteStride);
    meshopt.decodeGltfBuffer(bytes, packed.count, packed.byteStride, bytesOf(packed), packed.mode, packed.filter);
    Object.assign(view, buffer.put(bytes), { extensions });
    if (Object.keys(extensions).length === 0) delete view.extensions;
  });
  if (needs(kDraco)) {
    const draco = await makeDraco(assets);
    primitives.forEach((primitive, k) => decodeDraco(draco, json, primitive, compressed[k], add));
  }
  for (const list of ["extensionsRequired", "extensionsUsed"]) {
    json[list] = json[list]?.filter((name) => name !== kDraco && name !== kMeshopt);
    if (!json[list]?.length) delete json[list];
  }
  return { ...model, name: model.name.replace(/gltf$/i, "glb"), bytes: new Uint8Array(await buffer.file(json).arrayBuffer()) };
}
