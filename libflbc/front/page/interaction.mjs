// SPDX-License-Identifier: BSD-3-Clause
// Mouse, pen and fingers on the picture.
import { pick, pointsInside, rectangle, surfaceAt } from "./picking.mjs";
import { ModelDrag, ToolDrag } from "./actions.mjs";

const kReach = { mouse: 12, pen: 16, touch: 26 };  // pixels
const kClick = { mouse: 2, pen: 4, touch: 8 };     // moves up to here are none
const kHandle = { mouse: 6, pen: 8, touch: 18 };   // pixels around a handle of the gizmo

export class Interaction {
  // \param view  what is shown: canvas, camera, editor, gizmo, tool, axis, axes, area, typed, drag, and
  // functions redraw, hover, onOutline, onState
  constructor(view) {
    this.view = view;
    this.pointers = new Map();
    this.mode = null;
    this.behind = -1;  // the control point behind the handle that is held
    const { canvas } = view;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.up(event));
    canvas.addEventListener("pointercancel", (event) => this.up(event));
    canvas.addEventListener("dblclick", (event) => this.selectRing(event));
    canvas.addEventListener("pointerleave", () => view.hover(-1));
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  spotOf(event) {
    const box = this.view.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  pickAt(spot, event) {
    const { editor, camera, showsCage, grabsModel } = this.view;
    return showsCage && !grabsModel ? pick(editor.points, camera, spot.x, spot.y, kReach[event.pointerType] ?? 12) : -1;
  }

  down(event) {
    const { view } = this;
    view.canvas.setPointerCapture(event.pointerId);
    view.canvas.focus();
    view.canvas.classList.remove("keyed");
    const spot = this.spotOf(event);
    this.pointers.set(event.pointerId, spot);
    view.stopPlaying();
    if (this.pointers.size === 2) return this.beginPinch();
    this.from = this.last = spot;
    this.hasMoved = false;
    this.adds = event.shiftKey || event.ctrlKey || event.metaKey;
    if (event.button === 0 && !this.adds && view.brush?.begin(spot, event.altKey)) {
      this.mode = "paint";
      return;
    }
    const hit = event.button === 0 ? this.pickAt(spot, event) : -1;
    const handle = this.handleAt(spot, event);
    if (handle) return this.hold(handle, hit);
    // With Alt the pivot is set, or a handle leaves the line with the opposite one.
    if (hit >= 0 && event.altKey && !view.editor.isHandle(hit)) return view.editor.setPivot([hit]);
    this.mode = hit >= 0 ? this.grab(hit, !event.altKey) : this.modeOfEmptySpot(event);
  }

  // With Shift, dragging is for selecting, and with Alt for the pivot.
  handleAt(spot, event) {
    if (event.shiftKey || event.altKey || event.button > 0) return null;
    return this.view.gizmo.pick(spot, kHandle[event.pointerType] ?? 6);
  }

  // A handle of the gizmo is dragged; a click is for the control point behind it.
  hold(handle, hit) {
    this.mode = "edit";
    this.behind = hit;
    this.beginDrag = () => { this.view.drag = this.view.gizmo.begin(handle, this.from); };
  }

  // A control point under the pointer is selected, and moves with all that are. The first drag of
  // all takes the limb beyond it with its ring, because one control point alone makes a dent.
  grab(hit, keepsLine) {
    const { editor } = this.view;
    const isFirst = !editor.isHandle(hit) && editor.selection.size === 0 && !editor.canUndo && !editor.canRedo && !this.adds;
    if (this.adds || !editor.selection.has(hit)) editor.click(hit, this.adds);
    if (!editor.selection.has(hit)) return "none";
    this.beginDrag = () => {
      if (isFirst) editor.selectRings();
      if (isFirst) editor.selectLimb();
      this.view.drag = Object.assign(this.newDrag(hit), { keepsLine });
    };
    return "edit";
  }

  // The place of the model under the pointer. \return whether there is one
  grabModel() {
    const { view } = this, { deformer, content, camera, editor, axis, axes } = view;
    view.update();
    const grip = surfaceAt(deformer.points, content.surface, camera, content.center, this.from);
    if (!grip) return false;
    this.beginDrag = () => {
      view.drag = new ModelDrag(editor, camera, axis, grip.place, deformer.weightsAt(grip.shares), this.from, axes);
    };
    return true;
  }

  newDrag(grabbed) {
    const { editor, camera, tool, axis, axes } = this.view;
    return new ToolDrag(editor, camera, tool, axis, grabbed, this.from, axes);
  }

  selectRing(event) {
    const { editor } = this.view;
    const hit = this.pickAt(this.spotOf(event), event);
    if (hit < 0) return;
    const others = event.shiftKey ? [...editor.selection] : [];
    editor.selectRings([hit]);
    if (others.length > 0) editor.select([...others, ...editor.selection]);
  }

  // A key of a number that the tool applies to the selection. \return whether it was one
  type(key) {
    const { view } = this;
    const { selection } = view.editor;
    if (view.typed === null || (selection.size === 0 && !view.drag)) return false;
    if (key === "Enter" && view.typed !== "") {
      view.editor.end();
      this.finish();
      return true;
    }
    if (/^[-.\d]$/.test(key)) view.typed += key;
    else if (key === "Backspace" && view.typed !== "") view.typed = view.typed.slice(0, -1);
    else return false;
    view.drag ??= this.newDrag(selection.values().next().value);
    const number = Number(view.typed || NaN);
    if (Number.isFinite(number)) view.drag.by(number);
    view.redraw();
    view.onState();
    return true;
  }

  modeOfEmptySpot(event) {
    const { view } = this;
    if (event.button !== 0) return "pan";
    if (view.grabsModel && !this.adds && this.grabModel()) return "edit";
    if (view.area || event.shiftKey || event.ctrlKey) {
      this.area = event.ctrlKey ? "lasso" : event.shiftKey ? "box" : view.area;
      this.outline = [this.from];
      return "area";
    }
    return view.camera.dim === 3 ? "orbit" : "pan";
  }

  beginPinch() {
    this.cancel();
    this.mode = "pinch";
    this.pinch = this.pinchOf();
  }

  pinchOf() {
    const [a, b] = [...this.pointers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2,
             distance: Math.max(1, Math.hypot(a.x - b.x, a.y - b.y)) };
  }

  move(event) {
    const { view } = this;
    const spot = this.spotOf(event);
    if (!this.pointers.has(event.pointerId)) {
      if (event.pointerType !== "mouse") return;
      const handle = this.handleAt(spot, event);
      view.hover(handle ? -1 : this.pickAt(spot, event), spot, handle);
      return;
    }
    this.pointers.set(event.pointerId, spot);
    if (this.mode === "pinch") return this.movePinch();
    const far = Math.hypot(spot.x - this.from.x, spot.y - this.from.y);
    if (!this.hasMoved && far <= (kClick[event.pointerType] ?? 2)) return;
    this.hasMoved = true;
    this.moveTo(spot, event.ctrlKey || event.metaKey);
    this.last = spot;
  }

  // \param snaps  drags go in round steps
  moveTo(spot, snaps) {
    const { view } = this;
    const { camera } = view;
    const dx = spot.x - this.last.x, dy = spot.y - this.last.y;
    if (this.mode === "edit") {
      if (!view.drag) this.beginDrag();
      view.typed ??= "";
      if (view.typed === "") view.drag.to(spot, snaps);
    } else if (this.mode === "area") {
      if (this.area === "lasso") this.outline.push(spot);
      else this.outline = rectangle(this.from, spot);
      view.onOutline(this.outline);
    } else if (this.mode === "paint") {
      view.brush?.to(spot);
    } else if (this.mode === "orbit") {
      camera.orbit(dx, dy);
    } else if (this.mode === "pan") {
      camera.pan(dx, dy);
    }
    view.redraw();
  }

  movePinch() {
    if (this.pointers.size < 2) return;
    const { camera } = this.view;
    const pinch = this.pinchOf();
    camera.pan(pinch.x - this.pinch.x, pinch.y - this.pinch.y);
    camera.zoom(pinch.distance / this.pinch.distance, pinch.x, pinch.y);
    this.pinch = pinch;
    this.view.redraw();
  }

  up(event) {
    const { view } = this;
    if (!this.pointers.delete(event.pointerId)) return;
    if (event.type === "pointercancel") this.cancel();
    if (this.mode === "pinch") {
      if (this.pointers.size === 0) this.mode = null;
      return;
    }
    if (this.mode === "edit") view.editor.end();
    if (this.mode === "paint") view.brush?.end();
    if (this.mode === "area") this.selectArea();
    const isClick = !this.hasMoved && event.button === 0;
    if (isClick && (this.mode === "orbit" || this.mode === "pan")) view.editor.select([]);
    if (isClick && this.behind >= 0) view.editor.click(this.behind, this.adds);
    this.finish();
  }

  selectArea() {
    const { editor, camera } = this.view;
    const found = this.hasMoved ? pointsInside(editor.points, camera, this.outline) : [];
    editor.select(this.adds ? [...editor.selection, ...found] : found);
  }

  // Escape, or a second finger: the drag never was.
  cancel() {
    if (this.view.drag) this.view.editor.cancel();
    this.view.brush?.cancel();
    this.finish();
  }

  finish() {
    this.mode = null;
    this.behind = -1;
    this.view.drag = null;
    this.view.typed = null;
    this.view.onOutline(null);
    this.view.onState();
    this.view.redraw();
  }

  wheel(event) {
    event.preventDefault();
    const spot = this.spotOf(event);
    const lines = event.deltaMode === 1 ? 20 : 1;
    this.view.camera.zoom(Math.exp(-0.0015 * lines * event.deltaY), spot.x, spot.y);
    this.view.redraw();
  }
}
