// SPDX-License-Identifier: BSD-3-Clause
// Common steps of meshers before and after the external library.
#pragma once

#include <cmath>
#include <string>

#include "flbc/cage.h"
#include "flbc/meshing.h"
#include "meshing/isolated_process.h"

namespace flbc {

//! TetGen also merges points closer than this fraction of cage size.
constexpr double kPointTolerance = 1e-8;

//! The control points followed by the points to embed.
//! \throws OptionError if an option is out of range, InputError if a point to embed is not finite,
//! not strictly inside the cage, or coincides with another one or with a control point
template <int Dim>
PointList<Dim> collect_input_points(const Cage<Dim>& cage, const MeshingOptions<Dim>& options);

//! Units in which meshers compute, because the last bits of coordinates decide about a mesh. Cages
//! whose units differ by a power of ten, such as meters and millimeters, get the same vertices:
//! sizes are taken to the decade from 1.4 to 14, where coordinates are rounded to 12 decimals. With
//! more decimals, rounding may still decide.
template <int Dim>
class DecimalUnit {
 public:
  explicit DecimalUnit(const PointList<Dim>& cage);

  //! Cages in this decade, with at most 12 decimals, are unchanged.
  PointList<Dim> scaled(const PointList<Dim>& points) const;

  //! \param input  the first points of the result, before scaled()
  PointList<Dim> restored(const PointList<Dim>& points, const PointList<Dim>& input) const;

  double length() const { return std::pow(10.0, exponent_); }  //!< of this unit

 private:
  int exponent_;
};

//! \throws OptionError if `wanted` vertices (0 = any number) are fewer than `minimum`, by more than
//! the relative `tolerance`
void check_vertex_count(Index wanted, Index minimum, double tolerance);

//! Describes the failure of a mesher process: "gave up", "crashed with ...", "was stopped at the
//! time limit of 60 s (--mesh-timeout)". \return empty if it finished
std::string describe_failure(const ProcessOutcome& outcome, double time_limit);

//! "; the cage is thinnest between ...", for messages; empty if the cage is not thin.
std::string describe_thinnest(const Cage<3>& cage);

//! Sum of the areas or volumes of the cells.
template <int Dim>
double total_measure(const DomainMesh<Dim>& mesh);

//! Validates the mesh and orders its new vertices and its cells along a space-filling curve.
template <int Dim>
void finish_mesh(DomainMesh<Dim>& mesh, Index num_input_points);

}  // namespace flbc
