// SPDX-License-Identifier: BSD-3-Clause
// The surface of a model for rendering: triangles whose corners are vertices with all attributes.
// A model vertex with two texture coordinates becomes two vertices.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "flbc/io/model.h"

namespace flbc::gltf {

//! S vertices and T triangles. Optional attributes have no columns if they are absent.
struct Surface {
  //! Per vertex, the model vertex (column of points) of which it is a copy; ascending.
  std::vector<Index> sources{};
  FacetList<3> triangles{};            //!< 3 x T, counterclockwise seen from the front
  PointList<3> normals{};              //!< 3 x S, of length 1
  PointList<2> texture_coordinates{};  //!< 2 x S, optional, origin at the upper left corner of the
                                       //!< image
  PointList<3> colors{};               //!< 3 x S, optional, linear, in [0, 1]
  std::vector<Index> triangle_materials{};  //!< by triangle, -1 = none; empty if all have none
  std::vector<io::Material> materials{};
  std::vector<std::string> missing_files{};      //!< material files that could not be read
  std::shared_ptr<const io::GltfSource> gltf{};  //!< as of io::Model
};

//! The polygons of a model, cut into triangles. Missing normals are computed as angle-weighted
//! means over the triangles around a vertex. In 2D, triangles are oriented counterclockwise, and
//! all normals are (0, 0, 1). Vertices without a triangle and triangles with a repeated vertex are
//! left out.
//! \throws InputError if no triangle is left
template <int Dim>
Surface surface_of_model(const io::Model& model);

//! The triangles in terms of model vertices. \return 3 x T
FacetList<3> triangles_of_points(const Surface& surface);

}  // namespace flbc::gltf
