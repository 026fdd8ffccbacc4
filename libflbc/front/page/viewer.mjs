// SPDX-License-Identifier: BSD-3-Clause
// The page's state: what is shown, and redrawing it when something has changed.
import { Camera } from "./camera.mjs";
import { colorValues } from "./colors.mjs";
import { Deformer } from "./deformer.mjs";
import { Editor } from "./editor.mjs";
import { interpolatePoses, nearestPose, playedTime } from "./poses.mjs";
import { Renderer } from "./renderer.mjs";
import { kAxes, principalAxes } from "./transforms.mjs";
import { pointAt } from "./vectors.mjs";

const kThemes = {
  light: { background: [0.965, 0.969, 0.976], plain: [0.70, 0.76, 0.84], ink: [0.13, 0.15, 0.19],
           edgeInk: [0.05, 0.07, 0.12], highlight: [0.88, 0.10, 0.12] },
  dark: { background: [0.086, 0.098, 0.122], plain: [0.58, 0.66, 0.77], ink: [0.87, 0.90, 0.95],
          edgeInk: [0.02, 0.03, 0.06], highlight: [1.0, 0.45, 0.20] },
};
// Larger models move on the card, which shades their triangles flat.
const kManyVertices = 100000;
const kGap = 0.05;  // seconds between keys
const kNowhere = [9, 9];  // in clip coordinates
const kViews = { front: [0, 0], side: [Math.PI / 2, 0], top: [0, Math.PI / 2 - 0.03] };

export class Viewer {
  // \throws Error where there is no WebGL2
  constructor(canvas, content) {
    this.canvas = canvas;
    this.content = content;
    this.deformer = new Deformer(content.weights, content.base, content.rest);
    const movesOnCard = content.movesOnCard ?? content.surface.numVertices > kManyVertices;
    const weights = movesOnCard ? this.deformer.weightsForCard() : null;
    this.renderer = new Renderer(canvas, content, weights);
    this.camera = new Camera(content.dim, content.up, content.front);
    this.editor = new Editor(content.rest, content.dim, content.facets, content);
    this.coloring = "shaded";
    this.tool = "move";
    this.axis = null;
    this.isLocal = false;  // whether axes are those of the selection, instead of the model
    this.dragsModel = false;  // instead of control points
    this.brush = null;   // paints on the model: begin, to, end, cancel, colors; and undo, as the editor
    this.area = null;    // what drags elsewhere select: "box", "lasso" or null
    this.typed = null;   // digits of a number for the tool, null: digits are other keys
    this.drag = null;    // what the tool or a handle of the gizmo does just now
    this.gizmo = null;
    this.showsCage = true;
    this.showsEdges = false;
    this.theme = "light";
    this.hovered = -1;
    this.cursor = -1;    // the control point to which arrow keys have walked, which is hovered then
    this.pointer = kNowhere;
    this.time = 0;       // of the poses
    this.isSought = false;  // whether the visitor has chosen a time
    this.playing = null;
    this.isStale = true;  // the cage or colours have changed since the model was moved
    this.isAwaited = false;
    this.milliseconds = -1;  // of the last step, which may be too short for the clock; none yet
    this.onState = this.onLegend = this.onOutline = this.onDrawn = () => {};
    this.editor.onChange = () => this.changed();
    this.camera.sphere = this.editor.sphere;
  }

  changed() {
    this.isStale = true;
    this.redraw();
    this.onState();
  }

  set(name, value) {
    this[name] = value;
    this.changed();
  }

  redraw() {
    if (this.isAwaited) return;
    this.isAwaited = true;
    requestAnimationFrame((now) => {
      this.isAwaited = false;
      this.frameDrawn(now);
    });
  }

  frameDrawn(now) {
    if (this.playing) this.playOn(now);
    const begin = performance.now();
    this.draw();
    this.milliseconds = performance.now() - begin;
  }

  // The model where the cage takes it.
  update() {
    if (!this.isStale) return;
    this.isStale = false;
    const { editor, deformer, renderer } = this;
    deformer.move(this.holdsModel ? deformer.rest : editor.points);
    renderer.setModel(deformer);
    const { values, legend } = this.brush?.colors() ?? colorValues(this.coloring, deformer, editor.selection);
    if (values) renderer.setValues(values);
    renderer.setCage(editor.points, editor.shares(), this.hovered);
    this.onLegend(legend);
  }

  draw() {
    const { canvas, camera, renderer } = this;
    renderer.resize();
    camera.width = canvas.clientWidth || 1;
    camera.height = canvas.clientHeight || 1;
    if (!this.isFramed) this.frame();
    this.update();
    const coloring = this.brush ? "region" : this.coloring;
    renderer.draw(camera, { ...kThemes[this.theme], coloring, dotSize: this.dotSize(), pointer: this.pointer,
                            showsCage: this.showsCage && !this.playing?.onEnd, showsDots: !this.playing, showsEdges: this.showsEdges });
    this.onDrawn();
  }

  // Dots shrink where control points are dense and on small screens, and grow near the pointer.
  dotSize() {
    const { camera, content } = this;
    const extent = camera.sphere.radius * camera.height / camera.halfHeight;
    const spacing = extent / Math.sqrt(content.rest.length / 3);
    const isSmall = Math.min(camera.width, camera.height) < 480;
    return Math.max(4, Math.min(isSmall ? 8 : 12, (isSmall ? 0.24 : 0.3) * spacing));
  }

  // Shows the selection, or the cage as it is and in all of its poses.
  frame(indices = []) {
    const { editor, camera, content } = this;
    const everything = () => [editor.points, ...content.poses.map((pose) => pose.points)]
      .flatMap((points) => Array.from(points));
    camera.frame(indices.length > 1 ? indices.flatMap((i) => pointAt(editor.points, i)) : everything());
    this.isFramed = true;
    this.redraw();
  }

  look(name) {
    this.camera.look(...kViews[name]);
    this.frame();
  }

  turn() {
    this.camera.turn();
    this.frame();
  }

  // \param spot  of the pointer, null: elsewhere \param handle  of the gizmo there, or null
  hover(i, spot = null, handle = null) {
    const { width, height } = this.camera;
    this.pointer = spot ? [2 * spot.x / width - 1, 1 - 2 * spot.y / height] : kNowhere;
    this.gizmo.hot = handle?.id ?? null;
    this.cursor = spot ? -1 : i;
    this.canvas.style.cursor = handle || this.grabsModel ? "grab" : i >= 0 ? "pointer" : "";
    this.redraw();
    if (i === this.hovered) return;
    this.hovered = i;
    this.renderer.setCage(this.editor.points, this.editor.shares(), i);
    this.onState();
  }

  // Axes of the tools and the gizmo.
  get axes() {
    const { points, selection, graph } = this.editor;
    if (!this.isLocal || selection.size === 0) return kAxes;
    return principalAxes(points, selection.size > 2 ? [...selection] : [...new Set(graph.grow(selection))]);
  }

  // Whether the cage is reshaped at rest; its poses are for later.
  get holdsModel() {
    return Boolean(this.reshaper?.isOn);
  }

  get grabsModel() {
    return this.dragsModel && !this.holdsModel;
  }

  get duration() {
    const { poses } = this.content;
    return poses.length > 0 ? poses[poses.length - 1].time : 0;
  }

  // Takes the cage to a time of its poses, within a stroke that stopPlaying() ends.
  seek(time) {
    const { poses } = this.content;
    if (this.holdsModel) return;
    this.time = time;
    this.isSought = true;
    this.editor.begin();
    this.editor.setPoints(interpolatePoses(poses, time));
  }

  // The pose as it is becomes the key at the time that was chosen, or the last one of the animation, a
  // second after the one before.
  addKey() {
    const { content: { poses, rest }, editor, time, duration } = this;
    if (this.holdsModel) return;
    this.stopPlaying();
    const old = poses.length > 0 ? poses : [{ name: "rest", time: 0, points: rest }];
    const isInside = this.isSought && time < duration;
    const key = { ...old[0], name: `key ${old.length}`, time: isInside ? time : duration + (this.loops ? 0 : 1), points: editor.points.slice() };
    const replaced = old.find((pose) => !pose.closes && Math.abs(pose.time - key.time) < kGap);
    if (replaced) Object.assign(key, { name: replaced.name, time: replaced.time });
    this.time = key.time;
    this.setKeys([...old.filter((pose) => pose !== replaced), key]);
    editor.end();
  }

  // The key at the time that was chosen, or the last one.
  get key() {
    const { poses } = this.content;
    return poses.indexOf(this.isSought || this.loops ? nearestPose(poses, this.time) : poses.at(-1));
  }

  removeKey() {
    const { key } = this;
    this.stopPlaying();
    this.setKeys(this.content.poses.filter((_, k) => k !== key));
    this.time = Math.min(this.time, this.duration);
    this.editor.end();
  }

  // Another name of a key, or another time between those of the keys next to it, in a stroke.
  changeKey(k, changes) {
    const keys = this.content.poses.slice();
    const least = k > 0 ? keys[k - 1].time + kGap : 0, most = keys[k + 1]?.time - kGap || Infinity;
    keys[k] = { ...keys[k], ...changes };
    keys[k].time = this.time = Math.max(least, Math.min(most, keys[k].time));
    this.isSought = true;
    this.setKeys(keys);
  }

  // The key that closes a loop comes last, and has the points of the first one.
  setKeys(keys) {
    const open = keys.filter(({ closes }) => !closes).sort((a, b) => a.time - b.time);
    const closing = keys.find(({ closes }) => closes), last = open.at(-1);
    if (closing && open.length > 1) {
      open.push({ ...closing, points: open[0].points, time: closing.time < last.time + kGap ? last.time + 1 : closing.time });
    }
    this.editor.setPoses(open);
  }

  get loops() {
    return Boolean(this.content.poses.at(-1)?.closes);
  }

  toggleLoop() {
    const { content: { poses }, loops, duration } = this;
    this.stopPlaying();
    const closing = { ...poses[0], name: "loop", time: 2 * duration - poses.at(-2).time, closes: true };
    this.setKeys(loops ? poses.slice(0, -1) : [...poses, closing]);
    this.editor.end();
  }

  toggleSmooth() {
    const { poses } = this.content;
    this.stopPlaying();
    this.setKeys(poses.map((pose) => ({ ...pose, isStraight: !poses[0].isStraight })));
    this.editor.end();
  }

  // \param onEnd  is called when playing ends, which then is after the last key
  play(onEnd = null) {
    if (this.content.poses.length < 2 || this.holdsModel) return;
    this.playing = { begin: null, from: onEnd || this.time >= this.duration ? 0 : this.time, onEnd };
    this.changed();
  }

  playOn(now) {
    const { playing, duration, content: { poses } } = this;
    playing.begin ??= now - 1000 * (playing.from - poses[0].time);
    const seconds = (now - playing.begin) / 1000, isOver = playing.onEnd && seconds > duration - poses[0].time;
    this.seek(isOver ? duration : playedTime(poses, seconds));
    if (isOver) this.stopPlaying();
  }

  stopPlaying() {
    const { onEnd } = this.playing ?? {};
    this.playing = null;
    onEnd?.();
    this.editor.end();
    this.onState();
  }
}
