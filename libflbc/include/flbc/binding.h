// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Binds the points of a model to a cage. A Binding is the result: weights with all that belongs to
//! them, so that whatever is made of it keeps what it promises.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/gradients.h"
#include "flbc/make_domain.h"
#include "flbc/masks.h"
#include "flbc/mirror.h"
#include "flbc/options.h"
#include "flbc/placement.h"
#include "flbc/pointwise.h"
#include "flbc/quality.h"
#include "flbc/report.h"
#include "flbc/sparse_weights.h"
#include "flbc/sparsify.h"
#include "flbc/types.h"

namespace flbc {

//! Options of a Rig.
struct BindOptions {
  //! Number of vertices of the domain mesh; 0: the minimum that element quality allows. It is
  //! increased if a cage needs more.
  Index vertices = kDefaultVertices;
  //! Method, tolerance, threads.
  SolverOptions solver{};
  //! Other coordinates instead, which read only SolverOptions::threads and non_negative.
  std::optional<Coordinates> coordinates{};
  //! n x F: these functions phi instead of those of SolverOptions::phi, for a given mesh of F
  //! cells; empty: none.
  WeightMatrix phi{};
  //! Of the solve; poll() also during the reduction. What it throws leaves Rig::bind().
  Observer observer{};
  Index max_influences = 8;                   //!< per point; 0 = keep all weights
  Reduction reduction = Reduction::kPoisson;  //!< how influences are reduced
  //! Points outside the cage. With kFail, those without an edge may be there nevertheless, if
  //! others have edges: they follow the nearest point of the cage.
  OutsidePoints outside = OutsidePoints::kFail;
  //! Masks of the points: regions of the model that some control points must not move. Weights are
  //! exactly 0 there, also after the reduction, except on facets of masked control points, which
  //! BindReport::note counts.
  std::vector<Mask> masks{};
  //! Solid regions of the points, each of which moves by one affine map in every pose, also after
  //! the reduction. Weights there are the nearest ones that are >= 0; a control point that is
  //! masked at a point of a region moves none of its points. Along the edges, weights change
  //! smoothly over a band around a region.
  std::vector<std::vector<Index>> solid{};
  //! Exact mirror (mirror.h): axis of the symmetric cage, 0 to Dim - 1; -1 for none. Weights of
  //! mirrored points are bit-identical, also after the reduction.
  int mirror_axis = -1;
};

//! Report of a binding.
struct BindReport {
  SolveReport solve{};    //!< on the domain mesh
  std::string method{};   //!< name of the method or of the coordinates
  std::string options{};  //!< those that the result depends on, for people
  Quality quality{};      //!< of the final weights at the points that they reproduce
  Index outside = 0;      //!< number of points outside the cage
  std::string mesher{};   //!< that made the mesh; empty if it was given
  std::string note{};     //!< MadeDomain::note, PlacedMasks::note(), and the solid regions
  double mesh_seconds = 0, solve_seconds = 0, evaluate_seconds = 0, sparsify_seconds = 0;
};

//! How a deformation ends where a mesh passes through its cage (Binding::joined()).
struct Joint {
  //! Sum of the weights of control points that may move, in (0, 1], from which on nothing changes.
  double mass = 0.5;
  //! Whether second derivatives are continuous as well.
  bool is_curvature = false;

  //! s(min(1, m / mass)), by which the displacement is multiplied. \param m  >= 0
  double factor(double m) const;
};

//! Reads "smooth", "curvature", or one of them with a mass, as in "smooth:0.3".
//! \throws OptionError naming the text
Joint parse_joint(const std::string& text);

//! What Binding::fit() looks for.
struct FitOptions {
  std::vector<Index> points{};  //!< with targets, each once; empty: all
  std::vector<Index> held{};    //!< control points that stay at rest
  double stiffness = 1e-5;      //!< >= 0, relative: neighbors in the cage move alike
};

template <int Dim>
struct Fit {
  PointList<Dim> control_points{};  //!< Dim x n
  double rms = 0;                   //!< of the distances to the targets
  double largest = 0;               //!< of these distances
  Index worst = -1;                 //!< the point with the largest
  double condition = 0;             //!< largest over smallest eigenvalue of the equations
};

//! The P points of a model bound to a cage of n control points. Its functions keep what the weights
//! promise, or refuse: masked weights stay exactly 0, mirrored ones bit-identical, solid regions
//! affine, sums 1, points reproduced, and points outside follow their policy. A Rig makes bindings,
//! and flbc/io reads and writes them (io/binding_file.h).
template <int Dim>
struct Binding {
  Cage<Dim> cage{};         //!< at rest; without facets if they are not known
  SparseWeights weights{};  //!< of P points
  PointList<Dim> points{};  //!< Dim x P at rest, as the weights reproduce them
  //! Dim x P, what is added to weighted control points; no columns if all are zero. Points outside
  //! the cage have an offset, except for OutsidePoints::kExtend.
  PointList<Dim> offsets{};
  EdgeList edges{};           //!< of the model, along which a reduction leaves no seams
  std::vector<Mask> masks{};  //!< of the points; these weights are 0
  std::vector<std::vector<Index>> solid{};  //!< regions of the points that move by one affine map
  std::optional<Mirror> mirror{};
  OutsidePoints policy = OutsidePoints::kFail;  //!< for points outside the cage
  std::vector<Index> outside{};                 //!< points outside the cage, ascending
  DomainMesh<Dim> domain{};        //!< of the interior of the cage, V vertices; may be empty
  SparseWeights domain_weights{};  //!< of V points
  BindReport report{};
  std::vector<Index> held{};  //!< control points that must stay at rest, ascending (joined())

  //! Dim x P: where the points of the model rest.
  PointList<Dim> rest() const;
  //! The same for a point in [0, P).
  Vector<Dim> rest_of(Index p) const;

  //! The points for moved control points: x + sum_i w_i (c'_i - c_i). Points whose control points
  //! rest stay where they are, to the bit.
  //! \param control_points  Dim x n \return Dim x P
  //! \throws InputError if the number of control points differs, or naming one that is held and
  //! has moved
  PointList<Dim> deform(const PointList<Dim>& control_points) const;

  //! The same, for every frame: no memory is allocated for points.
  //! \param moved  Dim x P, receives the points
  //! \throws InputError also if moved has another size
  void deform_into(const PointList<Dim>& control_points, Eigen::Ref<PointList<Dim>> moved) const;

  //! Where other points move: transferred(points, {}, outside).deform(control_points), in the
  //! memory that a part of the points needs. Those of a mirror or of solid regions are one part.
  //! \param points  Dim x Q, in the units of the cage \throws InputError as both
  PointList<Dim> deform(const PointList<Dim>& control_points, const PointList<Dim>& points,
                        OutsidePoints outside) const;

  //! The derivatives of a function of the points by the control points: the transpose of deform(),
  //! dJ/dc_i = sum over points of w_i dJ/dx. Those of held control points are 0.
  //! \param gradients  dJ/dx, Dim x P \return Dim x n
  //! \throws InputError if the number of points differs, or a number is not finite
  PointList<Dim> adjoint(const PointList<Dim>& gradients) const;

  //! The pose of the cage that moves points to targets, in the sense of least squares:
  //! c' = c + (W^T W + lambda L)^-1 W^T (y - x), with the graph Laplacian L of the cage and lambda
  //! relative to the mean diagonal of W^T W.
  //! \param targets  y, Dim x number of points
  //! \throws OptionError, InputError naming what is not valid, or the control point that the targets
  //! do not determine without stiffness
  Fit<Dim> fit(const PointList<Dim>& targets, const FitOptions& options = {}) const;

  //! The same binding with a smooth end where the mesh passes through the cage and points outside
  //! stay. The control points of the facets there are held; m is the sum of the weights of all
  //! others, and their displacement u becomes s(min(1, m / mass)) u with s(t) = t (2 - t), or
  //! 6 t^2 - 8 t^3 + 3 t^4 for continuous curvature. Value and slope are 0 at the border. There is
  //! no domain mesh then.
  //! \throws OptionError; InputError if no edge passes through the cage, nothing can move,
  //! or there are solid regions
  Binding joined(const Joint& joint) const;

  //! The Jacobians of the deformation at the points, from smooth gradients of the weights on the
  //! domain mesh (gradients.h). Points that do not move have the identity.
  //! \param control_points  Dim x n \return (Dim Dim) x P, each column has J column by column
  //! \throws InputError if the binding has no domain mesh
  Eigen::MatrixXd jacobians(const PointList<Dim>& control_points) const;

  //! The same for many poses.
  PointJacobians<Dim> point_jacobians() const;

  //! Reduces influences by reduce_influences(). Masks and mirror are kept. Points outside keep all
  //! weights of OutsidePoints::kExtend, because negative weights cannot be reduced. All points of a
  //! solid region have the same influences, regardless of the threshold.
  //! \param limits  without masks \param poses  Dim x n each, may be empty
  //! \throws OptionError, InputError as reduce_influences(), or naming a solid region that so few
  //! control points do not surround
  Binding reduced(const SparsifyOptions& limits, const std::vector<PointList<Dim>>& poses = {},
                  Reduction reduction = Reduction::kPoisson) const;

  //! A binding of other points in the same cage, evaluated on the domain mesh. A weight is masked
  //! where it is masked at all ends of the nearest edge of this model; solid regions as well.
  //! \param to  Dim x Q, in the units of the cage \param edges  between them, may be empty
  //! \throws InputError if the binding has no domain mesh, or as place_points()
  Binding transferred(const PointList<Dim>& to, EdgeList edges, OutsidePoints outside) const;

  //! A binding of another version of the model. Weights are interpolated linearly in the nearest
  //! element of this one, then projected so that they are non-negative, sum to 1, and reproduce the
  //! point (project_non_negative()). A weight is masked where it is masked at all vertices around;
  //! solid regions as well.
  //! \param corners  3 x E, elements of this model (ModelElements)
  //! \param limit  maximum distance, in units of the cage \param distances  output; may be null
  //! Points outside the cage follow the policy of the binding, or the nearest point of the cage.
  //! \throws InputError if sizes do not match, or points are farther away than the limit, naming
  //! their number, the first, and the farthest; also as project_non_negative()
  Binding transferred(const FacetList<3>& corners, const PointList<Dim>& to, EdgeList edges,
                      double limit, Eigen::VectorXd* distances = nullptr) const;

  //! A binding to other control points that move those of this one (compose()). A weight is masked
  //! where no control point follows it that may move the point. There is no domain mesh then.
  //! \param map  weights of the n control points for m others \param outer  those, m control points
  //! at rest; its facets may be missing
  //! \throws InputError as compose(), if the map does not reproduce the control points, or the
  //! binding is mirrored
  Binding composed(const SparseWeights& map, Cage<Dim> outer) const;

  //! Refuses points that are not those of the model.
  //! \param given  Dim x P, within 1e-6 of the size of the cage
  //! \throws InputError naming the numbers of points, or the first point that differs
  void require_points(const PointList<Dim>& given) const;
};

//! Checks that the parts of a binding belong together.
//! \throws InputError naming what does not match
template <int Dim>
void validate(const Binding<Dim>& binding);

//! A binding by weights from elsewhere. What the weights do not reproduce becomes offsets; points
//! without weights stay where they are.
//! \param cage  n control points; facets may be missing \param points  Dim x P of the model
//! \param weights  of P points \param edges  of the model, may be empty
//! \param masks  of the points, whose weights are 0; they end at the facets of the cage
//! \throws InputError if sizes do not match or a masked weight is not 0
template <int Dim>
Binding<Dim> bound_by(Cage<Dim> cage, const PointList<Dim>& points, SparseWeights weights,
                      EdgeList edges = {}, const std::vector<Mask>& masks = {});

}  // namespace flbc
