// SPDX-License-Identifier: BSD-3-Clause
// Models in 2D from what is not a model's file: drawings, pictures, and shapes that are drawn. The
// browser paints all of them, so that curves, transforms, and crossing parts are what one sees.

const kLargest = 1024;  // pixels along the longer side of what is painted
const kFaint = 16;       // alpha of pixels that are not to be seen
const kSvg = "http://www.w3.org/2000/svg";
const kShapes = ":is(path, polygon, polyline, rect, circle, ellipse):not(defs *, clipPath *, mask *, symbol *)";

async function imageOf(blob, name) {
  const image = new Image();
  image.src = URL.createObjectURL(blob);
  try {
    await image.decode();
  } catch {
    throw new Error(`${name}: the browser cannot read this picture`);
  } finally {
    URL.revokeObjectURL(image.src);
  }
  return image;
}

// \param filling  picture to fill it with, or null \param largest  pixels along the longer side
function painted(image, filling = null, largest = kLargest) {
  const shrink = Math.min(1, largest / Math.max(image.width, image.height));
  const [width, height] = [image.width, image.height].map((size) => Math.max(1, Math.round(shrink * size)));
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0, width, height);
  context.globalCompositeOperation = "source-in";
  if (filling) context.drawImage(filling, 0, 0, width, height);
  return { canvas, pixels: context.getImageData(0, 0, width, height) };
}

// Of the pixels that are to be seen: their share, mean brightness from 0 to 1, and bounds.
function seenOf({ data, width, height }) {
  let count = 0, sum = 0, left = width, top = height, right = 0, bottom = 0;
  for (let k = 0; k < width * height; ++k) {
    const [red, green, blue, alpha] = data.subarray(4 * k, 4 * k + 4);
    if (alpha <= kFaint) continue;
    const x = k % width, y = Math.floor(k / width);
    [left, right, top, bottom] = [Math.min(left, x), Math.max(right, x + 1), Math.min(top, y), Math.max(bottom, y + 1)];
    count += 1;
    sum += (0.3 * red + 0.6 * green + 0.1 * blue) / 255;
  }
  return { share: count / (width * height), mean: sum / Math.max(1, count), left, top, right, bottom };
}

// Makes the background of an opaque picture transparent: what has the color of its border and is
// connected with it. \return whether there is one, with something in front
function cutOut({ data, width, height }) {
  const kSame = 24, kSoft = 96;  // of 255, in the channel that differs most
  const border = [];
  for (let x = 0; x < width; ++x) border.push(x, x + width * (height - 1));
  for (let y = 1; y < height - 1; ++y) border.push(width * y, width * (y + 1) - 1);
  for (let k = 3; k < data.length; k += 4) if (data[k] < 255) return false;
  const color = [0, 1, 2].map((c) => border.map((k) => data[4 * k + c]).sort((a, b) => a - b)[border.length >> 1]);
  const distance = (k) => Math.max(...color.map((value, c) => Math.abs(data[4 * k + c] - value)));
  const open = border.filter((k) => distance(k) <= kSame);
  if (open.length < 0.95 * border.length) return false;
  const alpha = new Uint8Array(width * height).fill(255);
  let left = alpha.length;
  while (open.length > 0) {
    const k = open.pop();
    if (alpha[k] === 0) continue;
    if (distance(k) > kSame) {
      alpha[k] = Math.min(255, 255 * distance(k) / kSoft);
      continue;
    }
    alpha[k] = 0;
    left -= 1;
    const x = k % width;
    if (x > 0) open.push(k - 1);
    if (x < width - 1) open.push(k + 1);
    if (k >= width) open.push(k - width);
    if (k < width * (height - 1)) open.push(k + width);
  }
  if (left < 0.002 * alpha.length) return false;
  alpha.forEach((value, k) => { data[4 * k + 3] = value; });
  return true;
}

// The root of a drawing, which needs no namespace here. \throws Error
function parsedDrawing(text, name) {
  const root = (code) => new DOMParser().parseFromString(code, "image/svg+xml").documentElement;
  let drawing = root(text);
  if (drawing.localName === "svg" && drawing.namespaceURI !== kSvg) drawing = root(text.replace(/<svg\b/, `<svg xmlns="${kSvg}"`));
  if (drawing.localName !== "svg") throw new Error(`${name}: this is no drawing in SVG`);
  return drawing;
}

// A drawing in SVG, without shapes in the back that fill all of it. \throws Error
async function paintedDrawing(file, filling) {
  const source = await file.text();
  let drawing = parsedDrawing(source, file.name);
  // Its HTML would make the canvas unreadable.
  const foreign = drawing.querySelectorAll("foreignObject");
  for (const part of foreign) part.remove();
  const note = foreign.length > 0 ? "Text in HTML (foreignObject) is left out; export it as paths" : "";
  const lengths = ["width", "height"].map((name) => (/^[^%]+$/.test(drawing.getAttribute(name) ?? "") ? drawing[name].baseVal.value : NaN));
  const own = drawing.getAttribute("viewBox")?.trim().split(/[\s,]+/).map(Number) ?? [];
  const isSized = lengths.every((length) => length > 0), hasBox = own.length === 4 && own.every(Number.isFinite);
  const size = isSized ? lengths : hasBox ? own.slice(2) : [300, 150];  // of an image without size
  // What a viewer cuts off is not to be seen. Without a size nothing is.
  let box = isSized || hasBox ? [0, 0, ...size] : [-1000, -1000, 4000, 4000];
  Object.entries({ x: 0, y: 0, width: size[0], height: size[1], overflow: isSized || hasBox ? "hidden" : "visible" })
    .forEach(([name, value]) => drawing.setAttribute(name, value));
  const paint = async (other = null) => {
    const scale = kLargest / Math.max(box[2], box[3]);
    const frame = `<svg xmlns="${kSvg}" viewBox="${box.join(" ")}" width="${scale * box[2]}" height="${scale * box[3]}">`;
    const text = `${frame}${new XMLSerializer().serializeToString(drawing)}</svg>`;
    return painted(await imageOf(new Blob([text], { type: "image/svg+xml" }), file.name), other);
  };
  const whole = drawing.cloneNode(true);
  const shareOf = async () => seenOf((await paint()).pixels).share;
  let share = await shareOf();
  if (share === 0) throw new Error(`${file.name}: nothing is to be seen in this drawing${note && `. ${note}`}`);
  for (let shape; share > 0.99 && (shape = drawing.querySelector(kShapes)); share = await shareOf()) shape.remove();
  if (share === 0) drawing = whole;
  for (let k = 0; k < 2; ++k) {
    const { pixels } = await paint();
    const { left, top, right, bottom } = seenOf(pixels), unit = box[2] / pixels.width;
    box = [box[0] + unit * left, box[1] + unit * top, unit * (right - left), unit * (bottom - top)];
  }
  const result = await paint(filling), { width, height } = result.pixels;
  const [x, y] = [width / box[2], height / box[3]];
  const placing = { page: size, matrix: [x, 0, 0, -y, -x * box[0], height + y * box[1]] };
  return { ...result, note, drawing: filling ? null : { source, placing } };
}

// A picture, without its background unless that is to be kept. \throws Error
async function paintedPicture(file, keepsBackground) {
  const { canvas, pixels } = painted(await imageOf(file, file.name));
  const isCut = !keepsBackground && cutOut(pixels);
  if (isCut) canvas.getContext("2d").putImageData(pixels, 0, 0);
  return { canvas, pixels, isCut, note: isCut ? "The background is left out; the panel Cage can bring it back" : "" };
}

// The pixels of a picture at its own resolution. \param source  of readPicture()
export async function wholePicture({ file, keepsBackground }) {
  const { pixels } = painted(await imageOf(file, file.name), null, Infinity);
  if (!keepsBackground) cutOut(pixels);
  return pixels;
}

// Squares that cover what is to be seen of a picture, as OBJ with texture coordinates.
function gridToObj({ data, width, height }) {
  const kSquares = 96;  // along the longer side
  const step = Math.ceil(Math.max(width, height) / kSquares);
  const lines = [], numbers = new Map();
  const corner = (left, top) => {
    const x = Math.min(left, width), y = height - Math.min(top, height);
    const place = `v ${x} ${y} 0`;
    if (!numbers.has(place)) {
      numbers.set(place, numbers.size + 1);
      lines.push(place, `vt ${x / width} ${y / height}`);
    }
    return `${numbers.get(place)}/${numbers.get(place)}`;
  };
  const isSeen = (left, top) => {
    for (let y = top; y < Math.min(top + step, height); ++y) {
      for (let x = left; x < Math.min(left + step, width); ++x) if (data[4 * (x + width * y) + 3] > kFaint) return true;
    }
    return false;
  };
  for (let y = 0; y < height; y += step) {
    for (let x = 0; x < width; x += step) {
      if (isSeen(x, y)) lines.push(`f ${corner(x, y)} ${corner(x, y + step)} ${corner(x + step, y + step)} ${corner(x + step, y)}`);
    }
  }
  return lines.join("\n");
}

// A drawing or a picture as a model, its picture as an address, the theme before which it is seen, if
// there is one, whether a background was cut out, a note, and what is saved again: the document with its place in
// the model, or the file of a picture with its size there.
// \param filling  file of another picture
// for a drawing, or none
export async function readPicture(file, { filling = null, keepsBackground = false } = {}) {
  const other = filling ? await imageOf(filling, filling.name) : null;
  const { canvas, pixels, isCut = false, note, drawing = null } = /\.svg$/i.test(file.name)
    ? await paintedDrawing(file, other) : await paintedPicture(file, keepsBackground);
  const { mean } = seenOf(pixels);
  const photo = drawing || filling ? null : { file, keepsBackground, size: [pixels.width, pixels.height] };
  return { obj: gridToObj(pixels), picture: canvas.toDataURL("image/png"), isCut, note, drawing, photo,
           theme: mean < 0.25 ? "light" : mean > 0.8 ? "dark" : null };
}

// A board on which a polygon is drawn.
export class Sketch {
  constructor(board, onClosed) {
    this.board = board;
    this.line = board.querySelector("polygon");
    this.onClosed = onClosed;
    board.addEventListener("click", (event) => this.click(event));
    this.clear();
  }

  clear() {
    this.corners = [];
    this.draw();
  }

  draw() {
    this.line.setAttribute("points", this.corners.map((corner) => corner.join(",")).join(" "));
  }

  click(event) {
    const box = this.board.getBoundingClientRect();
    const corner = [600 * (event.clientX - box.left) / box.width, 400 * (event.clientY - box.top) / box.height];
    const [first] = this.corners;
    if (first && this.corners.length > 2 && Math.hypot(corner[0] - first[0], corner[1] - first[1]) < 14) {
      return this.close();
    }
    this.corners.push(corner.map((place) => Math.round(place)));
    this.draw();
  }

  close() {
    if (this.corners.length > 2) this.onClosed(new XMLSerializer().serializeToString(this.board));
  }
}
