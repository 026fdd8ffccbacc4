// SPDX-License-Identifier: BSD-3-Clause
// flbc convert as its users and their scripts see it.
#include "flbc/io/mesh_io.h"
#include "support/command_line.h"
#include "support/io_files.h"

namespace flbc::testing {
namespace {

class ConvertCommand : public CommandLineTest {
 protected:
  void expect_converted(const std::string& arguments, const std::string& words = "") const {
    expect("convert " + arguments, 0, words);
  }

  void expect_refused(const std::string& arguments, int status, const std::string& words) const {
    CommandLineTest::expect_refused("convert " + arguments, status, words);
  }

  WeightMatrix read(const std::string& name) const { return io::read_weights(name).dense(); }

  // Five points and three control points, without weights of the last of either.
  WeightMatrix write_weights(const std::string& name) const {
    WeightMatrix weights = WeightMatrix::Zero(3, 5);
    weights << 1 / 3.0, 1, -1e-17, 0, 0,  //
        2 / 3.0, 0, 1e-300, 0.1, 0,       //
        0, 0, 0, 0, 0;
    io::write_weights(name, weights);
    return weights;
  }
};

TEST_F(ConvertCommand, WeightsBetweenAllFormats) {
  const std::string formats[] = {"npy", "mtx", "csv"};
  const auto weights = write_weights("a.npy");
  for (const auto& from : formats) {
    if (from != "npy") expect_converted("a.npy -o a." + from);
    EXPECT_TRUE(bit_equal(read("a." + from), weights)) << from;
    for (const auto& to : formats) {
      const auto there = "b." + to, back = "c." + from;
      expect_converted("a." + from + " -o " + there,
                       "b." + to + ": weights of 5 points for 3 control points");
      EXPECT_TRUE(bit_equal(read("b." + to), weights)) << from << " " << to;
      expect_converted(there + " -q -o " + back);
      EXPECT_EQ(slurp(back), slurp("a." + from)) << from << " " << to;
    }
  }
  EXPECT_EQ(run("convert -q a.npy -o d.csv").errors, "");
}

TEST_F(ConvertCommand, SizesAreThoseOfTheFiles) {
  write_weights("a.npy");
  const auto few = file("few.obj", "v 0 0\nv 1 0\n");
  expect_refused("a.npy -o b.npy --cage " + few, 2,
                 "a.npy: has weights for 3 control points, but few.obj has 2");
  expect_refused("a.npy -o b.npy --points " + few, 2,
                 "a.npy: has weights of 5 points, but few.obj has 2 vertices");
}

TEST_F(ConvertCommand, Transpose) {
  const auto cage = file("cage.obj", "v 0 0\nv 1 0\nv 0 1\n");
  const auto weights = write_weights("a.npy");
  io::write_weights("t.npy", weights.transpose());
  expect_converted("t.npy --transpose -o b.npy");
  EXPECT_TRUE(bit_equal(read("b.npy"), weights));

  const auto points = file("points.obj", "v 0 0\nv 0 0\nv 0 0\nv 0 0\nv 0 0\n");
  const auto files = " --cage " + cage + " --points " + points + " -o d.npy";
  expect_refused("t.npy" + files, 2, "t.npy: has control points as rows; give --transpose");
  expect_refused("a.npy" + files + " --transpose", 2, "leave out --transpose");
  expect_converted("t.npy" + files + " --transpose");
}

TEST_F(ConvertCommand, WhatModelsLoseIsTold) {
  const auto model = file("a.obj",
                          "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0.1 0 0 1\nv 0 1 0 0.2 0.4 0.6\n"
                          "vt 0 0.5\nf 1/1 2/1 3/1 4/1\n");
  expect_no_piece(run("convert " + model + " -o b.ply").errors, "lost");
  EXPECT_EQ(io::read_polygons("b.ply").polygons, (std::vector<std::vector<Index>>{{0, 1, 2, 3}}));
  expect_converted(model + " -o b.stl",
                   "the order of the vertices, coordinates beyond single precision, polygons (they "
                   "are cut into triangles), colors, texture coordinates\n");
  // As a mesh of the interior.
  const auto flat = file("flat.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n# a\n");
  expect_converted(flat + " -o b.vtu", "flat.obj; lost: comments, colors\n");
  expect_piece(slurp("b.vtu"), "NumberOfCells=\"1\"");
}

TEST_F(ConvertCommand, WrongKindsAreRefusedByName) {
  write_weights("a.npy");
  const auto model = file("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");
  io::write_domain("a.mesh", samples<3>().front().mesh);
  const auto to = [&](const std::string& name) { return " -o " + name; };
  expect_refused("a.npy" + to("b.obj"), 1, "b.obj: weights cannot be written as a mesh");
  expect_refused(model + to("b.npy"), 1, "b.npy: a mesh cannot be written as weights");
  expect_refused("a.txt" + to("b.npy"), 1, "weights end in .mtx, .npy, .csv or .lbw");
  expect_refused("a.npy" + to("b.txt"), 1, "must end in .mtx, .npy, .csv or .lbw");
  expect_refused(model + to("b.xls"), 1, "b.xls: unknown file format");
  expect_refused(model + to("b.msh"), 1, "b.msh: " + model + " holds no tetrahedra");
  expect_refused("a.mesh" + to("b.obj"), 1, "b.obj: a.mesh holds tetrahedra");
  // Wrong extensions, and formats of other programs.
  const auto obj = slurp(model);
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  expect_refused(file("obj.stl", "# a model\n" + obj + obj) + to("b.ply"), 2,
                 "obj.stl: not STL; it looks like OBJ; let its name end in .obj");
  expect_refused(file("off.obj", off) + to("b.ply"), 2,
                 "off.obj: not OBJ; it looks like OFF; let its name end in .off");
  expect_refused(file("ply.off", "ply\nformat ascii 1.0\n") + to("b.ply"), 2,
                 "ply.off: not OFF; it looks like PLY");
  expect_refused(file("glb.obj", "glTF\x02") + to("b.ply"), 2,
                 "glb.obj: not OBJ; it looks like GLB; let its name end in .glb");
  expect_refused(file("binary.obj", std::string("\x7f"
                                                "ELF\0\0\0",
                                                7)) +
                     to("b.ply"),
                 2, "binary.obj: not OBJ; it looks like a binary file");
  expect_refused(file("model.fbx", "Kaydara FBX Binary") + to("b.ply"), 1,
                 "convert it to .obj or .ply first, for example in Blender");
  expect_refused(file("model.obj.gz", "") + to("b.ply"), 1, "unpack it first");
  expect_refused(file("splats.spz", "") + to("b.ply"), 1, "uncompressed .ply");
  expect_refused(file("part.dxf", "") + to("b.ply"), 1, "save the drawing as .svg first");
  expect_refused(model + to("b.fbx"), 1, "usually read glTF");
  expect_refused(model + to("b.vtu"), 2, "vertex 2 at (0, 1, 1) is not in the plane z = 0");
  expect_refused(model + to("b.ply") + " --transpose", 1, "a.obj is a mesh");
  expect_refused("a.npy -o a.npy", 1, "would replace this input file");
  expect_refused("a.npy" + to("absent/b.npy"), 4, "absent");
  expect_refused("missing.npy" + to("b.npy"), 4, "missing.npy");
  expect_refused("missing.ply" + to("b.obj"), 4, "missing.ply");
  expect_refused(file("a.vtu", "") + to("b.mesh"), 1, "a.vtu: .vtu files are only written");
  expect_refused(file("a.node", "") + to("b.mesh"), 1, "convert it to .mesh first");
  expect_refused(file("a.dmat", "") + to("b.npy"), 1, "write .csv from libigl");
}

}  // namespace
}  // namespace flbc::testing
