// SPDX-License-Identifier: BSD-3-Clause
#include "coordinates/affine_fit.h"

#include <algorithm>

#include <Eigen/LU>

#include "linear/dense.h"

namespace flbc {
namespace {

// Least extent of the control points, relative to their largest, squared: flatter ones would turn
// small displacements across into large ones of what is far from their plane.
constexpr double kLeastExtent = 0.04;

template <int Dim>
PointList<Dim> centered(const PointList<Dim>& points, const std::vector<Index>& chosen) {
  PointList<Dim> some = points(Eigen::all, chosen);
  const Vector<Dim> center = some.rowwise().mean();
  return some.colwise() - center;
}

template <int Dim>
bool surrounds(const PointList<Dim>& offsets) {
  const Eigen::Matrix<double, Dim, Dim> moments = offsets * offsets.transpose();
  const Eigen::Matrix<double, Dim, Dim> axes = dense::principal_axes<Dim>(moments);
  const Vector<Dim> extents = (axes.transpose() * moments * axes).diagonal();
  return extents.minCoeff() > kLeastExtent * extents.maxCoeff();
}

}  // namespace

template <int Dim>
AffineFitter<Dim>::AffineFitter(const Cage<Dim>& cage) : cage_(cage), neighbors_(cage.size()) {
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    for (int j = 0; j < Dim; ++j) {
      for (int k = 0; k < Dim; ++k) {
        if (j != k) neighbors_[cage.facets(j, f)].push_back(cage.facets(k, f));
      }
    }
  }
}

template <int Dim>
AffineFit<Dim> AffineFitter<Dim>::operator()(Index control_point) const {
  std::vector<Index> chosen{control_point};
  std::vector<bool> is_chosen(cage_.size(), false);
  is_chosen[control_point] = true;
  PointList<Dim> offsets;
  std::size_t before = 0;
  do {
    const std::size_t end = chosen.size();
    for (std::size_t k = before; k < end; ++k) {
      for (const Index neighbor : neighbors_[chosen[k]]) {
        if (is_chosen[neighbor]) continue;
        is_chosen[neighbor] = true;
        chosen.push_back(neighbor);
      }
    }
    before = end;
    offsets = centered<Dim>(cage_.points, chosen);
  } while (!surrounds<Dim>(offsets) && chosen.size() > before);
  const Eigen::Matrix<double, Dim, Dim> moments = offsets * offsets.transpose();
  return {std::move(chosen), offsets.transpose() * moments.inverse()};
}

template class AffineFitter<2>;
template class AffineFitter<3>;

}  // namespace flbc
