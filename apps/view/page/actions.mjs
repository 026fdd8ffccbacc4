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
    this.indices = [...editor.selection];
    this.tool = this.indices.length > 1 ? tool : "move";
    this.axis = axisName ? kAxes[axisName] : null;
    this.from = from;
    this.grabbed = grabbed;
    editor.begin();
    this.anchor = pointAt(editor.start, grabbed);
    this.center = centroid(editor.start, this.indices);
  }

  to(spot) {
    const { editor, indices } = this;
    editor.change(indices, (start, listed, result) => {
      if (this.tool === "rotate") return this.rotate(spot, start, listed, result);
      if (this.tool === "scale") return this.scale(spot, start, listed, result);
      return this.translate(spot, start, listed, result);
    });
  }

  translate(spot, start, listed, result) {
    const dx = spot.x - this.from.x, dy = spot.y - this.from.y;
    const step = this.axis
      ? times(alongAxis(this.camera, this.anchor, this.axis, dx, dy), this.axis)
      : this.camera.step(this.anchor, dx, dy);
    translate(start, listed, step, result);
  }

  rotate(spot, start, listed, result) {
    const middle = this.camera.project(this.center);
    const angleOf = (place) => Math.atan2(middle.y - place.y, place.x - middle.x);
    const { toward } = this.camera.axes();
    const axis = this.axis ?? toward;
    const sense = dot(axis, toward) < 0 ? -1 : 1;
    rotate(start, listed, this.center, axis, sense * (angleOf(spot) - angleOf(this.from)), result);
  }

  scale(spot, start, listed, result) {
    const middle = this.camera.project(this.center);
    const distance = (place) => Math.hypot(place.x - middle.x, place.y - middle.y);
    const factor = distance(spot) / Math.max(4, distance(this.from));
    scale(start, listed, this.center, factor, this.axis, result);
  }

  // How far the grabbed control point is from where it began.
  moved() {
    return length(subtract(pointAt(this.editor.points, this.grabbed), this.anchor));
  }
}
