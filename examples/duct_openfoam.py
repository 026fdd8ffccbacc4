# SPDX-License-Identifier: BSD-3-Clause
"""The duct of duct.py in OpenFOAM: quality of the cells by checkMesh when a cage moves them, and when
displacement diffusion or radial basis functions (SciPy) continue the same displacement of the boundary.

duct_openfoam.py OUT   makes a case of each in this folder. See docs/how-to/engineers.md for the variables
that OpenFOAM and cageDeformMesh need
"""
import pathlib
import re
import subprocess
import sys

import flbc
import numpy as np
from duct import CELLS, SIDES, SIZE, box, duct, moves_of
from scipy.interpolate import RBFInterpolator

AMPLITUDES = (0.15, 0.3, 0.45)

HEADER = "FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n"
FILES = {
    "system/blockMeshDict": f"""
vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));
blocks (hex (0 1 2 3 4 5 6 7) {str(CELLS).replace(",", "")} simpleGrading (1 1 1));
boundary
(
    wall {{ type wall; faces ((0 3 2 1)); }}
    sides {{ type patch; faces ((4 5 6 7) (0 4 7 3) (1 2 6 5) (0 1 5 4) (3 7 6 2)); }}
);
""",
    "system/controlDict": """
startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1;
writeControl timeStep; writeInterval 1; writePrecision 12;
""",
    "system/fvSchemes": """
divSchemes {} gradSchemes { default Gauss linear; } interpolationSchemes { default linear; }
laplacianSchemes { default Gauss linear corrected; } snGradSchemes { default corrected; }
""",
    "system/fvSolution": """
solvers { "cellDisplacement.*" { solver PCG; preconditioner DIC; tolerance 1e-10; relTol 0; } }
PIMPLE {}
""",
    "constant/dynamicMeshDict": """
dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs ("libfvMotionSolvers.so");
motionSolver displacementLaplacian;
displacementLaplacianCoeffs { diffusivity quadratic inverseDistance (wall); }
""",
}
MAPPED = "{ type timeVaryingMappedFixedValue; setAverage off; mapMethod nearest; offset (0 0 0); }"
FILES["0/pointDisplacement"] = f"""
dimensions [0 1 0 0 0 0 0];
internalField uniform (0 0 0);
boundaryField {{ wall {MAPPED} sides {MAPPED} }}
"""
KINDS = {"pointDisplacement": "pointVectorField"}


class Case:
    """A folder with the mesh of the duct."""

    def __init__(self, folder, points):
        self.folder = folder
        for name, text in FILES.items():
            self.write(name, HEADER.format(KINDS.get(file := name.rpartition("/")[2], "dictionary"), file) + text)
        self.run("blockMesh")
        self.write_points("constant", points)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def run(self, *command):
        done = subprocess.run(command, cwd=self.folder, text=True, capture_output=True, check=False)
        if done.returncode:
            sys.exit(f"{' '.join(command)} in {self.folder}:\n{done.stdout[-1000:]}{done.stderr}")
        return done.stdout

    def write_points(self, time, points):
        """In the order of blockMesh, where x varies fastest."""
        rows = points.reshape(*(n + 1 for n in CELLS), 3).transpose(2, 1, 0, 3).reshape(-1, 3)
        self.write(f"{time}/polyMesh/points", HEADER.format("vectorField", "points") + as_list(rows))

    def quality(self):
        """Largest angle of non-orthogonality in degrees, and largest skewness, at time 1."""
        text = self.run("checkMesh", "-time", "1")
        if re.search("negative volume|incorrectly oriented", text, re.I):
            return "inverted"
        angle = re.search(r"non-orthogonality Max: (\S+)", text).group(1)
        skewness = re.search(r"[Mm]ax skewness = ([^\s,]+)", text).group(1)
        return f"{float(angle):.1f}, {float(skewness):.2f}"


def as_list(rows):
    return f"{len(rows)}\n(\n" + "\n".join(f"({x!r} {y!r} {z!r})" for x, y, z in rows.tolist()) + "\n)\n"


def write_cage(path, cage, points):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
    path.write_text("\n".join(lines + [f"f {' '.join(str(k + 1) for k in face)}" for face in cage.facets]) + "\n")


def main(out):
    points, cells, _ = duct()
    cage = box([0.75, -0.2, -0.3], [2.25, 1.2, 0.7], (6, 4, 3))
    binding = flbc.bind(points, cells[:, SIDES].reshape(-1, 4), cage, outside="keep")
    out.mkdir(parents=True, exist_ok=True)
    binding.save(out / "binding.npz")
    at_border = (np.isclose(points, 0) | np.isclose(points, SIZE)).any(1)
    print("largest non-orthogonality, skewness\namplitude  cage            cage, joint     diffusion       RBF")
    for amplitude in AMPLITUDES:
        write_cage(out / "pose.obj", cage, cage.points + amplitude * moves_of(cage))
        row = []
        for joint in ([], ["-joint", "smooth"]):
            case = Case(out / f"cage{'_joint' * bool(joint)}_{amplitude}", points)
            case.run("cageDeformMesh", "-binding", "../binding.npz", "-pose", "../pose.obj", *joint)
            row.append(case.quality())
        moves = binding.joined("smooth").deform(cage.points + amplitude * moves_of(cage)) - points
        case = Case(out / f"diffusion_{amplitude}", points)
        for patch in ("wall", "sides"):
            name = f"constant/boundaryData/{patch}"
            case.write(f"{name}/points", as_list(points[at_border]))
            case.write(f"{name}/0/pointDisplacement", as_list(0 * moves[at_border]))
            case.write(f"{name}/1/pointDisplacement", as_list(moves[at_border]))
        case.run("moveDynamicMesh")
        row.append(case.quality())
        case = Case(out / f"rbf_{amplitude}", points)
        known = np.flatnonzero(at_border)[::2]
        spread = RBFInterpolator(points[known], moves[known], kernel="thin_plate_spline")
        case.write_points("1", points + np.where(at_border[:, None], moves, spread(points)))
        row.append(case.quality())
        print(f"{amplitude:9.2f}  " + "  ".join(f"{text:14}" for text in row))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
