// SPDX-License-Identifier: BSD-3-Clause
// The actions of dragging selected control points with a tool, or the model.
import { shortNumber } from "./colors.mjs";
import { add, centroid, cross, dot, length, pointAt, setPoint, times } from "./vectors.mjs";
import { kAxes, rotate, scale, translate } from "./transforms.mjs";

export const kUnits = { move: "", rotate: "°", scale: " times" };
const kSnaps = { rotate: Math.PI / 12, scale: 0.1 };
const kSteady = 0.01;  // of the sum of squared weights: less does not move a place along the axis of the mirror
const kLever = 64;  // pixels, of a ring that is seen from its side

// By how far along one or two axes a thing at `place` moves if it follows the pointer on the screen.
function alongAxes(camera, place, axes, dx, dy) {
  const unit = camera.halfHeight / camera.height;
  const from = camera.project(place);
  const [a, b] = axes.map((axis) => {
    const to = camera.project(add(place, times(unit, axis)));
    return { x: to.x - from.x, y: to.y - from.y };
  });
  const squared = a.x * a.x + a.y * a.y;
  if (!b) return [squared > 1e-6 ? unit * (dx * a.x + dy * a.y) / squared : 0];
  const area = a.x * b.y - a.y * b.x;
  return Math.abs(area) > 1e-6 ? [unit * (dx * b.y - dy * b.x) / area, unit * (dy * a.x - dx * a.y) / area] : [0, 0];
}

// A drag from where it began. Turning and scaling need two control points; one alone moves.
export class ToolDrag {
  // \param axisNames  "x", "xy", and so on; nothing: all
  // \param grabbed  the control point under the pointer, null: the center of the selection
  // \param named  axes by name
  constructor(editor, camera, tool, axisNames, grabbed, from, named = kAxes) {
    this.editor = editor;
    this.camera = camera;
    this.shares = editor.shares();
    this.shareOf = (i) => this.shares.get(i);
    this.tool = this.shares.size > 1 || editor.pivot ? tool : "move";
    this.named = named;
    this.axes = [...axisNames ?? ""].map((name) => named[name]);
    this.axis = this.axes[0];
    this.label = axisNames ? `${this.tool} ${axisNames}` : this.tool;
    this.from = from;
    editor.begin();
    this.center = editor.pivot ?? centroid(editor.start, [...editor.selection]);
    this.anchor = grabbed === null ? this.center : pointAt(editor.start, grabbed);
    this.amounts = [0];
    this.keepsLine = true;
  }

  // To where the pointer is. \param snaps  in round steps
  to(spot, snaps = false) {
    const amounts = this.tool === "rotate" ? [this.angleTo(spot)] : this.tool === "scale" ? [this.factorTo(spot)] : this.stepsTo(spot);
    const step = kSnaps[this.tool] ?? 10 ** Math.round(Math.log10(this.editor.sphere.radius / 20));
    this.apply(snaps ? amounts.map((amount) => step * Math.round(amount / step)) : amounts);
  }

  apply(amounts) {
    this.amounts = amounts;
    if (this.tool === "rotate") return this.rotate(amounts[0]);
    if (this.tool === "scale") return this.scale(amounts[0]);
    const axes = this.movingAxes();
    return this.translate(amounts.reduce((sum, amount, k) => add(sum, times(amount, axes[k])), [0, 0, 0]));
  }

  // By a number of degrees, times, or units of length along the axis (x if none is chosen).
  by(number) {
    if (this.tool === "move" && !this.axis) return this.translate(times(number, this.named.x));
    return this.apply([this.tool === "rotate" ? number * Math.PI / 180 : number]);
  }

  // What has been done, with its number.
  get text() {
    const numbers = this.tool === "rotate" ? [this.amounts[0] * 180 / Math.PI]
                  : this.tool === "move" && !this.axis ? [Math.hypot(...this.amounts)] : this.amounts;
    return `${this.label} ${numbers.map(shortNumber).join(", ")}${kUnits[this.tool]}`;
  }

  change(move) {
    this.editor.change([...this.shares.keys()], move, this.keepsLine);
  }

  translate(step) {
    this.change((start, listed, result) => translate(start, listed, step, result, this.shareOf));
  }

  rotate(angle) {
    const axis = this.axis ?? this.camera.axes().toward;
    this.change((start, listed, result) =>
      rotate(start, listed, this.center, axis, angle, result, this.shareOf));
  }

  scale(factor) {
    this.change((start, listed, result) =>
      scale(start, listed, this.center, factor, this.axis ?? null, result, this.shareOf));
  }

  // Freely is in the plane of the picture.
  movingAxes() {
    const { right, up } = this.camera.axes();
    return this.axis ? this.axes : [right, up];
  }

  stepsTo(spot) {
    return alongAxes(this.camera, this.anchor, this.movingAxes(), spot.x - this.from.x, spot.y - this.from.y);
  }

  angleTo(spot) {
    const { camera, center, from } = this;
    const { right, toward } = camera.axes();
    const axis = this.axis ?? toward;
    if (Math.abs(dot(axis, toward)) < 0.25) {
      const across = cross(axis, toward);
      const [far] = alongAxes(camera, center, [times(1 / length(across), across)], spot.x - from.x, spot.y - from.y);
      return far / length(camera.step(center, kLever, 0));
    }
    const side = cross(axis, cross(right, axis));
    const first = times(1 / length(side), side), second = cross(axis, first);
    const middle = camera.project(center);
    const angleOf = (place) => {
      const [x, y] = alongAxes(camera, center, [first, second], place.x - middle.x, place.y - middle.y);
      return Math.atan2(y, x);
    };
    const angle = angleOf(spot) - angleOf(from);
    return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
  }

  factorTo(spot) {
    const middle = this.camera.project(this.center);
    const distance = (place) => Math.hypot(place.x - middle.x, place.y - middle.y);
    return distance(spot) / Math.max(4, distance(this.from));
  }
}

// The smallest moves of control points that together move a place: by which factor each follows a step along
// each axis. Images in the mirror move as images do, so a place in its plane stays there.
// \param weights  of the place, by control point
export function leastMoves(weights, pairs = null, mirrorAxis = -1) {
  const parts = new Map();
  const put = (i, weight, reversed) => parts.set(i, [0, 1, 2].map((k) => (parts.get(i)?.[k] ?? 0) + (k === reversed ? -weight : weight)));
  let most = 0;
  for (const [i, weight] of weights) {
    const image = pairs?.[i] ?? -1, own = image < 0 ? weight : weight / 2;
    most += weight * weight;
    put(i, own, -1);
    if (image >= 0) put(image, own, mirrorAxis);
  }
  const squares = [0, 1, 2].map((k) => [...parts.values()].reduce((sum, part) => sum + part[k] * part[k], 0));
  const divisors = squares.map((sum) => Math.max(sum, kSteady * most) || 1);
  return new Map([...parts].map(([i, part]) => [i, part.map((value, k) => value / divisors[k])]));
}

// A drag of a place of the model, which follows the pointer.
export class ModelDrag extends ToolDrag {
  constructor(editor, camera, axisNames, place, weights, from, named) {
    super(editor, camera, "move", axisNames, null, from, named);
    this.anchor = place;
    this.factors = leastMoves(weights, editor.pairs, editor.mirrorAxis);
  }

  translate(step) {
    this.editor.change([...this.factors.keys()], (start, listed, result) => {
      for (const [i, factor] of this.factors) setPoint(result, i, pointAt(start, i).map((value, k) => value + factor[k] * step[k]));
    }, false);  // or the place would not follow
  }
}
