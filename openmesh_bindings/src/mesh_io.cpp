// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/mesh_io.h"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/IO/importer/ImporterT.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <fstream>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "flbc/openmesh/silenced.h"

namespace flbc::openmesh {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using Mesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;

// Receives vertices and faces from a reader. The underlying half-edge mesh stores only points and
// attributes. Faces are stored separately, because OpenMesh would skip non-manifold faces with a
// message on standard error.
class SoupImporter : public OpenMesh::IO::ImporterT<Mesh> {
 public:
  using Base = OpenMesh::IO::ImporterT<Mesh>;
  using Base::add_face;

  SoupImporter(Mesh& mesh, std::vector<std::vector<Index>>& polygons)
      : Base(mesh), polygons_(polygons) {}

  OpenMesh::FaceHandle add_face(const VHandles& corners) override {
    std::vector<Index> polygon;
    for (const auto corner : corners) polygon.push_back(corner.idx());
    polygons_.push_back(std::move(polygon));
    return OpenMesh::FaceHandle(static_cast<int>(polygons_.size()) - 1);
  }

  // Faces are not in the mesh, so they cannot have attributes.
  void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle,
                          const std::vector<OpenMesh::Vec2f>&) override {}
  void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle,
                          const std::vector<OpenMesh::Vec3f>&) override {}
  void set_face_texindex(OpenMesh::FaceHandle, int) override {}
  void finish() override {}

 private:
  std::vector<std::vector<Index>>& polygons_;
};

}  // namespace

io::PolygonSoup read_polygons(const std::string& path) {
  const auto extension = io::extension_of(path);
  if (extension == "ply" || extension == "om") return io::ModelFile(path).model().soup;
  if (!std::ifstream(path)) io::read_file(path);  // throws with the system error
  io::PolygonSoup soup;
  Mesh mesh;
  OpenMesh::IO::Options options;
  const SilencedOpenMesh silence;
  SoupImporter importer(mesh, soup.polygons);
  const bool read = OpenMesh::IO::IOManager().read(path, importer, options);
  if (!read) throw InputError(path + ": OpenMesh cannot read this file");
  for (const auto vertex : mesh.vertices()) {
    const auto& point = mesh.point(vertex);
    soup.points.emplace_back(point[0], point[1], point[2]);
    if (!soup.points.back().allFinite()) {
      throw InputError(path + ": vertex " + std::to_string(vertex.idx()) + " is not finite");
    }
  }
  return soup;
}

}  // namespace flbc::openmesh
