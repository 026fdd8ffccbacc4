#!/usr/bin/env python3
"""The matrix of promises, operations, and doors:

    matrix_test.py PROGRAM DRIVER MESH_FREE_WORK_FOLDER [PYTHON_MODULE_FOLDER]

Every door binds the same models to the same symmetric cages, in 2D and 3D, with vertices outside that
stay where they are, masks, and a mirror, and takes every operation. What comes out is judged here by
NumPy alone, for every promise. A cell that a door cannot do is in REFUSED with a part of its message.
"""
import itertools
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys

import numpy as np

OPERATIONS = ["bind", "reduce8", "reduce4", "export", "transfer", "transfer_nearest", "deform",
              "joint", "reshape", "save"]
DOORS = ["program", "cpp", "openmesh", "python"]
# (door, operation): part of the message, or why there is no such call.
REFUSED = {
    ("program", "reshape"): "no command moves a rest cage",
    ("openmesh", "reshape"): "use flbc::Binding and flbc::Rig",
    ("openmesh", "transfer"): "use flbc::Binding and flbc::Rig",
    ("openmesh", "transfer_nearest"): "use flbc::Binding and flbc::Rig",
}


def refusal(door, operation, method):
    if method == "solid" and door == "openmesh":
        return "use flbc::Binding and flbc::Rig"
    if method == "solid" and operation == "joint":
        return "which a joint would bend"
    return REFUSED.get((door, operation))


# ---- the models ------------------------------------------------------------------------------------
def grid(dim, low, high, counts):
    axes = [np.linspace(low[d], high[d], counts[d]) for d in range(dim)]
    return np.array(list(itertools.product(*axes)))


def obj(path, points, faces):
    rows = points if points.shape[1] == 3 else np.c_[points, np.zeros(len(points))]
    kind = "l" if points.shape[1] == 2 and path.name not in ("model.obj", "other.obj") else "f"
    with open(path, "w") as file:
        for row in rows:
            file.write("v %.17g %.17g %.17g\n" % tuple(row))
        for face in faces:
            file.write(kind + "".join(f" {k + 1}" for k in face) + "\n")


def bar_cage(dim):
    """A bar along x, symmetric across x = 0, with seven rings of control points."""
    x = np.linspace(-3, 3, 7)
    if dim == 2:
        points = np.r_[np.c_[x, -np.ones(7)], np.c_[x[::-1], np.ones(7)]]
        return points, [list(range(14)) + [0]]
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    points = np.array([(a, y, z) for a in x for y, z in corners])
    faces = [[3, 2, 1, 0], [24, 25, 26, 27]]
    for ring in range(6):
        for k in range(4):
            a, b = 4 * ring + k, 4 * ring + (k + 1) % 4
            faces.append([a, b, b + 4, a + 4])
    # Both halves are cut alike: triangles with corners mirrored.
    triangles = []
    for face in faces:
        middle = points[face].mean(axis=0)[0]
        a, b, c, d = face
        flip = middle > 0
        triangles += [[a, b, d], [b, c, d]] if flip else [[a, b, c], [a, c, d]]
    return points, triangles


def model(dim, counts, reach):
    """A sheet (2D) or plates (3D) inside the bar, with a strip that leaves it at the top."""
    low, high = [-2.6] + [-0.7] * (dim - 1), [2.6] + [reach] + [0.6] * (dim - 2)
    points = grid(dim, low, high, counts)
    index = np.arange(len(points)).reshape(counts)
    faces = []
    sheets = [index] if dim == 2 else [index[:, :, k] for k in range(counts[2])]
    for sheet in sheets:
        for i in range(sheet.shape[0] - 1):
            for j in range(sheet.shape[1] - 1):
                faces.append([sheet[i, j], sheet[i + 1, j], sheet[i + 1, j + 1], sheet[i, j + 1]])
    return points, faces


def write_models(folder, dim):
    cage, facets = bar_cage(dim)
    obj(folder / "cage.obj", cage, facets)
    points, faces = model(dim, [15, 6] if dim == 2 else [15, 6, 3], 1.3)
    obj(folder / "model.obj", points, faces)
    other, other_faces = model(dim, [23, 7] if dim == 2 else [23, 7, 3], 1.3)
    obj(folder / "other.obj", other, other_faces)
    turn = np.eye(dim)
    turn[0, 1] = 0.4
    turn[1, 1] = 1.2
    obj(folder / "pose.obj", cage @ turn.T + 0.25, facets)
    reshaped = cage.copy()
    reshaped[:, 1] *= 1 + 0.05 * np.abs(cage[:, 0])
    obj(folder / "reshaped.obj", reshaped, facets)
    # Control points of one end do not move the other half.
    ends = np.flatnonzero(cage[:, 0] < -1.5)
    inside = np.flatnonzero((points[:, 0] > 0.5) & (points[:, 1] < 0.9))
    mask = {"control_points": ends.tolist(), "region": {"vertices": inside.tolist()}}
    (folder / "locality.json").write_text(json.dumps({"masks": [mask], "falloff": 0.1}))
    solid = np.flatnonzero((np.abs(points[:, 0] - 1.3) < 0.7) & (np.abs(points[:, 1]) < 0.4)
                           & (np.abs(points[:, -1]) < 0.4))
    (folder / "solid.json").write_text(json.dumps({"solid": [{"region": solid.tolist()}]}))
    np.savetxt(folder / "solid.csv", solid, "%d")
    with open(folder / "masks.csv", "w") as file:
        for i, p in itertools.product(ends, inside):
            file.write(f"{i},{p}\n")


def read_obj(path, dim):
    rows = [line.split()[1:4] for line in open(path) if line.startswith("v ")]
    return np.array(rows, float)[:, :dim]


# ---- the doors -------------------------------------------------------------------------------------
class Refusal(Exception):
    pass


def call(*arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise Refusal(done.stderr)


class Program:
    def __init__(self, program):
        self.program = program

    def __call__(self, operation, folder, dim, method):
        def flbc(*arguments):
            call(self.program, *arguments, "-q")

        cage, model = folder / "cage.obj", folder / "model.obj"
        bound, result = folder / "bound.npz", folder / "result.npz"
        if operation == "reshape":
            raise Refusal("no command moves a rest cage")
        joint = ["--joint", "smooth"] if operation == "joint" else []
        if method == "harmonic" and not joint:
            flbc("solve", cage, "--model", model, "--method", method, "--outside", "keep",
                 "--vertices", 800, "-o", bound)
        else:
            own = (["--method", method] if method == "harmonic" else
                   ["--locality", folder / "solid.json"] if method == "solid" else
                   ["--symmetric", "x", "--locality", folder / "locality.json"])
            flbc("run", cage, model, *own, *joint, "--outside", "keep", "--vertices", 800, "-k", 40,
                 "-o", folder / "run", "--force")
            shutil.copy(folder / "run" / "binding.npz", bound)
        shutil.copy(bound, result)
        if operation.startswith("reduce"):
            flbc("sparsify", bound, "-k", operation[-1], "-o", result)
        if operation == "export":
            for name, rigid in (("result.glb", []), ("rigid.glb", ["--rigid"] * (method == "solid"))):
                flbc("export", model, "--weights", bound, "-k", 4, *rigid, "-o", folder / name)
        if operation == "transfer":
            flbc("transfer", bound, "--to", folder / "other.obj", "--outside", "keep", "-o", result)
        if operation == "transfer_nearest":
            flbc("transfer", bound, "--from", model, "--to", folder / "other.obj", "--limit", 1,
                 "-o", result)
        if operation == "deform":
            flbc("deform", model, "--weights", bound, "--pose", folder / "pose.obj", "-o",
                 folder / "moved.obj")
            np.savetxt(folder / "moved.csv", read_obj(folder / "moved.obj", dim), delimiter=",")


class Driver:
    def __init__(self, driver, door):
        self.driver, self.door = driver, door

    def __call__(self, operation, folder, dim, method):
        call(self.driver, self.door, operation, folder, method)


class Python:
    def __call__(self, operation, folder, dim, method):
        import flbc

        def read(name):
            points, faces = flbc.read_model(folder / name)
            return np.asarray(points)[:, :dim], faces

        points, faces = read("model.obj")
        cage = flbc.read_cage(folder / "cage.obj")
        options = {"outside": "keep", "symmetric": "x", "mesh_vertices": 800, "max_influences": 0}
        if method == "harmonic":
            options["method"] = method
        elif method == "solid":
            options.pop("symmetric")
            options["solid"] = [np.loadtxt(folder / "solid.csv", dtype=int)]
        else:
            pairs = np.loadtxt(folder / "masks.csv", delimiter=",", dtype=int)
            mask = np.zeros((len(points), len(cage)), bool)
            mask[pairs[:, 1], pairs[:, 0]] = True
            options.update(mask=mask, falloff=0.1)
        binding = flbc.bind(points, faces, cage, **options)
        if operation.startswith("reduce"):
            binding = binding.reduced(int(operation[-1]))
        if operation == "export":
            binding.export(folder / "result.glb", faces, max_influences=4)
            binding.export(folder / "rigid.glb", faces, max_influences=4, rigid=method == "solid")
        if operation == "transfer":
            binding = binding.transferred(*read("other.obj"), outside="keep")
        if operation == "transfer_nearest":
            binding = binding.transferred(*read("other.obj"), from_faces=faces, limit=1)
        if operation == "deform":
            pose = read_obj(folder / "pose.obj", dim)
            np.savetxt(folder / "moved.csv", binding.deform(pose), delimiter=",")
            jacobians = binding.jacobians(pose)  # (P, d, d)
            np.savetxt(folder / "jacobians.csv",
                       jacobians.transpose(0, 2, 1).reshape(len(points), -1), delimiter=",")
        if operation == "joint":
            binding = binding.joined()
        if operation == "reshape":
            keep = {k: v for k, v in options.items() if k not in ("mesh_vertices", "max_influences")}
            rig = flbc.Rig(cage, points, faces, mesh_vertices=800, **keep)
            rig.solve()
            rig.reshape(read_obj(folder / "reshaped.obj", dim))
            binding = rig.binding()
        binding.save(folder / "result.npz")
        if operation == "save":
            flbc.load_binding(folder / "result.npz").save(folder / "result.npz")


# ---- the judge -------------------------------------------------------------------------------------
class Result:
    def __init__(self, folder, operation, dim):
        self.folder, self.operation, self.dim = folder, operation, dim
        data = np.load(folder / "result.npz")
        self.data = data
        self.cage = read_obj(folder / ("reshaped.obj" if operation == "reshape" else "cage.obj"), dim)
        is_transferred = operation.startswith("transfer")
        self.model = read_obj(folder / ("other.obj" if is_transferred else "model.obj"), dim)
        shape = data["shape"]
        self.weights = np.zeros(shape)
        rows = np.repeat(np.arange(shape[0]), np.diff(data["indptr"]))
        self.weights[rows, data["indices"]] = data["data"]
        if operation == "export":
            self.weights = joint_weights(folder / "result.glb", shape)
        self.offsets = data["offsets"] if len(data["offsets"]) else np.zeros_like(self.model)
        self.outside = np.abs(self.model[:, 1]) > self.height(self.model) + 1e-6
        is_single = operation == "export" or (folder / "single").exists()
        self.tolerance = 1e-6 if is_single else 1e-9

    def height(self, points):
        grows = 0.05 * np.abs(points[:, 0]) if self.operation == "reshape" else 0
        return 1 + grows

    def partners(self, points):
        images = points * np.r_[-1, np.ones(self.dim - 1)]
        distance = np.linalg.norm(points[None] - images[:, None], axis=2)
        assert distance.min(axis=1).max() < 1e-9
        return distance.argmin(axis=1)


def joint_weights(path, shape):
    """Weights of the points from JOINTS_n and WEIGHTS_n of a .glb."""
    content = path.read_bytes()
    length = struct.unpack("<I", content[12:16])[0]
    document = json.loads(content[20:20 + length])
    binary = content[28 + length:]
    types = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
    widths = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

    def read(number):
        accessor = document["accessors"][number]
        view = document["bufferViews"][accessor["bufferView"]]
        kind, width = types[accessor["componentType"]], widths[accessor["type"]]
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        step = view.get("byteStride", np.dtype(kind).itemsize * width)
        return np.array([np.frombuffer(binary, kind, width, begin + k * step)
                         for k in range(accessor["count"])])

    weights = np.zeros(shape)
    for mesh in document["meshes"]:
        for primitive in mesh["primitives"]:
            attributes = primitive["attributes"]
            if "JOINTS_0" not in attributes or primitive.get("mode", 4) != 4:
                continue
            joints, values = read(attributes["JOINTS_0"]), read(attributes["WEIGHTS_0"])
            points = (read(attributes["_VERTEX"])[:, 0].astype(int) if "_VERTEX" in attributes
                      else np.arange(len(joints)))
            for row, point in enumerate(points):
                weights[point] = 0
                for joint, value in zip(joints[row], values[row]):
                    if joint < shape[1]:
                        weights[point, joint] += value
    return weights


def zeros(result):
    """Control points of one end never move the other half, nor those of the other end this one."""
    if result.operation.startswith("transfer"):
        return listed_zeros(result)
    ends = np.flatnonzero(result.cage[:, 0] < -1.5)
    region = (result.model[:, 0] > 0.5) & (result.model[:, 1] < 0.9)
    assert region.any()
    images, partners = result.partners(result.cage), result.partners(result.model)
    assert not result.weights[np.ix_(region, ends)].any()
    assert not result.weights[np.ix_(partners[region], images[ends])].any()
    assert result.weights[:, ends].any(), "masks do not cover everything"


def listed_zeros(result):
    """Of another model, points are masked where all vertices around are."""
    sizes, data = result.data["mask_sizes"], result.data
    i, p, count = 0, 0, 0
    for most, points in sizes:
        some = data["mask_control_points"][i:i + most]
        region = data["mask_points"][p:p + points]
        assert not result.weights[np.ix_(region, some)].any()
        i, p, count = i + most, p + points, count + most * points
    deep = (np.abs(result.model[:, 0]) > 1.1) & (result.model[:, 1] < 0.7)
    assert count > 0.3 * deep.sum() * (result.cage[:, 0] < -1.5).sum()


def mirror(result):
    images, partners = result.partners(result.cage), result.partners(result.model)
    # Few influences cannot be symmetric in the plane itself: a point needs pairs of them.
    most = {"reduce4": 4, "export": 4, "reduce8": 8}.get(result.operation, 99)
    off_plane = (np.abs(result.model[:, 0]) > 1e-9) | (most // 2 > result.dim)
    assert np.array_equal(result.weights[partners][:, images][off_plane], result.weights[off_plane])


def sums_and_reproduction(result):
    inside = ~result.outside
    assert np.abs(result.weights[inside].sum(axis=1) - 1).max() < result.tolerance
    moved = result.weights @ result.cage + result.offsets
    if result.operation == "export":
        moved[result.outside] = result.model[result.outside]
    assert np.abs(moved - result.model).max() < result.tolerance * 10
    assert result.weights.min() >= 0
    if result.operation in ("reduce4", "reduce8", "export"):
        most = 8 if result.operation == "reduce8" else 4
        assert (result.weights > 0).sum(axis=1).max() <= most


def kept_points(result):
    assert result.outside.any()
    assert not result.weights[result.outside].any()
    if result.operation == "deform":
        moved = np.loadtxt(result.folder / "moved.csv", delimiter=",")
        scale = 1e-5 if (result.folder / "single").exists() else 1e-9
        assert np.abs(moved - result.model)[result.outside].max() <= scale
        assert np.abs(moved - result.model)[~result.outside].max() > 0.1


def affine_poses(result):
    """An affine pose moves points inside by it; Jacobians are its matrix, and 1 where nothing moves."""
    turn = np.eye(result.dim)
    turn[0, 1], turn[1, 1] = 0.4, 1.2
    wanted = result.model @ turn.T + 0.25
    pose = result.cage @ turn.T + 0.25
    moved = result.weights @ pose
    inside = ~result.outside
    if result.operation == "joint":  # there, its weights do not reproduce points
        inside &= ~result.offsets.any(axis=1)
        assert 0 < inside.sum() < (~result.outside).sum()
    assert np.abs(moved - wanted)[inside].max() < result.tolerance * 10
    if (result.folder / "jacobians.csv").exists():
        jacobians = np.loadtxt(result.folder / "jacobians.csv", delimiter=",")
        columns = turn.T.reshape(-1)
        assert np.abs(jacobians[~result.outside] - columns).max() < 1e-9
        assert np.abs(jacobians[result.outside] - np.eye(result.dim).reshape(-1)).max() < 1e-12


def given_coordinates_stay(result):
    """The weights of the domain mesh are harmonic: a textbook stiffness matrix annihilates them."""
    data = result.data
    if result.operation == "export":
        return sums_and_reproduction(result)
    if "domain" not in data:  # of OpenMesh: the weights are those of the door that has one
        twin = pathlib.Path(str(result.folder).replace("openmesh", "cpp"))
        other = Result(twin, result.operation, result.dim)
        poses = [result.cage @ np.diag(1 + k * result.cage[0] / 9) for k in range(3)]
        for pose in poses:
            assert np.abs((result.weights - other.weights) @ pose).max() < 1e-4
        return None
    assert json.loads(data["info"].item())["method"] == "harmonic"
    points, cells = data["domain"], data["cells"]
    weights = np.zeros((len(points), data["shape"][1]))
    rows = np.repeat(np.arange(len(points)), np.diff(data["domain_indptr"]))
    weights[rows, data["domain_indices"]] = data["domain_data"]
    dim = result.dim
    corners = np.concatenate([np.ones((len(cells), dim + 1, 1)), points[cells]], axis=2)
    hats = np.linalg.inv(corners)[:, 1:, :]
    volumes = np.abs(np.linalg.det(corners))
    local = np.einsum("c,cda,cdb->cab", volumes, hats, hats)
    sums = np.zeros_like(weights)
    for a, b in itertools.product(range(dim + 1), repeat=2):
        np.add.at(sums, cells[:, a], local[:, a, b, None] * weights[cells[:, b]])
    facets = np.sort(np.concatenate([np.delete(cells, k, axis=1) for k in range(dim + 1)]), axis=1)
    unique, counts = np.unique(facets, axis=0, return_counts=True)
    interior = np.setdiff1d(np.arange(len(points)), unique[counts == 1])
    assert np.abs(sums[interior]).max() < 1e-9


def solid_regions(result):
    """The weights of a region, and what they do to it, are affine functions of the place."""
    sums_and_reproduction(result)
    sizes = result.data["solid_sizes"]
    assert len(sizes) == 1 and sizes[0][1] == len(result.data["solid_points"])
    region = result.data["solid_points"]
    affine = np.c_[result.model, np.ones(len(result.model))][region]
    assert len(region) > np.linalg.matrix_rank(affine), "any weights are affine"
    values = [(result.weights[region], 1e-6 if result.operation == "export" else 1e-12)]
    if result.operation == "deform":
        values.append((np.loadtxt(result.folder / "moved.csv", delimiter=",")[region], 1e-9))
    for value, tolerance in values:
        left = value - affine @ np.linalg.lstsq(affine, value, rcond=None)[0]
        assert np.abs(left).max() < tolerance
    if result.operation in ("reduce4", "reduce8", "export"):
        most = 8 if result.operation == "reduce8" else 4
        assert (result.weights[region] > 0).any(axis=0).sum() <= most
    if result.operation == "export":  # a joint more, which has the region alone
        count, joints = result.weights.shape
        rigid = joint_weights(result.folder / "rigid.glb", (count, joints + 1))
        others = np.setdiff1d(np.arange(count), region)
        assert (rigid[region, joints] == 1).all() and (rigid[region, :joints] == 0).all()
        assert (rigid[others, :joints] == result.weights[others]).all()


PROMISES = {
    "zeros": ("weights", zeros),
    "mirror": ("weights", mirror),
    "sums and reproduction": ("weights", sums_and_reproduction),
    "kept points": ("weights", kept_points),
    "affine poses and Jacobians": ("weights", affine_poses),
    "given coordinates stay": ("harmonic", given_coordinates_stay),
    "solid regions": ("solid", solid_regions),
}


def main():
    program, driver, work = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    doors = {"program": Program(program), "cpp": Driver(driver, "cpp"),
             "openmesh": Driver(driver, "openmesh")}
    if len(sys.argv) > 4:
        sys.path.insert(0, sys.argv[4])
        doors["python"] = Python()
    filled, refused, failed = 0, 0, []
    for dim, (door, take), operation in itertools.product((2, 3), doors.items(), OPERATIONS):
        results = {}
        for method in ("weights", "harmonic", "solid"):
            folder = work / f"{dim}d_{door}_{operation}_{method}"
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            write_models(folder, dim)
            if door == "openmesh":  # its points are floats here
                (folder / "single").touch()
            try:
                take(operation, folder, dim, method)
                results[method] = folder
            except Exception as error:
                expected = refusal(door, operation, method)
                if expected is None or expected not in str(error):
                    failed.append((dim, door, operation, method, str(error).strip()[:300]))
        for promise, (method, judge) in PROMISES.items():
            if refusal(door, operation, method):
                refused += 1
            elif method in results:
                try:
                    judge(Result(results[method], operation, dim))
                    filled += 1
                except Exception as error:  # also a file that is no binding
                    line = error.__traceback__.tb_next.tb_lineno if error.__traceback__.tb_next else 0
                    failed.append((dim, door, operation, promise, f"line {line}: {error}"[:200]))
    for failure in failed:
        print("FAILED: %dD, %s, %s, %s: %s" % failure)
    print(f"{filled} passed, {len(failed)} failed, {refused} refused by design")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
