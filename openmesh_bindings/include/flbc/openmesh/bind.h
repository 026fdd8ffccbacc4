// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Computes weights on a model from a cage in one call. deform.h then moves the model with the
//! cage.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "flbc/binding.h"
#include "flbc/bounding_box.h"
#include "flbc/linked_meshers.h"
#include "flbc/openmesh/convert.h"
#include "flbc/openmesh/deform.h"
#include "flbc/openmesh/sparsify.h"
#include "flbc/openmesh/weights.h"

namespace flbc::openmesh {

//! Treatment of the model's vertices outside the cage (flbc/placement.h).
using flbc::BindReport;
using flbc::OutsidePoints;

//! Options of bind().
struct BindOptions : flbc::BindOptions {
  std::string weights = kWeights;  //!< name of the property
  bool persistent = false;         //!< whether .om files store the properties
};

namespace internal {

//! The weights with at most `most` influences (0: any number) nearest to `weights` that reproduce a
//! point. \param cage  Dim x n \throws InputError naming the vertex if no weights >= 0 reproduce it
Eigen::VectorXd reproducing(const Eigen::MatrixXd& cage, const Eigen::VectorXd& point, int vertex,
                            const Eigen::VectorXd& weights, std::size_t most);

[[noreturn]] void refuse_without_neighbors(int vertex);
[[noreturn]] void refuse_moved(int vertex);

//! \throws InputError naming the first vertex with weights that is not where it was bound
template <class Mesh>
void require_at_rest(const Mesh& mesh, const RowBlock<double>& rest,
                     const std::vector<bool>& are_bound) {
  const auto points = points_of<kPointSize<Mesh>>(mesh);
  const double tolerance = kBoundaryTolerance * bounding_box_diagonal(points);
  for (std::size_t v = 0; v < are_bound.size(); ++v) {
    for (int d = 0; are_bound[v] && d < kPointSize<Mesh>; ++d) {
      const double moved = points(d, static_cast<Index>(v)) - rest[v][static_cast<std::size_t>(d)];
      if (!(std::abs(moved) <= tolerance)) refuse_moved(static_cast<int>(v));
    }
  }
}

//! Whether each vertex was bound, which it also was if it stays where it is (kKeep). All were if
//! the mesh has no weights of this name.
template <class Mesh>
std::vector<bool> bound_vertices(const Mesh& mesh, const std::string& weights) {
  std::vector<bool> are_bound(mesh.n_vertices(), true);
  const auto* influences = find_property<Influences>(mesh, weights);
  const auto* rows = find_property<Wide<double>>(mesh, weights);
  const auto* offsets = find_property<Wide<double>>(mesh, name_of_offset(weights));
  for (std::size_t v = 0; v < are_bound.size(); ++v) {
    if (offsets && !is_unbound(offsets->data_vector()[v])) continue;
    if (influences) {
      are_bound[v] = !is_unbound(influences->data_vector()[v]);
    } else if (rows) {
      are_bound[v] = !is_unbound(rows->data_vector()[v]);
    }
  }
  return are_bound;
}

inline void add_row(const InfluencesView<const double>& influences, Eigen::VectorXd& sum) {
  for (std::size_t j = 0; j < influences.size(); ++j) {
    sum[influences.control_point(j)] += influences.weight(j);
  }
}
inline void add_row(const RowsView<const double>& row, Eigen::VectorXd& sum) {
  sum += row.matrix().row(0).transpose();
}

inline void set_row(const Eigen::VectorXd& weights, const InfluencesView<double>& influences) {
  std::size_t j = 0;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0) continue;
    influences.control_point(j) = static_cast<std::uint32_t>(i);
    influences.weight(j++) = weights[i];
  }
}
inline void set_row(const Eigen::VectorXd& weights, const RowsView<double>& row) {
  row.matrix().row(0) = weights.transpose();
}

//! \param block  of the weights \param most  pairs per vertex; 0 = all weights
template <class Mesh, class Block>
void bind_new(Mesh& mesh, Block& block, const Eigen::MatrixXd& cage, std::size_t most,
              RowBlock<double>& rest, std::vector<OpenMesh::VertexHandle> open,
              std::vector<bool> are_bound) {
  while (!open.empty()) {
    std::vector<OpenMesh::VertexHandle> done, left;
    for (const auto vertex : open) {
      const auto v = static_cast<std::size_t>(vertex.idx());
      Eigen::VectorXd mean = Eigen::VectorXd::Zero(cage.cols());
      int neighbors = 0;
      for (const auto neighbor : mesh.vv_range(vertex)) {
        if (!are_bound[static_cast<std::size_t>(neighbor.idx())]) continue;
        add_row(std::as_const(block)[static_cast<std::size_t>(neighbor.idx())], mean);
        ++neighbors;
      }
      if (neighbors == 0) {
        left.push_back(vertex);
        continue;
      }
      Eigen::VectorXd point(cage.rows());
      for (int d = 0; d < cage.rows(); ++d) point[d] = static_cast<double>(mesh.point(vertex)[d]);
      set_row(reproducing(cage, point, vertex.idx(), mean / neighbors, most), block[v]);
      for (int d = 0; d < kPointSize<Mesh>; ++d) {
        rest[v][static_cast<std::size_t>(d)] = static_cast<double>(mesh.point(vertex)[d]);
      }
      done.push_back(vertex);
    }
    if (done.empty()) refuse_without_neighbors(left.front().idx());
    for (const auto vertex : done) are_bound[static_cast<std::size_t>(vertex.idx())] = true;
    open = std::move(left);
  }
}

template <class T>
struct IsCage : std::false_type {};
template <int Dim>
struct IsCage<Cage<Dim>> : std::true_type {};

//! \throws InputError if two vertices of a cage that was a mesh are at the same place
template <int Dim>
void refuse_doubled_vertices(const Cage<Dim>& cage);

template <class AnyCage>
auto as_cage(const AnyCage& cage) {
  if constexpr (IsCage<AnyCage>::value) {
    return cage;
  } else {
    auto result = [&] {
      if constexpr (kPointSize<AnyCage> == 2) {
        return to_outline(cage);
      } else {
        return to_cage(cage);
      }
    }();
    refuse_doubled_vertices(result);
    return result;
  }
}

template <class Mesh>
void keep_rest(Mesh& mesh, const std::string& weights, bool persistent) {
  auto& rest = get_property<Wide<double>>(mesh, name_of_rest(weights));
  rest.set_shape(1, static_cast<std::size_t>(kPointSize<Mesh>));
  for (const auto vertex : mesh.vertices()) {
    const auto& point = mesh.point(vertex);
    for (int d = 0; d < kPointSize<Mesh>; ++d) {
      rest[vertex.idx()][static_cast<std::size_t>(d)] = static_cast<double>(point[d]);
    }
  }
  if (persistent) rest.set_persistent(true);
}

//! A row per point; of width 0 without points.
template <int Dim>
RowBlock<double> rows_of(const PointList<Dim>& points) {
  RowBlock<double> rows(1, points.cols() == 0 ? 0 : Dim);
  rows.resize(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index p = 0; p < points.cols(); ++p) {
    for (int d = 0; d < Dim; ++d) {
      rows[static_cast<std::size_t>(p)][static_cast<std::size_t>(d)] = points(d, p);
    }
  }
  return rows;
}

template <int Dim, class Mesh>
BindReport bind_to(Mesh& model, const Cage<Dim>& cage, const DomainMesh<Dim>* domain,
                   const Meshers<Dim>& meshers, const BindOptions& options) {
  if constexpr (!std::is_same_v<Mesh, TetMesh>) refuse_deleted_elements(model);
  const auto points = points_of<Dim>(model);
  const auto edges = edge_list_at<Dim>(model, points);
  auto binding = domain != nullptr ? flbc::bind<Dim>(cage, *domain, points, edges, options)
                                   : flbc::bind<Dim>(cage, points, edges, options, meshers);
  if (options.max_influences > 0) {
    const Index most = options.outside == OutsidePoints::kExtend
                           ? 0
                           : std::min(options.max_influences, cage.size());
    set_influences(model, binding.weights, static_cast<std::size_t>(most), options.weights,
                   options.persistent);
  } else {
    set_weights(model, binding.weights.dense(), options.weights, options.persistent);
  }
  auto offsets = rows_of(binding.offsets);
  // A vertex at the origin that stays there has an offset as well, unlike one that is added later.
  for (std::size_t v = 0; v < offsets.size(); ++v) {
    if (!binding.weights.has_weights(static_cast<Index>(v)) && is_unbound(offsets[v])) {
      offsets[v][0] = std::numeric_limits<double>::denorm_min();
    }
  }
  set_offsets(model, offsets, options.weights, options.persistent);
  set_rest_cage(model, cage.points, options.weights, options.persistent);
  keep_rest(model, options.weights, options.persistent);
  return std::move(binding.report);
}

}  // namespace internal

//! Binds a model to a cage: meshes the interior, solves, evaluates weights at the model vertices,
//! and reduces influences. The weights become a property, which deform() uses to move the model.
//! The current vertex positions become the rest positions; restore_rest() restores them.
//!
//! The domain mesh comes from the mesher that the program links (flbc/linked_meshers.h): flbc::cgal
//! for a cage in the plane, flbc::tetgen or flbc::netgen for a surface.
//! \param model  a mesh of triangles or polygons, with points of floats or doubles, or a TetMesh
//! \param cage  a Cage, or a mesh: a closed surface, or a planar mesh whose boundary is the cage
//! (points with two coordinates)
//! \throws InputError naming the defect of cage or model; OptionError, SolverError. The model is
//! then unchanged
template <class Model, class AnyCage>
BindReport bind(Model& model, const AnyCage& any_cage, const BindOptions& options = {}) {
  const auto cage = internal::as_cage(any_cage);
  if constexpr (std::is_same_v<std::decay_t<decltype(cage)>, Cage<2>>) {
    return internal::bind_to<2>(model, cage, nullptr, linked_meshers<2>(), options);
  } else {
    return internal::bind_to<3>(model, cage, nullptr, linked_meshers<3>(), options);
  }
}

//! The same with a given domain mesh, which needs no component.
//! \param domain  see normalize_and_validate()
template <class Model, int Dim>
BindReport bind(Model& model, const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                const BindOptions& options = {}) {
  return internal::bind_to<Dim>(model, cage, &domain, {}, options);
}

//! Binds vertices that were added after bind(), for example by split(). They get the mean of the
//! weights of their neighbors, changed as little as is needed to reproduce their positions. The
//! model must be at rest. Other vertices keep their weights.
//! \return number of new vertices
//! \throws InputError if the model was not bound, or naming a vertex that is not at rest, that no
//! neighbors connect with bound ones, or that lies outside the convex hull of the cage. Vertices
//! before it may be bound
template <class Model>
Index bind_new_vertices(Model& model, const std::string& weights = kWeights) {
  static_assert(!std::is_same_v<Model, TetMesh>, "the vertices of a TetMesh do not change");
  const auto cage = get_rest_cage(model, weights);
  const auto rest_name = internal::name_of_rest(weights);
  if (!internal::find_property<Wide<double>>(model, rest_name) || cage.size() == 0) {
    internal::refuse_without_weights(rest_name);
  }
  auto& rest = internal::get_property<Wide<double>>(model, rest_name).data_vector();
  auto are_bound = internal::bound_vertices(model, weights);
  internal::require_at_rest(model, rest, are_bound);
  std::vector<OpenMesh::VertexHandle> open;
  for (const auto vertex : model.vertices()) {
    if (!are_bound[static_cast<std::size_t>(vertex.idx())]) open.push_back(vertex);
  }
  const auto count = static_cast<Index>(open.size());
  if (internal::find_property<Influences>(model, weights)) {
    auto& block = internal::get_property<Influences>(model, weights).data_vector();
    internal::bind_new(model, block, cage, block.most(), rest, std::move(open),
                       std::move(are_bound));
  } else {
    weights_property(model, weights);
    auto& block = internal::get_property<Wide<double>>(model, weights).data_vector();
    internal::bind_new(model, block, cage, 0, rest, std::move(open), std::move(are_bound));
  }
  return count;
}

//! Has .om files store all that bind() has attached, or not.
//! \throws InputError if the model was not bound
template <class Model>
void set_persistent(Model& model, const std::string& weights = kWeights, bool yes = true) {
  if (internal::find_property<Influences>(model, weights)) {
    internal::get_property<Influences>(model, weights).set_persistent(yes);
  } else {
    weights_property(model, weights);
  }
  for (const auto& name :
       {weights, internal::name_of_offset(weights), internal::name_of_rest(weights)}) {
    if (!internal::find_property<Wide<double>>(model, name)) continue;
    internal::get_property<Wide<double>>(model, name).set_persistent(yes);
  }
  OpenMesh::MPropHandleT<Wide<double>> cage;
  if (!model.get_property_handle(cage, internal::name_of_cage(weights))) return;
  model.mproperty(cage).set_persistent(yes);
}

//! Restores the vertex positions at the time of bind(). Vertices that were added since stay where
//! they are, unless bind_new_vertices() has bound them.
//! \throws InputError if the model was not bound
template <class Model>
void restore_rest(Model& model, const std::string& weights = kWeights) {
  const auto* rest = internal::find_property<Wide<double>>(model, internal::name_of_rest(weights));
  if (!rest) internal::refuse_without_weights(internal::name_of_rest(weights));
  const auto are_bound = internal::bound_vertices(model, weights);
  for (const auto vertex : model.vertices()) {
    if (!are_bound[static_cast<std::size_t>(vertex.idx())]) continue;
    auto point = model.point(vertex);
    using Coordinate = std::decay_t<decltype(point[0])>;
    for (int d = 0; d < kPointSize<Model>; ++d) {
      point[d] = static_cast<Coordinate>((*rest)[vertex.idx()][static_cast<std::size_t>(d)]);
    }
    model.set_point(vertex, point);
  }
}

}  // namespace flbc::openmesh
