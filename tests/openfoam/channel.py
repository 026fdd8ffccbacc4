"""A channel with a cage around a part of its floor, as an OpenFOAM case."""

import os
import re
import subprocess

import numpy as np

# The cage cuts through the mesh at x = 1, at x = 3, and at the top. The control points that move are
# below the floor.
X = [1, 1.5, 2, 2.5, 3]
Y = [-0.2, 0.6]
Z = [-0.5, 1.5]
CELLS = (40, 10, 8)
# Debian's OpenFOAM needs the first; containers need the others.
ENVIRONMENT = {"WM_PROJECT_DIR": "/usr/share/openfoam", "OMPI_ALLOW_RUN_AS_ROOT": "1",
               "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
SIZE = float(np.linalg.norm([2, 0.8, 2]))

HEADER = """FoamFile
{{
    version 2.0;
    format ascii;
    class {kind};
    object {name};
}}
"""

BLOCK_MESH = """
vertices ((0 0 0) (4 0 0) (4 1 0) (0 1 0) (0 0 1) (4 0 1) (4 1 1) (0 1 1));
blocks (hex (0 1 2 3 4 5 6 7) (%d %d %d) simpleGrading (1 1 1));
boundary
(
    inlet { type patch; faces ((0 4 7 3)); }
    outlet { type patch; faces ((1 2 6 5)); }
    floor { type wall; faces ((0 1 5 4)); }
    lid { type wall; faces ((3 7 6 2)); }
    sides { type patch; faces ((0 3 2 1) (4 5 6 7)); }
);
"""

CONTROL = """
startFrom latestTime;
startTime 0;
stopAt endTime;
endTime %g;
deltaT 0.25;
writeControl timeStep;
writeInterval 1;
writeFormat binary;
timePrecision 6;
runTimeModifiable false;
"""

MOTION = """
dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs ("%s");
motionSolver cageMotion;
cageMotionCoeffs
{
    binding "%s";
    poses ((0 "%s") (1 "%s"));
    fixedPatches (%s);
    %s
}
"""


def control_points(heave=0.0):
    """Rows x, y, z; those below the floor rise by `heave`, except at both ends."""
    points = [[x, y, z] for z in Z for y in Y for x in X]
    for point in points:
        if point[1] == Y[0] and point[0] not in (X[0], X[-1]):
            point[1] += heave
    return np.array(points)


def write_cage(path, points):
    def number(i, j, k):
        return 1 + i + len(X) * (j + 2 * k)

    quads = []
    for i in range(len(X) - 1):
        for k in (0, 1):
            side = [number(i, 0, k), number(i + 1, 0, k), number(i + 1, 1, k), number(i, 1, k)]
            quads.append(side[::-1] if k == 0 else side)
        for j in (0, 1):
            level = [number(i, j, 0), number(i + 1, j, 0), number(i + 1, j, 1), number(i, j, 1)]
            quads.append(level if j == 0 else level[::-1])
    for i in (0, len(X) - 1):
        end = [number(i, 0, 0), number(i, 0, 1), number(i, 1, 1), number(i, 1, 0)]
        quads.append(end if i == 0 else end[::-1])
    with open(path, "w", encoding="ascii") as out:
        for point in points:
            out.write("v %r %r %r\n" % tuple(float(x) for x in point))
        for a, b, c, d in quads:
            out.write("f %d %d %d\nf %d %d %d\n" % (a, b, c, a, c, d))


def write_plane_cage(path, points):
    """The side of the cage at its least z, as a 2D cage."""
    n = len(X)
    loop = list(range(1, n + 1)) + list(range(2 * n, n, -1))
    with open(path, "w", encoding="ascii") as out:
        for x, y, _ in points[:2 * n]:
            out.write("v %r %r\n" % (float(x), float(y)))
        out.write("l %s %d\n" % (" ".join(map(str, loop)), loop[0]))


class Case:
    """A case in a folder, and the programs that work on it."""

    def __init__(self, folder, flbc, library):
        self.folder, self.flbc, self.library = folder, flbc, library
        for part in ("system", "constant", "0"):
            os.makedirs(os.path.join(folder, part))
        write_cage(self.path("cage.obj"), control_points())
        write_cage(self.path("pose.obj"), control_points(0.2))
        self.dictionary("system/blockMeshDict", BLOCK_MESH % CELLS)
        self.dictionary("system/fvSchemes", "divSchemes {}\ngradSchemes {}\nlaplacianSchemes {}\n")
        self.dictionary("system/fvSolution", "PIMPLE {}")
        self.end_at(1)
        self.move_to("pose.obj")
        self.run("blockMesh")
        self.run(flbc, "solve", "cage.obj", "--vertices", "1500", "-q", "-o", "binding.npz")

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def dictionary(self, name, text):
        with open(self.path(name), "w", encoding="ascii") as out:
            out.write(HEADER.format(kind="dictionary", name=os.path.basename(name)) + text)

    def end_at(self, time):
        self.dictionary("system/controlDict", CONTROL % time)

    def move_to(self, pose, fixed="", rest="cage.obj", binding="binding.npz", joint=""):
        self.dictionary("constant/dynamicMeshDict",
                        MOTION % (self.library, binding, rest, pose, fixed, joint))

    def run(self, *command, fails=False):
        """Runs a program in the case. Returns its output."""
        done = subprocess.run(
            command, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            check=False, timeout=250, env={**ENVIRONMENT, **os.environ, "PWD": self.folder},
        )
        if (done.returncode != 0) != fails:
            raise AssertionError("%s returned %d:\n%s" % (command, done.returncode, done.stdout[-2000:]))
        return done.stdout

    def decompose(self, ranks):
        self.dictionary(
            "system/decomposeParDict",
            "numberOfSubdomains %d;\nmethod simple;\nsimpleCoeffs { n (%s); delta 0.001; }\n"
            % (ranks, {1: "1 1 1", 2: "2 1 1", 3: "3 1 1", 4: "2 2 1"}[ranks]),
        )
        if ranks > 1:
            self.run("decomposePar", "-force")

    def run_ranks(self, ranks, *command, fails=False):
        # One rank is not parallel to OpenFOAM.
        parallel = ["-parallel"] if ranks > 1 else []
        return self.run("mpirun", "-np", str(ranks), "--oversubscribe", *command, *parallel,
                        fails=fails)

    def points(self, *folder):
        """The points of a mesh, a row each."""
        return np.frombuffer(self.binary(np.float64, 24, *folder, "polyMesh", "points"),
                             np.float64).reshape(-1, 3)

    def binary(self, kind, size, *name):
        with open(self.path(*name), "rb") as file:
            content = file.read()
        if b"format      binary" not in content[:1000]:
            numbers = re.search(rb"\n(\d+)\s*\((.*)\)", content, re.S).group(2)
            return np.array(numbers.translate(None, b"()").split(), dtype=kind).tobytes()
        match = re.search(rb"\n(\d+)\n?\(", content)
        return content[match.end():match.end() + int(match.group(1)) * size]

    def points_of_ranks(self, ranks, time):
        """The points of the whole mesh; those that ranks share must be bit-identical."""
        if ranks == 1:
            return self.points(time)
        whole = np.full(self.points("constant").shape, np.nan)
        for rank in range(ranks):
            processor = "processor%d" % rank
            numbers = np.frombuffer(
                self.binary(np.int32, 4, processor, "constant", "polyMesh", "pointProcAddressing"),
                np.int32)
            points = self.points(processor, time)
            known = ~np.isnan(whole[numbers, 0])
            assert (whole[numbers[known]] == points[known]).all(), "ranks disagree"
            whole[numbers] = points
        assert not np.isnan(whole).any()
        return whole
