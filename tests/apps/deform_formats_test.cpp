// SPDX-License-Identifier: BSD-3-Clause
// flbc deform with models in all formats, read by OpenMesh alone.
#include "flbc/io/files.h"
#include "flbc/io/mesh_io.h"
#include "support/command_line.h"
#include "support/openmesh_model.h"
#include "support/vtu_fields.h"

namespace flbc::testing {
namespace {

using OpenMesh::IO::Options;

class DeformFormats : public CommandLineTest {
 protected:
  // A triangle or tetrahedron as cage, scaled from the origin, then moved.
  template <int Dim>
  std::string simplex(const std::string& name, double scale = 1,
                      const Vector<3>& shift = Vector<3>::Zero()) const {
    const std::string flat = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    Dim == 2 ? file(name, flat + "l 1 2 3 1\n") : tetrahedron(flat + "v 0 0 1\n", name);
    return moved(name, name, [&](const auto& point) { return scale * point + shift; });
  }
  template <int Dim>
  std::string weights_of(const std::string& model) const {
    return linear_weights(points_of(read_by_openmesh(model, Options())).topRows(Dim));
  }

  Ended deform(const std::string& arguments, int status = 0) const {
    return expect("deform " + arguments, status);
  }
};

// Of the light, from 0 to 1.
double luminance(const OpenMesh::Vec3uc& color) {
  const auto linear = [&](int k) { return std::pow(color[k] / 255.0, 2.2); };
  return 0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2);
}

// The cage grows from the origin: how far a vertex moves is its distance from there.
TEST_F(DeformFormats, DisplacementsAreShownInColours) {
  const auto mesh = box_with_attributes();
  const auto rest = simplex<3>("rest.obj");
  simplex<3>("pose_0.obj");
  simplex<3>("pose_1.obj", 1.5);
  simplex<3>("pose_2.obj", 2);
  const std::string model = "a.ply";
  write_by_openmesh(mesh, model, all_attributes());
  const auto command = model + " --weights " + weights_of<3>(model) + " --rest " + rest +
                       " --pose pose_%d.obj --show-displacement --displacement d.npy -o ";
  const PointList<3> points = points_of(mesh);
  Eigen::Index farthest = 0;
  const double largest = points.colwise().norm().maxCoeff(&farthest);
  const OpenMesh::Vec3uc still(248, 248, 249), last(23, 48, 114);
  for (const std::string extension : {"obj", "off", "ply"}) {
    SCOPED_TRACE(extension);
    const auto errors = deform(command + "o_%d." + extension).errors;
    std::ostringstream value;
    value << "; shown from 0 (near white) to " << largest << " (dark blue)\n";
    expect_piece(errors, value.str());
    expect_piece(errors, "colors (they show the displacement)");
    std::vector<OpenMeshModel> shown;
    for (int k = 0; k < 3; ++k) {
      shown.push_back(read_by_openmesh("o_" + std::to_string(k) + "." + extension));
      expect_same_faces(shown.back(), mesh);
      EXPECT_LT((points_of(shown.back()) - (1 + 0.5 * k) * points).cwiseAbs().maxCoeff(), 1e-6);
      for (const auto v : mesh.vertices()) {
        EXPECT_LT((shown.back().texcoord2D(v) - mesh.texcoord2D(v)).norm(), 1e-5);
      }
    }
    // The color shows the distance, on the same scale in all poses; half as far in the second one.
    std::vector<std::pair<double, double>> seen;
    for (const auto v : mesh.vertices()) {
      const double length = points.col(v.idx()).norm();
      EXPECT_EQ(shown[0].color(v), still);
      seen.emplace_back(length / 2, luminance(shown[1].color(v)));
      seen.emplace_back(length, luminance(shown[2].color(v)));
    }
    EXPECT_EQ(shown[2].color(OpenMesh::VertexHandle(static_cast<int>(farthest))), last);
    std::sort(seen.begin(), seen.end());
    constexpr double kLevel = 0.01;
    for (std::size_t k = 1; k < seen.size(); ++k) {
      EXPECT_LE(seen[k].second, seen[k - 1].second + kLevel);
    }
    EXPECT_LT(seen.back().second, seen.front().second - 0.3);
    const auto lengths = io::read_weights("d.npy").dense();
    EXPECT_LT((lengths.row(1) - 0.5 * points.colwise().norm()).cwiseAbs().maxCoeff(), 1e-15);
  }
  const auto refused = deform(command + "o_%d.stl", 1).errors;
  expect_piece(refused, "cannot show displacements");
  EXPECT_FALSE(std::filesystem::exists("o_0.stl"));
}

TEST_F(DeformFormats, DisplacementsOfMeshesAreFields) {
  auto mesh = samples<3>().front().mesh;
  const Vector<3> low = mesh.points.rowwise().minCoeff();
  mesh.points = (mesh.points.colwise() - low) / 16;
  const auto command = "m.mesh --weights " + linear_weights(mesh.points) + " --rest " +
                       simplex<3>("rest.obj") + " --pose " + simplex<3>("pose.obj", 3) +
                       " --show-displacement -o ";
  io::write_domain("m.mesh", mesh);
  deform(command + "o.vtu");
  const auto fields = fields_in_vtu(slurp("o.vtu"));
  ASSERT_EQ(fields.size(), 1U);
  EXPECT_EQ(fields[0].name, "displacement");
  const Eigen::VectorXd lengths = 2 * mesh.points.colwise().norm().transpose();
  EXPECT_LT((fields[0].values - lengths).cwiseAbs().maxCoeff(), 1e-15);
  for (const std::string other : {"o.mesh", "o.msh"}) {
    expect_piece(deform(command + other, 1).errors, other + ": cannot show displacements");
  }
}

// The rows of weights are what flbc solve gives for the same file.
TEST_F(DeformFormats, StlHasTheVerticesThatWeightsBelongTo) {
  for (const std::string name : {"2d/figure", "3d/limb"}) {
    SCOPED_TRACE(name);
    const auto cage = name + "_cage.obj";
    expect("convert " + name + "_model.obj -o model.stl");
    expect("solve " + cage + " --method harmonic --vertices 1500 -q -o w.npy --model model.stl");
    const auto command =
        "model.stl --weights w.npy --rest " + cage + " --pose " + name + "_cage_pose.obj -q -o ";
    EXPECT_EQ(deform(command + "o.stl").errors, "");
    EXPECT_EQ(deform(command + "o.ply").errors, "");
    const auto moved = read_by_openmesh("o.ply", Options());
    EXPECT_EQ(io::read_weights("w.npy").dense().cols(), static_cast<Index>(moved.n_vertices()));
  }
  // Where numbers are that small, other programs take them for equal.
  const auto odd = file("odd.stl",
                        "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                        "vertex 0 1 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\n"
                        "vertex 1e-39 0 0\nvertex 1 0 0\nvertex 0 -1 0\nendloop\nendfacet\n"
                        "endsolid\n");
  io::write_weights("w.npy", WeightMatrix::Constant(4, 5, 0.25));
  const auto cage = simplex<3>("rest.obj");
  EXPECT_EQ(deform(odd + " --weights w.npy --pose " + cage + " -q -o p.stl").errors, "");
  EXPECT_EQ(run("info " + odd).output.find(odd + ": 5 vertices"), 0U);
  expect("convert " + odd + " -o odd.ply");
  EXPECT_EQ(read_by_openmesh("odd.ply", Options()).n_vertices(), 5U);
}

}  // namespace
}  // namespace flbc::testing
