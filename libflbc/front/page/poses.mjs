// SPDX-License-Identifier: BSD-3-Clause
// Between the poses the cage moves along straight lines.

// The control points at a time in seconds.
export function interpolatePoses(poses, time) {
  const last = poses[poses.length - 1];
  if (time <= poses[0].time) return poses[0].points.slice();
  if (time >= last.time) return last.points.slice();
  const next = poses.findIndex((pose) => pose.time > time);
  const { time: begin, points: from } = poses[next - 1];
  const { time: end, points: to } = poses[next];
  const share = (time - begin) / (end - begin);
  return from.map((value, k) => value + share * (to[k] - value));
}

// The pose that is nearest in time.
export function nearestPose(poses, time) {
  let best = 0;
  poses.forEach((pose, k) => {
    if (Math.abs(pose.time - time) < Math.abs(poses[best].time - time)) best = k;
  });
  return poses[best];
}

// Where playing is after some seconds: from the first pose to the last one and back again.
export function playedTime(poses, seconds) {
  const begin = poses[0].time, length = poses[poses.length - 1].time - begin;
  const phase = seconds % (2 * length);
  return begin + (phase <= length ? phase : 2 * length - phase);
}
