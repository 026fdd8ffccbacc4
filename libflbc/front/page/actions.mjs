// SPDX-License-Identifier: BSD-3-Clause
// The actions of dragging selected control points with a tool.
import { centroid, dot, length, pointAt, subtract, times } from "./vectors.mjs";
import { kAxes, rotate, scale, translate } from "./transforms.mjs";

// By how far along the axis a thing at `place` moves if it follows the pointer on the screen.
function alongAxis(camera, place, axis, dx, dy) {
  const unit = camera.halfHeight / camera.height;
  const a = camera.project(place);
  const b = camera.project(place.map((value, k) => value + unit * axis[k]));
  const x = b.x - a.x, y = b.y - a.y;
  const squared = x * x + y * y;
  return squared > 1e-6 ? unit * (dx * x + dy * y) / squared : 0;
}

// A drag from where it began. Turning and scaling need two control points; one alone moves.
export class ToolDrag {
  // \param grabbed  the control point under the pointer
  constructor(editor, camera, tool, axisName, grabbed, from) {
    this.editor = editor;
    this.camera = camera;
    this.shares = editor.shares();
    this.shareOf = (i) => this.shares.get(i);
    this.tool = this.shares.size > 1 || editor.pivot ? tool : "move";
    this.axis = axisName ? kAxes[axisName] : null;
    this.from = from;
    this.grabbed = grabbed;
    editor.begin();
    this.anchor = pointAt(editor.start, grabbed);
    this.center = editor.pivot ?? centroid(editor.start, [...editor.selection]);
  }

  // To where the pointer is.
  to(spot) {
    if (this.tool === "rotate") return this.rotate(this.angleTo(spot));
    if (this.tool === "scale") return this.scale(this.factorTo(spot));
    return this.translate(this.stepTo(spot));
  }

  // By a number of degrees, times, or units of length along the axis (x if none is chosen).
  by(number) {
    if (this.tool === "rotate") return this.rotate(number * Math.PI / 180);
    if (this.tool === "scale") return this.scale(number);
    return this.translate(times(number, this.axis ?? kAxes.x));
  }

  change(move) {
    this.editor.change([...this.shares.keys()], move);
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
      scale(start, listed, this.center, factor, this.axis, result, this.shareOf));
  }

  stepTo(spot) {
    const dx = spot.x - this.from.x, dy = spot.y - this.from.y;
    return this.axis ? times(alongAxis(this.camera, this.anchor, this.axis, dx, dy), this.axis)
                     : this.camera.step(this.anchor, dx, dy);
  }

  angleTo(spot) {
    const middle = this.camera.project(this.center);
    const angleOf = (place) => Math.atan2(middle.y - place.y, place.x - middle.x);
    const sense = this.axis && dot(this.axis, this.camera.axes().toward) < 0 ? -1 : 1;
    return sense * (angleOf(spot) - angleOf(this.from));
  }

  factorTo(spot) {
    const middle = this.camera.project(this.center);
    const distance = (place) => Math.hypot(place.x - middle.x, place.y - middle.y);
    return distance(spot) / Math.max(4, distance(this.from));
  }

  // How far the grabbed control point is from where it began.
  moved() {
    return length(subtract(pointAt(this.editor.points, this.grabbed), this.anchor));
  }
}
