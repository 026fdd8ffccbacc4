// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The names of other coordinates, and those that need no domain mesh.
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

}  // namespace flbc
