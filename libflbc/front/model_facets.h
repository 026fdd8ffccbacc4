// SPDX-License-Identifier: BSD-3-Clause
// Models as cages are made round them, and cages as files.
#pragma once

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "flbc/domain_mesh.h"
#include "flbc/io/cage_io.h"
#include "flbc/types.h"

namespace flbc::app {

//! The points of a model with the edges (2D) or triangles (3D) between them. In 3D edges are
//! triangles that repeat a corner.
template <int Dim>
struct ModelFacets {
  PointList<Dim> points;
  FacetList<Dim> facets;
  double height = 0;            //!< 2D: the z of all points
  std::vector<Index> unused{};  //!< vertices of no face or polyline that were left out, ascending

  //! Vertices of the file.
  Index num_vertices() const { return static_cast<Index>(points.cols() + unused.size()); }
  //! Of numbers for all of them, those of the points.
  Eigen::VectorXd left_of(const Eigen::VectorXd& numbers) const {
    std::vector<Index> left;
    for (Index v = 0; v < numbers.size(); ++v) {
      if (!std::binary_search(unused.begin(), unused.end(), v)) left.push_back(v);
    }
    return numbers(left);
  }
};

using AnyModelFacets = std::variant<ModelFacets<2>, ModelFacets<3>>;

//! Of a model's file, 2D if all points have the same z; or the silhouette of a picture. Of Gaussian
//! splats, points that enclose their centers. Vertices of no face or polyline are left out if there
//! are others. \throws IoError, InputError, OptionError
AnyModelFacets load_model_facets(const std::string& path);

//! Whether the name is that of a picture that can be read: .png, .jpg, or .jpeg.
bool is_picture_file(const std::string& path);

//! The outline of the pixels of a picture that are not transparent: their alpha is at least 1/32
//! of the highest.
//! \throws IoError; InputError if the file is no such picture, or has no pixel that is transparent
//! or none that is not
ModelFacets<2> load_silhouette(const std::string& path);

//! Whether each pixel of a picture is to be seen, row by row from the bottom.
struct Mask {
  Index width = 0, height = 0;
  int lowest_alpha = 255;
  std::vector<bool> pixels{};

  bool at(Index x, Index y) const {
    return x >= 0 && y >= 0 && x < width && y < height && pixels[x + std::size_t(y) * width];
  }
};

//! Their outline. A pixel is a unit square; the lower left corner of the picture is at the origin.
//! \param path  for messages \throws InputError if none of the pixels is to be seen, or all are
ModelFacets<2> outline_of(const Mask& mask, const std::string& path);

//! Triangles of all polygons, and segments, which repeat a corner.
FacetList<3> triangles_of(const io::PolygonSoup& soup);

//! The same, and points that belong to none of them: ModelElements::corners.
FacetList<3> elements_of(const io::PolygonSoup& soup);

//! A model as its elements. \throws IoError, InputError
template <int Dim>
ModelElements<Dim> load_model_elements(const std::string& path);

//! Writes a sound cage: .obj, in 3D also .off and .ply. \param height  2D: the z of all points
template <int Dim>
void write_cage(const std::string& path, const Cage<Dim>& cage, double height = 0);

//! \throws OptionError before any work is done if write_cage() could not write the file
template <int Dim>
void require_cage_writable(const std::string& path);

}  // namespace flbc::app
