"""cageMotion and cageDeformMesh agree with flbc deform, on any number of ranks."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

if not all(map(shutil.which, ("blockMesh", "decomposePar", "moveDynamicMesh", "mpirun"))):
    print("skipped: OpenFOAM or mpirun is missing")
    sys.exit(77)

import numpy as np

import channel

FLBC, LIBRARY, UTILITY = sys.argv[1:4]


class OpenFoamTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.case = case = channel.Case(cls.folder + "/channel", FLBC, LIBRARY)
        cls.rest = case.points("constant")
        np.save(case.path("rest.npy"), cls.rest)
        case.run(FLBC, "deform", "rest.npy", "--weights", "binding.npz", "--pose", "pose.obj",
                 "--outside", "nearest", "-q", "-o", "moved.npy")
        cls.inside = ((cls.rest[:, 0] >= 1) & (cls.rest[:, 0] <= 3) & (cls.rest[:, 1] <= 0.6))
        cls.moved = np.where(cls.inside[:, None], np.load(case.path("moved.npy")), cls.rest)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def tearDown(self):
        self.case.end_at(1)
        self.case.move_to("pose.obj")
        for time in ("0.25", "0.5", "0.75", "1"):
            shutil.rmtree(self.case.path(time), ignore_errors=True)

    def expect_moved(self, points):
        self.assertLess(np.abs(points - self.moved).max(), 1e-12 * channel.SIZE)
        self.assertTrue((points[~self.inside] == self.rest[~self.inside]).all())

    def test_any_number_of_ranks(self):
        self.assertGreater(np.abs(self.moved - self.rest).max(), 0.1)
        serial = None
        for ranks in (1, 2, 3, 4):
            with self.subTest(ranks=ranks):
                self.case.decompose(ranks)
                self.case.run_ranks(ranks, "moveDynamicMesh")
                points = self.case.points_of_ranks(ranks, "1")
                self.expect_moved(points)
                serial = points if serial is None else serial
                self.assertTrue((points == serial).all())
                self.tearDown()

    def test_restart(self):
        self.case.decompose(2)
        self.case.end_at(0.5)
        self.case.run_ranks(2, "moveDynamicMesh")
        half = self.case.points_of_ranks(2, "0.5")
        self.assertLess(np.abs(half - (self.rest + self.moved) / 2).max(), 1e-12 * channel.SIZE)
        self.case.end_at(1)
        self.assertNotIn("Time = 0.25\n", self.case.run_ranks(2, "moveDynamicMesh"))
        self.expect_moved(self.case.points_of_ranks(2, "1"))

    def test_fixed_patches(self):
        self.case.move_to("pose.obj", "sides")
        self.case.decompose(4)
        self.case.run_ranks(4, "moveDynamicMesh")
        points = self.case.points_of_ranks(4, "1")
        on_sides = np.isclose(self.rest[:, 2], 0) | np.isclose(self.rest[:, 2], 1)
        self.assertTrue((points[on_sides] == self.rest[on_sides]).all())
        self.assertLess(np.abs(points - self.moved)[~on_sides].max(), 1e-12 * channel.SIZE)
        self.case.move_to("pose.obj", "ceiling")
        self.assertIn("no patch ceiling", self.case.run("moveDynamicMesh", fails=True))

    def test_utility(self):
        files = ["-binding", "binding.npz"]
        self.case.decompose(3)
        self.case.run_ranks(3, UTILITY, *files, "-pose", "pose.obj")
        self.expect_moved(self.case.points_of_ranks(3, "0.25"))
        self.tearDown()
        self.case.decompose(3)
        self.case.run_ranks(3, UTILITY, *files, "-pose", "pose.obj", "-overwrite")
        self.expect_moved(self.case.points_of_ranks(3, "constant"))

    def test_a_joint_slows_points_by_the_mass_that_moves(self):
        case = self.case
        # A shift by 1 of all control points that may move shows the sum of their weights.
        probe = channel.control_points()
        probe[channel.control_points(1)[:, 1] != probe[:, 1], 0] += 1
        channel.write_cage(case.path("probe.obj"), probe)
        case.run(FLBC, "deform", "rest.npy", "--weights", "binding.npz", "--pose", "probe.obj",
                 "--outside", "nearest", "-q", "-o", "probe.npy")
        mass = (np.load(case.path("probe.npy")) - self.rest)[:, :1]
        t = np.minimum(1, mass / 0.4)
        moved = np.where(self.inside[:, None], self.rest + t * (2 - t) * (self.moved - self.rest),
                         self.rest)
        case.move_to("pose.obj", joint="joint smooth; jointMass 0.4;")
        case.decompose(2)
        case.run_ranks(2, "moveDynamicMesh")
        self.assertLess(np.abs(case.points_of_ranks(2, "1") - moved).max(), 1e-12 * channel.SIZE)
        self.tearDown()
        case.decompose(2)
        case.run_ranks(2, UTILITY, "-binding", "binding.npz", "-pose", "pose.obj",
                       "-joint", "smooth", "-jointMass", "0.4")
        self.assertLess(np.abs(case.points_of_ranks(2, "0.25") - moved).max(), 1e-12 * channel.SIZE)
        case.move_to("pose.obj", joint="joint soft;")
        self.assertIn("use smooth or curvature", case.run("moveDynamicMesh", fails=True))

    def test_plane_cages_move_both_sides_alike(self):
        case = self.case
        channel.write_plane_cage(case.path("plane.obj"), channel.control_points())
        channel.write_plane_cage(case.path("plane_pose.obj"), channel.control_points(0.2))
        case.run(FLBC, "solve", "plane.obj", "--vertices", "500", "-q", "-o", "plane.npz")
        np.save(case.path("plane_rest.npy"), self.rest[:, :2])
        case.run(FLBC, "deform", "plane_rest.npy", "--weights", "plane.npz", "--pose",
                 "plane_pose.obj", "--outside", "nearest", "-q", "-o", "plane_moved.npy")
        moved = self.rest.copy()
        moved[self.inside, :2] = np.load(case.path("plane_moved.npy"))[self.inside]
        self.assertGreater(np.abs(moved - self.rest).max(), 0.1)
        case.move_to("plane_pose.obj", rest="plane.obj", binding="plane.npz")
        case.decompose(2)
        case.run_ranks(2, "moveDynamicMesh")
        points = case.points_of_ranks(2, "1")
        self.assertLess(np.abs(points - moved).max(), 1e-12 * channel.SIZE)
        layers = points.reshape(channel.CELLS[2] + 1, -1, 3)
        self.assertLess(np.ptp(layers[:, :, :2], axis=0).max(), 1e-14 * channel.SIZE)

    def test_inverted_cells_are_refused(self):
        channel.write_cage(self.case.path("bad.obj"), channel.control_points(1.2))
        self.case.move_to("bad.obj")
        self.case.decompose(2)
        output = self.case.run_ranks(2, "moveDynamicMesh", fails=True)
        self.assertRegex(output, r"the first is cell \d+ at .* of processor \d, at time [\d.]+, on "
                                 r"the way to pose \"?bad.obj")
        self.assertIn("the mesh was not moved", output)

    def test_cuts_must_not_move(self):
        pose = channel.control_points(0.2)
        pose[0, 0] += 0.1
        channel.write_cage(self.case.path("cut.obj"), pose)
        self.case.move_to("cut.obj")
        output = self.case.run("moveDynamicMesh", fails=True)
        self.assertIn("control point 0 moves by 0.1", output)

    def refused(self, words, pose="pose.obj", binding="binding.npz"):
        self.case.move_to(pose, binding=binding)
        self.assertIn(words, self.case.run("moveDynamicMesh", fails=True))

    def test_poses_with_other_vertices_are_refused(self):
        points, path = channel.control_points(0.2), self.case.path("other.obj")
        channel.write_cage(path, points)
        with open(path, encoding="ascii") as file:
            lines = file.readlines()
        # The same surface, with vertices 1 and 2 exchanged, as exporters renumber them.
        lines[1], lines[2] = lines[2], lines[1]
        swap = {"2": "3", "3": "2"}
        with open(path, "w", encoding="ascii") as file:
            for line in lines:
                words = line.split()
                file.write(" ".join([swap.get(word, word) for word in words] if words[0] == "f"
                                    else words) + "\n")
        self.refused("no such face", "other.obj")
        with open(path, "w", encoding="ascii") as file:
            file.writelines(lines[:10])
        self.refused("has 10 vertices, but the cage of the binding has 20", "other.obj")

    def test_weights_that_do_not_reproduce_their_mesh_are_refused(self):
        with np.load(self.case.path("binding.npz")) as file:
            arrays = dict(file)
        arrays["domain_data"] = arrays["domain_data"][::-1]
        np.savez(self.case.path("wrong.npz"), **arrays)
        self.refused("the weights do not put vertex", binding="wrong.npz")

    def test_the_table_of_the_how_to_is_what_the_example_prints(self):
        source = pathlib.Path(__file__).parents[2]
        example = source / "examples/duct_openfoam.py"
        path = os.pathsep.join([os.path.dirname(UTILITY), os.environ["PATH"]])
        done = subprocess.run(
            ["/usr/bin/python3", example, self.folder + "/duct"], text=True, capture_output=True,
            check=False, env={**channel.ENVIRONMENT, **os.environ, "PATH": path})
        if "No module named" in done.stderr:
            self.skipTest(done.stderr)
        printed = [re.split("  +", line.strip()) for line in done.stdout.splitlines()[2:]]
        written = (source / "docs/how-to/engineers.md").read_text()
        rows = [line.strip("| ").split(" | ") for line in written.splitlines() if line.startswith("| 0.")]
        self.assertEqual(len(printed), len(rows), done.stderr)
        for own, other in zip(printed, rows):
            for value, expected in zip(own, other, strict=True):
                np.testing.assert_allclose(numbers_of(value), numbers_of(expected), rtol=0.05)


def numbers_of(text):
    """Of a cell of the table; none if it has words."""
    return [float(number) for number in text.split(", ")] if text[0].isdigit() else []


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
