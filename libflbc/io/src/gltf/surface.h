// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The surface of a model as graphics cards take it: triangles whose corners are vertices with all
//! their attributes, so that a model's vertex with two texture coordinates becomes two.
#pragma once

#include <vector>

#include "flbc/io/model.h"

namespace flbc::gltf {

//! S vertices and T triangles. Optional attributes have no columns if they are absent.
struct Surface {
  //! Per vertex the model's vertex (its column among the points) that it is a copy of; ascending.
  std::vector<Index> sources{};
  FacetList<3> triangles{};            //!< 3 x T, counterclockwise seen from the front
  PointList<3> normals{};              //!< 3 x S, of length 1
  PointList<2> texture_coordinates{};  //!< 2 x S, optional, from the picture's upper left corner
  PointList<3> colors{};               //!< 3 x S, optional, linear, in [0, 1]
  std::vector<Index> triangle_materials{};   //!< by triangle, -1 = none; empty if all have none
  std::vector<io::Material> materials{};
  std::vector<std::string> missing_files{};  //!< of materials, that could not be read
};

//! The polygons of a model, cut into triangles. Normals the file does not have are the means of the
//! triangles round a vertex, weighted by their angles there. In 2D triangles are turned
//! counterclockwise, and all normals are (0, 0, 1). Vertices without a triangle are left out, and
//! so are triangles that have a vertex twice.
//! \throws InputError if no triangle is left
template <int Dim>
Surface surface_of_model(const io::Model& model);

//! The triangles by the model's own vertices. \return 3 x T
FacetList<3> triangles_of_points(const Surface& surface);

}  // namespace flbc::gltf
