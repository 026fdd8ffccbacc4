// SPDX-License-Identifier: BSD-3-Clause
// One HTML file in which a person moves a cage, and the model in it follows.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "flbc/binding.h"
#include "flbc/sparse_weights.h"
#include "model/surface.h"

namespace flbc::view {

//! Most influences of a point that a page holds.
constexpr Index kMostInfluences = 16;

//! Reduces the points that have more than `most` influences by sparsify(), with the masks of the
//! binding; all others keep their weights as they are, negative ones too.
//! \param most  Dim + 1 .. kMostInfluences \return weights of the points
//! \throws OptionError if `most` is out of range; InputError as sparsify()
template <int Dim>
SparseWeights limit_influences(const Binding<Dim>& binding, Index most);

template <int Dim>
struct ShownCage {
  PointList<Dim> points{};                    //!< Dim x n, at rest
  FacetList<Dim> facets{};                    //!< Dim x m
  std::vector<std::array<Index, 2>> edges{};  //!< of its polygons, each once
  //! The file, if it is OBJ: poses are saved as this text with other coordinates.
  std::string text{};
  //! 2D: whether each three facets, from a corner by two handles to the next corner, are a cubic
  //! Bezier curve.
  bool is_curved = false;
};

template <int Dim>
struct ShownModel {
  PointList<Dim> points{};  //!< Dim x P
  gltf::Surface surface{};  //!< of these points; without triangles points are shown
};

template <int Dim>
struct ShownPose {
  std::string name{};
  double time = 0;          //!< seconds, ascending
  PointList<Dim> points{};  //!< Dim x n
};

template <int Dim>
struct PageContent {
  std::string title{};
  std::string model_file{};  //!< these three as the command that the page offers has them
  std::string weights_file{};
  std::string cage_file{};
  ShownCage<Dim> cage{};
  PointList<Dim> points{};  //!< Dim x P, of the model; they rest there, whatever the weights
  gltf::Surface surface{};  //!< of these points; without triangles points are shown
  SparseWeights weights{};  //!< of P points, at most kMostInfluences of each
  std::vector<ShownPose<Dim>> poses{};
  int up = 1;             //!< 3D: axis that points up at first
  double front = 0;       //!< 3D: azimuth of the front in degrees, a multiple of 90
  std::string picture{};  //!< data URI of a texture in place of all materials, or empty
};

//! The edges of a cage's polygons; of its facets if there are none.
template <int Dim>
std::vector<std::array<Index, 2>> edges_of_cage(const std::vector<std::vector<Index>>& polygons,
                                                const FacetList<Dim>& facets);

//! The content as JSON that decodeContent() of the page reads. Errors as for make_page().
template <int Dim>
std::string make_content(const PageContent<Dim>& content);

//! The page, which needs no other file and no network.
//! \throws InputError for more than 65535 control points
template <int Dim>
std::string make_page(const PageContent<Dim>& content);

}  // namespace flbc::view
