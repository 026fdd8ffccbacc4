// SPDX-License-Identifier: BSD-3-Clause
// Keys, and what the help says about them.
import { translate } from "./transforms.mjs";
import { pick } from "./picking.mjs";
import { centroid, pointAt } from "./vectors.mjs";

const kNudge = 8;  // pixels
const kArrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export const kHelp = [
  ["Drag a control point", "moves it, and all that are selected; the first drag takes the limb with the ring around it"],
  ["Drag an arrow, a ring, …", "the handles at the selection: move it along an axis or in a plane, rotate it; with Ctrl in round steps"],
  ["Click, Shift+click", "select one, one more or one less"],
  ["Double click, E", "select the ring around the limb; Shift+double click: one more ring"],
  ["L", "select the limb beyond the ring; it rotates around the ring"],
  ["+  −", "grow, shrink the selection"],
  ["Shift+drag, Ctrl+drag", "select in a rectangle, in a lasso"],
  ["Drag elsewhere", "turn (3D) or shift (2D) the view"],
  ["Right drag, wheel", "shift, zoom; with two fingers both"],
  ["G  R  S", "tools: move, rotate, scale the selection"],
  ["G  R  S, number, Enter", "move by units of length, rotate by degrees, scale by a factor; also during a drag"],
  ["X  Y  Z", "along or around one axis only; again: freely"],
  [",", "axes along the selection, instead of those of the model"],
  ["Alt+drag a handle", "of a curve: it leaves the line with the opposite one, which otherwise turns along"],
  ["Alt+click, P", "pivot of R and S: a control point, the center of the selection; P again: none"],
  ["O", "soft selection: neighbors follow; the slider is its radius"],
  ["Arrows, Space", "walk from control point to control point along the cage; Space selects, one more or one less"],
  ["Shift+Arrows", "move the selection a little"],
  ["M", "drag the model: the place that you grab follows the pointer, and few control points move"],
  ["I", "mirror: off, x, y, z"],
  ["A  B  Q", "select all or none; drags select in a box; in a lasso"],
  ["Ctrl+Z  Ctrl+Y", "undo, redo"],
  ["Del  Shift+Del", "reset the selection, everything"],
  ["F  1  2  3", "frame the selection; front, side, top"],
  ["T", "turn the model by 90 degrees (3D)"],
  ["C  W", "cage, edges of the model"],
  ["K  Space", "the pose becomes a key of the animation; play it"],
  ["D", "light or dark"],
  ["Esc", "cancel the drag, close this"],
];

// To the control point next to the last one, or to a selected one, that lies in the direction of an arrow.
function walk(viewer, [dx, dy]) {
  const { editor: { points, selection, graph }, camera, cursor } = viewer;
  const from = cursor >= 0 ? cursor : [...selection].at(-1);
  if (from === undefined) return viewer.hover(pick(points, camera, camera.width / 2, camera.height / 2, Infinity));
  const here = camera.project(pointAt(points, from));
  let next = from, most = 0.3;
  for (const i of graph.neighbors[from]) {
    const { x, y } = camera.project(pointAt(points, i));
    const cosine = (dx * (x - here.x) + dy * (y - here.y)) / Math.hypot(x - here.x, y - here.y);
    if (cosine > most) [next, most] = [i, cosine];
  }
  viewer.hover(next);
}

// In the picture's plane.
function nudge(viewer, [dx, dy]) {
  const { editor, camera } = viewer;
  const shares = editor.shares();
  if (shares.size === 0) return;
  const step = camera.step(centroid(editor.points, [...editor.selection]), kNudge * dx, kNudge * dy);
  editor.change([...shares.keys()], (start, listed, result) =>
    translate(start, listed, step, result, (i) => shares.get(i)));
  editor.end();
}

// \param commands  functions by name, as the panel has them \param interaction  may be cancelled
export function bindKeys(viewer, commands, interaction, signal) {
  const plain = {
    g: "move", r: "rotate", s: "scale", x: "x", y: "y", z: "z", m: "dragModel", i: "nextMirror",
    a: "selectAll", b: "box", q: "lasso", e: "ring", l: "limb", "+": "grow", "=": "grow", "-": "shrink",
    p: "pivotHere", o: "toggleSoft", k: "addKey", f: "frame", t: "turn", 1: "front", 2: "side", 3: "top", c: "cage", w: "edges",
    ",": "localAxes", " ": "play", d: "theme", "?": "help", delete: "resetSelection", backspace: "resetSelection",
  };
  // A frame around the picture is for those who come by keys.
  window.addEventListener("keyup", ({ key }) => {
    if (key === "Tab") viewer.canvas.classList.toggle("keyed", document.activeElement === viewer.canvas);
  }, { signal });
  const withControl = { z: "undo", y: "redo", a: "selectAll" };
  window.addEventListener("keydown", (event) => {
    if (event.target.matches("input, select") && event.key !== "Escape") return;
    if (!event.ctrlKey && !event.metaKey && interaction.type(event.key)) return event.preventDefault();
    const key = event.key.toLowerCase();
    const isControl = event.ctrlKey || event.metaKey;
    let name = isControl ? withControl[key] : plain[key];
    if (isControl && event.shiftKey && key === "z") name = "redo";
    if (!isControl && event.shiftKey && name === "resetSelection") name = "resetAll";
    if (key === " " && event.target.matches("button")) return;
    if (key === "escape") {
      interaction.cancel();
      commands.closeHelp();
    } else if (kArrows[event.key] && !isControl) {
      (event.shiftKey ? nudge : walk)(viewer, kArrows[event.key]);
    } else if (key === " " && viewer.cursor >= 0) {
      viewer.editor.toggle(viewer.cursor);
    } else if (name) {
      if (!/^[xyz]$/.test(name)) viewer.typed = null;
      commands[name]();
    } else {
      return;
    }
    event.preventDefault();
  }, { signal });
}
