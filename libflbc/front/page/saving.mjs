// SPDX-License-Identifier: BSD-3-Clause
// Downloads of poses, models and pictures, and a command to copy.
import { kBases } from "./camera.mjs";
import { inFile } from "./data.mjs";
import { glbOf } from "./glb.mjs";
import { modelText, poseText } from "./obj.mjs";
import { straightKeys } from "./poses.mjs";

export function download(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function saveText(name, text) {
  download(name, new Blob([text], { type: "text/plain" }));
}

// The control points with as many coordinates as the cage's file gives.
function placesOf(viewer) {
  const { dim } = viewer.content;
  return inFile(viewer.editor.points, dim);
}

export function poseOf(viewer) {
  const { cageText, given, dim, facets } = viewer.content;
  return poseText(cageText, given, placesOf(viewer), dim, facets);
}

// Where the model's points are, dim numbers each.
export function pointsOf(viewer) {
  viewer.update();
  const { dim, center } = viewer.content;
  return viewer.deformer.points.map((value, k) => value + center[k % 3]).filter((_, k) => k % 3 < dim);
}

export function savePose(viewer) {
  saveText(`${viewer.content.title}_pose.obj`, poseOf(viewer));
}

export function saveModel(viewer) {
  const { dim, surface, title } = viewer.content;
  saveText(`${title}_posed.obj`, modelText(pointsOf(viewer), dim, surface));
}

export function saveAnimation({ content }) {
  download(`${content.title}_animation.glb`, glbOf({ ...content, poses: straightKeys(content.poses) }, kBases[content.up]));
}

// The animation as it plays, once and without the cage. \return the name of the file
// \throws Error where the browser records no films
export async function saveFilm(viewer) {
  const { canvas, content, editor } = viewer;
  const type = ["video/webm", "video/mp4"].find((each) => globalThis.MediaRecorder?.isTypeSupported(each));
  if (!type || !canvas.captureStream) throw new Error("This browser does not record films. Recent versions of Chrome, Edge, Firefox, and Safari do");
  const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: type, videoBitsPerSecond: 1e7 });
  const parts = [], name = `${content.title}.${type.slice(6)}`;
  recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
  const stopped = new Promise((done) => { recorder.addEventListener("stop", done); });
  viewer.stopPlaying();
  recorder.start();
  viewer.play(() => {
    editor.cancel();
    recorder.stop();
  });
  await stopped;
  download(name, new Blob(parts, { type }));
  return name;
}

export function savePicture(viewer) {
  viewer.draw();
  viewer.canvas.toBlob((blob) => download(`${viewer.content.title}.png`, blob), "image/png");
}

// A word for a shell.
function quoted(text) {
  return /^[\w@%+=:,./-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
}

// The place of a file that is named relative to the page, where the page is a file itself.
function placeOf(file, address) {
  if (!address.startsWith("file:")) return file;
  const path = new URL(file.split("/").map(encodeURIComponent).join("/"), address).pathname;
  return decodeURIComponent(path);
}

// Moves the model, exactly and in its own format, into the pose that is saved. It works in the folder
// of the pose, which only the browser knows.
export function commandOf(viewer, address) {
  const { title, files } = viewer.content;
  const extension = /\.[^./]*$/.exec(files.model)?.[0] ?? ".obj";
  const place = (file) => quoted(placeOf(file, address));
  return ["flbc deform", place(files.model), "--weights", place(files.weights), "--pose",
          quoted(`${title}_pose.obj`), "--rest", place(files.cage), "-o", quoted(`${title}_posed${extension}`)].join(" ");
}
