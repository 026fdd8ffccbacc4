// SPDX-License-Identifier: BSD-3-Clause
// Models in 2D from what is not a model's file: drawings, pictures, and shapes that are drawn. The
// browser paints all of them, so that curves, transforms, and crossing parts are what one sees.

const kLargest = 1024;  // pixels along the longer side of what is painted
const kFaint = 16;       // alpha of pixels that are not to be seen
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

// \param filling  picture to fill it with, or null
function painted(image, filling = null) {
  const shrink = Math.min(1, kLargest / Math.max(image.width, image.height));
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

// A drawing in SVG, without shapes in the back that fill all of it. \throws Error
async function paintedDrawing(file, filling) {
  let { documentElement: drawing } = new DOMParser().parseFromString(await file.text(), "image/svg+xml");
  if (drawing.localName !== "svg") throw new Error(`${file.name}: this is no drawing in SVG`);
  const lengths = ["width", "height"].map((name) => (/%/.test(drawing.getAttribute(name)) ? NaN : parseFloat(drawing.getAttribute(name))));
  let box = drawing.getAttribute("viewBox")?.trim().split(/[\s,]+/).map(Number) ?? [0, 0, ...lengths];
  if (!box.every(Number.isFinite)) box = [-1000, -1000, 4000, 4000];
  const paint = async (other = null) => {
    const scale = kLargest / Math.max(box[2], box[3]);
    Object.entries({ viewBox: box.join(" "), width: scale * box[2], height: scale * box[3] })
      .forEach(([name, value]) => drawing.setAttribute(name, value));
    const text = new XMLSerializer().serializeToString(drawing);
    return painted(await imageOf(new Blob([text], { type: "image/svg+xml" }), file.name), other);
  };
  const whole = drawing.cloneNode(true);
  const shareOf = async () => seenOf((await paint()).pixels).share;
  let share = await shareOf();
  if (share === 0) throw new Error(`${file.name}: nothing is to be seen in this drawing`);
  for (let shape; share > 0.99 && (shape = drawing.querySelector(kShapes)); share = await shareOf()) shape.remove();
  if (share === 0) drawing = whole;
  for (let k = 0; k < 2; ++k) {
    const { pixels } = await paint();
    const { left, top, right, bottom } = seenOf(pixels), unit = box[2] / pixels.width;
    box = [box[0] + unit * left, box[1] + unit * top, unit * (right - left), unit * (bottom - top)];
  }
  return paint(filling);
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

// A drawing or a picture as a model, its picture as an address, and the theme before which it is
// seen, if there is one. \param filling  file of another picture for a drawing, or none
export async function readPicture(file, filling) {
  const other = filling ? await imageOf(filling, filling.name) : null;
  const { canvas, pixels } = /\.svg$/i.test(file.name) ? await paintedDrawing(file, other)
                                                       : painted(await imageOf(file, file.name));
  const { mean } = seenOf(pixels);
  return { obj: gridToObj(pixels), picture: canvas.toDataURL("image/png"),
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
