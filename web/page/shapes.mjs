// SPDX-License-Identifier: BSD-3-Clause
// Models in 2D from what is not a model's file: paths of .svg, pictures, and shapes that are drawn.

// Closed polygons as OBJ. \param polygons  lists of [x, y], y down
export function polygonsToObj(polygons) {
  const lines = [];
  let first = 1;
  for (const polygon of polygons) {
    for (const [x, y] of polygon) lines.push(`v ${x} ${-y} 0`);
    lines.push(`l ${polygon.map((_, k) => first + k).join(" ")} ${first}`);
    first += polygon.length;
  }
  return `${lines.join("\n")}\n`;
}

// The corners of a closed polygon that matter by more than a distance.
function simplified(polygon, distance) {
  const kept = new Set([0]);
  const keepBetween = (from, to) => {
    const [a, b] = [polygon[from], polygon[to % polygon.length]];
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const length = Math.hypot(dx, dy);
    let farthest = -1, most = distance;
    for (let k = from + 1; k < to; ++k) {
      const [x, y] = [polygon[k][0] - a[0], polygon[k][1] - a[1]];
      const away = length > distance ? Math.abs(x * dy - y * dx) / length : Math.hypot(x, y);
      if (away > most) [farthest, most] = [k, away];
    }
    if (farthest < 0) return;
    kept.add(farthest);
    keepBetween(from, farthest);
    keepBetween(farthest, to);
  };
  keepBetween(0, polygon.length);
  return polygon.filter((_, k) => kept.has(k));
}

// The outlines of all shapes in a drawing. \throws Error
export function svgToObj(text) {
  const drawing = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  const host = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  host.style.cssText = "position: absolute; visibility: hidden";
  document.body.append(host);
  const polygons = [];
  for (const shape of drawing.querySelectorAll("path, polygon, polyline, rect, circle, ellipse")) {
    host.append(document.importNode(shape));
    const outline = host.lastElementChild;
    // The parts of a path, each of which begins with an M.
    const parts = (outline.getAttribute("d") ?? "").split(/(?=M)/).filter((part) => part.trim());
    for (const part of parts.length > 1 ? parts : [null]) {
      if (part) outline.setAttribute("d", part);
      const length = outline.getTotalLength();
      const count = 2000;
      const points = Array.from({ length: count }, (_, k) => outline.getPointAtLength(length * k / count));
      const polygon = simplified(points.map(({ x, y }) => [x, y]), 5e-4 * length);
      if (polygon.length > 2) polygons.push(polygon);
    }
  }
  host.remove();
  if (polygons.length === 0) throw new Error("there is no path, polygon, rectangle, or circle in this drawing");
  return polygonsToObj(polygons);
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
      for (let x = left; x < Math.min(left + step, width); ++x) if (data[4 * (x + width * y) + 3] > 16) return true;
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

// A picture as a model and as an address. Larger ones are shrunk.
export async function decodePicture(file) {
  const kLargest = 1024;
  const image = await createImageBitmap(file);
  const shrink = Math.min(1, kLargest / Math.max(image.width, image.height));
  const width = Math.max(1, Math.round(shrink * image.width));
  const height = Math.max(1, Math.round(shrink * image.height));
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  context.drawImage(image, 0, 0, width, height);
  return { obj: gridToObj(context.getImageData(0, 0, width, height)), address: canvas.toDataURL("image/png") };
}

// A board on which a polygon is drawn.
export class Sketch {
  constructor(board, onClosed) {
    this.board = board;
    this.line = board.querySelector("polyline");
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
    if (this.corners.length > 2) this.onClosed(polygonsToObj([this.corners]));
  }
}
