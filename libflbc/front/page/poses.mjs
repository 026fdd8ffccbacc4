// SPDX-License-Identifier: BSD-3-Clause
// Between the keys the cage moves along straight lines, or every control point on a smooth curve.

export const kFrames = 12;  // per second of an animation that is saved in frames

// How fast control points pass a key. A point that rests before or after it, or turns back at it, rests
// at it, so that no curve overshoots; all of them rest at both ends, unless the last key closes a loop.
function velocitiesAt(poses, k) {
  const count = poses.length - 1, velocities = new Float64Array(poses[k].points.length);
  if (!poses[count].closes && (k === 0 || k === count)) return velocities;
  const [before, after] = [(k + count - 1) % count, k % count].map((part) => {
    const [from, to] = [poses[part], poses[part + 1]];
    return from.points.map((place, c) => (to.points[c] - place) / (to.time - from.time));
  });
  for (let i = 0; i < velocities.length; i += 3) {
    const [a, b] = [before, after].map((list) => Math.hypot(list[i], list[i + 1], list[i + 2]));
    for (let c = i; c < i + 3; ++c) velocities[c] = (b * before[c] + a * after[c]) / (a + b || 1);
  }
  return velocities;
}

// The control points at a time in seconds.
export function interpolatePoses(poses, time) {
  const last = poses[poses.length - 1];
  if (time <= poses[0].time) return poses[0].points.slice();
  if (time >= last.time) return last.points.slice();
  const next = poses.findIndex((pose) => pose.time > time);
  const { time: begin, points: from } = poses[next - 1];
  const { time: end, points: to } = poses[next];
  const share = (time - begin) / (end - begin);
  if (poses[0].isStraight) return from.map((value, k) => value + share * (to[k] - value));
  const [first, second] = [next - 1, next].map((k) => velocitiesAt(poses, k));
  return from.map((value, k) => {
    const far = to[k] - value;
    const bend = (1 - share) * ((end - begin) * first[k] - far) - share * ((end - begin) * second[k] - far);
    return value + share * far + share * (1 - share) * bend;
  });
}

// The keys of an animation in a file whose readers move along straight lines: more than are smooth.
export function straightKeys(poses) {
  if (poses.length < 2 || poses[0].isStraight) return poses;
  return poses.flatMap((pose, k) => {
    const far = k + 1 < poses.length ? poses[k + 1].time - pose.time : 0, count = Math.max(1, Math.round(kFrames * far));
    const between = Array.from({ length: count - 1 }, (_, j) => pose.time + (j + 1) / count * far);
    return [pose, ...between.map((time) => ({ name: `${pose.name} + ${(time - pose.time).toFixed(2)} s`, time, points: interpolatePoses(poses, time) }))];
  });
}

// The pose that is nearest in time.
export function nearestPose(poses, time) {
  let best = 0;
  poses.forEach((pose, k) => {
    if (Math.abs(pose.time - time) < Math.abs(poses[best].time - time)) best = k;
  });
  return poses[best];
}

// Where playing is after some seconds: again and again in a loop, else to the last pose and back again.
export function playedTime(poses, seconds) {
  const { time, closes } = poses[poses.length - 1];
  const begin = poses[0].time, length = time - begin;
  const phase = seconds % (closes ? length : 2 * length);
  return begin + (phase <= length ? phase : 2 * length - phase);
}
