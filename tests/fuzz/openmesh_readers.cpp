// SPDX-License-Identifier: BSD-3-Clause
// Readers of .om files, and of properties in them.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <sstream>
#include <string>

#include "flbc/io/model_file.h"
#include "flbc/openmesh/influences.h"
#include "flbc/openmesh/wide_property.h"
#include "fuzz/reader.h"

namespace flbc::fuzz {
namespace {

void read_om(const std::string& path) {
  const io::ModelFile file(path);
  const auto& soup = file.model().soup;
  for (const auto& point : soup.points) require(point.allFinite(), "points are finite");
  for (const auto& polygon : soup.polygons) {
    for (const Index vertex : polygon) {
      require(vertex >= 0 && vertex < static_cast<Index>(soup.points.size()), "vertices in range");
    }
  }
}

std::string om_file() {
  OpenMesh::PolyMesh_ArrayKernelT<> mesh;
  mesh.request_vertex_normals();
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    mesh.set_normal(mesh.add_vertex({float(x), float(y), 0}), {0, 0, 1});
  }
  mesh.add_face(mesh.vertex_handle(0), mesh.vertex_handle(1), mesh.vertex_handle(2));
  mesh.add_face(mesh.vertex_handle(0), mesh.vertex_handle(2), mesh.vertex_handle(3));
  return written("a.om", [&](const std::string& path) {
    OpenMesh::IO::write_mesh(mesh, path, OpenMesh::IO::Options::VertexNormal);
  });
}

constexpr std::size_t kElements = 3;

template <class Scalar>
void read_rows(const std::string& path) {
  std::istringstream in(get_file(path));
  openmesh::RowBlock<Scalar> rows;
  rows.resize(kElements);
  openmesh::restore_block(in, false, "rows", rows);
  require(rows.size() == kElements, "there are as many elements as before");
}

void read_influences(const std::string& path) {
  std::istringstream in(get_file(path));
  openmesh::InfluenceBlock block;
  block.resize(kElements);
  openmesh::restore_block(in, false, "influences", block);
  require(block.size() == kElements, "there are as many elements as before");
  for (std::size_t j = 0; j < block.size() * block.most(); ++j) {
    require(block.control_points()[j] < block.num_control_points(), "control points in range");
  }
}

template <class Scalar>
std::string stored_rows() {
  openmesh::RowBlock<Scalar> rows(2, 3);
  rows.resize(kElements);
  std::ostringstream out;
  openmesh::store_block(out, false, "rows", rows);
  return out.str();
}

std::string stored_influences() {
  openmesh::InfluenceBlock block(5, 2);
  block.resize(kElements);
  std::ostringstream out;
  openmesh::store_block(out, false, "influences", block);
  return out.str();
}

}  // namespace

std::vector<Reader> openmesh_readers() {
  return {{"om", "input.om", read_om, {om_file()}},
          {"rows", "input.rows", read_rows<double>, {stored_rows<double>()}},
          {"rows_single", "input.rows", read_rows<float>, {stored_rows<float>()}},
          {"influences", "input.pairs", read_influences, {stored_influences()}}};
}

}  // namespace flbc::fuzz
