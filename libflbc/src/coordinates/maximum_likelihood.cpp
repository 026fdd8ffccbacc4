// SPDX-License-Identifier: BSD-3-Clause
// The control points are projected onto the unit sphere around x and smoothed. The smoothed vector
// u_i of a control point is the normalized sum, over its facets, of vectors toward the centers of
// the projected facets: the integrals of the unit normal over them, in 2D divided by their lengths.
// The weights mu_i of these vectors maximize the likelihood sum_i log mu_i subject to sum_i mu_i
// u_i = 0. By duality mu_i = 1 / (1 + psi . u_i) up to a factor, where psi minimizes -sum_i log(1 +
// psi . u_i). Each u_i is a combination of c_j - x with positive factors, so that mu_i gives the
// weights w_j. Next to a facet these factors grow without bounds, so only its corners keep weights.
#include "flbc/pointwise.h"

#include <cmath>

#include "base/instantiate.h"
#include "coordinates/points_in_cage.h"
#include "coordinates/seen_facet.h"
#include "linear/dense.h"

namespace flbc {
namespace {

// Factors >= 0 of the corners of a facet, relative to x, whose combination is its vector.
Vector<2> factors_of(const SeenFacet<2>& facet, const Vector<2>& x) {
  const Eigen::Matrix2d seen = facet.corners.colwise() - x;
  const Vector<2> inverse = seen.colwise().norm().cwiseInverse();
  return inverse / (seen * inverse).norm();
}

Vector<3> factors_of(const SeenFacet<3>& facet, const Vector<3>& x) {
  return facet.share(x).cwiseAbs();  // all negative where the facet is seen from outside
}

// Damped Newton steps converge from 0, because the function is self-concordant.
// \param directions  u_i \param weights  set to mu_i
// \return whether there is a minimum: 0 is inside the convex hull of the directions
template <int Dim>
bool maximize_likelihood(const PointList<Dim>& directions, Eigen::VectorXd& weights) {
  constexpr int kMostSteps = 200;
  constexpr double kRounding = 1e-15;
  Vector<Dim> psi = Vector<Dim>::Zero();
  double decrement = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    weights = (1 + (directions.transpose() * psi).array()).inverse();
    const Vector<Dim> gradient = -(directions * weights);
    const Eigen::Matrix<double, Dim, Dim> hessian =
        dense::moments<Dim>(directions, weights.cwiseAbs2());
    const Vector<Dim> direction = -dense::solve_symmetric<Dim>(hessian, gradient);
    decrement = std::sqrt(std::max(0.0, -gradient.dot(direction)));
    if (gradient.norm() <= kRounding * weights.sum() || decrement < kRounding) return true;
    psi += direction / (decrement < 0.25 ? 1 : 1 + decrement);
  }
  return decrement < 1e-8;
}

}  // namespace

template <int Dim>
WeightMatrix maximum_likelihood_coordinates(const Cage<Dim>& cage, const PointList<Dim>& points) {
  const auto facets = see_facets(cage, bounding_box_diagonal(cage.points));
  const auto& corners = cage.facets;
  return weights_in_cage<Dim>(
      cage, points, [&](const Vector<Dim>& x, Eigen::Ref<Eigen::VectorXd> weights) {
        PointList<Dim> factors(Dim, corners.cols());  // of the corners, per facet
        PointList<Dim> directions = PointList<Dim>::Zero(Dim, cage.size());
        for (Index f = 0; f < corners.cols(); ++f) {
          factors.col(f) = factors_of(facets[f], x);
          const Vector<Dim> sum = (facets[f].corners.colwise() - x) * factors.col(f);
          for (int k = 0; k < Dim; ++k) directions.col(corners(k, f)) += sum;
        }
        const Eigen::VectorXd lengths = directions.colwise().norm();
        directions.colwise().normalize();
        Eigen::VectorXd likely;
        const bool found = maximize_likelihood<Dim>(directions, likely);
        likely = likely.cwiseQuotient(lengths);
        for (Index f = 0; f < corners.cols(); ++f) {
          double sum = 0;
          for (int k = 0; k < Dim; ++k) sum += likely[corners(k, f)];
          for (int k = 0; k < Dim; ++k) weights[corners(k, f)] += sum * factors(k, f);
        }
        return found;
      });
}

FLBC_INSTANTIATE_FUNCTION(maximum_likelihood_coordinates)

}  // namespace flbc
