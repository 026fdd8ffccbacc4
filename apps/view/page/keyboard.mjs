// SPDX-License-Identifier: BSD-3-Clause
// Keys, and what the help says about them.
import { translate } from "./transforms.mjs";
import { centroid } from "./vectors.mjs";

const kNudge = 8;  // pixels
const kArrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export const kHelp = [
  ["Drag a control point", "moves it, and all that are selected"],
  ["Click, Shift+click", "select one, one more or one less"],
  ["Shift+drag, Box", "select what is in a rectangle"],
  ["Drag elsewhere", "turn (3D) or shift (2D) the view"],
  ["Right drag, wheel", "shift, zoom; with two fingers both"],
  ["G  R  S", "tools: move, rotate, scale the selection"],
  ["X  Y  Z", "along or around one axis only; again: freely"],
  ["Arrows", "move the selection a little; Shift: more"],
  ["M", "mirror: off, x, y, z"],
  ["A  B", "select all or none; box"],
  ["Ctrl+Z  Ctrl+Y", "undo, redo"],
  ["Del  Shift+Del", "reset the selection, everything"],
  ["F  1  2  3", "frame the selection; front, side, top"],
  ["T", "turn the model by 90 degrees (3D)"],
  ["C  W", "cage, edges of the model"],
  ["Space", "play the poses"],
  ["D", "light or dark"],
  ["Esc", "cancel the drag, close this"],
];

// In the picture's plane.
function nudge(viewer, [dx, dy], isLarge) {
  const { editor, camera } = viewer;
  const indices = [...editor.selection];
  if (indices.length === 0) return;
  const far = isLarge ? 4 * kNudge : kNudge;
  const step = camera.step(centroid(editor.points, indices), far * dx, far * dy);
  editor.change(indices, (start, listed, result) => translate(start, listed, step, result));
  editor.end();
}

// \param commands  functions by name, as the panel has them \param interaction  may be cancelled
export function bindKeys(viewer, commands, interaction, signal) {
  const plain = {
    g: "move", r: "rotate", s: "scale", x: "axisX", y: "axisY", z: "axisZ", m: "nextMirror",
    a: "selectAll", b: "box", f: "frame", t: "turn", 1: "front", 2: "side", 3: "top", c: "cage", w: "edges",
    " ": "play", d: "theme", "?": "help", delete: "resetSelection", backspace: "resetSelection",
  };
  const withControl = { z: "undo", y: "redo", a: "selectAll" };
  window.addEventListener("keydown", (event) => {
    if (event.target.matches("input, select") && event.key !== "Escape") return;
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
      nudge(viewer, kArrows[event.key], event.shiftKey);
    } else if (name) {
      commands[name]();
    } else {
      return;
    }
    event.preventDefault();
  }, { signal });
}
