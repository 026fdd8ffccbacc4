// SPDX-License-Identifier: BSD-3-Clause
// The sample cages and models of meshes/ keep the promises of meshes/README.md.
#include <filesystem>

#include "flbc/cage_facts.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "support/enclosure_judge.h"
#include "support/mesh_checks.h"

namespace flbc::testing {
namespace {

constexpr double kMargin = 0.02;  // between model and cage, in diagonals of the cage

io::PolygonSoup load(const std::string& name) {
  return io::read_polygons(std::string(FLBC_MESHES_DIR) + "/" + name + ".obj");
}

// A cage, or the surface of a 3D model.
template <int Dim>
Cage<Dim> load_closed(const std::string& name) {
  return std::get<Cage<Dim>>(io::to_cage(load(name), name));
}

// The names, without extension, of the files of a folder that end like this.
std::vector<std::string> names(const std::string& folder, const std::string& ending) {
  std::vector<std::string> found;
  const std::filesystem::path path = std::filesystem::path(FLBC_MESHES_DIR) / folder;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    const std::string name = entry.path().stem().string();
    if (name.size() < ending.size() || entry.path().extension() != ".obj") continue;
    if (name.substr(name.size() - ending.size()) == ending) found.push_back(folder + "/" + name);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string with_ending(const std::string& cage, const std::string& ending) {
  return cage.substr(0, cage.rfind("_cage")) + ending;
}

template <int Dim>
void expect_no_defects(const Cage<Dim>& cage) {
  for (const auto& defect : find_defects(cage)) ADD_FAILURE() << defect.message;
  for (const auto& defect : find_self_intersections(cage)) ADD_FAILURE() << defect.message;
  EXPECT_GT(enclosed_measure(cage), 0);
}

// Moved by the margin along any axis, every vertex is still inside.
template <int Dim>
void expect_inside(const Cage<Dim>& cage, const PointList<Dim>& model) {
  const double step = kMargin * bounding_box_diagonal<Dim>(cage.points);
  for (const Vector<Dim> vertex : model.colwise()) {
    ASSERT_NEAR(winding_number<Dim>(cage, vertex), 1, 1e-9) << vertex.transpose();
    for (int axis = 0; axis < Dim; ++axis) {
      const Vector<Dim> offset = step * Vector<Dim>::Unit(axis);
      ASSERT_NEAR(winding_number<Dim>(cage, vertex + offset), 1, 1e-9) << vertex.transpose();
      ASSERT_NEAR(winding_number<Dim>(cage, vertex - offset), 1, 1e-9) << vertex.transpose();
    }
  }
}

TEST(SamplesTest, PlanarCagesAndModels) {
  const std::vector<std::string> cages = names("2d", "_cage");
  ASSERT_GE(cages.size(), 3u);
  for (const std::string& name : cages) {
    SCOPED_TRACE(name);
    const auto cage = load_closed<2>(name);
    expect_no_defects(cage);
    const Index holes = name == "2d/ring_cage" ? 1 : 0;
    EXPECT_EQ(measure_cage(cage).parts, 1);
    EXPECT_EQ(measure_cage(cage).holes, holes);

    const auto soup = load(with_ending(name, "_model"));
    DomainMesh<2> model{io::to_points<2>(soup, name), CellList<2>(3, soup.polygons.size())};
    for (std::size_t cell = 0; cell < soup.polygons.size(); ++cell) {
      ASSERT_EQ(soup.polygons[cell].size(), 3u);
      for (int k = 0; k < 3; ++k) model.cells(k, cell) = soup.polygons[cell][k];
      EXPECT_GT(signed_measure(model, static_cast<Index>(cell)), 5e-6) << cell;
    }
    const auto topology = build_topology(model);
    validate(model);
    validate(model, topology);
    EXPECT_EQ(model.num_vertices() - topology.num_facets() + model.num_cells(), 1 - holes);
    expect_inside<2>(cage, model.points);
  }
}

TEST(SamplesTest, SpatialCagesAndModels) {
  const std::vector<std::string> cages = names("3d", "_cage");
  ASSERT_GE(cages.size(), 3u);
  for (const std::string& name : cages) {
    SCOPED_TRACE(name);
    const auto cage = load_closed<3>(name), model = load_closed<3>(with_ending(name, "_model"));
    const bool is_ring = name == "3d/torus_cage" || name == "3d/knot_cage";
    for (const auto* surface : {&cage, &model}) {
      expect_no_defects(*surface);
      // Euler's characteristic: every triangle has three sides, every side two triangles.
      EXPECT_EQ(surface->size() - surface->facets.cols() / 2, is_ring ? 0 : 2);
    }
    expect_inside<3>(cage, model.points);
  }
}

template <int Dim>
void expect_poses_differ_in_coordinates_only(const std::string& folder) {
  const std::vector<std::string> poses = names(folder, "_cage_pose");
  ASSERT_GE(poses.size(), 1u);
  for (const std::string& name : poses) {
    SCOPED_TRACE(name);
    const auto pose = load_closed<Dim>(name), cage = load_closed<Dim>(with_ending(name, "_cage"));
    ASSERT_EQ(pose.size(), cage.size());
    EXPECT_EQ(pose.facets, cage.facets);
    EXPECT_GT((pose.points - cage.points).colwise().norm().maxCoeff(),
              0.1 * bounding_box_diagonal<Dim>(cage.points));
    expect_no_defects(pose);
  }
}

TEST(SamplesTest, PosesDifferFromTheirCagesInCoordinatesOnly) {
  expect_poses_differ_in_coordinates_only<2>("2d");
  expect_poses_differ_in_coordinates_only<3>("3d");
}

}  // namespace
}  // namespace flbc::testing
