// SPDX-License-Identifier: BSD-3-Clause
// Pictures and drawings as files, and several of them in one.

// \return the bytes of a .png file
export async function pngOf({ data, width, height }) {
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(data.buffer), width, height), 0, 0);
  const blob = await new Promise((done) => { canvas.toBlob(done, "image/png"); });
  if (!blob) throw new Error(`The browser cannot save a picture of ${width} x ${height} pixels`);
  return new Uint8Array(await blob.arrayBuffer());
}

// A drawing that shows drawings one after the other, without a script. Each one is an image, so their
// ids do not clash. \param texts  of .svg files with the same view \param fps  drawings per second
export function playingDrawing(texts, fps) {
  const view = new DOMParser().parseFromString(texts[0], "image/svg+xml").documentElement;
  const sizes = ["viewBox", "width", "height"].filter((name) => view.hasAttribute(name));
  const attributes = sizes.map((name) => `${name}="${view.getAttribute(name)}"`).join(" ");
  const [x, y, width, height] = view.getAttribute("viewBox")?.split(/[\s,]+/) ?? [0, 0, "100%", "100%"];
  const count = texts.length;
  const images = texts.map((text, k) => {
    const bytes = Array.from(new TextEncoder().encode(text), (byte) => String.fromCharCode(byte)).join("");
    const changes = [["hidden", 0], ["visible", k / count], ["hidden", (k + 1) / count]].slice(k === 0 ? 1 : 0, k + 1 === count ? 2 : 3);
    const [values, times] = [0, 1].map((part) => changes.map((change) => change[part]).join(";"));
    return `<image x="${x}" y="${y}" width="${width}" height="${height}" visibility="${k === 0 ? "visible" : "hidden"}" href="data:image/svg+xml;base64,${btoa(bytes)}">`
      + `<animate attributeName="visibility" calcMode="discrete" values="${values}" keyTimes="${times}" dur="${count / fps}s" repeatCount="indefinite"/></image>\n`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" ${attributes}>\n${images.join("")}</svg>\n`;
}

function checksumOf(bytes) {
  let sum = ~0;
  for (const byte of bytes) {
    sum ^= byte;
    for (let bit = 0; bit < 8; ++bit) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum;
}

// A part of a .zip file. \param fields  pairs of a number and how many bytes it has
function zipPart(...fields) {
  return Uint8Array.from(fields.flatMap(([value, count]) => Array.from({ length: count }, (_, k) => (value >>> (8 * k)) & 255)));
}

// A .zip file without compression. \param files  bytes by name
export function zipOf(files) {
  const parts = [], entries = [];
  let place = 0;
  for (const [title, bytes] of Object.entries(files)) {
    const name = new TextEncoder().encode(title);
    const [january1980, utf8] = [0x210000, 0x800];
    const facts = [[20, 2], [utf8, 2], [0, 2], [january1980, 4], [checksumOf(bytes), 4], [bytes.length, 4], [bytes.length, 4], [name.length, 2]];
    parts.push(zipPart([0x04034b50, 4], ...facts, [0, 2]), name, bytes);
    entries.push(zipPart([0x02014b50, 4], [20, 2], ...facts, [0, 2], [0, 2], [0, 2], [0, 2], [0, 4], [place, 4]), name);
    place += 30 + name.length + bytes.length;
  }
  const size = entries.reduce((sum, { length }) => sum + length, 0), count = entries.length / 2;
  return new Blob([...parts, ...entries, zipPart([0x06054b50, 4], [0, 4], [count, 2], [count, 2], [size, 4], [place, 4], [0, 2])]);
}
