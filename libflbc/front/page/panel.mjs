// SPDX-License-Identifier: BSD-3-Clause
// The buttons beside the picture: what they do, and how they show what is on.
import { kUnits } from "./actions.mjs";
import { kColorings, portion } from "./colors.mjs";
import { inSpace } from "./data.mjs";
import { kHelp } from "./keyboard.mjs";
import { readPose } from "./obj.mjs";
import { Library } from "./library.mjs";
import { commandOf, saveAnimation, saveFilm, saveModel, savePicture, savePose } from "./saving.mjs";

const kAxisNames = ["x", "y", "z"];

export function element(id) {
  return document.getElementById(id);
}

function plural(count, word, words = `${word}s`) {
  return `${count.toLocaleString("en")} ${count === 1 ? word : words}`;
}

// A line that goes away by itself.
export function tell(text) {
  const note = element("note");
  note.textContent = text;
  note.classList.add("shown");
  clearTimeout(tell.timer);
  tell.timer = setTimeout(() => note.classList.remove("shown"), 4000);
}

async function copyCommand(viewer) {
  const command = commandOf(viewer, window.location.href);
  try {
    await navigator.clipboard.writeText(command);
    tell(`Copied. Run it in the folder of the saved pose: ${command}`);
  } catch {
    tell(command);  // browsers may refuse: then it can be read at least
  }
}

function mirror(viewer, axis) {
  const count = viewer.editor.setMirror(axis);
  element("mirror").value = String(axis);
  const total = viewer.editor.size;
  if (axis < 0) return;
  const name = kAxisNames[axis];
  const cure = count < total ? `; the others move alone. Make the cage with the symmetry ${name}` : "";
  tell(`Mirror ${name}: ${count} of ${total} control points have an image${cure}`);
}

async function loadPose(viewer, file) {
  const { editor, content } = viewer;
  try {
    if (/\.json$/i.test(file.name)) return viewer.library.load(await file.text());
    const places = readPose(await file.text(), content.dim, editor.size);
    viewer.stopPlaying();
    editor.begin();
    editor.setPoints(inSpace(places, content.dim));
    editor.end();
  } catch (error) {
    tell(`${file.name}: ${error.message}`);
  }
}

async function film(viewer) {
  try {
    tell("Recording…");
    tell(`Saved ${await saveFilm(viewer)}`);
  } catch (error) {
    tell(error.message);
  }
}

// Turns soft selection off, or on with the radius that it had.
function toggleSoft(viewer) {
  const { editor } = viewer;
  const slider = element("soft");
  slider.value = editor.softness > 0 ? 0 : viewer.lastSoft;
  slider.dispatchEvent(new Event("input"));
}

function fillSoft(viewer) {
  const { editor } = viewer;
  viewer.lastSoft = 0.3;
  element("soft").addEventListener("input", ({ target }) => {
    if (Number(target.value) > 0) viewer.lastSoft = Number(target.value);
    editor.softness = Number(target.value) * editor.sphere.radius;
    viewer.changed();
  });
  element("soft").addEventListener("change", () => viewer.canvas.focus());
}

export function setTheme(viewer, theme) {
  document.documentElement.dataset.theme = theme;
  viewer.set("theme", theme);
}

// The commands behind buttons and keys, by name.
export function makeCommands(viewer) {
  const { editor, content } = viewer;
  const everything = () => [...Array(editor.size).keys()];
  const selected = () => [...editor.selection];
  const axis = (name) => () => viewer.set("axis", viewer.axis === name ? null : name);
  const tool = (name) => () => { viewer.typed = ""; viewer.set("tool", name); };
  const area = (name) => () => viewer.set("area", viewer.area === name ? null : name);
  const help = element("keyHelp");
  return {
    undo: () => { viewer.stopPlaying(); (viewer.brush ?? editor).undo(); },
    redo: () => { viewer.stopPlaying(); (viewer.brush ?? editor).redo(); },
    move: tool("move"), rotate: tool("rotate"), scale: tool("scale"),
    x: axis("x"), y: axis("y"), z: content.dim === 3 ? axis("z") : () => {},
    resetSelection: () => editor.reset(editor.withHandles(selected())),
    resetAll: () => { viewer.stopPlaying(); editor.reset(everything()); },
    selectAll: () => editor.select(editor.selection.size === editor.size ? [] : everything()),
    box: area("box"), lasso: area("lasso"),
    ring: () => editor.selectRings(),
    limb: () => { if (editor.selection.size > 0) editor.selectLimb(); },
    grow: () => editor.select(editor.graph.grow(editor.selection)),
    shrink: () => editor.select(editor.graph.shrink(editor.selection)),
    localAxes: () => viewer.set("isLocal", !viewer.isLocal),
    dragModel: () => viewer.set("dragsModel", !viewer.dragsModel),
    pivotHere: () => editor.setPivot(editor.pivot || editor.selection.size === 0 ? null : selected()),
    toggleSoft: () => toggleSoft(viewer),
    loadPose: () => element("poseFile").click(),
    addKey: () => viewer.addKey(),
    removeKey: () => viewer.removeKey(),
    smooth: () => viewer.toggleSmooth(),
    loop: () => viewer.toggleLoop(),
    keepPose: () => viewer.library.keep(),
    savePoses: () => viewer.library.save(),
    nextMirror: () => mirror(viewer, (editor.mirrorAxis + 2) % (content.dim + 1) - 1),
    frame: () => viewer.frame(selected()),
    front: () => viewer.look("front"),
    side: () => { if (content.dim === 3) viewer.look("side"); },
    top: () => { if (content.dim === 3) viewer.look("top"); },
    turn: () => { if (content.dim === 3) viewer.turn(); },
    cage: () => viewer.set("showsCage", !viewer.showsCage),
    edges: () => viewer.set("showsEdges", !viewer.showsEdges),
    play: () => (viewer.playing ? viewer.stopPlaying() : viewer.play()),
    savePose: () => savePose(viewer),
    saveAnimation: () => saveAnimation(viewer),
    saveFilm: () => film(viewer),
    saveModel: () => saveModel(viewer),
    savePicture: () => savePicture(viewer),
    copyCommand: () => copyCommand(viewer),
    theme: () => setTheme(viewer, viewer.theme === "light" ? "dark" : "light"),
    help: () => {
      if (help.open) return help.close();
      help.showModal();
      help.scrollTop = 0;  // the focus is on the button below
    },
    closeHelp: () => help.close(),
    fold: () => document.body.classList.toggle("folded"),
  };
}

function showFacts(content) {
  document.title = `${content.title} – flbc`;
  element("title").textContent = content.title;
  const facts = [plural(content.base.length / 3, "vertex", "vertices"),
                 plural(content.surface.triangles.length / 3, "triangle"),
                 plural(content.rest.length / 3, "control point")];
  element("facts").textContent = facts.join(" · ");
}

function fillColorings(viewer) {
  const select = element("coloring");
  const { colors, parts, pictures } = viewer.content.surface;
  const isOwn = colors !== null || parts.some(({ color, picture }) => color || picture >= 0);
  for (const [value, label] of Object.entries(kColorings)) {
    if (value !== "materials" || isOwn) select.add(new Option(label, value));
  }
  select.addEventListener("change", () => viewer.set("coloring", select.value));
  if (isOwn) viewer.coloring = select.value = "materials";
  pictures.forEach((address, k) => loadPicture(viewer, k, address));
}

async function loadPicture(viewer, k, address) {
  const image = new Image();
  image.src = address;
  try {
    await image.decode();
  } catch {
    return tell("This picture cannot be read");
  }
  if (/^data:image\/svg/.test(address)) {  // a .glb file has none
    const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
    canvas.getContext("2d").drawImage(image, 0, 0);
    viewer.content.surface.pictures[k] = canvas.toDataURL();
  }
  viewer.renderer.setPicture(k, image);
  viewer.redraw();
}

function fillHelp() {
  for (const [keys, meaning] of kHelp) {
    const row = element("keys").insertRow();
    row.insertCell().textContent = keys;
    row.insertCell().textContent = meaning;
  }
}

const kKeyFields = { keyName: ({ name }) => name, keyTime: ({ time }) => String(Number(time.toFixed(2))) };

function fillTimeline(viewer) {
  const { editor, content } = viewer;
  const slider = element("time"), marks = element("keyMarks");
  slider.addEventListener("input", () => {
    if (viewer.playing) viewer.stopPlaying();
    viewer.seek(Number(slider.value));
  });
  slider.addEventListener("change", () => viewer.stopPlaying());
  const change = (id, changesOf) => element(id).addEventListener("change", ({ target }) => {
    viewer.stopPlaying();
    viewer.changeKey(viewer.key, changesOf(target.value));
    editor.end();
    target.value = kKeyFields[id](content.poses[viewer.key]);
  });
  change("keyName", (name) => ({ name }));
  change("keyTime", (time) => ({ time: Number(time) }));
  // A key follows the pointer on the scale that it had when it was grabbed.
  let held = null;
  marks.addEventListener("pointerdown", (event) => {
    const k = [...marks.children].indexOf(event.target);
    if (k < 0) return;
    const { time } = content.poses[k];
    if (viewer.playing) viewer.stopPlaying();
    viewer.seek(time);
    held = { k, time, from: event.clientX, scale: (viewer.duration - content.poses[0].time) / marks.clientWidth };
    marks.setPointerCapture(event.pointerId);
  });
  marks.addEventListener("pointermove", ({ clientX }) => {
    if (!held || (clientX === held.from && content.poses[held.k].time === held.time)) return;
    viewer.changeKey(held.k, { time: Math.round(20 * (held.time + held.scale * (clientX - held.from))) / 20 });
  });
  for (const name of ["pointerup", "pointercancel"]) {
    marks.addEventListener(name, () => {
      held = null;
      viewer.stopPlaying();
    });
  }
}

function showTimeline(viewer) {
  const { content: { poses }, duration, time, key } = viewer;
  element("timeline").hidden = poses.length < 2 || viewer.holdsModel;
  if (poses.length < 2) return;
  const begin = poses[0].time;
  Object.assign(element("time"), { min: begin, max: duration, value: time });
  const marks = poses.map((pose, k) => `<span class="${k === key ? "chosen" : ""}" title="${kKeyFields.keyTime(pose)} s" style="left: ${
    100 * (pose.time - begin) / (duration - begin)}%"></span>`).join("");
  if (element("keyMarks").innerHTML !== marks) element("keyMarks").innerHTML = marks;
  for (const [id, valueOf] of Object.entries(kKeyFields)) {
    if (document.activeElement !== element(id)) element(id).value = valueOf(poses[key]);
  }
}

function fillPalette(palette) {
  const stops = [];
  for (let k = 0; k < 256; k += 15) stops.push(`rgb(${palette.slice(3 * k, 3 * k + 3).join(" ")})`);
  element("bar").style.background = `linear-gradient(to right, ${stops.join(", ")})`;
}

function showLegend(legend) {
  element("legend").hidden = !legend;
  if (!legend) return;
  element("legendTitle").textContent = legend.title;
  element("low").textContent = legend.low;
  element("high").textContent = legend.high;
}

function showOutline(outline) {
  const corners = (outline ?? []).map(({ x, y }) => `${x},${y}`).join(" ");
  element("outline").firstElementChild.setAttribute("points", corners);
}

function describeSelection(viewer) {
  const { editor: { selection }, deformer, drag, typed } = viewer;
  if (drag && typed) return `${drag.label} ${typed}${kUnits[drag.tool]}; press Enter, or Esc to cancel`;
  if (drag) return drag.text;
  const { hovered, cursor } = viewer;
  const chosen = hovered >= 0 && (cursor >= 0 || !selection.has(hovered)) ? [hovered] : [...selection];
  if (viewer.grabsModel) return "drag the model: the control points near the place that you grab move it";
  if (chosen.length === 0) return "drag a control point, or double-click it for the ring around the limb";
  const moved = deformer.weights.values.length > 0 ? portion(deformer.countMovedBy(chosen), deformer.base.length / 3) : "nothing yet";
  const keys = cursor < 0 ? "" : selection.has(cursor) ? "; Space deselects it" : "; Space selects it";
  return chosen.length === 1 ? `control point ${chosen[0]} moves ${moved}${keys}`
                             : `${chosen.length} control points are selected and move ${moved}`;
}

function showState(viewer) {
  const { editor, content } = viewer;
  const isPressed = {
    move: viewer.tool === "move", rotate: viewer.tool === "rotate", scale: viewer.tool === "scale",
    box: viewer.area === "box", lasso: viewer.area === "lasso", cage: viewer.showsCage, edges: viewer.showsEdges,
    localAxes: viewer.isLocal, dragModel: viewer.dragsModel, loop: viewer.loops, smooth: !content.poses[0]?.isStraight };
  for (const [id, pressed] of Object.entries(isPressed)) {
    element(id).setAttribute("aria-pressed", String(pressed));
  }
  element("undo").disabled = !(viewer.brush ?? editor).canUndo;
  element("redo").disabled = !(viewer.brush ?? editor).canRedo;
  for (const id of ["resetSelection", "ring", "limb", "grow", "shrink"]) {
    element(id).disabled = editor.selection.size === 0;
  }
  element("removeKey").disabled = content.poses.length === 0;
  element("state").textContent = describeSelection(viewer);
  element("play").textContent = viewer.playing ? "Pause" : "Play";
  element("addKey").disabled = viewer.holdsModel;
  showTimeline(viewer);
  viewer.library.show();
}

// Fills the panel and connects it. \return the commands
export function bindPanel(viewer) {
  const { content } = viewer;
  const commands = makeCommands(viewer);
  viewer.library = new Library(viewer, element("library"));
  for (const button of document.querySelectorAll("button[id]")) {
    button.addEventListener("click", commands[button.id]);
  }
  for (const id of ["side", "top", "turn"]) element(id).hidden = content.dim === 2;
  for (let axis = 0; axis < content.dim; ++axis) {
    element("mirror").add(new Option(kAxisNames[axis], String(axis)));
  }
  element("mirror").addEventListener("change", (event) => mirror(viewer, Number(event.target.value)));
  viewer.onState = () => showState(viewer);
  viewer.onLegend = showLegend;
  viewer.onOutline = showOutline;
  viewer.onDrawn = () => viewer.gizmo.draw();
  showFacts(content);
  fillColorings(viewer);
  fillHelp();
  fillTimeline(viewer);
  fillSoft(viewer);
  element("poseFile").addEventListener("change", ({ target }) => {
    if (target.files.length > 0) loadPose(viewer, target.files[0]);
    target.value = "";
  });
  fillPalette(content.palette);
  setTheme(viewer, matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  return commands;
}
