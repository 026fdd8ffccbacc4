// SPDX-License-Identifier: BSD-3-Clause
// The cage as the user edits it: where its control points are, which of them are selected, the keys
// of its animation, the library of poses, and what can be undone. Between begin() and end() lies a
// stroke, which is undone at once.
import { mirrorMoves, mirrorPairs } from "./mirror.mjs";
import { CageGraph } from "./rings.mjs";
import { boundingSphere, centroid, cross, dot, length, pointAt, setPoint, subtract, times } from "./vectors.mjs";

const kMostStrokes = 200;
const kInLine = 1e-3;  // sine of the angle between handles that are in line

function areEqual(a, b) {
  return a.every((value, k) => Object.is(value, b[k]));
}

export class Editor {
  // \param facets  of the cage, dim control points each
  // \param content  whose poses are the keys, and which has the library
  constructor(rest, dim, facets = [], content = { poses: [] }) {
    this.content = content;
    this.handles = new Map();  // of curves, by their corners
    for (const [a, first, second, b] of content.curves ?? []) {
      for (const [corner, handle] of [[a, first], [b, second]]) this.handles.set(corner, [...this.handles.get(corner) ?? [], handle]);
    }
    this.graph = new CageGraph(facets, dim, rest.length / 3);
    this.softness = 0;  // radius of the soft selection, 0: none
    this.pivotPoints = null;  // around whose center the selection is rotated and scaled, null: its own
    this.rest = rest;
    this.dim = dim;
    this.points = rest.slice();
    this.selection = new Set();
    this.done = [];
    this.undone = [];
    this.start = this.startLists = null;  // points, keys, and library as they were when the stroke began
    this.mirrorAxis = -1;
    this.pairs = null;
    this.sphere = boundingSphere(rest);
    this.onChange = () => {};
  }

  get size() { return this.rest.length / 3; }
  get pivot() { return this.pivotPoints && centroid(this.points, this.pivotPoints); }
  get lists() {
    const { poses, library } = this.content;
    return { poses, library };
  }
  get canUndo() { return this.done.length > 0; }
  get canRedo() { return this.undone.length > 0; }

  // Takes the points there, with nothing to be undone.
  restart(points) {
    this.start = null;
    this.done = [];
    this.undone = [];
    this.setPoints(points);
  }

  select(indices) {
    this.pivotPoints = null;
    this.selection = new Set([...indices].filter((i) => i >= 0 && i < this.size));
    this.onChange();
  }

  toggle(i) {
    if (!this.selection.delete(i)) this.selection.add(i);
    this.onChange();
  }

  click(i, adds) {
    if (adds) this.toggle(i);
    else this.select([i]);
  }

  // The rings around the limbs at the control points selected.
  selectRings(indices = this.selection) {
    this.select([...indices].flatMap((i) => this.graph.ring(this.rest, i)));
  }

  // The limb beyond the selection, which rotates around the center of what was selected.
  selectLimb() {
    const ring = [...this.selection];
    this.select(this.graph.beyond(this.selection));
    this.setPivot(ring);
  }

  setPivot(indices) {
    this.pivotPoints = indices;
    this.onChange();
  }

  // Handles of curves come after all corners.
  isHandle(i) {
    return this.handles.size > 0 && i >= this.handles.size;
  }

  // These control points, and the handles of those that are corners of curves.
  withHandles(indices) {
    return [...indices].flatMap((i) => [i, ...this.handles.get(i) ?? []]);
  }

  // A handle that moves alone turns the one on the other side of its corner if both were in line.
  keepInLine(result) {
    for (const [corner, handles] of this.handles) {
      const arms = handles.map((i) => subtract(pointAt(this.start, i), pointAt(this.start, corner)));
      const place = pointAt(result, corner), moved = handles.map((i) => subtract(pointAt(result, i), place));
      const held = moved.map((arm, k) => arm.some((value, c) => value !== arms[k][c]));
      if (handles.length !== 2 || held[0] === held[1] || dot(...arms) >= 0) continue;
      if (length(cross(...arms)) > kInLine * length(arms[0]) * length(arms[1])) continue;
      const [turns, other] = held[0] ? [1, 0] : [0, 1];
      const factor = length(arms[turns]) / length(moved[other]);
      if (Number.isFinite(factor)) setPoint(result, handles[turns], subtract(place, times(factor, moved[other])));
    }
  }

  // Which share of a step control points take: within the radius it falls smoothly to 0. Corners take
  // their handles along.
  shares() {
    const distances = this.graph.distances(this.rest, this.selection, this.softness);
    const shares = new Map();
    for (const [i, distance] of distances) {
      const share = distance > 0 ? (1 - (distance / this.softness) ** 2) ** 2 : 1;
      if (share > 0) shares.set(i, share);
    }
    for (const [i, share] of [...shares]) {
      for (const handle of this.handles.get(i) ?? []) shares.set(handle, Math.max(share, shares.get(handle) ?? 0));
    }
    return shares;
  }

  // -1: none. Mirrors at a plane through the origin or through the middle of the resting cage.
  setMirror(axis) {
    this.mirrorAxis = axis;
    if (axis < 0) {
      this.pairs = null;
      return 0;
    }
    const places = [0, this.sphere.center[axis]];
    this.pairs = mirrorPairs(this.rest, axis, 2 * this.sphere.radius, places);
    return this.pairs.reduce((sum, j) => sum + (j >= 0), 0);
  }

  begin() {
    if (this.start) return;
    this.start = this.points.slice();
    this.startLists = this.lists;
  }

  // Moves control points from where the stroke began: move(start, indices, result).
  // \param keepsLine  whether handles that are in line stay so
  change(indices, move, keepsLine = true) {
    this.begin();
    const result = this.start.slice();
    move(this.start, indices, result);
    if (this.pairs) mirrorMoves(this.start, result, indices, this.pairs, this.mirrorAxis);
    if (keepsLine) this.keepInLine(result);
    if (this.dim === 2) for (let i = 0; i < this.size; ++i) result[3 * i + 2] = 0;
    this.setPoints(result);
  }

  setPoints(points) {
    this.points = points;
    this.onChange();
  }

  // Takes other keys, of which there are none or two at least, within a stroke.
  setPoses(poses) {
    this.begin();
    this.content.poses = poses.length > 1 ? poses : [];
    this.onChange();
  }

  // Takes another library, as a stroke.
  setLibrary(library) {
    this.begin();
    this.content.library = library;
    this.end();
  }

  end() {
    const points = this.start, lists = this.startLists, { poses, library } = this.content;
    this.start = null;
    if (!points || (lists.poses === poses && lists.library === library && areEqual(points, this.points))) return;
    this.done.push({ points, lists });
    if (this.done.length > kMostStrokes) this.done.shift();
    this.undone = [];
    this.onChange();
  }

  cancel() {
    if (!this.start) return;
    const before = this.start;
    this.start = null;
    Object.assign(this.content, this.startLists);
    this.setPoints(before);
  }

  undo() {
    this.swap(this.done, this.undone);
  }

  redo() {
    this.swap(this.undone, this.done);
  }

  swap(from, to) {
    this.end();
    if (from.length === 0) return;
    to.push({ points: this.points, lists: this.lists });
    const { points, lists } = from.pop();
    Object.assign(this.content, lists);
    this.setPoints(points);
  }

  // Back to rest, as a stroke.
  reset(indices) {
    this.begin();
    const points = this.points.slice();
    for (const i of indices) setPoint(points, i, pointAt(this.rest, i));
    this.setPoints(points);
    this.end();
  }

  place(i, place) {
    this.change([i], (start, listed, result) => setPoint(result, i, place));
    this.end();
  }
}
