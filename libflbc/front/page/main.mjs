// SPDX-License-Identifier: BSD-3-Clause
// Starts the page, and lets scripts do what the mouse does.
import { decodeContent } from "./data.mjs";
import { Gizmo } from "./gizmo.mjs";
import { Interaction } from "./interaction.mjs";
import { keepPose } from "./keeping.mjs";
import { bindKeys } from "./keyboard.mjs";
import { bindPanel, tell } from "./panel.mjs";
import { pointsOf, poseOf } from "./saving.mjs";
import { pointAt } from "./vectors.mjs";
import { Viewer } from "./viewer.mjs";

export const kNoWebGl = "This page draws with WebGL2, which this browser does not offer. A recent Firefox, Chrome, Edge, "
  + "or Safari with hardware acceleration switched on shows it.";

function apologize(error) {
  const textContent = `${kNoWebGl} (${error.message})`;
  Object.assign(document.getElementById("message"), { hidden: false, textContent });
  for (const id of ["panel", "timeline", "fold"]) document.getElementById(id).hidden = true;
}

// The interface for scripts and tests. Points have as many coordinates as the cage.
function hookOf(viewer) {
  const { editor, content, camera } = viewer;
  const inSpace = (place) => [...place, 0].slice(0, 3);
  return {
    move: (i, place) => editor.place(i, inSpace(place)),
    points: () => pointsOf(viewer),
    controlPoint: (i) => pointAt(editor.points, i).slice(0, content.dim),
    select: (indices) => editor.select(indices),
    selection: () => [...editor.selection].sort((a, b) => a - b),
    undo: () => editor.undo(),
    redo: () => editor.redo(),
    pose: () => poseOf(viewer),
    spot: (i) => {
      const box = viewer.canvas.getBoundingClientRect();
      const { x, y } = camera.project(pointAt(editor.points, i));
      return { x: box.left + x, y: box.top + y };
    },
    milliseconds: () => viewer.milliseconds,
    viewer,
  };
}

// Shows a model and its cage. \param signal  ends listening to keys
export function show(content, signal) {
  const canvas = document.getElementById("canvas");
  let viewer;
  try {
    // For tests, and for cards that are slower than the processor: page.html#card or #processor.
    if (["#card", "#processor"].includes(location.hash)) {
      content.movesOnCard = location.hash === "#card";
    }
    viewer = new Viewer(canvas, content);
  } catch (error) {
    return apologize(error);
  }
  viewer.gizmo = new Gizmo(viewer, document.getElementById("gizmo"));
  const commands = bindPanel(viewer);
  const interaction = new Interaction(viewer);
  bindKeys(viewer, commands, interaction, signal);
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => {
    viewer.renderer.prepare();
    viewer.changed();
  });
  new ResizeObserver(() => viewer.redraw()).observe(canvas);
  window.flbc = hookOf(viewer);
  if (keepPose(viewer)) tell("The pose of your last visit. Ctrl+Z: the cage at rest");
  viewer.changed();
  canvas.focus();
  return viewer;
}

const kContent = JSON.parse(document.getElementById("content").textContent);
if (kContent) show(decodeContent(kContent));
