// SPDX-License-Identifier: BSD-3-Clause
// Skins written from a mesh: a reader of glTF moves them as deform() moves the mesh.
#include "flbc/openmesh/skin.h"

#include "flbc/openmesh/deform.h"
#include "support/glb_file.h"
#include "support/harmonic_weights.h"
#include "support/io_files.h"
#include "support/wide_meshes.h"

namespace flbc::testing {
namespace {

template <class Dimension>
class MeshSkin : public FolderTest {};
TYPED_TEST_SUITE(MeshSkin, Dimensions);

// Triangles between the vertices of a mesh of the interior, with few weights each.
template <int Dim>
struct Example {
  Example() : sample(make_sample<Dim>(Shape::kBox, 3, 0.2)) {
    for (Index v = 0; v < sample.mesh.num_vertices(); ++v) mesh.add_vertex({9, 9, 9});
    for (Index s = 0; s < sample.mesh.num_cells(); s += Dim == 2 ? 1 : 7) {
      const auto cell = sample.mesh.cells.col(s);
      add(cell[0], cell[1], cell[2]);
    }
    const WeightMatrix few =
        sparsify<Dim>(sample.cage.points, sample.mesh.points, harmonic_weights(sample), {4})
            .dense();
    openmesh::set_influences(mesh, SparseWeights(few));
    openmesh::set_rest_cage(mesh, sample.cage.points);
  }
  void add(Index a, Index b, Index c) {
    const openmesh::internal::SilencedOpenMesh silence;
    mesh.add_face(mesh.vertex_handle(a), mesh.vertex_handle(b), mesh.vertex_handle(c));
  }
  PointList<Dim> pose(int seed) const {
    std::srand(static_cast<unsigned>(seed));
    return sample.cage.points + 0.3 * PointList<Dim>::Random(Dim, sample.cage.size());
  }

  Sample<Dim> sample;
  DoublePoly mesh;
};

TYPED_TEST(MeshSkin, MovesAsTheMeshDoes) {
  constexpr int kDim = TypeParam::value;
  Example<kDim> example;
  auto& mesh = example.mesh;
  ASSERT_GT(mesh.n_faces(), 0U);
  mesh.request_vertex_colors();
  mesh.request_vertex_texcoords2D();
  for (const auto v : mesh.vertices()) {
    mesh.set_color(v, DoublePoly::Color(0, 255, 0));
    mesh.set_texcoord2D(v, {0.25F, static_cast<float>(v.idx())});
  }
  const auto path = this->path("skin.glb");
  openmesh::write_skin<kDim>(path, mesh, {example.sample.cage.points, example.pose(1)});
  const GlbFile file(this->content("skin.glb"));
  EXPECT_EQ(static_cast<std::size_t>(file.triangles().cols()), mesh.n_faces());
  EXPECT_EQ(file.attribute("COLOR_0").col(0).head(3), Eigen::Vector3d(0, 1, 0));
  EXPECT_NEAR(file.attribute("TEXCOORD_0")(0, 0), 0.25, 1e-7);
  const auto sources = file.sources();
  const auto expect_moved = [&](const Eigen::MatrixXd& joints, const PointList<kDim>& cage) {
    openmesh::deform(mesh, cage);
    const Eigen::MatrixXd moved = file.skinned(joints);
    const PointList<kDim> expected = openmesh::points_of<kDim>(mesh)(Eigen::all, sources);
    EXPECT_LT((moved.topRows(kDim) - expected).cwiseAbs().maxCoeff(), 1e-6);
  };
  expect_moved(file.joints(), example.sample.cage.points);
  expect_moved(file.joints(1.0 / 24), example.pose(1));
}

TYPED_TEST(MeshSkin, RefusesWhatIsNoSkin) {
  constexpr int kDim = TypeParam::value;
  Example<kDim> example;
  const auto path = this->path("skin.glb");
  EXPECT_NO_THROW(openmesh::write_skin(path, example.mesh));
  EXPECT_NO_THROW(openmesh::write_skin(this->path("skin.usda"), example.mesh));
  EXPECT_THROW(openmesh::write_skin(this->path("skin.fbx"), example.mesh), InputError);
  openmesh::SkinOptions options;
  options.max_influences = 5;
  EXPECT_THROW(openmesh::write_skin(path, example.mesh, options), OptionError);
  options = {};
  options.weights = "others";
  EXPECT_THROW(openmesh::write_skin(path, example.mesh, options), InputError);
  EXPECT_THROW(openmesh::write_skin<5 - kDim>(path, example.mesh, {}), InputError);
  EXPECT_THROW(openmesh::write_skin<kDim>(path, example.mesh, {PointList<kDim>(kDim, 2)}),
               InputError);
}

}  // namespace
}  // namespace flbc::testing
