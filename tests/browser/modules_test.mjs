// SPDX-License-Identifier: BSD-3-Clause
// The page's modules without a browser: node --test modules_test.mjs
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";

const page = new URL("../../libflbc/front/page/", import.meta.url);
const load = (name) => import(new URL(`${name}.mjs`, page));
const { Camera } = await load("camera");
const { portion } = await load("colors");
const { Deformer } = await load("deformer");
const { Editor } = await load("editor");
const { curvesOf } = await load("curves");
const { decodeIndices, inSpace } = await load("data");
const { poseText, readPose } = await load("obj");
const { interpolatePoses, playedTime, straightKeys } = await load("poses");
const { edgesOf, sumNormals } = await load("surface_normals");
const { principalAxes, rotate, scale, translate } = await load("transforms");
const { pointAt } = await load("vectors");
const { pick, pointsInside, rectangle, surfaceAt } = await load("picking");
const { CageGraph } = await load("rings");
const { leastMoves, ModelDrag, ToolDrag } = await load("actions");
const { Reshaper } = await import(new URL("../../web/page/reshaping.mjs", import.meta.url));
const { Protector } = await import(new URL("../../web/page/protecting.mjs", import.meta.url));
const { cageToObj, curvedCage, mergePoints, piecesOf, splitEdge, straightCage } = await import(new URL("../../web/page/cage_edits.mjs", import.meta.url));
const { commandOf } = await load("saving");
const { kWeightedSum } = await load("shaders");

// The corners of a cube with edges of length 2.
const kCube = Float64Array.from({ length: 24 }, (_, k) => (k % 3 === 0 ? Math.floor(k / 3) & 1
  : k % 3 === 1 ? Math.floor(k / 3) >> 1 & 1 : Math.floor(k / 3) >> 2) * 2 - 1);

function near(a, b, tolerance = 1e-9) {
  assert.equal(a.length, b.length);
  for (let k = 0; k < a.length; ++k) assert.ok(Math.abs(a[k] - b[k]) <= tolerance, `${a} and ${b}`);
}

function cameraOf(dim) {
  const camera = new Camera(dim);
  camera.width = 800;
  camera.height = 600;
  camera.sphere = { center: [0, 0, 0], radius: 2 };
  camera.frame(kCube);
  return camera;
}

// Where the matrix puts a place, in pixels.
function throughMatrix(camera, origin, place) {
  const m = camera.matrix(origin);
  const seen = place.map((value, k) => value - origin[k]);
  const clip = [0, 1, 2, 3].map((r) => m[r] * seen[0] + m[4 + r] * seen[1] + m[8 + r] * seen[2] + m[12 + r]);
  return { x: (1 + clip[0] / clip[3]) / 2 * camera.width,
           y: (1 - clip[1] / clip[3]) / 2 * camera.height, depth: clip[2] / clip[3] };
}

test("camera: the axis that points up, and turns by 90 degrees", () => {
  for (const up of [0, 1, 2]) {
    const camera = new Camera(3, up);
    camera.look(0, 0);
    const axis = [0, 1, 2].map((k) => (k === up ? 1 : 0));
    near(camera.axes().up, axis);
    const { right, toward } = camera.axes();
    near(toward, [0, 1, 2].map((k) => right[(k + 1) % 3] * axis[(k + 2) % 3] -
                                      right[(k + 2) % 3] * axis[(k + 1) % 3]));
    camera.turn();
    near(camera.axes().toward, toward);
    assert.ok(Math.abs(camera.axes().up[up]) < 1e-9);
    for (let k = 0; k < 3; ++k) camera.turn();
    near(camera.axes().up, axis);
    camera.look(0, 1.5);
    camera.turn();
    camera.look(0, 0);
    near(camera.axes().up.map(Math.abs), axis);
    assert.ok(Math.abs(camera.axes().toward.reduce((sum, value, k) => sum + value * toward[k], 0)) < 1e-9);
  }
});

test("camera: the front is where it was found", () => {
  for (const [front, expected] of [[0, [0, 0, 1]], [90, [1, 0, 0]], [180, [0, 0, -1]], [-90, [-1, 0, 0]]]) {
    const camera = new Camera(3, 1, front);
    camera.look(0, 0);
    near(camera.axes().toward, expected);
    near(camera.axes().up, [0, 1, 0]);
  }
});

test("portions of the vertices are never 0% of something", () => {
  assert.equal(portion(0, 5000), "0% of the vertices");
  assert.equal(portion(1, 5000), "1 vertex");
  assert.equal(portion(4, 50000), "4 vertices");
  assert.equal(portion(5, 5000), "0.1% of the vertices");
  assert.equal(portion(617, 5000), "12.3% of the vertices");
});

for (const dim of [2, 3]) {
  test(`camera in ${dim}D: the card and the picking agree on where things are`, () => {
    const camera = cameraOf(dim);
    camera.orbit(40, -25);
    for (let i = 0; i < 8; ++i) {
      const place = [...kCube.slice(3 * i, 3 * i + dim), 0].slice(0, 3);
      const spot = camera.project(place);
      const drawn = throughMatrix(camera, [0.25, -0.5, 0.125], place);
      near([spot.x, spot.y], [drawn.x, drawn.y], 1e-2);
      assert.ok(Math.abs(drawn.depth) <= 1);
    }
  });

  test(`camera in ${dim}D: what is framed is seen, and fills the picture`, () => {
    const camera = cameraOf(dim);
    camera.frame(kCube);
    const spots = [...Array(8).keys()].map((i) => camera.project(Array.from(kCube.slice(3 * i, 3 * i + 3))));
    for (const { x, y } of spots) assert.ok(x > 0 && x < 800 && y > 0 && y < 600);
    const shares = spots.map(({ x, y }) => Math.max(Math.abs(x - 400) / 400, Math.abs(y - 300) / 300));
    assert.ok(Math.max(...shares) > 0.8);
  });

  test(`camera in ${dim}D: a step follows the pointer, a zoom keeps what is under it`, () => {
    const camera = cameraOf(dim);
    const place = [0.5, -0.75, dim === 3 ? 0.25 : 0];
    const before = camera.project(place);
    const step = camera.step(place, 30, -12);
    const after = camera.project(place.map((value, k) => value + step[k]));
    near([after.x - before.x, after.y - before.y], [30, -12]);
    const spot = camera.project(camera.target);
    camera.zoom(2, spot.x, spot.y);
    near(Object.values(camera.project(camera.target)), Object.values(spot));
  });

  test(`a drag in ${dim}D moves, turns and scales what is selected, and undo returns the bits`, () => {
    const camera = cameraOf(dim);
    const rest = kCube.map((value, k) => (dim === 2 && k % 3 === 2 ? 0 : value));
    for (const tool of ["move", "rotate", "scale"]) {
      for (const axis of [null, "x", "y"]) {
        const editor = new Editor(rest, dim);
        editor.select([0, 1, 3]);
        const from = camera.project(Array.from(rest.slice(0, 3)));
        const drag = new ToolDrag(editor, camera, tool, axis, 0, from);
        drag.to({ x: from.x + 17, y: from.y + 33 });
        editor.end();
        const moved = editor.points;
        assert.ok(moved.some((value, k) => value !== rest[k]), `${tool} ${axis}`);
        near(moved.slice(6, 9), rest.slice(6, 9), 0);
        if (dim === 2) for (let i = 0; i < 8; ++i) assert.equal(moved[3 * i + 2], 0);
        editor.undo();
        assert.deepEqual(editor.points, rest);
        editor.redo();
        assert.deepEqual(editor.points, moved);
      }
    }
  });
}

test("transforms: identities", () => {
  const result = kCube.slice(), all = [...Array(8).keys()];
  rotate(kCube, all, [0, 0, 0], [0, 0, 1], Math.PI / 2, result);
  near(result.slice(0, 3), [1, -1, -1]);
  rotate(result.slice(), all, [0, 0, 0], [0, 0, 1], -Math.PI / 2, result);
  near(result, kCube);
  scale(kCube, all, [1, 1, 1], 3, null, result);
  near(result.slice(21), [1, 1, 1]);
  near(result.slice(0, 3), [-5, -5, -5]);
  scale(kCube, all, [1, 1, 1], 3, [0, 1, 0], result);
  near(result.slice(0, 3), [-1, -5, -1]);
  translate(kCube, [2], [1, 2, 3], result);
  near(result.slice(6, 9), [0, 3, 2]);
});

// A tube of square sections at the heights given, closed at both ends. The last one is far larger,
// as a body is.
function tube(heights) {
  const count = heights.length, points = [], facets = [];
  heights.forEach((height, h) => {
    const size = h === count - 1 ? 3 : 0.5;
    for (const [x, y] of [[-1, -1], [1, -1], [1, 1], [-1, 1]]) points.push(size * x, size * y, height);
  });
  for (let h = 0; h + 1 < count; ++h) {
    for (let k = 0; k < 4; ++k) {
      const [a, b] = [4 * h + k, 4 * h + (k + 1) % 4];
      facets.push(a, b, b + 4, a, b + 4, a + 4);
    }
  }
  const last = 4 * count - 4;
  facets.push(0, 2, 1, 0, 3, 2, last, last + 1, last + 2, last, last + 2, last + 3);
  return { points: Float64Array.from(points), facets };
}

test("rings: around a limb, beyond it, and growing", () => {
  const { points, facets } = tube([0, 1, 2, 3, 4, 5]);
  const graph = new CageGraph(facets, 3, points.length / 3);
  for (const h of [1, 2, 3]) {
    for (let k = 0; k < 4; ++k) {
      assert.deepEqual(graph.ring(points, 4 * h + k).sort((a, b) => a - b), [0, 1, 2, 3].map((c) => 4 * h + c));
    }
    const ring = new Set(graph.ring(points, 4 * h));
    if (h > 1) assert.deepEqual(graph.shrink(new Set(graph.grow(ring))).sort(), [...ring].sort());
    const limb = graph.beyond(ring).sort((a, b) => a - b);
    // The smaller part: toward the end that has fewer control points.
    assert.deepEqual(limb, h < 3 ? [...Array(4 * h + 4).keys()] : [...Array(24).keys()].slice(12));
  }
  const open = new CageGraph(facets.slice(0, 24), 3, points.length / 3);
  assert.deepEqual(open.ring(points, 0), [0], "at the border of an open cage");
});

test("rings in the plane: the control point across the shape", () => {
  // A bar of width 1, with points at all units.
  const bottom = [0, 1, 2, 3, 4, 5].map((x) => [x, 0, 0]), top = [5, 4, 3, 2, 1, 0].map((x) => [x, 1, 0]);
  const points = Float64Array.from([...bottom, ...top].flat());
  const graph = new CageGraph([...Array(12).keys()].flatMap((k) => [k, (k + 1) % 12]), 2, 12);
  for (const x of [1, 2, 3, 4]) assert.deepEqual(graph.ring(points, x), [x, 11 - x]);
});

test("soft selection follows the cage, and fades to its radius", () => {
  const { points, facets } = tube([0, 1, 2, 3, 4, 5]);
  const editor = new Editor(points, 3, facets);
  editor.select([0, 1, 2, 3]);
  assert.deepEqual([...editor.shares().keys()], [0, 1, 2, 3]);
  editor.softness = 2.5;
  const shares = editor.shares();
  near([0, 4, 8].map((i) => shares.get(i)), [1, (1 - 0.16) ** 2, (1 - 0.64) ** 2]);
  assert.ok(!shares.has(12));
  const drag = new ToolDrag(editor, cameraOf(3), "rotate", "z", 0, { x: 0, y: 0 });
  drag.by(90);
  near(editor.points.slice(0, 3), [0.5, -0.5, 0]);
  const angle = Math.PI / 2 * shares.get(4) + Math.atan2(-0.5, -0.5);
  near(editor.points.slice(12, 15), [Math.hypot(0.5, 0.5) * Math.cos(angle), Math.hypot(0.5, 0.5) * Math.sin(angle), 1]);
  drag.by(0);
  near(editor.points, points);
});

test("a limb rotates around the ring where it begins", () => {
  const { points, facets } = tube([0, 1, 2, 3, 4, 5]);
  const editor = new Editor(points, 3, facets);
  editor.selectRings([8]);
  editor.selectLimb();
  near(editor.pivot, [0, 0, 2]);
  new ToolDrag(editor, cameraOf(3), "rotate", "x", 0, { x: 0, y: 0 }).by(90);
  near(editor.points.slice(0, 3), [-0.5, 2, -0.5 + 2]);
  // The pivot moves with its ring, and back with undo.
  editor.end();
  new ToolDrag(editor, cameraOf(3), "move", "z", 0, { x: 0, y: 0 }).by(2);
  editor.end();
  near(editor.pivot, [0, 0, 4]);
  editor.undo();
  near(editor.pivot, [0, 0, 2]);
  editor.select([1]);
  assert.equal(editor.pivot, null);
});

test("poses are read from files", () => {
  near(readPose("# pose\nv 1 2 3\n v 4 5 6 7\r\nvt 0 0\nf 1 2 1\n", 3, 2), [1, 2, 3, 4, 5, 6], 0);
  near(readPose("v 1 2 0\n", 2, 1), [1, 2], 0);
  assert.throws(() => readPose("v 1 2 3\n", 3, 8), /has 1 vertices, but the cage has 8/);
  assert.throws(() => readPose("v 1 two 3\n", 3, 1), /no number/);
});

test("mirror: images move as mirrors do, points of the plane stay in it", () => {
  const rest = Float64Array.of(1, 0, 0, -1, 0, 0, 0, 1, 0, 5, 5, 5);
  const editor = new Editor(rest, 3);
  assert.equal(editor.setMirror(0), 3);
  editor.change([0], (start, listed, result) => translate(start, listed, [0.5, 0.25, -1], result));
  editor.end();
  near(editor.points, [1.5, 0.25, -1, -1.5, 0.25, -1, 0, 1, 0, 5, 5, 5], 0);
  editor.change([2], (start, listed, result) => translate(start, listed, [3, 1, 0], result));
  near(editor.points.slice(6, 9), [0, 2, 0], 0);
  editor.cancel();
  editor.change([0, 1], (start, listed, result) => translate(start, listed, [1, 0, 0], result));
  near(editor.points.slice(0, 6), [2.5, 0.25, -1, -0.5, 0.25, -1], 0);
});

test("editor: resetting is a stroke, strokes without a change are none", () => {
  const editor = new Editor(kCube, 3);
  editor.begin();
  editor.end();
  assert.equal(editor.canUndo, false);
  editor.place(3, [7, 8, 9]);
  editor.place(4, [4, 4, 4]);
  editor.reset([3]);
  near(editor.points.slice(9, 12), kCube.slice(9, 12), 0);
  near(editor.points.slice(12, 15), [4, 4, 4], 0);
  editor.undo();
  near(editor.points.slice(9, 12), [7, 8, 9], 0);
  editor.undo();
  editor.undo();
  assert.deepEqual(editor.points, kCube);
  assert.equal(editor.canUndo, false);
});

test("editor: points, keys, and the library are undone together, through 200 random strokes", () => {
  const content = { poses: [], library: [] }, editor = new Editor(kCube, 3, [], content);
  let seed = 1;
  const random = () => { seed = (48271 * seed) % 2147483647; return seed / 2147483647; };
  const states = [];
  const state = () => ({ points: editor.points, poses: content.poses, library: content.library });
  for (let k = 0; k < 200; ++k) {
    states.push(state());
    const keys = content.poses, kind = random();
    if (kind < 0.4) editor.place(Math.floor(8 * random()), [random(), random(), random()]);
    else if (kind < 0.5) editor.setLibrary([...content.library, kind]);
    else if (kind < 0.7) editor.setPoses([...keys, { name: "", time: random(), points: editor.points }]);
    else editor.setPoses(keys.slice(0, Math.floor((keys.length + 1) * random())));
    if (kind > 0.95) editor.cancel();
    editor.end();
    if (editor.done.length < states.length) assert.deepEqual(state(), states.pop(), "cancelled");
  }
  assert.ok(content.poses.length !== 1 && states.length > 100);
  for (const before of states.reverse()) {
    editor.undo();
    assert.deepEqual(state(), before);
  }
  assert.equal(editor.canUndo, false);
});

test("picking: the nearest within reach, and what an outline holds", () => {
  const camera = cameraOf(3);
  camera.look(0, 0);
  const spot = camera.project([1, 1, 1]);
  assert.equal(pick(kCube, camera, spot.x + 3, spot.y - 2, 12), 7);
  assert.equal(pick(kCube, camera, 400, 300, 12), -1);
  const right = pointsInside(kCube, camera, rectangle({ x: 800, y: 0 }, { x: 400, y: 600 }));
  assert.deepEqual(right, [1, 3, 5, 7]);
  const diamond = [[-9, 0], [0, -9], [9, 0], [0, 9]].map(([x, y]) => ({ x: spot.x + x, y: spot.y + y }));
  assert.deepEqual(pointsInside(kCube, camera, diamond), [7]);
  const arrow = [diamond[0], { x: spot.x + 3, y: spot.y }, diamond[2], diamond[3]];
  assert.deepEqual(pointsInside(kCube, camera, arrow.map(({ x, y }) => ({ x, y: y + 1 }))), [], "the notch of a lasso");
});

// Two triangles for each side of the cube.
const kSides = [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]
  .flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);

test("picking: the front of a surface, as shares of the corners of its triangle", () => {
  const camera = cameraOf(3), center = [3, -2, 1];
  const at = (x, y) => surfaceAt(kCube, { triangles: kSides, sources: null }, camera, center, { x, y });
  for (const [yaw, pitch] of [[0, 0], [0.6, 0.3], [2.5, -1]]) {
    camera.look(yaw, pitch);
    camera.target = center;
    let hits = 0;
    for (let x = 5; x < 800; x += 30) {
      for (let y = 5; y < 600; y += 30) {
        const found = at(x, y);
        if (!found) continue;
        hits += 1;
        const spot = camera.project(found.place), inside = found.place.map((value, k) => value - center[k]);
        near([spot.x, spot.y], [x, y], 1e-3);
        near([Math.max(...inside.map(Math.abs))], [1], 1e-6);
        // No other side of the cube is nearer.
        const { toward } = camera.axes();
        const eye = inside.map((value, k) => value + 1e-3 * (toward[k] / camera.shrinking() - value));
        assert.ok(Math.max(...eye.map(Math.abs)) > 1, `behind at ${x}, ${y}`);
        const mean = found.shares.reduce((sum, [p, share]) => sum.map((value, k) => value + share * kCube[3 * p + k]), [0, 0, 0]);
        near(mean, inside, 1e-6);
      }
    }
    assert.ok(hits > 50, String(hits));
    assert.equal(at(1, 1), null);
  }
  const doubled = surfaceAt(kCube, { triangles: kSides.map((_, k) => k), sources: kSides }, camera, center, { x: 400, y: 300 });
  assert.deepEqual(doubled, at(400, 300), "corners of a seam");
});

test("a place of the model is moved by the smallest moves of control points", () => {
  let seed = 5;
  const random = () => { seed = (48271 * seed) % 2147483647; return seed / 2147483647 - 0.5; };
  for (let trial = 0; trial < 60; ++trial) {
    const dim = 2 + trial % 2, axis = [-1, 0, dim - 1][trial % 3];
    // Three pairs of images, a control point in the plane of the mirror, and one without an image.
    const rest = Float64Array.from({ length: 24 }, () => random());
    for (const i of [0, 1, 2]) {
      for (let k = 0; k < 3; ++k) rest[9 + 3 * i + k] = k === axis ? -rest[3 * i + k] : rest[3 * i + k];
    }
    rest[18 + Math.max(axis, 0)] = 0;
    if (dim === 2) for (let i = 0; i < 8; ++i) rest[3 * i + 2] = 0;
    const editor = new Editor(rest, dim);
    editor.setMirror(axis);
    if (axis >= 0) editor.pairs = [3, 4, 5, 0, 1, 2, 6, -1];
    const weights = new Map([0, 1, 4, 6, 7].map((i) => [i, Math.abs(random())]));
    const camera = cameraOf(dim), place = [0.1, 0.2, dim === 2 ? 0 : 0.3], spot = camera.project(place);
    const step = camera.step(place, 37, -21);
    new ModelDrag(editor, camera, null, place, weights, spot).to({ x: spot.x + 37, y: spot.y - 21 });
    const moves = editor.points.map((value, k) => value - rest[k]);
    const through = (others) => [0, 1, 2].map((k) => [...weights].reduce((sum, [i, weight]) => sum + weight * others[3 * i + k], 0));
    near(through(moves), step, 1e-9);
    for (const i of axis < 0 ? [2, 3, 5] : [2, 5]) near(moves.slice(3 * i, 3 * i + 3), [0, 0, 0], 0);
    const reflect = (others) => (axis < 0 ? others : others.map((value, m) => {
      const [i, k] = [Math.floor(m / 3), m % 3], image = editor.pairs[i];
      return image < 0 ? value : (k === axis ? -1 : 1) * others[3 * image + k];
    }));
    near(reflect(moves), moves, 1e-12);
    // Any others with the same image in the mirror that do not move the place are orthogonal: none are smaller.
    const other = moves.map((_, k) => (dim === 2 && k % 3 === 2 ? 0 : random()));
    const symmetric = reflect(other).map((value, k) => (value + other[k]) / 2);
    const reached = through(symmetric), factors = leastMoves(weights, editor.pairs, axis);
    const rested = symmetric.map((value, m) => value - (factors.get(Math.floor(m / 3))?.[m % 3] ?? 0) * reached[m % 3]);
    near(through(rested), [0, 0, 0], 1e-12);
    near([rested.reduce((sum, value, m) => sum + value * moves[m], 0)], [0], 1e-12);
    editor.end();
    editor.undo();
    assert.deepEqual(editor.points, rest);
  }
  // In the plane of the mirror a place does not leave it, and nothing moves that has no weight.
  const stays = leastMoves(new Map([[0, 0.5], [1, 0.5]]), [1, 0], 0);
  near([...stays.get(0), ...stays.get(1)], [0, 1, 1, 0, 1, 1], 0);
  assert.equal(leastMoves(new Map()).size, 0);
});

test("deformer: a point goes where its weights take it, and home again bit by bit", () => {
  const rest = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0);
  const weights = { starts: Uint32Array.of(0, 3, 4), controlPoints: Uint8Array.of(0, 1, 2, 2),
                    values: Float32Array.of(0.25, 0.5, 0.25, 1) };
  const base = Float32Array.of(0.5, 0.25, 0, 0, 1, 0);
  const deformer = new Deformer(weights, base, rest);
  const moved = rest.slice();
  moved[3] += 2;
  moved[8] += 1;
  deformer.move(moved);
  near(deformer.points, [1.5, 0.25, 0.25, 0, 1, 1], 1e-7);
  near(deformer.weightsOf(new Set([0, 1])), [0.75, 0], 0);
  near(deformer.influenceCounts(), [3, 1], 0);
  deformer.move(rest);
  assert.deepEqual(deformer.points, base);
});

test("deformer: eight weights per point for the card", () => {
  const weights = { starts: Uint32Array.of(0, 2, 3), controlPoints: Uint8Array.of(0, 2, 1),
                    values: Float32Array.of(0.25, 0.75, 1) };
  const deformer = new Deformer(weights, new Float32Array(6), new Float64Array(9));
  const { indices, weights: values } = deformer.weightsForCard();
  assert.deepEqual(indices, Uint16Array.of(0, 2, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0));
  near(values, [0.25, 0.75, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0], 0);
  const many = { starts: Uint32Array.of(0, 9), controlPoints: new Uint8Array(9),
                 values: new Float32Array(9) };
  assert.equal(new Deformer(many, new Float32Array(3), new Float64Array(3)).weightsForCard(), null);
});

test("shaders: the page moves models as the shader for engines does", () => {
  const engine = readFileSync(new URL("../../engines/deform.glsl", import.meta.url), "utf8");
  assert.ok(engine.includes(kWeightedSum));
});

test("surface: normals of a cube's corner, edges once each, seams share normals", () => {
  const corner = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);
  const triangles = Uint8Array.of(0, 1, 2, 0, 2, 3, 0, 3, 1);
  const normals = new Float32Array(12);
  sumNormals(corner, triangles, null, normals);
  near(normals.slice(0, 3), [1, 1, 1], 0);
  assert.equal(edgesOf(triangles, 4).length, 2 * 6);
  const split = Float32Array.of(...corner, 0, 0, 0);
  const parted = Uint8Array.of(0, 1, 2, 4, 2, 3, 0, 3, 1);
  const both = new Float32Array(15);
  sumNormals(split, parted, Uint8Array.of(0, 1, 2, 3, 0), both);
  near(both.slice(0, 3), [1, 1, 1], 0);
  near(both.slice(12), [1, 1, 1], 0);
});

test("poses: on straight lines, to and fro, or in a loop", () => {
  const poses = [0, 1, 3].map((time) => ({ time, points: Float64Array.of(time * time, 0, 0), isStraight: true }));
  near(interpolatePoses(poses, 2), [5, 0, 0], 0);
  near(interpolatePoses(poses, 99), [9, 0, 0], 0);
  near([playedTime(poses, 2), playedTime(poses, 4), playedTime(poses, 6.5)], [2, 2, 0.5]);
  poses[2].closes = true;
  near([playedTime(poses, 2), playedTime(poses, 4), playedTime(poses, 6.5)], [2, 1, 0.5]);
  assert.equal(straightKeys(poses), poses);
});

test("poses: smooth curves pass their keys without jumps of velocity, rest where keys rest, and do not overshoot", () => {
  // A point on a curve, one that stays between two keys, one on a line, and one that turns back.
  const places = [[[0, 0, 0], [1, 2, 0], [3, 1, 1], [2, -1, 4]], [[0, 0, 0], [1, 1, 1], [1, 1, 1], [0, 2, 0]],
                  [[0, 0, 0], [1, 2, 3], [1.1, 2.2, 3.3], [5, 10, 15]], [[0, 0, 0], [1, 0, 0], [0, 0, 0], [1, 0, 0]]];
  const times = [0, 1, 1.5, 3];
  const keys = times.map((time, k) => ({ time, points: Float64Array.from(places.flatMap((list) => list[k])) }));
  const at = (time, poses = keys) => interpolatePoses(poses, time);
  const speed = (time, step, poses) => at(time + step, poses).map((value, c) => (value - at(time, poses)[c]) / step);
  keys.forEach(({ time, points }) => near(at(time), points, 0));
  for (const time of [1, 1.5]) near(speed(time, 1e-6), speed(time, -1e-6), 1e-3);
  near(speed(1, 1e-6).slice(9), [0, 0, 0], 1e-3);
  near([...speed(0, 1e-6), ...speed(3, -1e-6)], new Array(24).fill(0), 1e-3);
  for (let k = 1; k < 300; ++k) {
    const [now, before] = [at(k / 100), at((k - 1) / 100)];
    if (k > 100 && k < 150) near(now.slice(3, 6), [1, 1, 1]);
    assert.ok(now[6] >= before[6] && Math.abs(now[7] - 2 * now[6]) < 1e-9, "off the line, or back");
    assert.ok(now[9] >= 0 && now[9] <= 1, "overshoots");
  }
  // A loop has no jump where it closes.
  const loop = [...keys, { ...keys[0], time: 4, closes: true }];
  near(speed(0, 1e-6, loop), speed(4, -1e-6, loop), 1e-3);
  assert.ok(Math.hypot(...speed(0, 1e-6, loop).slice(0, 3)) > 0.1);
  // More keys on straight lines are nearly the same.
  const more = straightKeys(keys).map((key) => ({ ...key, isStraight: true }));
  assert.equal(more.length, 37);
  keys.forEach((key) => assert.ok(more.some(({ time, points }) => time === key.time && points === key.points)));
  for (let k = 0; k < 300; ++k) near(at(k / 100), at(k / 100, more), 0.05);
});

test("axes of a selection are those along which it extends, with the nearest names", () => {
  const box = kCube.map((place, k) => [3, 2, 1][k % 3] * place), all = [...Array(8).keys()];
  for (const [degrees, x] of [[20, 20], [-40, -40], [60, -30], [170, -10]]) {
    const angle = degrees * Math.PI / 180, turned = box.slice();
    rotate(box, all, [0, 0, 0], [0, 0, 1], angle, turned);
    const axes = principalAxes(turned, all), expected = x * Math.PI / 180;
    near(axes.x, [Math.cos(expected), Math.sin(expected), 0]);
    near(axes.y, [-Math.sin(expected), Math.cos(expected), 0]);
    near(axes.z, [0, 0, 1]);
  }
  near(Object.values(principalAxes(kCube, all)).flat(), [1, 0, 0, 0, 1, 0, 0, 0, 1]);
});

test("poses are saved in the cage's own words", () => {
  const text = "# a cage\r\nv 0.10 1e0 5 # corner\n  v\t2 3.50 5\nv 4 4 5\nl 1 2 3 1\n";
  const given = [0.1, 1, 2, 3.5, 4, 4];
  assert.equal(poseText(text, given, given, 2, []), text);
  assert.equal(poseText(text, given, [0.1, 1, 2.25, 3.5, 4, 4], 2, []),
               text.replace("2 3.50", "2.25 3.50"));
  const facets = Uint8Array.of(0, 1, 1, 2, 2, 0);
  const other = poseText("", given, given, 2, facets);
  assert.equal(other, "v 0.1 1 0\nv 2 3.5 0\nv 4 4 0\nl 1 2\nl 2 3\nl 3 1\n");
  assert.equal(poseText("v 7 7 7\n", given, given, 2, facets), other);
});

test("indices are read in the width they are written", () => {
  const pack = (numbers) => Buffer.from(numbers.buffer).toString("base64");
  for (const numbers of [Uint8Array.of(1, 255), Uint16Array.of(1, 65535), Uint32Array.of(1, 70000)]) {
    const packed = { bytes: numbers.BYTES_PER_ELEMENT, data: pack(numbers) };
    assert.deepEqual(decodeIndices(packed), numbers);
  }
});

test("of a resting cage the last shape is solved, one at a time, and refused shapes go back", async () => {
  const editor = new Editor(Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), 2);
  const poses = [0, 0.25].map((step) => ({ points: editor.rest.map((place) => place + step) }));
  const viewer = { editor, content: { dim: 2, rest: editor.rest, poses },
                   deformer: { rest: editor.rest }, changed: () => {} };
  const asked = [];
  let atOnce = 0;
  const reshaper = new Reshaper(viewer, async (request) => {
    assert.equal(++atOnce, 1);
    await new Promise((done) => setTimeout(done, 5));
    --atOnce;
    asked.push(request.refine ? "refine" : request.points[0]);
    if (request.points?.[0] > 5) return { refused: "too far" };
    const rest = Float64Array.from(request.points ?? reshaper.sent.filter((_, k) => k % 3 < 2));
    return { converged: asked.at(-1) === "refine", residual: 1,
             rest, weights: {} };
  });
  editor.onChange = () => reshaper.edited();
  const settled = async () => {
    do await new Promise((done) => setTimeout(done, 20)); while (reshaper.isBusy);
  };

  editor.place(0, [0.5, 0, 0]);
  assert.deepEqual(asked, [], "posing asks for nothing");
  editor.undo();
  reshaper.toggle();
  await reshaper.refine();
  assert.deepEqual(asked.splice(0), ["refine"]);
  for (const x of [1, 2, 3]) editor.change([0], (start, listed, result) => { result[0] = x; });
  editor.end();
  await settled();
  assert.deepEqual(asked, [1, 3, "refine"], "shapes in between are left out");
  assert.equal(viewer.deformer.rest[0], 3);
  near(poses.map(({ points }) => points[0]), [3, 3.25], 0);
  near(poses[1].points.slice(1), editor.rest.slice(1).map((place) => place + 0.25), 0);
  editor.place(0, [7, 0, 0]);
  await settled();
  assert.equal(editor.points[0], 3);
  reshaper.toggle();
  near(editor.points, [3, 0, 0, 1, 0, 0, 0, 1, 0]);
});

test("a region is painted on the front of the model, and weights obey the latest stroke", async () => {
  // Two squares of 21 x 21 points each, one behind the other, seen from the front.
  const count = 21;
  const base = [0.5, -0.5].flatMap((z) => Array.from({ length: count * count }, (_, p) =>
    [2 * (p % count) / (count - 1) - 1, 2 * Math.floor(p / count) / (count - 1) - 1, z]).flat());
  const triangles = [0, count * count].flatMap((first) => Array.from({ length: (count - 1) ** 2 }, (_, s) => {
    const a = first + s % (count - 1) + count * Math.floor(s / (count - 1));
    return [a, a + 1, a + count, a + 1, a + count + 1, a + count];
  }).flat());
  const camera = cameraOf(3);
  camera.look(0, 0);
  const asked = [];
  const content = { center: [0, 0, 0], surface: { triangles, sources: null } };
  const viewer = { camera, content, editor: new Editor(kCube, 3), changed: () => {}, reshaper: { take: () => true },
                   deformer: { points: Float32Array.from(base), base } };
  let conflict;
  const protector = new Protector(viewer, {
    protect: async (masks) => {
      asked.push(masks);
      const given = masks.masks ?? masks, reach = Array(8).fill(1);
      for (const { control_points: [i], factor } of masks.reach ?? []) reach[i] = factor;
      return { onFacets: 0, conflict, reach: masks.reach ? reach : [], falloff: masks.falloff ?? 0, masks: given.map((mask) => ({ controlPoints: mask.control_points.slice(0, 1), vertices: mask.region.vertices })) };
    },
    refine: async () => ({ converged: asked.at(-1) === "refine" || asked.push("refine") > 0 }),
  });
  const settled = async () => { do await new Promise((done) => setTimeout(done, 5)); while (protector.isBusy); };
  const place = (k) => base.slice(3 * k, 3 * k + 3);
  const stroke = (erases, ...places) => {
    const [first, ...others] = places.map((x) => camera.project(x));
    if (!protector.begin(first, erases)) return false;
    for (const spot of others) protector.to(spot);
    protector.end();
    return true;
  };
  protector.toggle();
  await settled();
  assert.deepEqual(asked.splice(0), [[], "refine"], "the solver gets ready");
  let told = "";
  protector.tell = (text) => { told = text; };
  assert.equal(stroke(false, [0, 0, 0.5]), true);
  assert.match(told, /First select the control points/);
  assert.equal(protector.masked.size, 0);
  viewer.editor.select([5, 3]);
  assert.equal(stroke(false, [3, 3, 0.5]), false, "not on the model");

  const radius = Math.hypot(...camera.step([0, 0, 0.5], protector.radius, 0));
  stroke(false, [-0.5, 0, 0.5], [0.5, 0, 0.5]);
  stroke(false, [0.5, 0, 0.5], [0, 0, 0.5]);  // while the first is solved
  await settled();
  const far = (k) => Math.hypot(Math.max(0, Math.abs(place(k)[0]) - 0.5), place(k)[1], place(k)[2] - 0.5);
  for (let k = 0; k < base.length / 3; ++k) {
    const isPainted = protector.masked.has(k);
    if (far(k) > radius * 1.001) assert.ok(!isPainted, `${place(k)} is painted`);
    if (far(k) < radius * 0.9) assert.ok(isPainted, `${place(k)} is not painted`);
  }
  assert.ok(protector.masked.size > 20);
  assert.deepEqual(asked.at(-2), protector.masks());
  assert.deepEqual(protector.masks().map((mask) => mask.control_points), [[3, 5]]);
  const { vertices } = protector.masks()[0].region;
  assert.deepEqual(protector.renumbered([0, 1, 2, 9, 4, 9, 6, 7]), { masks: [{ control_points: [9], region: { vertices } }], reach: [], falloff: 0, solid: [] });
  assert.deepEqual(protector.renumbered([]), { masks: [], reach: [], falloff: 0, solid: [] });

  // Regions of other control points overlap; erasing takes away those of the selection only.
  const before = protector.masked.size;
  viewer.editor.select([7, 3]);
  stroke(false, [0, 0, 0.5]);
  await settled();
  assert.deepEqual(protector.masks().map((mask) => mask.control_points.join()).sort(), ["3,5", "3,5,7"]);
  viewer.editor.select([3]);
  stroke(true, [-0.5, 0, 0.5], [0.5, 0, 0.5]);
  await settled();
  assert.deepEqual(protector.masks().map((mask) => mask.control_points.join()).sort(), ["5", "5,7"]);
  assert.equal(protector.masked.size, before);
  for (let k = 0; k < 4; ++k) protector.undo();
  await settled();
  assert.equal(protector.masked.size, 0);
  assert.deepEqual(asked.at(-2), []);
  for (let k = 0; k < 4; ++k) protector.redo();
  await settled();
  assert.equal(protector.canRedo, false);
  assert.equal(protector.masked.size, before);

  // A stroke that a second finger ends never was.
  const kept = protector.masked;
  protector.begin(camera.project([0, 0.9, 0.5]), false);
  protector.cancel();
  await settled();
  assert.equal(protector.masked, kept);

  conflict = { vertices: [4], controlPoints: [5] };
  protector.undo();
  await settled();
  assert.match(protector.describe(), /1 vertex \(red\) cannot stay.*\(5\)/);
  assert.notDeepEqual(protector.accepted, protector.masks());
  conflict = undefined;
  await protector.load({ masks: protector.masks(), conflicts: "relax" });
  await settled();
  assert.deepEqual(protector.accepted, protector.masks());
  assert.equal(protector.masks().every((mask) => mask.control_points.length === 1), true);

  // The reach of the selection is solved for, undone, saved, and loaded with the masks.
  viewer.editor.select([2, 6]);
  protector.setReach(0.5);
  await settled();
  viewer.editor.select([6]);
  protector.setReach(4);
  await settled();
  const reach = [{ control_points: [2], factor: 0.5 }, { control_points: [6], factor: 4 }];
  assert.deepEqual(asked.at(-2), { masks: protector.masks(), reach });
  assert.deepEqual(protector.accepted, protector.locality());
  protector.setReach(1);
  await settled();
  assert.deepEqual(asked.at(-2).reach, reach.slice(0, 1));
  protector.undo();
  assert.deepEqual(protector.factors(), reach);
  await settled();
  protector.setFalloff(0.1);
  await settled();
  assert.deepEqual(asked.at(-2), { masks: protector.masks(), reach, falloff: 0.1 });
  const saved = protector.locality();
  protector.undo();
  assert.deepEqual(protector.locality(), { masks: protector.masks(), reach });
  for (const _ of reach) protector.undo();
  await settled();
  assert.deepEqual(asked.at(-2), protector.masks(), "no reach is left");
  await protector.load(saved);
  await settled();
  assert.deepEqual(protector.locality(), saved);

  // A solid region grows from stroke to stroke; one that meets none is another region.
  protector.paints = "solid";
  viewer.editor.select([]);
  stroke(false, [-0.8, 0, 0.5]);
  stroke(false, [-0.75, 0, 0.5]);
  stroke(false, [0.8, 0, 0.5]);
  await settled();
  const regions = protector.regions();
  assert.equal(regions.length, 2);
  for (const { region: { vertices: own } } of regions) assert.equal(new Set(own.map((k) => place(k)[0] > 0)).size, 1);
  assert.deepEqual(asked.at(-2).solid, regions);
  stroke(true, [0.8, 0, 0.5]);
  await settled();
  assert.deepEqual(protector.regions(), regions.slice(0, 1));
  protector.undo();
  await settled();
  assert.deepEqual(protector.regions(), regions);

  // The density of the next cage: 4 times per stroke, and no other weights are solved for.
  protector.paints = "density";
  const solves = asked.length;
  stroke(false, [0.5, 0, 0.5]);
  stroke(true, [-0.5, 0, 0.5]);
  const densities = protector.densities();
  assert.deepEqual([...new Set(densities)].sort(), [0.25, 1, 4]);
  densities.forEach((density, k) => assert.ok(density === 1 || (density > 1) === place(k)[0] > 0));
  stroke(true, [0.5, 0, 0.5]);
  assert.deepEqual(protector.densities(), densities.map((density) => Math.min(density, 1)));
  protector.undo();
  assert.deepEqual(protector.densities(), densities);
  await settled();
  assert.equal(asked.length, solves);
});

test("an edge of a cage is split, and control points are merged", () => {
  const cube = { dim: 3, points: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], facets: [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2] };
  const volume = ({ points, facets }) => {
    const at = (i) => points.slice(3 * i, 3 * i + 3);
    let sum = 0;
    for (let f = 0; f < facets.length; f += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => at(facets[f + k]));
      sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return sum / 6;
  };
  const split = splitEdge(cube, [0, 1]);
  assert.equal(split.points.length, 15);
  assert.equal(split.facets.length, 18);
  assert.ok(Math.abs(volume(split) - 1 / 6) < 1e-15);
  assert.equal(splitEdge(split, [0, 1]), null, "that edge is gone");
  const merged = mergePoints(split, [0, 4]);
  assert.deepEqual(split.numbers, [0, 1, 2, 3]);
  for (const [i, place] of split.numbers.entries()) near(split.points.slice(3 * place, 3 * place + 3), cube.points.slice(3 * i, 3 * i + 3), 0);
  assert.equal(merged.numbers[0], merged.numbers[4]);
  assert.equal(merged.points.length, 12);
  assert.equal(merged.facets.length, 12);
  near(merged.points.slice(0, 3), [0.25, 0, 0]);
  assert.ok(Math.abs(volume(merged) - 0.75 / 6) < 1e-15);
  const square = { dim: 2, points: [0, 0, 1, 0, 1, 1, 0, 1], facets: [0, 1, 1, 2, 2, 3, 3, 0] };
  assert.deepEqual(splitEdge(square, [2, 1]).facets, [0, 1, 4, 2, 1, 4, 2, 3, 3, 0]);
  assert.equal(cageToObj(mergePoints(square, [0, 1])), "v 0.5 0 0\nv 1 1 0\nv 0 1 0\nl 1 2\nl 2 3\nl 3 1\n");
});

test("the copied command names files where they are", () => {
  const viewer = { content: { title: "arm (2)", files: { model: "../in put/arm #2.ply", weights: "w.mtx", cage: "cage.obj" } } };
  assert.equal(commandOf(viewer, "file:///home/me/out%20dir/model.html"),
               "flbc deform '/home/me/in put/arm #2.ply' --weights '/home/me/out dir/w.mtx' "
               + "--pose 'arm (2)_pose.obj' --rest '/home/me/out dir/cage.obj' "
               + "-o 'arm (2)_posed.ply'");
  assert.equal(commandOf(viewer, "http://127.0.0.1:8000/0/"),
               "flbc deform '../in put/arm #2.ply' --weights w.mtx "
               + "--pose 'arm (2)_pose.obj' --rest cage.obj -o 'arm (2)_posed.ply'");
});

test("edges of a cage become curves: what is solved lies on them, and straight ones come back", () => {
  // A square with a square hole.
  const straight = { points: [0, 0, 6, 0, 6, 6, 0, 6, 2, 2, 2, 4, 4, 4, 4, 2], facets: [0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4] };
  const curved = curvedCage(straight), count = curved.points.length / 2;
  assert.equal(count, 24);
  assert.deepEqual(straightCage(curved), straight);
  near(curved.points.slice(16, 20), [2, 0, 4, 0]);
  const curves = curvesOf(curved.facets, count);
  assert.deepEqual(curves[0], [0, 8, 9, 1]);
  // However files order them.
  const turned = curved.facets.map((_, k) => curved.facets[curved.facets.length - 1 - k]);
  assert.deepEqual(curvesOf(turned, count), curves);

  let seed = 3;
  const random = () => { seed = (48271 * seed) % 2147483647; return seed / 2147483647; };
  const posed = curved.points.map((value) => value + random());
  const { cage, map: { starts, controlPoints, values } } = piecesOf(curved);
  assert.equal(cage.facets.length, 2 * 8 * 8);
  const entries = starts.slice(1).map((end, row) => controlPoints.slice(starts[row], end).map((i, k) => [i, values[starts[row] + k]]));
  for (const row of entries) {
    assert.ok(row.every(([i, share], k) => share > 0 && (k === 0 || i > row[k - 1][0])));
    near([row.reduce((sum, [, share]) => sum + share, 0)], [1], 1e-15);
  }
  const at = (points) => entries.flatMap((row) => [0, 1].map((k) => row.reduce((sum, [i, share]) => sum + share * points[2 * i + k], 0)));
  near(at(curved.points), cage.points, 1e-12);
  // Along each curve by de Casteljau's construction, which starts and ends at corners.
  const places = at(posed);
  const between = (t, points) => (points.length === 1 ? points[0]
    : between(t, points.slice(1).map((point, k) => point.map((value, c) => (1 - t) * points[k][c] + t * value))));
  const next = new Map(Array.from({ length: cage.facets.length / 2 }, (_, f) => cage.facets.slice(2 * f, 2 * f + 2)));
  for (const curve of curves) {
    const corners = curve.map((i) => posed.slice(2 * i, 2 * i + 2));
    let i = curve[0];
    for (let k = 0; k <= 8; ++k, i = next.get(i)) near(places.slice(2 * i, 2 * i + 2), between(k / 8, corners), 1e-12);
  }

  // Corners take their handles along, which are reset with them; a handle goes alone.
  const rest = inSpace(Float64Array.from(curved.points), 2);
  const editor = new Editor(rest, 2, curved.facets, { poses: [], curves });
  editor.select([1]);
  assert.deepEqual([...editor.shares().keys()].sort((a, b) => a - b), [1, 9, 10]);
  editor.select([9]);
  assert.deepEqual([...editor.shares().keys()], [9]);
  assert.deepEqual(editor.withHandles([1, 12]), [1, 9, 10, 12]);
});

test("handles of curves that are in line stay in line", () => {
  // A corner in the middle of a straight side, at (3, 0).
  const curved = curvedCage({ points: [0, 0, 3, 0, 6, 0, 6, 6, 0, 6], facets: [0, 1, 1, 2, 2, 3, 3, 4, 4, 0] });
  const curves = curvesOf(curved.facets, curved.points.length / 2);
  const editor = new Editor(inSpace(Float64Array.from(curved.points), 2), 2, curved.facets, { poses: [], curves });
  const [before, after] = [curves[0][2], curves[1][1]];
  const drag = (i, step, keepsLine) => {
    editor.select([i]);
    editor.change([i], (start, indices, result) => translate(start, indices, step, result), keepsLine);
    editor.end();
  };
  const changed = () => [...Array(editor.size).keys()].filter((i) => [0, 1].some((c) => editor.points[3 * i + c] !== editor.rest[3 * i + c]));
  near(pointAt(editor.points, before), [2, 0, 0]);
  near(pointAt(editor.points, after), [4, 0, 0]);
  drag(before, [0, -1, 0]);
  near(pointAt(editor.points, before), [2, -1, 0]);
  near(pointAt(editor.points, after), [3 + Math.SQRT1_2, Math.SQRT1_2, 0], 1e-12);  // as long as before
  assert.deepEqual(changed(), [before, after]);
  editor.undo();
  assert.deepEqual(changed(), []);
  drag(before, [0, -1, 0], false);
  drag(after, [0, 1, 0]);  // they are in line no more
  near(pointAt(editor.points, before), [2, -1, 0]);
  editor.undo();
  editor.undo();
  // A place of the model that one handle moves follows the pointer, and a tool goes on as before.
  const camera = cameraOf(2), by = (tool) => { tool.by(1); editor.end(); };
  by(new ModelDrag(editor, camera, "y", pointAt(editor.points, before), new Map([[before, 1]]), { x: 0, y: 0 }));
  assert.deepEqual(changed(), [before]);
  editor.undo();
  editor.select([before]);
  by(new ToolDrag(editor, camera, "move", "y", before, { x: 0, y: 0 }));
  assert.deepEqual(changed(), [before, after]);
  editor.undo();
  // Handles at a corner, and those that move with their corner or with each other, are not turned.
  drag(curves[0][1], [0, 1, 0]);
  assert.deepEqual(changed(), [curves[0][1]]);
  editor.undo();
  for (const all of [[1, before, after], [before, after]]) {
    editor.change(all, (start, indices, result) => translate(start, indices, [0, 1, 0], result));
    editor.end();
    assert.deepEqual(changed(), all);
    editor.undo();
  }
  // The mirror image of a handle turns its own opposite one.
  editor.setMirror(0);
  drag(curves[0][1], [0, 1, 0]);
  assert.equal(changed().length, 2);
  drag(before, [0, -0.5, 0]);
  near(pointAt(editor.points, after), [4, -0.5, 0], 1e-12);
});
