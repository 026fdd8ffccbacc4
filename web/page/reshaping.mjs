// SPDX-License-Identifier: BSD-3-Clause
// Reshaping the rest cage, for which weights are computed anew. The cage follows the pointer at once;
// what is solved is always the latest shape, one at a time.
import { inFile, inSpace } from "../../libflbc/front/page/data.mjs";
import { element } from "../../libflbc/front/page/panel.mjs";

function areSame(a, b) {
  return a.every((value, k) => value === b[k]);
}

export class Reshaper {
  // \param ask  sends a request and gives the reply, both as objects
  constructor(viewer, ask) {
    this.viewer = viewer;
    this.ask = ask;
    this.isOn = false;
    this.isBusy = false;
    this.solved = viewer.content.rest;     // the shape that the weights belong to
    this.converged = viewer.content.rest;  // the last one whose solve was ended
    this.sent = viewer.content.rest;
    this.residual = 1;
    this.isRefused = false;
    this.onState = () => {};
    this.onRefusal = () => {};
    this.onWeights = () => {};  // there are other weights, those of the problem that is solved
  }

  // Between posing the cage and reshaping it at rest. The pose is kept as steps from rest.
  toggle() {
    const { editor, deformer } = this.viewer;
    if (this.isBusy) return;
    if (this.isOn) {
      editor.restart(Float64Array.from(deformer.rest, (place, k) => place + this.steps[k]));
    } else {
      this.steps = editor.points.map((place, k) => place - deformer.rest[k]);
      editor.restart(deformer.rest.slice());
    }
    this.isOn = !this.isOn;
    this.viewer.changed();
    this.onState();
  }

  // To be called whenever the cage may have been moved.
  async edited() {
    const { editor } = this.viewer;
    if (!this.isOn || this.isBusy) return;
    if (this.isRefused && !editor.start && areSame(editor.points, this.sent)) {
      return this.goBack(this.solved);
    }
    if (areSame(editor.points, this.sent)) return;
    this.isBusy = true;
    this.onState();
    while (!areSame(editor.points, this.sent)) await this.solve();
    this.isBusy = false;
    this.onState();
  }

  // The shape that is solved, to its end, unless it is moved meanwhile.
  async refine() {
    if (this.isBusy) return;
    this.isBusy = true;
    this.onState();
    await this.solveOn({ refine: true });
    this.isBusy = false;
    this.onState();
    await this.edited();
  }

  // The present shape.
  async solve() {
    const { editor, content } = this.viewer;
    this.sent = editor.points.slice();
    const reply = await this.solveOn({ points: inFile(this.sent, content.dim) });
    if (reply.refused && areSame(editor.points, this.sent) && !editor.start) this.goBack(this.solved);
  }

  // On until it has converged or there is another one. \return the last reply
  async solveOn(request) {
    const { editor } = this.viewer;
    let reply = await this.ask(request);
    while (this.take(reply) && !reply.converged && areSame(editor.points, this.sent)) {
      reply = await this.ask({ refine: true });
    }
    return reply;
  }

  // \return whether the shape was accepted
  take(reply) {
    this.isRefused = Boolean(reply.refused);
    if (reply.refused) {
      this.onRefusal(reply.refused);
      return false;
    }
    const { viewer } = this;
    const rest = inSpace(reply.rest, viewer.content.dim);
    const { rest: before, poses } = viewer.content;
    // Keys are moved with the cage, as the pose is.
    if (!areSame(rest, before)) {
      for (const pose of poses) pose.points = pose.points.map((place, k) => place - before[k] + rest[k]);
    }
    viewer.content.rest = rest;
    viewer.editor.rest = rest;
    Object.assign(viewer.deformer, { rest, weights: reply.weights });
    this.onWeights();
    this.solved = rest;
    if (reply.converged) this.converged = rest;
    this.residual = reply.residual;
    viewer.changed();
    this.onState();
    return true;
  }

  // To the last shape that was solved to the end.
  cancel() {
    this.goBack(this.converged);
  }

  goBack(points) {
    const { editor } = this.viewer;
    if (!this.isOn) return;
    editor.begin();
    editor.setPoints(points);
    editor.end();
  }
}

// How a solve stands, as a bar of the residual's logarithm.
function showReshaping(reshaper) {
  element("reshape").setAttribute("aria-pressed", String(reshaper.isOn));
  element("reshape").disabled = reshaper.isBusy;
  element("stop").disabled = !reshaper.isBusy;
  const excess = Math.log10(Math.max(1, reshaper.residual));
  element("progress").hidden = !reshaper.isBusy;
  element("progress").value = Math.max(0, 1 - excess / 6);
  element("solving").textContent =
    reshaper.isBusy ? "solving…" : reshaper.isOn ? "drag the cage at rest" : "weights are up to date";
}

// Connects the part of the panel for the rest cage.
export function bindReshaping(reshaper) {
  element("reshape").addEventListener("click", () => reshaper.toggle());
  element("stop").addEventListener("click", () => reshaper.cancel());
  reshaper.viewer.reshaper = reshaper;
  reshaper.viewer.editor.onChange = () => {
    reshaper.viewer.changed();
    reshaper.edited();
  };
  reshaper.onState = () => showReshaping(reshaper);
  showReshaping(reshaper);
}
