// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Content of model files, whatever their format.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flbc/types.h"

namespace flbc::io {

//! A file's points, polylines and polygons as they stand, indices from 0.
struct PolygonSoup {
  std::vector<Vector<3>> points;             //!< missing third coordinates are 0
  std::vector<std::vector<Index>> polygons;  //!< vertices in order, the first not repeated
  std::vector<std::vector<Index>>
      polylines;  //!< vertices in order; closed if the last is the first
};

//! Attributes of a polygon's corner beside its vertex; -1 = none.
struct CornerReferences {
  Index texture_coordinate = -1;
  Index normal = -1;
};

//! The attributes of a surface. All lists are empty where there are none.
struct SurfaceAttributes {
  PointList<2> texture_coordinates{};  //!< 2 x T, as in the file: the second one points up
  PointList<3> normals{};              //!< 3 x N, of any length
  //! 3 x P in [0, 1]; empty unless every vertex has a colour.
  PointList<3> colors{};
  std::vector<std::vector<CornerReferences>> corners{};  //!< by polygon and corner
};

//! How polygons look, as far as files say it.
struct Material {
  std::string name{};
  Vector<3> color = Vector<3>::Constant(0.8);  //!< red, green, blue in [0, 1], linear
  double opacity = 1;                          //!< in [0, 1]
  double roughness = 0.8;                      //!< in [0, 1]
  double metallic = 0;                         //!< in [0, 1]
  std::string texture{};  //!< path of the picture of its colours; empty for none
};

//! Polygons with what their vertices and corners carry.
struct Model {
  PolygonSoup soup{};
  //! Where a file has attributes of vertices, those of vertex v are columns v.
  SurfaceAttributes attributes{};
  std::vector<std::string> others{};  //!< what else is in the file, as phrases for messages
  bool is_text = true;  //!< whether the file is text, where its format leaves a choice
  //! Of .obj with their .mtl files, and of .ply with a comment "TextureFile".
  std::vector<Material> materials{};
  std::vector<Index> polygon_materials{};    //!< by polygon, -1 = none; empty if all have none
  std::vector<std::string> missing_files{};  //!< of materials, that could not be read
};

//! Texture coordinates as an attribute of vertices.
//! \return 2 x P, 0 where a vertex is in no polygon; empty if the model has none; nothing if some
//! vertex has not the same value at all its corners
std::optional<PointList<2>> texture_coordinates_at_vertices(const Model& model);

//! Normals as an attribute of vertices.
//! \return 3 x P, likewise
std::optional<PointList<3>> normals_at_vertices(const Model& model);

}  // namespace flbc::io
