// SPDX-License-Identifier: BSD-3-Clause
// Keeps the pose and the keys of the animation in the browser, so that they survive a reload.

// The same for the same cage of a model of the same name.
export function nameOf({ title, rest }) {
  let hash = 0;
  for (const bits of new Uint32Array(Float64Array.from(rest).buffer)) hash = (Math.imul(hash, 31) + bits) | 0;
  return `flbc ${title} ${rest.length / 3} ${hash}`;
}

// \return whether there was a pose to take up
export function keepPose(viewer) {
  const { content, editor, onState } = viewer;
  const { rest } = content;  // of the cage that the name is of; it may be reshaped
  const name = nameOf(content);
  const given = content.poses.length;
  let kept = null;
  try {
    kept = JSON.parse(localStorage.getItem(name));
  } catch {
    return false;  // browsers may refuse
  }
  const isOf = (points) => points?.length === editor.points.length;
  if (kept && isOf(kept.points) && kept.poses.every((pose) => isOf(pose.points))) {
    if (given === 0) content.poses = kept.poses.map((pose) => ({ ...pose, points: Float64Array.from(pose.points) }));
    editor.begin();
    editor.setPoints(Float64Array.from(kept.points));
    editor.end();
  } else {
    kept = null;
  }
  let stored = null, storedKeys = null;
  const kNone = [];
  viewer.onState = () => {
    onState();
    if (editor.start || viewer.holdsModel) return;
    const poses = given === 0 ? content.poses : kNone;
    if (stored === editor.points && storedKeys === poses) return;
    stored = editor.points;
    storedKeys = poses;
    const isAtRest = editor.points.every((place, k) => place === editor.rest[k]);
    try {
      if (isAtRest && poses.length === 0) return localStorage.removeItem(name);
      const plain = (points) => Array.from(points, (place, k) =>
        (editor.rest[k] === rest[k] ? place : place - editor.rest[k] + rest[k]));
      localStorage.setItem(name, JSON.stringify({
        points: plain(editor.points), poses: poses.map((pose) => ({ ...pose, points: plain(pose.points) })) }));
    } catch { /* there is no room: nothing is kept */ }
  };
  return kept !== null;
}
