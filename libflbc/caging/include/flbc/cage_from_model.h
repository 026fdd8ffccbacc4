// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Makes a cage for a model. Implemented in the optional component `caging`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/errors.h"

namespace flbc {

//! Mirror symmetry of a cage.
enum class CageSymmetry {
  kNone,
  kX,  //!< across the plane (2D: line) x = constant through the center of the model
  kY,
  kZ,    //!< 3D only
  kAuto  //!< such a plane if the model vertices are symmetric about it within 1% of model size
};

//! The names of CageSymmetry, in its order.
constexpr const char* kSymmetryNames[] = {"none", "x", "y", "z", "auto"};

//! \throws OptionError if the name is unknown
inline CageSymmetry symmetry_named(const std::string& name) {
  for (int k = 0; k < 5; ++k) {
    if (name == kSymmetryNames[k]) return static_cast<CageSymmetry>(k);
  }
  throw OptionError("symmetry must be one of none, x, y, z, auto, not " + name);
}

//! Steps of cage_from_model(), in this order.
enum class CagingStage {
  kSimplify,  //!< large models only
  kWrap,
  kReduce,  //!< collapses edges of the wrap
  kCheck
};

inline const char* name_of(CagingStage stage) {
  constexpr const char* kNames[] = {"simplifying the model", "wrapping the model",
                                    "reducing control points", "checking the cage"};
  return kNames[static_cast<int>(stage)];
}

//! The largest density of CagingOptions; the smallest is its inverse.
constexpr double kMaxCageDensity = 100;

//! Options of cage_from_model().
struct CagingOptions {
  //! Maximum number, >= Dim + 1. 0: chosen by shape, 12 to 60 in 2D. In 3D the smallest number
  //! whose cage stays close to the model, 8 to 300.
  Index control_points = 0;
  double offset = 0;  //!< distance from the model, in its units; 0: chosen by the number of control
                      //!< points
  CageSymmetry symmetry = CageSymmetry::kAuto;
  //! At each point of the model: control points per length (2D) or area, relative to a usual cage.
  //! Empty: 1. kAuto needs a symmetric density; otherwise the larger one of both sides counts.
  Eigen::VectorXd density{};
  //! Called when a stage begins and during it, with its progress in [0, 1]. Must not throw.
  std::function<void(CagingStage stage, double done)> stage{};
};

//! 3D cages stay within these limits if the requested number of control points permits it.
constexpr Index kMaxCageValence = 12;  //!< edges at a control point
constexpr double kMaxCageDistance =
    0.12;                             //!< of a control point from the model, relative to its size
constexpr double kMaxCageVolume = 3;  //!< relative to that of the model; for the default number

//! A gap between parts of a model that the cage does not keep open, so that they move together.
template <int Dim>
struct BridgedGap {
  Vector<Dim> place;  //!< inside it
  double width;       //!< in model units
};

//! A cage and its properties.
template <int Dim>
struct ModelCage {
  Cage<Dim> cage;             //!< counterclockwise (2D), outward normals (3D)
  double offset = 0;          //!< in model units
  int symmetry_axis = -1;     //!< 0, 1, 2: axis normal to the symmetry plane; -1: none
  double symmetry_place = 0;  //!< coordinate of the symmetry plane
  double mean_distance = 0;   //!< between cage and model, in model units
  double max_distance = 0;    //!< of a control point from the model, in model units
  Index max_valence = 0;      //!< edges at a control point
  double volume_ratio =
      0;  //!< 3D: volume of the cage over that of the model; 0: the model is open or has none
  //! Largest first. Only of 3D models, with a length of at least 20% of model size, wider
  //! than 0.4% of it, and narrower than the parts next to them.
  std::vector<BridgedGap<Dim>> bridged_gaps{};
  bool may_part = false;  //!< whether more control points may keep such gaps open
};

//! A given cage, with the gaps of a model that it bridges; the other properties are not set.
//! \param points, facets  see cage_from_model()
//! \throws InputError if a point is not finite, or an index is out of range
template <int Dim>
ModelCage<Dim> with_bridged_gaps(const Cage<Dim>& cage, const PointList<Dim>& points,
                                 const FacetList<Dim>& facets);

//! "the cage bridges a gap of width 0.1 near (1, 2, 3), and ..."; empty if there is none.
template <int Dim>
std::string describe_bridged_gaps(const ModelCage<Dim>& made);

//! Makes a closed, manifold cage without self-intersections. Every vertex, edge, and facet of the
//! model is strictly inside, which is verified exactly. The function wraps the model (3D: alpha
//! wrapping; 2D: a fine grid) and collapses edges of the wrap while it still encloses the model.
//! If the wrap bridges narrow gaps of a 3D model, a finer one is tried.
//! Parts that are far apart may get separate closed surfaces. The result is reproducible.
//! \param points  Dim x P, finite
//! \param facets  Dim x F, edges or triangles; they may be open, non-manifold, intersecting, or
//! degenerate. Repeated corners describe segments or points. Points without a facet are enclosed
//! \throws InputError if the model has no extent, is too far from the origin for its size, or cannot
//! be enclosed, or there is not one density per point in range; OptionError
template <int Dim>
ModelCage<Dim> cage_from_model(const PointList<Dim>& points, const FacetList<Dim>& facets,
                               const CagingOptions& options = {});

}  // namespace flbc
