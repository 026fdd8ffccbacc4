// SPDX-License-Identifier: BSD-3-Clause
// A bound mesh keeps what its binding promises: masks, mirror images, and vertices outside.
#include "flbc/openmesh/binding.h"

#include "flbc/io/binding_file.h"
#include "flbc/io/files.h"
#include "flbc/openmesh/bind.h"
#include "flbc/openmesh/skin.h"
#include "support/glb_file.h"
#include "support/io_files.h"
#include "support/refined_sample.h"
#include "support/wide_meshes.h"

namespace flbc::testing {
namespace {

constexpr int kOutside = 45;

// A sheet in a box. Both are symmetric across x = 0.5. Control points on the right do not move the
// left part of the sheet.
template <int Dim>
struct Sheet {
  Sheet() : sample(with_fine_cage<Dim>(Shape::kBox, 4, 8)), mesh(make_squares<DoubleTri>()) {
    for (const auto v : mesh.vertices()) {
      const auto at = mesh.point(v);
      mesh.set_point(v, {0.5 + 0.12 * (at[0] - 3), 0.14 + 0.12 * at[1], 0.4});
    }
    options.max_influences = 8;
    options.mirror_axis = 0;
    const auto points = openmesh::points_of<Dim>(mesh);
    const auto& control_points = sample.cage.points;
    for (Index p = 0; p < points.cols(); ++p) {
      if (points(0, p) < 0.4) left.push_back(p);
    }
    for (Index i = 0; i < sample.cage.size(); ++i) {
      if (control_points(0, i) > 0.6) right.push_back(i);
    }
    options.masks = {{right, left}};
  }
  void bind() { openmesh::bind(mesh, sample.cage, sample.mesh, options); }

  Sample<Dim> sample;
  DoubleTri mesh;
  openmesh::BindOptions options;
  std::vector<Index> left, right;  // vertices, control points
};

template <int Dim>
Binding<Dim> binding_of(const DoubleTri& mesh, const std::string& weights = openmesh::kWeights) {
  return openmesh::internal::binding_of<Dim>(mesh, openmesh::internal::rows_in(mesh, weights),
                                             weights);
}

// A mesh at rest whose binding has been in a file.
template <int Dim>
DoubleTri stored(const DoubleTri& mesh) {
  DoubleTri loaded = mesh;
  openmesh::restore_rest(loaded);
  const auto binding = io::decode_binding(io::encode_binding(binding_of<Dim>(loaded)));
  openmesh::set_binding(loaded, std::get<Binding<Dim>>(binding), 8);
  return loaded;
}

template <int Dim>
void expect_same_promises(const Binding<Dim>& found, const Binding<Dim>& expected) {
  EXPECT_EQ(found.cage.points, expected.cage.points);
  EXPECT_EQ(found.policy, expected.policy);
  EXPECT_EQ(found.outside, expected.outside);
  EXPECT_LT((found.rest() - expected.rest()).cwiseAbs().maxCoeff(), 1e-13);
  const Index n = found.cage.size(), count = found.weights.num_points();
  const PointMasks masks(found.masks, n, count), given(expected.masks, n, count);
  EXPECT_EQ(masks.points(), given.points());
  for (const Index p : given.points()) EXPECT_EQ(masks.forbidden(p), given.forbidden(p));
  ASSERT_EQ(found.mirror.has_value(), expected.mirror.has_value());
  EXPECT_EQ(found.mirror->axis, expected.mirror->axis);
  EXPECT_EQ(found.mirror->images, expected.mirror->images);
  EXPECT_EQ(found.mirror->partners, expected.mirror->partners);
}

// \return number of weights that are masked
template <int Dim>
int expect_kept(const Binding<Dim>& binding) {
  const auto weights = binding.weights.dense();
  int count = 0;
  for (const auto& mask : binding.masks) {
    for (const Index p : mask.points) {
      for (const Index i : mask.control_points) EXPECT_EQ(weights(i, p), 0) << p;
      count += static_cast<int>(mask.control_points.size());
    }
  }
  const auto& [axis, images, partners] = *binding.mirror;
  for (std::size_t p = 0; p < partners.size(); ++p) {
    if (partners[p] < 0) continue;
    const auto row = weights.col(static_cast<Index>(p));
    EXPECT_EQ(row(images).eval(), weights.col(partners[p])) << p;
  }
  return count;
}

TEST_IN_2D_AND_3D(MeshBinding, CopiesFilesAndReductionsKeepIt) {
  for (const auto outside :
       {OutsidePoints::kNearest, OutsidePoints::kKeep, OutsidePoints::kExtend}) {
    Sheet<Dim> sheet;
    sheet.mesh.set_point(OpenMesh::VertexHandle(kOutside), {0.5, 1.2, 0.4});
    sheet.options.outside = outside;
    const auto expected =
        Rig<Dim>(sheet.sample.cage, sheet.sample.mesh, openmesh::points_of<Dim>(sheet.mesh),
                 openmesh::edge_list<Dim>(sheet.mesh), sheet.options)
            .bind();
    ASSERT_EQ(expected.outside, std::vector<Index>{kOutside});
    sheet.bind();
    for (auto mesh : {sheet.mesh, stored<Dim>(sheet.mesh)}) {
      const auto found = binding_of<Dim>(mesh);
      EXPECT_TRUE(found.weights == expected.weights);
      expect_same_promises(found, expected);
      EXPECT_GT(expect_kept(found), 0);
      openmesh::ReductionOptions few;
      few.into = "few";
      openmesh::deform(mesh, PointList<Dim>(2 * sheet.sample.cage.points));
      openmesh::sparsify(mesh, 2 * Dim + 2, few);
      const auto reduced = binding_of<Dim>(mesh, "few");
      expect_same_promises(reduced, expected);
      EXPECT_GT(expect_kept(reduced), 0);
      for (Index p = 0; p < reduced.weights.num_points(); ++p) {
        if (p == kOutside) continue;
        EXPECT_LE(reduced.weights.count(p), 2 * Dim + 2);
      }
      openmesh::sparsify(mesh, 2 * Dim + 2);
      expect_same_promises(binding_of<Dim>(stored<Dim>(mesh)), expected);
      openmesh::restore_rest(mesh, "few");
      for (const auto v : mesh.vertices()) EXPECT_EQ(mesh.point(v), sheet.mesh.point(v));
    }
  }
}

TEST_IN_2D_AND_3D(MeshBinding, MirrorImagesFollowTheirVertices) {
  Sheet<Dim> sheet;
  sheet.bind();
  auto& mesh = sheet.mesh;
  request_status(mesh);
  const auto image = mesh.point(OpenMesh::VertexHandle(6));
  mesh.delete_vertex(OpenMesh::VertexHandle(0));
  mesh.garbage_collection();
  const auto binding = binding_of<Dim>(mesh);
  EXPECT_GT(expect_kept(binding), 0);
  for (const auto v : mesh.vertices()) {
    const auto point = mesh.point(v);
    const Index partner = binding.mirror->partners[static_cast<std::size_t>(v.idx())];
    if (point == image) {
      EXPECT_EQ(partner, -1);
      continue;
    }
    ASSERT_GE(partner, 0);
    const auto other = mesh.point(OpenMesh::VertexHandle(partner));
    EXPECT_NEAR(point[0] + other[0], 1, 1e-12);
    EXPECT_NEAR(point[1], other[1], 1e-12);
  }
}

TEST_IN_2D_AND_3D(MeshBinding, NewVerticesObeyTheMasksOfTheirNeighbors) {
  for (const Index most : {0, 8}) {
    Sheet<Dim> sheet;
    sheet.options.max_influences = most;
    sheet.bind();
    auto& mesh = sheet.mesh;
    openmesh::ReductionOptions few;
    few.into = "few";
    openmesh::sparsify(mesh, 2 * Dim + 2, few);
    // Off the mean of the corners, whose weights do not reproduce it.
    const auto split = [&](int face) {
      auto point = mesh.calc_face_centroid(mesh.face_handle(face));
      point[0] += 0.02;
      const auto vertex = mesh.add_vertex(point);
      mesh.split(mesh.face_handle(face), vertex);
      return vertex.idx();
    };
    const int masked = split(0), free = split(2 * 3);
    split(0);
    for (const std::string weights : {openmesh::kWeights, "few"}) {
      EXPECT_EQ(openmesh::bind_new_vertices(mesh, weights), 3);
      const auto binding = binding_of<Dim>(mesh, weights);
      const PointMasks masks(binding.masks, binding.cage.size(), binding.weights.num_points());
      EXPECT_EQ(masks.forbidden(masked), sheet.right);
      EXPECT_FALSE(masks.at(free));
      EXPECT_EQ(binding.mirror->partners[static_cast<std::size_t>(masked)], -1);
      expect_kept(binding);
      EXPECT_LT((binding.deform(binding.cage.points) - openmesh::points_of<Dim>(mesh))
                    .cwiseAbs()
                    .maxCoeff(),
                1e-12);
      expect_kept(binding.reduced({2 * Dim + 2}));
      openmesh::restore_rest(mesh, weights);
    }
  }
}

// A reader of glTF moves skins as deform() moves the mesh.
TEST_IN_2D_AND_3D(MeshBinding, SkinsMoveAsTheMeshDoes) {
  Sheet<Dim> sheet;
  sheet.bind();
  auto& mesh = sheet.mesh;
  mesh.request_vertex_colors();
  mesh.request_vertex_texcoords2D();
  for (const auto v : mesh.vertices()) {
    mesh.set_color(v, DoubleTri::Color(0, 255, 0));
    mesh.set_texcoord2D(v, {0.25F, static_cast<float>(v.idx())});
  }
  const auto& rest = sheet.sample.cage.points;
  const PointList<Dim> pose = rest + 0.3 * PointList<Dim>::Random(Dim, rest.cols());
  const auto path = scratch_path("skin.glb");
  openmesh::write_skin<Dim>(path, mesh, {rest, pose});
  const GlbFile file(io::read_file(path));
  EXPECT_EQ(static_cast<std::size_t>(file.triangles().cols()), mesh.n_faces());
  EXPECT_EQ(file.attribute("COLOR_0").col(0).head(3), Eigen::Vector3d(0, 1, 0));
  EXPECT_NEAR(file.attribute("TEXCOORD_0")(0, 0), 0.25, 1e-7);
  for (const auto& [time, cage] : {std::pair(0.0, rest), {1.0 / 24, pose}}) {
    openmesh::deform(mesh, cage);
    const PointList<Dim> moved = file.skinned(file.joints(time)).template topRows<Dim>();
    const PointList<Dim> expected = openmesh::points_of<Dim>(mesh)(Eigen::all, file.sources());
    EXPECT_LT((moved - expected).cwiseAbs().maxCoeff(), 1e-6);
  }
  openmesh::restore_rest(mesh);
  EXPECT_NO_THROW(openmesh::write_skin(scratch_path("skin.usda"), mesh));
  EXPECT_THROW(openmesh::write_skin(scratch_path("skin.fbx"), mesh), InputError);
  openmesh::SkinOptions options;
  options.max_influences = 5;
  EXPECT_THROW(openmesh::write_skin(path, mesh, options), OptionError);
  options = {};
  options.weights = "others";
  EXPECT_THROW(openmesh::write_skin(path, mesh, options), InputError);
  EXPECT_THROW(openmesh::write_skin<5 - Dim>(path, mesh, {}), InputError);
  EXPECT_THROW(openmesh::write_skin<Dim>(path, mesh, {PointList<Dim>(Dim, 2)}), InputError);
}

}  // namespace
}  // namespace flbc::testing
