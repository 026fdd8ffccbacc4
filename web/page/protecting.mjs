// SPDX-License-Identifier: BSD-3-Clause
// Regions of the model that control points must not move, solid ones, and the density of the next cage,
// painted by a brush, and the reach of control points. Weights are solved for the latest stroke, one at
// a time.
import { element, tell } from "../../libflbc/front/page/panel.mjs";
import { surfaceAt } from "../../libflbc/front/page/picking.mjs";
import { download } from "../../libflbc/front/page/saving.mjs";
import { add, length, pointAt, subtract } from "../../libflbc/front/page/vectors.mjs";

const kMostRegions = 50;     // that can be undone
const kMostConflicts = 300;  // that are drawn
const kDenser = 4, kMostDense = 16;  // factor of a stroke, and of all
const kOrigin = [0, 0, 0];

// Lists of control points as text, which serve as keys.
function listed(key) {
  return key ? key.split(",").map(Number) : [];
}

function united(key, others) {
  return [...new Set([...listed(key), ...others])].sort((a, b) => a - b).join();
}

export class Protector {
  // \param ask  protect(locality) and refine() of the worker
  constructor(viewer, ask) {
    this.viewer = viewer;
    this.ask = ask;
    this.masked = new Map();  // by vertex: the control points that must not move it, as text
    this.reach = new Map();   // by control point: a factor other than 1
    this.solid = new Map();   // by vertex: the number of its solid region
    this.density = new Map();  // by vertex: of control points, other than 1
    this.falloff = 0;         // width of the band next to regions, as a part of the cage size
    this.sent = null;         // the last regions that were sent; another reach makes others
    this.accepted = [];       // the locality that the weights obey
    this.done = [];
    this.undone = [];
    this.radius = 30;         // pixels
    this.isOn = this.erases = this.isBusy = false;
    this.paints = null;       // "solid", "density", or what the selection must not move
    this.stroke = null;
    this.reply = {};
    this.tell = () => {};
  }

  get canUndo() { return this.done.length > 0; }
  get canRedo() { return this.undone.length > 0; }

  // Once it is on, a new worker sets up its solver while the visitor takes aim.
  toggle() {
    this.isOn = !this.isOn;
    this.viewer.brush = this.isOn ? this : null;
    this.solve();
  }

  // As in a locality file.
  masks() {
    const regions = new Map();
    for (const [vertex, key] of this.masked) {
      if (!regions.has(key)) regions.set(key, []);
      regions.get(key).push(vertex);
    }
    return [...regions].map(([key, vertices]) => ({ control_points: listed(key), region: { vertices } }));
  }

  factors() {
    return [...this.reach].map(([i, factor]) => ({ control_points: [i], factor }));
  }

  regions() {
    const regions = new Map();
    for (const [vertex, number] of this.solid) {
      if (!regions.has(number)) regions.set(number, []);
      regions.get(number).push(vertex);
    }
    return [...regions.values()].map((vertices) => ({ region: { vertices } }));
  }

  locality() {
    const { falloff } = this;
    if (this.reach.size === 0 && this.solid.size === 0 && falloff === 0) return this.masks();
    return { masks: this.masks(), ...this.reach.size > 0 && { reach: this.factors() }, ...falloff > 0 && { falloff },
      ...this.solid.size > 0 && { solid: this.regions() } };
  }

  // Of all vertices, for another cage.
  densities() {
    const all = new Float64Array(this.viewer.deformer.base.length / 3).fill(1);
    for (const [vertex, density] of this.density) all[vertex] = density;
    return all;
  }

  get state() {
    const { masked, reach, falloff, solid, density } = this;
    return { masked, reach, falloff, solid, density };
  }
  get isUsed() { return this.masked.size > 0 || this.reach.size > 0 || this.solid.size > 0; }

  // Masks and reach for a cage that has been edited. \param numbers  of its control points, by those of before
  renumbered(numbers) {
    const known = (list) => [...new Set(list.map((i) => numbers[i]))].filter((i) => i !== undefined);
    const renamed = (choices) => choices.map(({ control_points, ...others }) => ({ control_points: known(control_points), ...others }))
      .filter(({ control_points }) => control_points.length > 0);
    return { masks: renamed(this.masks()), reach: renamed(this.factors()), falloff: this.falloff, solid: this.regions() };
  }

  // \param factor  of phi of the selection is divided; more lets weights extend farther
  setReach(factor) {
    const before = this.state;
    this.masked = new Map(this.masked);
    this.reach = new Map(this.reach);
    for (const i of this.viewer.editor.selection) {
      if (factor === 1) this.reach.delete(i);
      else this.reach.set(i, factor);
    }
    this.keep(before);
  }

  setFalloff(width) {
    const before = this.state;
    this.masked = new Map(this.masked);
    this.falloff = width;
    this.keep(before);
  }

  // ------------------------------------------------------------------------------------- strokes

  // \return whether the pointer is on the model
  begin(spot, erases) {
    const { selection } = this.viewer.editor;
    if (!this.placeAt(spot)) return false;
    if (selection.size === 0 && !this.paints) {
      this.tell("First select the control points that must not move the region");
      return true;
    }
    this.stroke = { spot, before: this.state, selection, erases: erases || this.erases, after: new Map() };
    if (this.paints !== "density") this.masked = new Map(this.masked);
    this.solid = new Map(this.solid);
    this.density = new Map(this.density);
    this.to(spot);
    return true;
  }

  to(spot) {
    if (!this.stroke) return;
    const { x, y } = this.stroke.spot;
    const steps = Math.max(1, Math.ceil(2 * Math.hypot(spot.x - x, spot.y - y) / this.radius));
    for (let k = 1; k <= steps; ++k) this.dab({ x: x + k / steps * (spot.x - x), y: y + k / steps * (spot.y - y) });
    this.stroke.spot = spot;
    this.viewer.changed();
  }

  end() {
    const { stroke } = this;
    this.stroke = null;
    if (stroke) this.keep(stroke.before);
  }

  cancel() {
    if (!this.stroke) return;
    Object.assign(this, this.stroke.before);
    this.stroke = this.sent = null;
    this.solve();
  }

  // The place of the model under the pointer, or undefined.
  placeAt(spot) {
    const { deformer, camera, content } = this.viewer;
    return surfaceAt(deformer.points, content.surface, camera, content.center, spot)?.place;
  }

  // Paints the vertices around the place under the pointer.
  dab(spot) {
    const { deformer: { points }, camera, content } = this.viewer;
    const place = this.placeAt(spot);
    if (!place) return;
    const reach = length(camera.step(place, this.radius, 0)), [x, y, z] = subtract(place, content.center);
    for (let p = 0; p < points.length; p += 3) {
      if (Math.hypot(points[p] - x, points[p + 1] - y, points[p + 2] - z) <= reach) this.paint(p / 3);
    }
  }

  // A stroke grows the first region that it meets, or makes another one.
  paint(vertex) {
    const { before, erases: isErasing } = this.stroke;
    if (this.paints === "density") {
      const density = (before.density.get(vertex) ?? 1) * (isErasing ? 1 / kDenser : kDenser);
      if (density === 1) this.density.delete(vertex);
      else this.density.set(vertex, Math.min(kMostDense, Math.max(1 / kMostDense, density)));
      return;
    }
    if (this.paints === "solid") {
      const { solid, stroke } = this;
      if (stroke.erases) solid.delete(vertex);
      else solid.set(vertex, solid.get(vertex) ?? (stroke.region ??= 1 + [...solid.values()].reduce((a, b) => Math.max(a, b), -1)));
      stroke.region ??= solid.get(vertex);
      return;
    }
    const { selection, erases, after } = this.stroke;
    const key = this.masked.get(vertex) ?? "";
    if (!after.has(key)) after.set(key, erases ? listed(key).filter((i) => !selection.has(i)).join() : united(key, selection));
    if (after.get(key)) this.masked.set(vertex, after.get(key));
    else this.masked.delete(vertex);
  }

  // ------------------------------------------------------------------------------ undo, and files

  keep(before) {
    this.done.push(before);
    if (this.done.length > kMostRegions) this.done.shift();
    this.undone = [];
    this.solve();
  }

  undo() { this.swap(this.done, this.undone); }
  redo() { this.swap(this.undone, this.done); }

  swap(from, to) {
    this.cancel();
    if (from.length === 0) return;
    to.push(this.state);
    Object.assign(this, from.pop());
    this.solve();
  }

  // Takes a file. \param locality  its bytes, or its content
  async load(locality) {
    try {
      const { masks, reach, falloff, solid } = await this.ask.protect(locality);
      const before = this.state;
      this.masked = new Map();
      this.reach = new Map([...(reach ?? []).entries()].filter(([, factor]) => factor !== 1));
      this.falloff = falloff ?? 0;
      this.solid = new Map((solid ?? []).flatMap((vertices, number) => vertices.map((vertex) => [vertex, number])));
      for (const { controlPoints, vertices } of masks) {
        for (const vertex of controlPoints.length > 0 ? vertices : []) {
          this.masked.set(vertex, united(this.masked.get(vertex), controlPoints));
        }
      }
      this.keep(before);
    } catch (error) {
      this.tell(error.message);
    }
  }

  save() {
    const name = `${this.viewer.content.title}_locality.json`;
    download(name, new Blob([JSON.stringify(this.locality())]));
    this.tell(`Saved ${name}`);
  }

  // ------------------------------------------------------------------------------ weights, drawing

  async solve() {
    const isBusy = this.isBusy;
    this.isBusy = true;
    this.viewer.changed();
    if (isBusy) return;
    while (!this.stroke && this.sent !== this.masked) {
      const masked = this.sent = this.masked;
      const locality = this.locality();
      try {
        this.reply = await this.ask.protect(locality);
        if (this.reply.conflict) continue;
        this.accepted = locality;
        let reply = await this.ask.refine();
        while (this.viewer.reshaper.take(reply) && !reply.converged && this.masked === masked) reply = await this.ask.refine();
      } catch (error) {
        if (error.name !== "Cancelled") this.tell(error.message);
      }
    }
    this.isBusy = false;
    this.viewer.changed();
  }

  // Whether the selection must not move vertices with a key.
  get isChosen() {
    const known = new Map(), { selection } = this.viewer.editor;
    return (key) => known.get(key) ?? known.set(key, listed(key).some((i) => selection.has(i))).get(key);
  }

  // In place of the coloring of the view.
  colors() {
    const { isChosen } = this;
    const values = new Float32Array(this.viewer.deformer.base.length / 3);
    for (const [vertex, key] of this.masked) values[vertex] = isChosen(key) ? 0.6 : 0.2;
    for (const vertex of this.solid.keys()) values[vertex] = 1;
    if (this.paints === "density") {
      values.fill(0);
      for (const [vertex, density] of this.density) values[vertex] = 0.5 + Math.log(density) / Math.log(kMostDense) / 2.5;
    }
    return { values, legend: null };
  }

  // The brush, vertices in conflict, and rings around the control points that would carry them.
  drawOver() {
    const { viewer: { camera, editor, deformer, content, pointer: [x, y] }, stroke, reply: { conflict } } = this;
    const circle = (kind, radius, place) => `<circle class="${kind}" cx="${place.x}" cy="${place.y}" r="${radius}"/>`;
    const circles = (kind, radius, points, list, origin) =>
      (list ?? []).map((k) => circle(kind, radius, camera.project(add(pointAt(points, k), origin)))).join("");
    const spot = stroke?.spot ?? { x: (1 + x) * camera.width / 2, y: (1 - y) * camera.height / 2 };
    element("marks").innerHTML = !this.isOn ? "" : circle("brush", this.radius, spot)
      + circles("vertex", 2.5, deformer.points, conflict?.vertices.slice(0, kMostConflicts), content.center)
      + circles("cure", 11, editor.points, conflict?.controlPoints, kOrigin);
  }

  // What the panel says.
  describe() {
    const { isChosen, masked, isBusy, reply: { conflict, onFacets }, viewer: { editor } } = this;
    const vertices = (count) => `${count.toLocaleString("en")} ${count === 1 ? "vertex" : "vertices"}`;
    if (conflict) {
      return `${vertices(conflict.vertices.length)} (red) cannot stay: too few control points are left to carry them. `
        + `Release the ringed control points (${conflict.controlPoints.join(", ")}), or erase a part of the region. Until then, weights and reach stay as they were.`;
    }
    const state = isBusy ? "; solving…" : onFacets > 0 ? `; ${onFacets} on the cage still move` : "";
    if (this.paints === "density") {
      return `Drag on the model where the next cage is to have ${kDenser} times as many control points, or with Erase as few. ${vertices(this.density.size)} painted; then "Make again" under Cage`;
    }
    if (this.paints === "solid") return `${vertices(this.solid.size)} solid; drag on the model to paint a region that moves as one${state}`;
    if (editor.selection.size === 0) return `${vertices(masked.size)} protected; select control points to paint${state}`;
    const count = [...masked.values()].filter(isChosen).length;
    if (count === 0) return `Drag on the model to paint what the selection must not move${state}`;
    return `The selection does not move ${vertices(count)}${state}`;
  }
}

// Connects the part of the panel for regions.
export function bindProtecting(protector) {
  const { viewer } = protector;
  const { onDrawn, onState } = viewer;
  const onClick = (id, action) => element(id).addEventListener("click", action);
  protector.tell = tell;
  const reach = element("reach");
  const showReach = () => { element("reachFactor").textContent = `× ${Number((2 ** reach.value).toPrecision(2))}`; };
  const falloff = element("falloff");
  const showFalloff = () => { element("falloffWidth").textContent = falloff.value; };
  let shown = null;
  element("outline").insertAdjacentHTML("afterend", '<svg id="marks"></svg>');
  viewer.onDrawn = () => { onDrawn(); protector.drawOver(); };
  viewer.onState = () => {
    onState();
    element("paint").setAttribute("aria-pressed", String(protector.isOn));
    element("erase").setAttribute("aria-pressed", String(protector.erases));
    for (const kind of ["solid", "density"]) element(kind).setAttribute("aria-pressed", String(protector.paints === kind));
    element("rigidParts").hidden = protector.solid.size === 0;
    element("release").hidden = !protector.reply.conflict;
    element("protected").textContent = protector.describe();
    // Not while the slider is dragged.
    const { reach: factors, viewer: { editor: { selection } } } = protector;
    const hasConflict = Boolean(protector.reply.conflict);
    const state = [protector.falloff, hasConflict, ...[...selection].map((i) => [i, factors.get(i)])].join();
    if (state === shown) return;
    shown = state;
    reach.disabled = selection.size === 0 || hasConflict;
    reach.value = Math.log2(factors.get([...selection][0]) ?? 1);
    showReach();
    falloff.value = protector.falloff;
    showFalloff();
  };
  onClick("paint", () => protector.toggle());
  onClick("erase", () => { protector.erases = !protector.erases; viewer.changed(); });
  for (const kind of ["solid", "density"]) onClick(kind, () => { protector.paints = protector.paints === kind ? null : kind; viewer.changed(); });
  onClick("release", () => protector.load({
    masks: protector.masks(), reach: protector.factors(), falloff: protector.falloff, solid: protector.regions(), conflicts: "relax" }));
  onClick("saveLocality", () => protector.save());
  onClick("loadLocality", () => element("localityFile").click());
  element("brush").addEventListener("input", ({ target }) => { protector.radius = Number(target.value); });
  reach.addEventListener("input", showReach);
  reach.addEventListener("change", () => protector.setReach(2 ** Number(reach.value)));
  falloff.addEventListener("input", showFalloff);
  falloff.addEventListener("change", () => protector.setFalloff(Number(falloff.value)));
  element("localityFile").addEventListener("change", async ({ target }) => {
    if (target.files.length > 0) protector.load(await target.files[0].arrayBuffer());
    target.value = "";
  });
  viewer.onState();
}
