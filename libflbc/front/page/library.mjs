// SPDX-License-Identifier: BSD-3-Clause
// Poses with pictures, which are kept in the browser for the cage, and in files.
import { nameOf } from "./keeping.mjs";
import { tell } from "./panel.mjs";
import { download } from "./saving.mjs";
import { pointAt } from "./vectors.mjs";

const kThumbnail = 96;  // pixels

// A square around the cage, without the cage.
function pictureOf(viewer) {
  const { canvas, camera, editor, showsCage, renderer } = viewer;
  viewer.showsCage = false;
  viewer.draw();
  const spots = Array.from({ length: editor.size }, (_, i) => camera.project(pointAt(editor.points, i)));
  const [left, right, top, bottom] = ["x", "y"].flatMap((c) => [Math.min, Math.max].map((best) => best(...spots.map((spot) => spot[c]))));
  const side = Math.max(right - left, bottom - top), { ratio } = renderer;
  const picture = Object.assign(document.createElement("canvas"), { width: kThumbnail, height: kThumbnail });
  picture.getContext("2d").drawImage(canvas, ratio * (left + right - side) / 2, ratio * (top + bottom - side) / 2, ratio * side, ratio * side, 0, 0, kThumbnail, kThumbnail);
  viewer.set("showsCage", showsCage);
  return picture.toDataURL("image/webp");
}

// \return null if there are none in the text
function posesIn(text) {
  const isPose = ({ name, picture, steps }) => typeof name === "string" && /^data:image\//.test(picture) && steps.every(Number.isFinite);
  try {
    const { poses } = JSON.parse(text);
    return poses.every(isPose) ? poses : null;
  } catch {
    return null;
  }
}

export class Library {
  // \param board  for the pictures
  constructor(viewer, board) {
    this.viewer = viewer;
    this.board = board;
    this.name = `${nameOf(viewer.content)} poses`;
    let kept = null;
    try {
      kept = JSON.parse(localStorage.getItem(this.name));
    } catch { /* browsers may refuse */ }
    this.shown = viewer.content.library = kept ?? [];  // name, picture, steps of the control points from rest
    this.draw();
  }

  get poses() { return this.viewer.content.library; }

  set(poses) {
    this.viewer.editor.setLibrary(poses);
    this.show();
  }

  // Keeps and shows what is new; undo may have brought it back.
  show() {
    if (this.shown === this.poses) return;
    this.shown = this.poses;
    try {
      localStorage.setItem(this.name, JSON.stringify(this.poses));
    } catch {
      tell("This browser does not keep these poses: save them");
    }
    this.draw();
  }

  keep() {
    const { editor, holdsModel } = this.viewer;
    if (holdsModel) return;
    const numbers = this.poses.map(({ name }) => Number(/\d+$/.exec(name)));
    this.set([...this.poses, { name: `pose ${Math.max(0, ...numbers) + 1}`, picture: pictureOf(this.viewer),
                               steps: Array.from(editor.points, (place, k) => place - editor.rest[k]) }]);
  }

  // Takes a pose. \param isPart  for the control points that are selected only
  take({ steps }, isPart) {
    const { viewer } = this, { editor } = viewer;
    viewer.stopPlaying();
    if (viewer.holdsModel) return;
    editor.begin();
    editor.setPoints(editor.points.map((place, k) => (isPart && !editor.selection.has(Math.floor(k / 3)) ? place : editor.rest[k] + steps[k])));
    editor.end();
  }

  save() {
    download(`${this.viewer.content.title}_poses.json`, new Blob([JSON.stringify({ poses: this.poses })]));
  }

  // \throws Error
  load(text) {
    const poses = posesIn(text), { length } = this.viewer.editor.points;
    if (!poses) throw new Error("this is not a file of saved poses");
    const other = poses.find(({ steps }) => steps.length !== length);
    if (other) throw new Error(`is of a cage of ${other.steps.length / 3} control points, but this one has ${length / 3}`);
    this.set([...this.poses, ...poses]);
  }

  draw() {
    document.getElementById("savePoses").disabled = this.poses.length === 0;
    this.board.replaceChildren(...this.poses.map((pose) => {
      const button = (changes, act) => {
        const made = Object.assign(document.createElement("button"), changes);
        made.addEventListener("click", act);
        return made;
      };
      const take = button({ title: `${pose.name}; with Shift: the selected control points only` }, (event) => this.take(pose, event.shiftKey));
      take.append(Object.assign(new Image(), { src: pose.picture, alt: pose.name }));
      const forget = button({ textContent: "×", title: `Remove ${pose.name}` }, () => this.set(this.poses.filter((each) => each !== pose)));
      forget.setAttribute("aria-label", forget.title);
      const both = document.createElement("div");
      both.append(take, forget);
      return both;
    }));
  }
}
