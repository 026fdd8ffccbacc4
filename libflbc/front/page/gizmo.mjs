// SPDX-License-Identifier: BSD-3-Clause
// Handles at the selection: arrows and squares move it along axes and planes, boxes scale it, rings
// rotate it, and the center moves it freely. An axis that is chosen by its key leaves its own handle only.
import { ToolDrag } from "./actions.mjs";
import { isInside } from "./picking.mjs";
import { add, centroid, dot, length, times } from "./vectors.mjs";

const kSize = 84;      // pixels, of an arrow
const kRing = 0.72, kOuterRing = 1.18, kSquare = [0.3, 0.5];  // of an arrow
const kCenter = 8;     // pixels
const kSteep = 0.25;   // of its length: an arrow that is seen shorter, and a square thinner, has no handle
const kSegments = 36;

function distanceTo(line, spot) {
  let least = Infinity;
  for (let k = 0; k + 1 < line.length; ++k) {
    const [a, b] = [line[k], line[k + 1]];
    const x = b.x - a.x, y = b.y - a.y;
    const share = Math.max(0, Math.min(1, ((spot.x - a.x) * x + (spot.y - a.y) * y) / (x * x + y * y || 1)));
    least = Math.min(least, Math.hypot(spot.x - a.x - share * x, spot.y - a.y - share * y));
  }
  return least;
}

export class Gizmo {
  // \param board  an SVG over the canvas
  constructor(viewer, board) {
    this.viewer = viewer;
    this.board = board;
    this.hot = null;   // the name of the handle under the pointer
    this.held = null;  // the one that is dragged
  }

  // What can be grabbed: kind, tool, names of axes, and its line or outline in pixels.
  handles() {
    const { editor, camera, brush, drag, playing, showsCage, grabsModel, axis, tool, content: { dim } } = this.viewer;
    if (editor.selection.size === 0 || brush || playing || !showsCage || grabsModel) return [];
    const axes = drag?.named ?? this.viewer.axes;
    const middle = editor.pivot ?? centroid(editor.points, [...editor.selection]);
    const { right, up, toward } = camera.axes();
    const size = kSize * Math.min(1, Math.min(camera.width, camera.height) / 480);
    const unit = length(camera.step(middle, size, 0));
    const at = (u, v, a, b) => camera.project(add(middle, add(times(unit * a, u), times(unit * b, v))));
    const ring = (u, v, radius, from, angle) => Array.from({ length: kSegments + 1 }, (_, k) => {
      const turned = from + angle * (k / kSegments - 0.5);
      return at(u, v, radius * Math.cos(turned), radius * Math.sin(turned));
    });
    const all = ["x", "y", "z"].slice(0, dim), handles = [];
    const put = (kind, names, line, does) => handles.push({ kind, names, line, tool: does, id: `${kind} ${names}` });
    const canTurn = editor.pivot || editor.shares().size > 1;
    const center = camera.project(middle);
    put("center", axis ?? "", [center], "move");
    for (const name of all.filter((each) => !axis || each === axis)) {
      const own = axes[name], [u, v] = all.filter((each) => each !== name).map((each) => axes[each]);
      const tip = at(own, own, 1, 0), facing = Math.abs(dot(own, toward));
      if (Math.hypot(tip.x - center.x, tip.y - center.y) > kSteep * size && !(axis && tool === "rotate")) {
        put(tool === "scale" && canTurn ? "box" : "arrow", name, [at(own, own, 0.2, 0), tip], tool === "scale" ? "scale" : "move");
      }
      if (dim === 3 && facing > kSteep && !axis && tool !== "scale") {
        const [a, b] = kSquare;
        put("square", all.filter((each) => each !== name).join(""), [at(u, v, a, a), at(u, v, b, a), at(u, v, b, b), at(u, v, a, b)], "move");
      }
      if (dim === 3 && canTurn && (!axis || tool === "rotate")) {
        const front = Math.atan2(dot(v, toward), dot(u, toward));
        put("ring", name, ring(u, v, kRing, front, facing > 0.97 ? 2 * Math.PI : Math.PI), "rotate");
      }
    }
    if (canTurn && !axis) put("ring", "", ring(right, up, kOuterRing, 0, 2 * Math.PI), tool === "scale" ? "scale" : "rotate");
    return handles;
  }

  // \param reach  pixels \return the handle there, or null
  pick(spot, reach) {
    let best = null, least = reach;
    for (const handle of this.handles()) {
      const { kind, line: [{ x, y }], line } = handle;
      const far = kind === "center" ? Math.max(0, Math.hypot(spot.x - x, spot.y - y) - kCenter)
                : kind === "square" ? (isInside(line, spot) ? 0 : Infinity) : distanceTo(line, spot);
      if (far < least) [best, least] = [handle, far];
      if (kind === "center" && far === 0) break;
    }
    return best;
  }

  begin({ id, names, tool }, from) {
    const { editor, camera, axes } = this.viewer;
    this.held = id;
    return new ToolDrag(editor, camera, tool, names, null, from, axes);
  }

  draw() {
    const { editor, camera, drag, typed } = this.viewer;
    if (!drag) this.held = null;
    const handles = this.handles().filter(({ id }) => !this.held || id === this.held);
    const pivot = editor.pivot && camera.project(editor.pivot);
    const text = drag && !typed ? drag.text : "";
    const isRight = handles[0]?.line[0].x > camera.width / 2;
    this.board.innerHTML = handles.map((handle) => this.shapeOf(handle)).join("")
      + (pivot ? `<circle id="pivot" cx="${pivot.x}" cy="${pivot.y}" r="6.5"/>` : "")
      + (text && handles.length > 0 ? `<text text-anchor="${isRight ? "end" : "start"}" x="${handles[0].line[0].x + (isRight ? -16 : 16)}" y="${handles[0].line[0].y - 16}">${text}</text>` : "");
  }

  shapeOf({ kind, names, line, id }) {
    const corners = (list) => list.map(({ x, y }) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" ");
    const [a, b] = line;
    const [x, y] = b ? [b.x - a.x, b.y - a.y].map((value) => value / Math.hypot(b.x - a.x, b.y - a.y)) : [0, 0];
    const head = (far, wide) => ({ x: b.x + far * x - wide * y, y: b.y + far * y + wide * x });
    const shape = kind === "center" ? `<circle cx="${a.x}" cy="${a.y}" r="${kCenter}"/>`
      : kind === "square" ? `<polygon points="${corners(line)}"/>`
      : kind === "arrow" ? `<polyline points="${corners(line)}"/><polygon points="${corners([head(-2, 5), head(12, 0), head(-2, -5)])}"/>`
      : kind === "box" ? `<polyline points="${corners(line)}"/><polygon points="${corners([head(0, 5), head(9, 5), head(9, -5), head(0, -5)])}"/>`
      : `<polyline points="${corners(line)}"/>`;
    return `<g class="${kind} ${names || "free"}${id === (this.held ?? this.hot) ? " hot" : ""}">${shape}</g>`;
  }
}
