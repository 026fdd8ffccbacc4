# SPDX-License-Identifier: BSD-3-Clause
"""Files of every format, skins, pages."""
import json
import struct

import flbc
import numpy as np
import pytest
import scipy.sparse
from conftest import MESHES


@pytest.mark.parametrize("ending", ["npy", "csv", "mtx"])
def test_weights(tmp_path, flat, ending):
    path = tmp_path / f"weights.{ending}"
    weights = flat.weights
    for given in (weights, np.asfortranarray(weights), scipy.sparse.csr_matrix(weights)):
        flbc.write_weights(path, given)
        found = flbc.read_weights(path)
        assert scipy.sparse.issparse(found) == (ending == "mtx")
        found = found.toarray() if ending == "mtx" else found
        assert np.array_equal(found, flat.weights)


@pytest.mark.parametrize(
    "which, ending", [("flat", "obj"), ("flat", "off"), ("solid", "mesh"), ("solid", "msh")])
def test_meshes(tmp_path, which, ending, request):
    mesh = request.getfixturevalue(which).mesh
    flbc.write_mesh(tmp_path / f"mesh.{ending}", mesh)
    same = flbc.read_mesh(tmp_path / f"mesh.{ending}")
    assert np.array_equal(same.points, mesh.points)
    assert np.array_equal(same.cells, mesh.cells)


def test_fields(tmp_path, flat):
    path = tmp_path / "mesh.vtu"
    flbc.write_mesh(path, flat.mesh, {"first": flat.weights[:, 0]})
    assert 'Name="first"' in path.read_text()


@pytest.mark.parametrize("ending", ["obj", "off", "ply", "stl"])
def test_models(tmp_path, limb, ending):
    _, vertices, faces = limb
    path = tmp_path / f"model.{ending}"
    flbc.write_model(path, vertices, faces)
    same = flbc.read_model(path)
    near = 1e-5 if ending == "stl" else 0  # single precision
    assert np.allclose(same.vertices[same.faces], vertices[faces], rtol=0, atol=near)


def test_models_keep_what_is_not_moved(tmp_path):
    text = "# mine\nv 0 0 0\nv 1 0 0\nv 0 1 1\nvt 0 0\nf 1/1 2/1 3/1\n"
    (tmp_path / "model.obj").write_text(text)
    vertices, _ = flbc.read_model(tmp_path / "model.obj")
    flbc.write_model(tmp_path / "moved.obj", vertices + 1, source=tmp_path / "model.obj")
    text = (tmp_path / "moved.obj").read_text()
    assert "# mine" in text and "f 1/1 2/1 3/1" in text and "v 2 1 1" in text
    flbc.write_model(tmp_path / "moved.ply", vertices + 1, source=tmp_path / "model.obj")
    assert np.array_equal(flbc.read_model(tmp_path / "moved.ply").vertices, vertices + 1)


def test_faces_of_several_lengths(tmp_path):
    text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 1\nf 1 2 3 4\nf 2 5 3\n"
    (tmp_path / "model.obj").write_text(text)
    model = flbc.read_model(tmp_path / "model.obj")
    assert model.faces == [[0, 1, 2, 3], [1, 4, 2]] and model.vertices.shape == (5, 3)
    flbc.write_model(tmp_path / "same.off", *model)
    assert flbc.read_model(tmp_path / "same.off").faces == model.faces
    with pytest.raises(flbc.InputError, match="plane"):
        flbc.read_model(tmp_path / "model.obj", dim=2)


@pytest.mark.parametrize("name", ["2d/ring", "2d/letter", "3d/limb"])
def test_cages(tmp_path, name):
    cage = flbc.read_cage(MESHES / f"{name}_cage.obj")
    flbc.write_cage(tmp_path / "cage.obj", cage)
    same = flbc.read_cage(tmp_path / "cage.obj")
    assert np.array_equal(same.points, cage.points)
    edges = {tuple(sorted(facet)) for facet in cage.facets.tolist()}
    assert {tuple(sorted(facet)) for facet in same.facets.tolist()} == edges


def test_skins(tmp_path, limb, solid, moved):
    cage, vertices, faces = limb
    binding = flbc.Binding(solid.at(vertices), cage, vertices)
    binding.export(tmp_path / "model.glb", faces, poses=[cage.points, moved])
    data = (tmp_path / "model.glb").read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    content = json.loads(data[20 : 20 + length])
    names = [content["nodes"][joint]["name"] for joint in content["skins"][0]["joints"]]
    assert sum(name.startswith("control_point_") for name in names) == len(cage)
    assert len(content["animations"]) == 1
    binding.reduced(4).export(tmp_path / "model.usda", faces, max_influences=4)
    assert (tmp_path / "model.usda").read_text().startswith("#usda")
    with pytest.raises(flbc.OptionError, match=".glb or .usda"):
        binding.export(tmp_path / "model.fbx", faces)
    with pytest.raises(flbc.InputError, match="no region is solid"):
        binding.export(tmp_path / "model.glb", faces, rigid=True)


def test_pages(tmp_path, limb, solid, flat):
    cage, vertices, faces = limb
    page = flbc.Binding(solid.at(vertices), cage, vertices).view(
        faces, poses=[cage.points], title="my limb")
    assert page.html.startswith("<!doctype html>") or "<html" in page.html[:200].lower()
    assert "my limb" in page.html
    shown = page._repr_html_()
    assert shown.startswith("<iframe srcdoc=") and "&lt;" in shown
    page.save(tmp_path / "page.html")
    assert (tmp_path / "page.html").read_text() == page.html
    inside = [[0.25, 0.5], [0.5, 0.75]]
    assert flbc.Binding(flat.at(inside), flat.cage, inside).view().html
