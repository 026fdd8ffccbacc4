// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights and moved positions at any number of points, in batches of bounded memory.
#pragma once

#include <memory>

#include "flbc/placement.h"

namespace flbc {

//! A pose of the cage and of its domain mesh.
template <int Dim>
struct PosedDomain {
  PointList<Dim> control_points;  //!< Dim x n
  PointList<Dim> vertices;        //!< Dim x V, of the domain mesh
};

//! Evaluates coordinates at points. All functions are const. Several threads may call them at the
//! same time. The result for a point depends on no other point, so batches of any size give
//! bit-identical results.
//!
//!     const Evaluator<3> evaluator(cage, mesh, weights, OutsidePoints::kNearest);
//!     const auto pose = evaluator.pose(control_points);
//!     while (read(batch)) write(evaluator.move(evaluator.place(batch), pose));
template <int Dim>
class Evaluator {
 public:
  //! \param cage  n control points, has passed validate()
  //! \param mesh  valid domain mesh of the cage, V vertices
  //! \param weights  n x V
  //! \param outside  how to handle points outside the cage
  //! \param threads  maximum number of threads of one call (0 = as many as OpenMP offers). The
  //! results do not depend on it
  //! \throws InputError if the sizes do not match
  Evaluator(Cage<Dim> cage, DomainMesh<Dim> mesh, SparseWeights weights,
            OutsidePoints outside = OutsidePoints::kFail, int threads = 0);
  ~Evaluator();
  Evaluator(Evaluator&&) noexcept;

  const Cage<Dim>& cage() const;

  //! Locates points. A placement serves any number of poses and takes 64 bytes per point in 3D.
  //! \param points  Dim x P, finite, in the units of the cage
  //! \throws InputError as place_points()
  Placement<Dim> place(const PointList<Dim>& points) const;

  //! The weights of placed points, n x P.
  SparseWeights weights(const Placement<Dim>& placement) const;

  //! Moves the domain mesh. move() then needs Dim + 1 vertices per point, however many weights
  //! those have.
  //! \param control_points  Dim x n, in the units of the cage for move(), and displacements in any
  //! units for displace()
  //! \throws InputError if the numbers of control points differ
  PosedDomain<Dim> pose(const PointList<Dim>& control_points) const;

  //! Moves placed points. Inside the cage, the result differs from deform() with the weights of
  //! these points only by rounding. Outside, the policy applies.
  //! \param placement  of P points
  //! \param pose  as returned by pose()
  //! \return Dim x P
  PointList<Dim> move(const Placement<Dim>& placement, const PosedDomain<Dim>& pose) const;

  //! The displacements of placed points. They differ from deform() with the weights of these points
  //! only by rounding.
  //! \param placement  of P points
  //! \param displacements  as returned by pose() for displacements of the control points
  //! \return Dim x P, in the units of the displacements
  PointList<Dim> displace(const Placement<Dim>& placement,
                          const PosedDomain<Dim>& displacements) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

extern template class Evaluator<2>;
extern template class Evaluator<3>;

}  // namespace flbc
