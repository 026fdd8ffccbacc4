// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Binds the points of a model to a cage in one call.
#pragma once

#include <string>
#include <vector>

#include "flbc/make_domain.h"
#include "flbc/observer.h"
#include "flbc/options.h"
#include "flbc/placement.h"
#include "flbc/quality.h"
#include "flbc/report.h"
#include "flbc/solver.h"
#include "flbc/sparsify.h"

namespace flbc {

//! Options of bind().
struct BindOptions {
  //! Number of vertices of the domain mesh; 0: the minimum that element quality allows. It is
  //! increased if a cage needs more.
  Index vertices = kDefaultVertices;
  //! Method, tolerance, threads.
  SolverOptions solver{};
  //! Of the solve; poll() also during the reduction. What it throws leaves bind().
  Observer observer{};
  Index max_influences = 8;                      //!< per point; 0 = keep all weights
  Reduction reduction = Reduction::kPoisson;     //!< how influences are reduced
  OutsidePoints outside = OutsidePoints::kFail;  //!< points outside the cage
  //! Masks of the points: regions of the model that some control points must not move. Weights are
  //! exactly 0 there, also after the reduction, except on facets of masked control points, which
  //! BindReport::note counts.
  std::vector<Mask> masks{};
  //! Exact mirror (mirror.h): axis of the symmetric cage, 0 to Dim - 1; -1 for none. Weights of
  //! mirrored points are bit-identical, also after the reduction.
  int mirror_axis = -1;
};

//! Report of bind().
struct BindReport {
  SolveReport solve{};   //!< on the domain mesh
  Quality quality{};     //!< of the final weights at the points that they reproduce
  Index outside = 0;     //!< number of points outside the cage
  std::string mesher{};  //!< that made the mesh; empty if it was given
  std::string note{};    //!< MadeDomain::note and PlacedMasks::note()
  double mesh_seconds = 0, solve_seconds = 0, evaluate_seconds = 0, sparsify_seconds = 0;
};

//! Weights of P points by which they follow n control points.
template <int Dim>
struct Binding {
  SparseWeights weights{};  //!< of P points
  //! Dim x P, what is added to weighted control points; no columns if all are zero. Points outside
  //! the cage have an offset, except for OutsidePoints::kExtend.
  PointList<Dim> offsets{};
  std::vector<Index> outside{};  //!< points outside the cage, ascending
  BindReport report{};

  //! The points for moved control points, Dim x n.
  PointList<Dim> deform(const PointList<Dim>& control_points) const;
};

//! Binds points: meshes the interior of the cage, solves, evaluates the weights at the points, and
//! reduces influences. With OutsidePoints::kExtend, points outside keep all their weights, because
//! negative weights cannot be reduced.
//! \param cage  n control points
//! \param points  Dim x P of the model, in the units of the cage
//! \param edges  of the model, along which the reduction leaves no seams; may be empty
//! \param meshers  such as linked_meshers<Dim>()
//! \throws InputError naming the defect of cage or model; OptionError, SolverError
template <int Dim>
Binding<Dim> bind(const Cage<Dim>& cage, const PointList<Dim>& points, const EdgeList& edges,
                  const BindOptions& options, const Meshers<Dim>& meshers);

//! The same with a given domain mesh. \param domain  see normalize_and_validate()
template <int Dim>
Binding<Dim> bind(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                  const PointList<Dim>& points, const EdgeList& edges, const BindOptions& options);

}  // namespace flbc
