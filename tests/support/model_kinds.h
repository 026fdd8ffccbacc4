// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Files of OpenMesh's in all formats of models.
#pragma once

#include "flbc/io/files.h"
#include "flbc/io/model_file.h"
#include "support/io_files.h"
#include "support/openmesh_model.h"

namespace flbc::testing {

//! A kind of file. OpenMesh writes no colors to .obj.
struct ModelKind {
  const char* file;
  int options;

  //! The attributes of vertices in it.
  OpenMesh::IO::Options attributes() const {
    auto result = all_attributes();
    if (io::extension_of(file) == "obj") result -= OpenMesh::IO::Options::VertexColor;
    return result;
  }
};

//! All but .stl.
constexpr ModelKind kModelKinds[] = {
    {"text.ply", 0},
    {"binary.ply", OpenMesh::IO::Options::Binary},
    {"big.ply", OpenMesh::IO::Options::Binary | OpenMesh::IO::Options::MSB},
    {"a.off", 0},
    {"a.obj", 0}};

//! A turn about the z axis by a right angle and a shift, exact in single precision.
inline PointList<3> turned(const PointList<3>& points) {
  PointList<3> result(3, points.cols());
  result << -points.row(1).array() + 4, points.row(0).array() - 2, points.row(2);
  return result;
}
inline OpenMesh::Vec3d turned(const OpenMesh::Vec3d& normal) {
  return {-normal[1], normal[0], normal[2]};
}

//! A test with files of these kinds.
class ModelFileTest : public FolderTest {
 protected:
  void write_kind(const OpenMeshModel& mesh, const ModelKind& kind) const {
    auto options = kind.attributes();
    options += OpenMesh::IO::Options(kind.options);
    write_by_openmesh(mesh, path(kind.file), options);
  }

  //! The box in triangles, with their normals. \return the path
  std::string write_stl(const std::string& name, bool is_binary) const {
    using OpenMesh::IO::Options;
    auto mesh = box_with_attributes();
    mesh.triangulate();
    mesh.update_normals();
    write_by_openmesh(mesh, path(name), Options(is_binary ? int(Options::Binary) : 0));
    return path(name);
  }

  io::ModelFile open(const std::string& name, const std::string& content) const {
    return io::ModelFile(make(name, content));
  }

  //! The content of a file with its vertices elsewhere.
  template <int Dim>
  std::string rewritten(const io::ModelFile& file, const PointList<Dim>& points) const {
    std::ostringstream out;
    file.write(out, points);
    return out.str();
  }
};

}  // namespace flbc::testing
