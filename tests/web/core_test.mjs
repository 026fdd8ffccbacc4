// SPDX-License-Identifier: BSD-3-Clause
// The module without meshers: node core_test.mjs MODULE
import assert from "node:assert/strict";
import { pathToFileURL } from "node:url";

const { Flbc } = await import(pathToFileURL(process.argv[2]));
const flbc = await Flbc.start();
// A tetrahedron has one cell, in which the coordinates are barycentric.
const corners = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
await flbc.setModel([0.1, 0.1, 0.1, 0.2, 0.1, 0.1, 0.1, 0.2, 0.1], [0, 1, 2]);
await assert.rejects(flbc.makeCage(), { name: "OptionError", message: /without CGAL/ });
await flbc.setCage(corners, [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]);
await assert.rejects(flbc.makeMesh(), { name: "OptionError", message: /without TetGen/ });
await flbc.setMesh(corners, [0, 1, 2, 3]);
await flbc.solve();
const { values } = await flbc.weights();
const expected = [0.7, 0.1, 0.1, 0.1, 0.6, 0.2, 0.1, 0.1, 0.6, 0.1, 0.2, 0.1];
assert.equal(values.length, expected.length);
expected.forEach((value, k) => assert.ok(Math.abs(value - values[k]) < 1e-6));
const moved = await flbc.deform(corners.map((place) => 2 * place));
assert.ok(Math.abs(moved[0] - 0.2) < 1e-12);
flbc.end();
