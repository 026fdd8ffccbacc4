#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How well cages bend the limbs of models.

    bends.py PROGRAM MODEL ... [--cages "NAME=OPTIONS" ...] [--work FOLDER] > out.csv

For every model it makes cages by `flbc cage` with the options given, and finds the limbs from the
model alone: what lies beyond a saddle of the geodesic distance from the middle of the surface. It
counts the rings of a cage between the ends of a limb: the most closed loops of control points, of
which no two touch, that separate its tip from the body. Then it bends the limb by 60 degrees at its
middle. Each control point follows the ideal bend of the model vertex that is nearest at rest. The
error is the distance of the deformed model from its ideal bend.
"""
import argparse
import csv
import heapq
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "paper"))
from judge_cages import edges_of, read_obj  # noqa: E402

ANGLE = np.pi / 3
LEAST = 0.12  # length of a limb, relative to model size
SLENDER = 1.5  # least length of a limb, relative to its diameter


def distances(points, neighbors, source):
    result = np.full(len(points), np.inf)
    result[source] = 0
    queue = [(0.0, source)]
    while queue:
        d, i = heapq.heappop(queue)
        if d > result[i]:
            continue
        for j in neighbors[i]:
            through = d + np.linalg.norm(points[i] - points[j])
            if through < result[j]:
                result[j] = through
                heapq.heappush(queue, (through, j))
    return result


def adjacency(count, edges):
    neighbors = [[] for _ in range(count)]
    for a, b in edges:
        neighbors[a].append(b)
        neighbors[b].append(a)
    return neighbors


def from_middle(points, neighbors):
    """Geodesic distances from the vertex whose farthest vertex is nearest."""
    # A small part, such as a button, belongs to no limb.
    starts = [distances(points, neighbors, seed) for seed in (0, len(points) // 2)]
    first = max(starts, key=lambda d: np.isfinite(d).sum())
    reach = [first]
    for _ in range(8):
        nearest = np.where(np.isfinite(first), np.minimum.reduce(reach), -1)
        reach.append(distances(points, neighbors, int(nearest.argmax())))
    return distances(points, neighbors, int(np.where(np.isfinite(first), np.maximum.reduce(reach[1:]), np.inf).argmin()))


def branches(far, neighbors, least):
    """(tip, distance of the saddle, vertices) of the parts beyond saddles, at their first one."""
    part = np.full(len(far), -1)
    tips, members, found = [], [], {}
    for i in np.argsort(-far, kind="stable"):
        if not np.isfinite(far[i]):
            continue
        touched = sorted({part[j] for j in neighbors[i] if part[j] >= 0}, key=lambda p: -far[tips[p]])
        if not touched:
            tips.append(i)
            members.append([i])
            part[i] = len(tips) - 1
            continue
        if len([p for p in touched if far[tips[p]] - far[i] >= least]) > 1:
            for p in touched:
                if far[tips[p]] - far[i] >= least and p not in found:
                    found[p] = (tips[p], far[i], np.array(members[p]))
        keep = touched[0]
        for p in touched[1:]:
            part[members[p]] = keep
            members[keep] += members[p]
        members[keep].append(i)
        part[i] = keep
    return list(found.values())


class Limb:
    def __init__(self, points, far, tip, saddle, members):
        self.tip, self.members = tip, members
        self.length = far[tip] - saddle
        self.along = np.full(len(points), -np.inf)  # distance beyond the middle, of its vertices
        self.along[members] = far[members] - (far[tip] + saddle) / 2

        def middle(at):
            band = np.abs(self.along - at * self.length) < 0.08 * self.length
            return points[band].mean(0) if band.any() else points[tip]
        self.center = middle(0)
        axis = middle(0.2) - middle(-0.2)
        self.axis = axis / np.linalg.norm(axis)
        band = points[np.abs(self.along) < 0.08 * self.length] - self.center
        self.radius = np.linalg.norm(band - np.outer(band @ self.axis, self.axis), axis=1).mean()

    def hinges(self):
        side = np.cross(self.axis, np.eye(3)[np.abs(self.axis).argmin()])
        side /= np.linalg.norm(side)
        return side, np.cross(self.axis, side)

    def bend(self, points, along, hinge):
        """Each point rotates around the hinge, smoothly over a diameter of the limb."""
        angle = ANGLE * np.clip((along + self.radius) / (2 * self.radius), 0, 1)[:, None]
        arm = points - self.center
        parallel = np.outer(arm @ hinge, hinge)
        turned = np.cos(angle) * (arm - parallel) + np.sin(angle) * np.cross(hinge, arm) + parallel
        return self.center + turned


def limbs_of(points, facets):
    neighbors = adjacency(len(points), edges_of(facets))
    far = from_middle(points, neighbors)
    size = np.linalg.norm(np.ptp(points, 0))
    limbs = [Limb(points, far, *branch) for branch in branches(far, neighbors, LEAST * size)]
    return [limb for limb in limbs if limb.length >= 2 * SLENDER * limb.radius]


def nearest(points, places):
    return np.array([((points - place) ** 2).sum(1).argmin() for place in places])


def rings(cage, facets, limb, owners):
    """By duality with a shortest path, one less than its edges from the tip to the body."""
    on_limb = np.isfinite(limb.along[owners])
    if not on_limb.any():
        return 0
    neighbors = adjacency(len(cage), edges_of(facets))
    seen = {int(np.where(on_limb, limb.along[owners], -np.inf).argmax())}
    level, count = set(seen), 0
    while level and all(on_limb[i] for i in level):
        level = {j for i in level for j in neighbors[i]} - seen
        seen |= level
        count += 1
    return count - 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    parser.add_argument("--cages", nargs="+", default=["default=", "57=--control-points 57"])
    parser.add_argument("--work", type=pathlib.Path, default=pathlib.Path("bends"))
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["model", "limb", "length", "diameter", "cage", "control_points", "rings", "rms", "max"])
    for model in arguments.models:
        points, facets = read_obj(model)
        limbs = limbs_of(points, facets)
        size = np.linalg.norm(np.ptp(points, 0))
        for given in arguments.cages:
            name, options = given.split("=", 1)
            cage_file = arguments.work / f"{model.stem}_{name}.obj"
            weights_file = cage_file.with_suffix(".npy")
            if options.endswith(".obj"):
                cage_file = pathlib.Path(options.replace("MODEL", str(model.with_suffix(""))))
            else:
                subprocess.run([arguments.program, "cage", model, "-q", "-o", cage_file, *options.split()], check=True)
            if not cage_file.exists():
                continue
            subprocess.run([arguments.program, "solve", cage_file, "--model", model, "--vertices", "6000", "-q", "-o", weights_file],
                           check=True)
            cage, cage_facets = read_obj(cage_file)
            weights = np.load(weights_file)
            owners = nearest(points, cage)
            for k, limb in enumerate(limbs):
                along = np.where(np.isfinite(limb.along[owners]), limb.along[owners], -np.inf)
                errors = []
                for hinge in limb.hinges():
                    pose = limb.bend(cage, along, hinge)
                    ideal = limb.bend(points, limb.along, hinge)[limb.members]
                    errors.append(points[limb.members] + weights[limb.members] @ (pose - cage) - ideal)
                far = np.linalg.norm(np.concatenate(errors), axis=1)
                table.writerow([model.stem, k, f"{limb.length / size:.3f}", f"{2 * limb.radius / size:.3f}", name,
                                len(cage), rings(cage, cage_facets, limb, owners),
                                f"{np.sqrt((far ** 2).mean()) / limb.length:.4f}", f"{far.max() / limb.length:.4f}"])
            sys.stdout.flush()


if __name__ == "__main__":
    main()
