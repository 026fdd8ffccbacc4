# SPDX-License-Identifier: BSD-3-Clause
"""Bindings that the program writes, as the add-on reads them, and shapes of meshes."""
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parents[2] / 'blender' / 'local_barycentric_cage'))
import files  # noqa: E402
import mesh  # noqa: E402


class FilesTest(unittest.TestCase):
    def setUp(self):
        self.random = np.random.default_rng(1)

    def test_the_largest_weights_of_a_binding(self):
        dense = self.random.random((40, 11)) * (self.random.random((40, 11)) < 0.5)
        dense[:, 3] += 0.1
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = Path(folder.name) / 'binding.npz'
        vertices, columns = np.nonzero(dense)
        np.savez(path, indptr=np.append(0, np.cumsum((dense != 0).sum(1))), indices=columns,
                 data=dense[vertices, columns], outside=np.array([2, 7]))
        self.assertEqual(files.vertices_outside(path).tolist(), [2, 7])
        for k in (1, 4, 20):
            indices, weights = files.largest_weights(path, k)
            self.assertEqual((indices.shape, weights.shape), ((40, k), (40, k)))
            found = np.zeros_like(dense)
            np.add.at(found, (np.arange(40)[:, None], indices), weights)
            least = np.sort(dense, axis=1)[:, -k] if k <= 11 else np.zeros(40)
            expected = np.where(dense >= least[:, None], dense, 0)
            expected /= expected.sum(1, keepdims=True)
            np.testing.assert_allclose(found, expected, atol=1e-7)

    def test_flat_shapes(self):
        turn = np.linalg.qr(self.random.normal(size=(3, 3)))[0]
        points = self.random.random((50, 3))
        empty = np.zeros(0, np.int32)
        for height, is_flat in ((0, True), (1e-3, False), (1, False)):
            placed = (points * (1, 1, height)) @ turn + 5
            shape = mesh.Shape(placed.astype(np.float32).astype(float), empty, empty, empty)
            self.assertEqual(mesh.is_flat(shape), is_flat)


if __name__ == '__main__':
    unittest.main()
