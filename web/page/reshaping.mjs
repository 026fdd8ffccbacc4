// SPDX-License-Identifier: BSD-3-Clause
// Reshaping the rest cage, for which weights are computed anew. The cage follows the pointer at once;
// what is solved is always the latest shape, one at a time.
import { inSpace } from "../../apps/view/page/data.mjs";
import { element } from "../../apps/view/page/panel.mjs";

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

  // Whether points are to stay where they rest while the cage is moved.
  get holdsModel() {
    return this.isOn;
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

  // The present shape, and on until it has converged or there is another one.
  async solve() {
    const { editor, content } = this.viewer;
    this.sent = editor.points.slice();
    let reply = await this.ask({ points: [...this.sent].filter((_, k) => k % 3 < content.dim) });
    while (this.take(reply) && !reply.converged && areSame(editor.points, this.sent)) {
      reply = await this.ask({ refine: true });
    }
    if (reply.refused && areSame(editor.points, this.sent) && !editor.start) this.goBack(this.solved);
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
    viewer.content.rest = rest;
    viewer.editor.rest = rest;
    Object.assign(viewer.deformer, { rest, weights: reply.weights });
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
