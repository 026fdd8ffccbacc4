// SPDX-License-Identifier: BSD-3-Clause
#include "support/judge.h"

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "support/simplex.h"

namespace flbc::testing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A maximum that no NaN slips through. \return whether `error` is the new worst
bool raise(double& worst, double error) {
  if (std::isnan(error)) error = kInfinity;
  if (!(error > worst)) return false;
  worst = error;
  return true;
}

template <int Dim>
double diagonal(const PointList<Dim>& points) {
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

void check_size(const Eigen::MatrixXd& matrix, Eigen::Index rows, Eigen::Index columns) {
  if (matrix.rows() != rows || matrix.cols() != columns) {
    throw std::invalid_argument("judge: sizes do not fit");
  }
}

template <int Dim>
void judge_identities(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                      const Eigen::MatrixXd& weights, Judgement<Dim>& result) {
  const double size = diagonal<Dim>(cage.points);
  result.min_weight = kInfinity;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    double sum = 0;
    Vector<Dim> reproduced = Vector<Dim>::Zero();
    for (Index i = 0; i < cage.size(); ++i) {
      const double w = weights(i, v);
      sum += w;
      reproduced += w * cage.points.col(i);
      if (!(w >= result.min_weight)) result.min_weight = std::isnan(w) ? -kInfinity : w;
    }
    raise(result.partition_error, std::abs(sum - 1));
    if (raise(result.reproduction_error, (reproduced - mesh.points.col(v)).norm() / size)) {
      result.worst_reproduced = mesh.points.col(v);
    }
  }
}

template <int Dim>
void judge_lagrange(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                    const Eigen::MatrixXd& weights, Judgement<Dim>& result) {
  const double tolerance = 1e-9 * diagonal<Dim>(cage.points);
  for (Index j = 0; j < cage.size(); ++j) {
    bool found = false;
    for (Index v = 0; v < mesh.num_vertices(); ++v) {
      if ((mesh.points.col(v) - cage.points.col(j)).norm() > tolerance) continue;
      found = true;
      for (Index i = 0; i < cage.size(); ++i) {
        raise(result.lagrange_error, std::abs(weights(i, v) - (i == j ? 1 : 0)));
      }
    }
    if (found) ++result.control_points_found;
  }
}

// Barycentric coordinates of the point in a facet, and how far it is from lying there: its distance
// from the plane of the facet plus its distance beyond the facet edges.
template <int Dim>
struct FacetFit {
  Vector<Dim> coordinates;
  double misfit;
};

template <int Dim>
FacetFit<Dim> fit_to_facet(const PointList<Dim>& corners, const Vector<Dim>& point) {
  const Eigen::Matrix<double, Dim, Dim - 1> edges = edges_of<Dim>(corners);
  const Vector<Dim> offset = point - corners.col(0);
  FacetFit<Dim> fit;
  fit.coordinates.template tail<Dim - 1>() = least_squares(edges, offset);
  fit.coordinates[0] = 1 - fit.coordinates.template tail<Dim - 1>().sum();
  fit.misfit = (corners * fit.coordinates - point).norm() +
               std::max(0.0, -fit.coordinates.minCoeff()) * diagonal<Dim>(corners);
  return fit;
}

// The best of all facets, so that a vertex near an edge is not held against a facet it only
// touches. \return whether the vertex lies on the cage
template <int Dim>
bool locate(const Cage<Dim>& cage, const Vector<Dim>& point, Eigen::VectorXd& demanded) {
  double best = 1e-6 * diagonal<Dim>(cage.points);
  bool found = false;
  for (Eigen::Index f = 0; f < cage.facets.cols(); ++f) {
    const auto fit = fit_to_facet<Dim>(corners_of<Dim>(cage.points, cage.facets.col(f)), point);
    if (!(fit.misfit < best)) continue;
    found = true;
    best = fit.misfit;
    demanded.setZero();
    for (int k = 0; k < Dim; ++k) demanded[cage.facets(k, f)] = fit.coordinates[k];
  }
  return found;
}

template <int Dim>
void judge_linearity(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                     const Eigen::MatrixXd& weights, Judgement<Dim>& result) {
  const auto interior = interior_vertices(mesh);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (interior[v]) continue;
    Eigen::VectorXd demanded(cage.size());
    if (!locate<Dim>(cage, mesh.points.col(v), demanded)) {
      ++result.boundary_vertices_off_cage;
      continue;
    }
    for (Index i = 0; i < cage.size(); ++i) {
      raise(result.linearity_error, std::abs(weights(i, v) - demanded[i]));
    }
  }
}

template <int Dim>
std::vector<std::set<Index>> neighbours(const DomainMesh<Dim>& mesh) {
  std::vector<std::set<Index>> result(mesh.num_vertices());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (const Index a : mesh.cells.col(s)) {
      for (const Index b : mesh.cells.col(s)) {
        if (a != b) result[a].insert(b);
      }
    }
  }
  return result;
}

template <int Dim>
void judge_extrema(const DomainMesh<Dim>& mesh, const Eigen::MatrixXd& weights, double margin,
                   Judgement<Dim>& result) {
  const auto interior = interior_vertices(mesh);
  const auto around = neighbours(mesh);
  result.local_minima.assign(weights.rows(), 0);
  result.local_maxima.assign(weights.rows(), 0);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (!interior[v]) continue;
    for (Eigen::Index i = 0; i < weights.rows(); ++i) {
      bool lowest = true;
      bool highest = true;
      for (const Index u : around[v]) {
        lowest = lowest && weights(i, v) < weights(i, u) - margin;
        highest = highest && weights(i, v) > weights(i, u) + margin;
      }
      if (lowest) ++result.local_minima[i];
      if (highest) ++result.local_maxima[i];
    }
  }
}

}  // namespace

template <int Dim>
Judgement<Dim> judge(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                     const Eigen::MatrixXd& weights, double extremum_margin) {
  check_size(weights, cage.size(), mesh.num_vertices());
  Judgement<Dim> result;
  judge_identities(cage, mesh, weights, result);
  judge_lagrange(cage, mesh, weights, result);
  judge_linearity(cage, mesh, weights, result);
  judge_extrema(mesh, weights, extremum_margin, result);
  return result;
}

template <int Dim>
Eigen::MatrixXd demanded_boundary_weights(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh) {
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(cage.size(), mesh.num_vertices());
  const auto interior = interior_vertices(mesh);
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    Eigen::VectorXd demanded(cage.size());
    if (!interior[v] && locate<Dim>(cage, mesh.points.col(v), demanded)) {
      weights.col(v) = demanded;
    }
  }
  return weights;
}

template <int Dim>
double objective(const DomainMesh<Dim>& mesh, const Eigen::MatrixXd& weights,
                 const Eigen::MatrixXd& phi, double smoothness) {
  check_size(weights, phi.rows(), mesh.num_vertices());
  check_size(phi, phi.rows(), mesh.num_cells());
  double sum = 0;
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    const auto corners = corners_of<Dim>(mesh.points, mesh.cells.col(s));
    const auto gradients = linear_gradients<Dim>(corners, columns_of(weights, mesh.cells.col(s)));
    for (Eigen::Index i = 0; i < weights.rows(); ++i) {
      const double length = gradients.col(i).norm();
      sum += simplex_measure<Dim>(corners) * length * (phi(i, s) + smoothness / 2 * length);
    }
  }
  return sum;
}

template <int Dim>
double mean_squared_difference(const DomainMesh<Dim>& mesh, const Eigen::MatrixXd& a,
                               const Eigen::MatrixXd& b) {
  check_size(a, b.rows(), mesh.num_vertices());
  check_size(b, a.rows(), mesh.num_vertices());
  const auto interior = interior_vertices(mesh);
  double sum = 0;
  double count = 0;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    if (!interior[v]) continue;
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      sum += (a(i, v) - b(i, v)) * (a(i, v) - b(i, v));
      ++count;
    }
  }
  if (!(count > 0)) throw std::invalid_argument("judge: the mesh has no interior vertices");
  return sum / count;
}

#define FLBC_INSTANTIATE(Dim)                                                                     \
  template Judgement<Dim> judge(const Cage<Dim>&, const DomainMesh<Dim>&, const Eigen::MatrixXd&, \
                                double);                                                          \
  template Eigen::MatrixXd demanded_boundary_weights(const Cage<Dim>&, const DomainMesh<Dim>&);   \
  template double objective(const DomainMesh<Dim>&, const Eigen::MatrixXd&,                       \
                            const Eigen::MatrixXd&, double);                                      \
  template double mean_squared_difference(const DomainMesh<Dim>&, const Eigen::MatrixXd&,         \
                                          const Eigen::MatrixXd&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::testing
