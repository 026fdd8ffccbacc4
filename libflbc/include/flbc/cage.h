// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The cage: control points and the facets between them.
#pragma once

#include <string>
#include <vector>

#include "flbc/bounding_box.h"
#include "flbc/types.h"

namespace flbc {

//! A closed polygon (2D: one or more closed polylines; inner ones are holes) or a closed
//! triangulated surface (3D). Each loop or shell needs a consistent orientation; the coordinates do
//! not depend on which.
template <int Dim>
struct Cage {
  PointList<Dim> points;  //!< Dim x n, control points c_1 .. c_n
  FacetList<Dim> facets;  //!< Dim x m, edges or triangles

  //! Number n of control points.
  Index size() const { return static_cast<Index>(points.cols()); }
};

//! Kinds of defects, for programs that handle some of them.
enum class DefectKind {
  kCount,             //!< too few control points or facets
  kNonFinite,         //!< a coordinate is not finite
  kExtent,            //!< size or distance from the origin out of range
  kIndex,             //!< a facet with an invalid or repeated control point
  kCoincident,        //!< two control points at the same place
  kUnreferenced,      //!< a control point without facets
  kFlat,              //!< all control points on one line or plane
  kDegenerate,        //!< a facet without length or area
  kDuplicate,         //!< two equal facets
  kOpen,              //!< a boundary of the cage
  kNonManifold,       //!< too many facets meet, or separate fans of them
  kOrientation,       //!< neighbors of opposite orientation
  kSelfIntersection,  //!< two facets intersect
};

//! One defect of a cage or mesh.
struct Defect {
  std::string message;            //!< description with element numbers (from 0) and coordinates
  std::vector<Index> vertices{};  //!< affected vertices
  std::vector<Index> facets{};    //!< affected facets
  DefectKind kind = DefectKind::kCount;
};

//! Looks for every defect that can be found without computing intersections:
//! - too few or non-finite control points;
//! - a size outside 1e-30 to 1e30, or a distance from the origin above 2e8 times the size;
//! - invalid facet indices, duplicate or unreferenced control points;
//! - edges of length zero, degenerate triangles;
//! - open or non-manifold edges and vertices;
//! - inconsistent orientation (3D only).
//! \param cage  any
//! \param limit  maximum number of defects to return
//! \return at most `limit` defects, the most fundamental first; empty for a valid cage
template <int Dim>
std::vector<Defect> find_defects(const Cage<Dim>& cage, std::size_t limit = 16);

//! Throws if a cage is defective.
//! \param cage  any
//! \throws InputError with the first defect that find_defects() finds
template <int Dim>
void validate(const Cage<Dim>& cage);

extern template struct Cage<2>;
extern template struct Cage<3>;

}  // namespace flbc
