// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Coordinates that need no domain mesh, for comparison, and the names of other coordinates.
#pragma once

#include "flbc/cage.h"
#include "flbc/placement.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! Coordinates that a formula or one linear system gives, without a search for an optimum.
enum class Coordinates {
  kHarmonic,       //!< harmonic coordinates (Joshi et al. 2007)
  kMeanValue,      //!< mean value coordinates (Floater 2003, Ju et al. 2005)
  kMaxEntropy,     //!< maximum entropy coordinates (Hormann and Sukumar 2008)
  kMaxLikelihood,  //!< maximum likelihood coordinates (Chang et al. 2023)
  kBlended,        //!< blended barycentric coordinates (Anisimov et al. 2017), 2D
  kBiharmonic,     //!< bounded biharmonic weights (Jacobson et al. 2011), which do not reproduce
  kGreen           //!< Green coordinates (Lipman et al. 2008), which also need normals: green.h;
                   //!< compute_coordinates() refuses them
};

//! Whether the weights of each point are computed on its own, without a domain mesh.
bool is_pointwise(Coordinates coordinates);

//! Coordinates at any points of the interior. If the cage has several parts, a point has weights
//! for the control points of its part only, as in compute_coordinates().
//! \param cage  valid and free of self-intersections
//! \param points  Dim x P, finite, in the units of the cage
//! \param coordinates  some with is_pointwise()
//! \return n x P, each column sums to 1
//! \throws OptionError if they are not pointwise, or not available in this dimension;
//! InputError naming the first point without coordinates
template <int Dim>
WeightMatrix pointwise_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points,
                                   Coordinates coordinates);

//! Coordinates of placed points.
//! \param placement  of P points, with or without a mesh, which is not used
//! \param coordinates  as above
//! \param non_negative  whether to make weights of points inside non-negative (non_negative.h)
//! \param num_threads  0 = automatic
//! \return n x P
//! \throws as above; also as project_non_negative()
template <int Dim>
SparseWeights pointwise_coordinates(const Cage<Dim>& cage, const Placement<Dim>& placement,
                                    Coordinates coordinates, bool non_negative,
                                    int num_threads = 0);

//! Mean value coordinates (Floater 2003, equation 2.1; Hormann and Floater 2006 for arbitrary
//! polygons; Ju, Schaefer and Warren 2005 for triangle meshes). They reproduce linear functions,
//! are linear on cage facets, and smooth elsewhere. They are not local, and can be negative if the
//! cage is not convex. They need no mesh and are also defined outside the cage. The result is
//! accurate to rounding everywhere, even near facets, edges, control points, and the planes of
//! facets. A point within 1e-12 of cage size from the cage is first moved to the nearest point of
//! the cage. The result does not depend on the number of threads.
//! \param cage  valid and free of self-intersections; may have holes and several parts, in any
//! orientation
//! \param points  Dim x P, finite
//! \return n x P, each column sums to 1
//! \throws InputError naming the first non-finite point
template <int Dim>
WeightMatrix mean_value_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points);

//! Maximum entropy coordinates (Hormann and Sukumar 2008) with the priors of their first kind. They
//! are positive, reproduce linear functions, are linear on cage facets, and smooth inside, also in
//! concave cages. They are not local. Each point needs a convex minimization in Dim unknowns, and
//! no mesh.
//! The result does not depend on the number of threads.
//! \param cage  valid and free of self-intersections; may have holes, in any orientation
//! \param points  Dim x P, finite, inside the cage or outside by at most kBoundaryTolerance
//! \return n x P, each column sums to 1
//! \throws InputError naming the first point that is not finite or outside the cage
template <int Dim>
WeightMatrix maximum_entropy_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points);

//! Maximum likelihood coordinates (Chang, Deng and Hormann 2023), without their optional scaling by
//! distances. They are non-negative, reproduce linear functions, are linear on cage facets, and
//! smooth inside, also in concave cages. They are not local. Each point needs a convex minimization
//! in Dim unknowns, and no mesh. In 3D, the paper has no proof that the minimum exists in every
//! concave cage.
//! The result does not depend on the number of threads.
//! \param cage  valid and free of self-intersections; may have holes, in any orientation
//! \param points  Dim x P, finite, inside the cage or outside by at most kBoundaryTolerance
//! \return n x P, each column sums to 1
//! \throws InputError naming the first point that is not finite, is outside the cage, or has no
//! such coordinates
template <int Dim>
WeightMatrix maximum_likelihood_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points);

//! Blended barycentric coordinates (Anisimov, Panozzo and Hormann 2017), in 2D: mean value
//! coordinates of the quadrilaterals of a constrained Delaunay triangulation, blended in each
//! triangle. They are non-negative, reproduce linear functions, are linear on cage edges, and have
//! continuous first derivatives inside. At most 6 weights of a point are positive, those of
//! neighboring triangles. They are in closed form, and depend on the triangulation.
//! \param cage  valid and free of self-intersections; may have holes and several parts, in any
//! orientation
//! \param points  2 x P, finite, inside the cage or outside by at most kBoundaryTolerance
//! \return n x P, each column sums to 1
//! \throws InputError naming the first point that is not finite or outside the cage; also if the
//! cage intersects itself and has no triangulation
WeightMatrix blended_coordinates(const Cage<2>& cage, const PointList<2>& points);

}  // namespace flbc
