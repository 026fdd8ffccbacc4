// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Exports a mesh with its weights as a skin for engines and viewers. Every control point is a
//! joint.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include <OpenMesh/Core/Utils/color_cast.hh>

#include "flbc/io/model.h"
#include "flbc/openmesh/binding.h"
#include "flbc/openmesh/convert.h"
#include "flbc/openmesh/weights.h"

namespace flbc::openmesh {

//! Options of write_skin().
struct SkinOptions {
  std::string weights = kWeights;  //!< name of the property, in either form
  Index max_influences = 8;        //!< per vertex, 8 or 4; every reader supports 4
  double frames_per_second = 24;   //!< of the poses, if any
};

namespace internal {

//! \param model  without points, which follow from the binding
template <int Dim>
void write_skin_file(const std::string& path, const Binding<Dim>& binding, io::Model model,
                     const std::vector<PointList<Dim>>& poses, const SkinOptions& options);

//! Faces, and vertex attributes from the standard properties of OpenMesh.
template <class Mesh>
io::Model faces_and_attributes(const Mesh& mesh) {
  io::Model model;
  model.soup.polygons = polygons_of(mesh);
  const auto count = static_cast<Eigen::Index>(mesh.n_vertices());
  auto& attributes = model.attributes;
  if (mesh.has_vertex_colors()) {
    attributes.colors.resize(3, count);
    for (const auto v : mesh.vertices()) {
      const auto color = OpenMesh::color_cast<OpenMesh::Vec3f>(mesh.color(v));
      attributes.colors.col(v.idx()) << color[0], color[1], color[2];
    }
  }
  if (mesh.has_vertex_texcoords2D()) {
    attributes.texture_coordinates.resize(2, count);
    for (const auto v : mesh.vertices()) {
      const auto& place = mesh.texcoord2D(v);
      attributes.texture_coordinates.col(v.idx()) << static_cast<double>(place[0]),
          static_cast<double>(place[1]);
    }
    for (const auto& polygon : model.soup.polygons) {
      attributes.corners.emplace_back();
      for (const Index vertex : polygon) attributes.corners.back().push_back({vertex, -1});
    }
  }
  return model;
}

}  // namespace internal

//! Writes the rest mesh as a glTF 2.0 skin (.glb) or a USD skin (.usda), like `flbc export`. The
//! joints are the control points and only translate, so other programs deform the mesh as deform()
//! does, also where weights are masked or mirrored. The current vertex positions have no effect,
//! except for vertices that were not bound, which do not move. Vertex colors and texture
//! coordinates are written if the mesh has them; normals are those of the rest mesh.
//! \param mesh  with weights and the rest cage from bind() or solve() (set_rest_cage())
//! \param poses  an animation: control points, Dim x n each; may be empty
//! \throws InputError if the mesh has no weights or faces, the rest cage is missing or has another
//! dimension, the number of control points differs, or the extension is unknown; OptionError;
//! IoError
template <int Dim, class Mesh>
void write_skin(const std::string& path, const Mesh& mesh, const std::vector<PointList<Dim>>& poses,
                const SkinOptions& options = {}) {
  static_assert(!std::is_same_v<Mesh, TetMesh>, "a skin is a surface: use a TriMesh or PolyMesh");
  internal::refuse_deleted_elements(mesh);
  internal::write_skin_file<Dim>(
      path,
      internal::binding_of<Dim>(mesh, internal::rows_in(mesh, options.weights), options.weights),
      internal::faces_and_attributes(mesh), poses, options);
}

//! The same without an animation.
template <class Mesh>
void write_skin(const std::string& path, const Mesh& mesh, const SkinOptions& options = {}) {
  if (get_rest_cage(mesh, options.weights).rows() == 2) {
    write_skin<2>(path, mesh, {}, options);
  } else {
    write_skin<3>(path, mesh, {}, options);
  }
}

}  // namespace flbc::openmesh
