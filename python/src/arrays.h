// SPDX-License-Identifier: BSD-3-Clause
// NumPy arrays as matrices of the library, and back. A C-contiguous (P, n) array has the memory
// layout of an n x P matrix, so results cross without a copy. The Python files have checked types
// and shapes of all arguments.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "flbc/binding.h"
#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/io/model.h"
#include "flbc/sparse_weights.h"

namespace flbc::python {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style>;
using Indices = py::array_t<Index, py::array::c_style>;

//! Polygons: all corners, and P + 1 offsets into them.
using Polygons = std::pair<Indices, py::array_t<std::int64_t, py::array::c_style>>;

//! Calls `action` with the number of columns of points, 2 or 3, as a constant.
template <class Action>
auto by_dimension(const Doubles& points, const Action& action) {
  if (points.shape(1) == 2) return action(std::integral_constant<int, 2>());
  return action(std::integral_constant<int, 3>());
}

template <int Dim>
PointList<Dim> points_of(const Doubles& array) {
  return Eigen::Map<const PointList<Dim>>(array.data(), Dim, array.shape(0));
}

template <int Dim>
std::vector<PointList<Dim>> poses_of(const std::vector<Doubles>& arrays) {
  std::vector<PointList<Dim>> poses;
  poses.reserve(arrays.size());
  for (const auto& array : arrays) poses.push_back(points_of<Dim>(array));
  return poses;
}

template <int Dim>
Cage<Dim> cage_of(const Doubles& points, const Indices& facets) {
  return {points_of<Dim>(points),
          Eigen::Map<const FacetList<Dim>>(facets.data(), Dim, facets.shape(0))};
}

//! Points of the plane get z = 0.
inline std::vector<Vector<3>> places_of(const Doubles& points) {
  std::vector<Vector<3>> places(static_cast<std::size_t>(points.shape(0)), Vector<3>::Zero());
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (py::ssize_t d = 0; d < points.shape(1); ++d) {
      places[k][d] = points.at(static_cast<py::ssize_t>(k), d);
    }
  }
  return places;
}

template <int Dim>
DomainMesh<Dim> mesh_of(const Doubles& points, const Indices& cells) {
  return {points_of<Dim>(points),
          Eigen::Map<const CellList<Dim>>(cells.data(), Dim + 1, cells.shape(0))};
}

inline std::vector<std::vector<Index>> lists_of(const Polygons& polygons) {
  const auto& [corners, starts] = polygons;
  std::vector<std::vector<Index>> lists;
  for (py::ssize_t k = 0; k + 1 < starts.shape(0); ++k) {
    lists.emplace_back(corners.data() + starts.at(k), corners.data() + starts.at(k + 1));
  }
  return lists;
}

inline io::PolygonSoup soup_of(const Doubles& points, const Polygons& polygons) {
  return {places_of(points), lists_of(polygons), {}};
}

//! An array with a row per column of a matrix. \param owner  keeps the matrix
template <class Matrix>
py::array view_of(const Matrix& matrix, const py::handle& owner) {
  const std::vector<py::ssize_t> shape{matrix.cols(), matrix.rows()};
  return py::array_t<typename Matrix::Scalar>(shape, matrix.data(), owner);
}

//! The arrays of scipy.sparse.csr_matrix, and the number of columns.
inline py::object view_of(const SparseWeights& weights, const py::handle& owner) {
  const auto count = static_cast<py::ssize_t>(weights.values().size());
  return py::make_tuple(
      py::array_t<double>(count, weights.values().data(), owner),
      // Below 2^31: SciPy takes signed numbers without a copy.
      py::array_t<std::int32_t>(
          count, reinterpret_cast<const std::int32_t*>(weights.control_points().data()), owner),
      py::array_t<std::int64_t>(static_cast<py::ssize_t>(weights.starts().size()),
                                weights.starts().data(), owner),
      weights.num_control_points());
}

//! The same of a value that the arrays own.
template <class Value>
auto owned_view_of(Value value) {
  auto kept = std::make_unique<Value>(std::move(value));
  const auto& found = *kept;
  return view_of(found,
                 py::capsule(kept.release(), [](void* p) { delete static_cast<Value*>(p); }));
}

template <class Matrix>
py::array as_array(Matrix matrix) {
  return owned_view_of(std::move(matrix));
}

inline py::object as_python(SparseWeights weights) {
  return owned_view_of(std::move(weights));
}

template <class Number>
py::array as_array(const std::vector<Number>& list) {
  return py::array_t<Number>(static_cast<py::ssize_t>(list.size()), list.data());
}

inline Polygons polygons_of(const std::vector<std::vector<Index>>& lists) {
  std::vector<Index> corners;
  std::vector<std::int64_t> starts{0};
  for (const auto& list : lists) {
    corners.insert(corners.end(), list.begin(), list.end());
    starts.push_back(static_cast<std::int64_t>(corners.size()));
  }
  return {as_array(corners), as_array(starts)};
}

//! \param weights  an array, or a tuple as from as_python()
inline SparseWeights weights_of(const py::object& weights) {
  if (!py::isinstance<py::tuple>(weights)) {
    const auto array = weights.cast<Doubles>();
    return WeightMatrix(
        Eigen::Map<const WeightMatrix>(array.data(), array.shape(1), array.shape(0)));
  }
  using Values = std::tuple<Doubles, Indices, py::array_t<std::int64_t, py::array::c_style>, Index>;
  const auto [values, columns, starts, count] = weights.cast<Values>();
  return SparseWeights(count, {starts.data(), starts.data() + starts.size()},
                       {columns.data(), columns.data() + columns.size()},
                       {values.data(), values.data() + values.size()});
}

template <int Dim>
py::tuple as_python(const Cage<Dim>& cage) {
  return py::make_tuple(as_array(cage.points), as_array(cage.facets));
}

template <int Dim>
py::tuple as_python(DomainMesh<Dim> mesh) {
  return py::make_tuple(as_array(std::move(mesh.points)), as_array(std::move(mesh.cells)));
}

//! Masks: pairs of control points and points.
using MaskLists = std::vector<std::pair<Indices, Indices>>;

inline std::vector<std::vector<Index>> regions_of(const std::vector<Indices>& arrays) {
  std::vector<std::vector<Index>> regions;
  for (const auto& array : arrays) regions.emplace_back(array.data(), array.data() + array.size());
  return regions;
}

inline std::vector<Mask> masks_of(const MaskLists& lists) {
  const auto indices = [](const Indices& array) { return regions_of({array}).front(); };
  std::vector<Mask> masks;
  for (const auto& [control_points, points] : lists) {
    masks.push_back({indices(control_points), indices(points)});
  }
  return masks;
}

template <int Dim>
EdgeList edges_of(const PointList<Dim>& points, const Polygons& polygons) {
  return edges_of_polygons(points, lists_of(polygons));
}

//! The dimension of a class template.
template <class T>
constexpr int kDimOf = 0;
template <template <int> class T, int Dim>
constexpr int kDimOf<T<Dim>> = Dim;

//! A binding of either dimension, which does not change.
struct AnyBinding {
  std::variant<Binding<2>, Binding<3>> value;

  template <class Action>
  auto visit(const Action& action) const {
    return std::visit(action, value);
  }
};

//! In a process forked from one that has used OpenMP, more than one thread would wait for threads
//! that do not exist.
void use_threads_of_this_process();

//! Throws if Ctrl-C was pressed; for work that runs without the GIL, which may call it very often.
std::function<void()> interruption();

//! Does work while other Python threads run.
template <class Work>
auto without_gil(const Work& work) {
  const py::gil_scoped_release release;
  use_threads_of_this_process();
  return work();
}

void bind_bindings(py::module_& module);
void bind_solving(py::module_& module);
void bind_files(py::module_& module);

}  // namespace flbc::python
