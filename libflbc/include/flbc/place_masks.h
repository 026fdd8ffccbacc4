// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Masks of a model: from its points to the domain mesh, and back to exact zeros at the points.
#pragma once

#include <string>
#include <vector>

#include "flbc/masks.h"
#include "flbc/placement.h"

namespace flbc {

//! Masks of the points of a model, prepared for each step of a bind.
struct PlacedMasks {
  std::vector<Mask> of_mesh{};     //!< SolverOptions::masks: the corners of the cells of the points
  std::vector<Mask> of_points{};   //!< without those that end at facets; SparsifyOptions::masks
  std::vector<Mask> of_outside{};  //!< of points with the weights of OutsidePoints::kExtend
  Index masked = 0;                //!< number of masked points
  Index on_facets = 0;             //!< those on facets of masked control points, which move them

  //! of_points and of_outside.
  std::vector<Mask> of_all() const;

  //! About the points on facets; empty if there are none.
  std::string note() const;
};

//! The masks without those that end at facets: a point on a facet keeps its known weights.
//! \param on_facets  output: the number of these points; may be null
template <int Dim>
std::vector<Mask> end_at_facets(const Cage<Dim>& cage, const PointList<Dim>& points,
                                const std::vector<Mask>& masks, Index* on_facets = nullptr);

//! Removes a few control points from all masks so that all points can obey, outside as with
//! OutsidePoints::kNearest.
//! \param freed  output: these control points, ascending
//! \param mirror_axis  BindOptions::mirror_axis, for which mirror images are added and obey, too
template <int Dim>
std::vector<Mask> relax_masks(const Cage<Dim>& cage, const PointList<Dim>& points,
                              std::vector<Mask> masks, std::vector<Index>& freed,
                              int mirror_axis = -1);

//! Prepares masks. Vertices of the mesh that cannot obey are left out, because enforce_masks()
//! makes weights of the points exactly 0.
//! \param placement  of P points, in the mesh; without places: of its vertices
//! \param masks  of the P points
//! \param images  MirroredModel::images() for symmetric masks; empty: no mirror
//! \throws MaskConflict if points cannot obey, naming their number, the first, and the control
//! points to free; InputError as PointMasks, and for a point outside (OutsidePoints::kExtend) that
//! is no affine combination of the control points that may move it
template <int Dim>
PlacedMasks place_masks(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                        const Placement<Dim>& placement, const std::vector<Mask>& masks,
                        const std::vector<Index>& images = {});

//! Makes masked weights exactly 0, with the smallest change of the others. Weights that obey are
//! unchanged.
//! \param weights  of P points, as returned by weights_at() \param masks  of the placement
//! \return weights of P points, which reproduce placement.points
template <int Dim>
SparseWeights enforce_masks(const Cage<Dim>& cage, const Placement<Dim>& placement,
                            const SparseWeights& weights, const PlacedMasks& masks);

}  // namespace flbc
