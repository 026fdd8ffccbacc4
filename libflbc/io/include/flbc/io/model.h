// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Content of model files, independent of their format.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flbc/types.h"

namespace flbc::io {

//! The unmodified points, polylines, and polygons of a file, indices from 0.
struct PolygonSoup {
  std::vector<Vector<3>> points;             //!< a missing third coordinate is 0
  std::vector<std::vector<Index>> polygons;  //!< vertices in order, the first not repeated
  std::vector<std::vector<Index>>
      polylines;  //!< vertices in order; closed if the last equals the first
};

//! Attributes of a polygon corner, in addition to its vertex; -1 = none.
struct CornerReferences {
  Index texture_coordinate = -1;
  Index normal = -1;
};

//! The attributes of a surface. All lists are empty where there are none.
struct SurfaceAttributes {
  PointList<2> texture_coordinates{};  //!< 2 x T, as in the file: the second axis points up
  PointList<3> normals{};              //!< 3 x N, of any length
  //! 3 x P in [0, 1]; empty unless every vertex has a color.
  PointList<3> colors{};
  std::vector<std::vector<CornerReferences>> corners{};  //!< by polygon and corner
};

//! The appearance of polygons, as given in the file.
struct Material {
  std::string name{};
  Vector<3> color = Vector<3>::Constant(0.8);  //!< red, green, blue in [0, 1], linear
  Vector<3> tint = Vector<3>::Ones();          //!< the same where the texture is multiplied by it
  double opacity = 1;                          //!< in [0, 1]
  double roughness = 0.8;                      //!< in [0, 1]
  double metallic = 0;                         //!< in [0, 1]
  std::string texture{};                       //!< path of the color texture; empty for none
  std::string picture{};                       //!< its bytes, if they are in the file of the model
  double alpha_cutoff = 0;  //!< above 0: where the alpha of the texture is below, nothing is shown
};

struct GltfSource;  // a document of which only flbc::io knows the parts

//! A surface with attributes.
struct Model {
  PolygonSoup soup{};
  //! If the file has vertex attributes, column v belongs to vertex v.
  SurfaceAttributes attributes{};
  std::vector<std::string> others{};  //!< other content of the file, as phrases for messages
  std::vector<std::string> notes{};   //!< what the reader does not support, for messages
  bool is_text = true;  //!< whether the file is text, for formats with a binary variant
  //! From .obj with .mtl files, and from .ply with a comment "TextureFile".
  std::vector<Material> materials{};
  std::vector<Index> polygon_materials{};    //!< by polygon, -1 = none; empty if all have none
  std::vector<std::string> missing_files{};  //!< material files that could not be read
  //! The document of a .glb or .gltf file, which results keep; without it they are written anew.
  std::shared_ptr<const GltfSource> gltf{};
};

//! Texture coordinates as vertex attributes.
//! \return 2 x P, 0 for a vertex without polygons; empty if the model has none; no value if a
//! vertex has different values at its corners
std::optional<PointList<2>> texture_coordinates_at_vertices(const Model& model);

//! Normals as vertex attributes.
//! \return 3 x P, as for texture coordinates
std::optional<PointList<3>> normals_at_vertices(const Model& model);

}  // namespace flbc::io
