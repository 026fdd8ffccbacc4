// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A mesh with its weights as a skin for engines and viewers, in which every control point is a joint.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include <OpenMesh/Core/Utils/color_cast.hh>

#include "flbc/io/model.h"
#include "flbc/openmesh/convert.h"
#include "flbc/openmesh/sparsify.h"
#include "flbc/openmesh/weights.h"

namespace flbc::openmesh {

//! How write_skin() works.
struct SkinOptions {
  std::string weights = kWeights;  //!< the property, in either form
  Index max_influences = 8;        //!< per vertex in the file, 8 or 4, which every reader knows
  double frames_per_second = 24;   //!< of the poses, if there are any
};

namespace internal {

//! A model at rest with its weights (n x P) and cage.
template <int Dim>
struct SkinInput {
  PointList<Dim> cage;
  WeightMatrix weights;
  io::Model model;  //!< without points: these are where the weights place them
};

template <int Dim>
void write_skin_file(const std::string& path, SkinInput<Dim> input,
                     const std::vector<PointList<Dim>>& poses, const SkinOptions& options);

//! Faces, and what OpenMesh's standard properties say of vertices.
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

//! Writes the mesh at rest as a glTF 2.0 skin (.glb) or for USD (.usda), as flbc export does: its
//! joints are the control points, which only translate, so that programs move it as deform() does.
//! Where the vertices are now does not matter. Colours and texture coordinates of vertices are
//! written if the mesh has them; normals are those at rest. Vertices that bind() found outside the
//! cage stand where their weights place them, on it.
//! \param mesh  with weights and the cage that bind() or solve() left with them (set_rest_cage())
//! \param poses  an animation: the control points, Dim x n each; may be empty
//! \throws InputError if the mesh has no weights or faces, if the cage is missing or of another
//! dimension, for another number of control points, or for another extension; OptionError; IoError
template <int Dim, class Mesh>
void write_skin(const std::string& path, const Mesh& mesh, const std::vector<PointList<Dim>>& poses,
                const SkinOptions& options = {}) {
  static_assert(!std::is_same_v<Mesh, TetMesh>, "a skin is a surface: use a TriMesh or PolyMesh");
  internal::refuse_deleted_elements(mesh);
  const auto cage = get_rest_cage(mesh, options.weights);
  internal::require_rest_cage(cage, options.weights);
  if (cage.rows() != Dim) {
    throw InputError("the cage of the weights '" + options.weights + "' has " +
                     std::to_string(cage.rows()) + " dimensions, the poses have " +
                     std::to_string(Dim));
  }
  internal::write_skin_file<Dim>(path,
                                 {PointList<Dim>(cage), get_weights(mesh, options.weights),
                                  internal::faces_and_attributes(mesh)},
                                 poses, options);
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
