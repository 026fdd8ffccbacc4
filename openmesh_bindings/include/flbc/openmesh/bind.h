// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Computes weights on a model from a cage in one call. deform.h then moves the model with the
//! cage.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "flbc/binding.h"
#include "flbc/bounding_box.h"
#include "flbc/make_domain.h"
#include "flbc/openmesh/binding.h"
#include "flbc/openmesh/convert.h"
#include "flbc/openmesh/deform.h"
#include "flbc/openmesh/sparsify.h"
#include "flbc/openmesh/weights.h"
#include "flbc/rig.h"

namespace flbc::openmesh {

//! Treatment of the model's vertices outside the cage (flbc/placement.h).
using flbc::BindReport;
using flbc::OutsidePoints;

//! Options of bind().
struct BindOptions : flbc::BindOptions {
  std::string weights = kWeights;  //!< name of the property
};

namespace internal {

//! The weights with at most `most` influences (0: any number) nearest to `weights` that reproduce a
//! point. \param cage  Dim x n \param masked  control points whose weights are 0
//! \throws InputError naming the vertex if no weights >= 0 reproduce it
Eigen::VectorXd reproducing(const Eigen::MatrixXd& cage, const Eigen::VectorXd& point, int vertex,
                            const Eigen::VectorXd& weights, std::size_t most,
                            const std::vector<Index>& masked);

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

//! Masks of vertices that are bound one after another: where all bound neighbors are masked.
class NewMasks {
 public:
  //! \param rows  with n control points \param count  vertices
  NewMasks(const BindingRows& rows, Index n, Index count)
      : masks_(masks_in(rows)), given_(masks_, n, count) {}

  //! \return the masked control points, ascending
  std::vector<Index> add(Index vertex, const std::vector<Index>& neighbors);

  const std::vector<Mask>& all() const { return masks_; }

 private:
  const std::vector<Index>& at(Index vertex) const;

  std::vector<Mask> masks_;
  PointMasks given_;
  std::map<Index, std::vector<Index>> new_{};
};

//! \param block  of the weights \param most  pairs per vertex; 0 = all weights
template <class Mesh, class Block>
void bind_new(Mesh& mesh, Block& block, const Eigen::MatrixXd& cage, std::size_t most,
              RowBlock<double>& rest, NewMasks& masks, std::vector<OpenMesh::VertexHandle> open,
              std::vector<bool> are_bound) {
  const auto positions = positions_of(mesh);
  while (!open.empty()) {
    std::vector<OpenMesh::VertexHandle> done, left;
    for (const auto vertex : open) {
      const auto v = static_cast<std::size_t>(vertex.idx());
      Eigen::VectorXd mean = Eigen::VectorXd::Zero(cage.cols());
      std::vector<Index> neighbors;
      for (const auto neighbor : mesh.vv_range(vertex)) {
        if (!are_bound[static_cast<std::size_t>(neighbor.idx())]) continue;
        add_row(std::as_const(block)[static_cast<std::size_t>(neighbor.idx())], mean);
        neighbors.push_back(neighbor.idx());
      }
      if (neighbors.empty()) {
        left.push_back(vertex);
        continue;
      }
      mean /= static_cast<double>(neighbors.size());
      const auto position = std::as_const(positions)[v];
      const Eigen::VectorXd point = position.matrix().row(0).head(cage.rows());
      set_row(
          reproducing(cage, point, vertex.idx(), mean, most, masks.add(vertex.idx(), neighbors)),
          block[v]);
      rest[v] = position;
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

template <int Dim, class Mesh>
BindReport bind_to(Mesh& model, const Cage<Dim>& cage, const DomainMesh<Dim>* domain,
                   const Meshers<Dim>& meshers, const BindOptions& options) {
  if constexpr (!std::is_same_v<Mesh, TetMesh>) refuse_deleted_elements(model);
  const auto points = points_of<Dim>(model);
  const auto edges = edge_list_at<Dim>(model, points);
  auto binding = domain != nullptr ? Rig<Dim>(cage, *domain, points, edges, options).bind()
                                   : Rig<Dim>(cage, points, edges, options, meshers).bind();
  set_binding(model, binding, options.max_influences, options.weights);
  return std::move(binding.report);
}

}  // namespace internal

//! Binds a model to a cage: meshes the interior, solves, evaluates weights at the model vertices,
//! and reduces influences. The weights become a property, which deform() uses to move the model.
//! The current vertex positions become the rest positions; restore_rest() restores them.
//!
//! The domain mesh comes from the mesher that the program links (flbc/make_domain.h): flbc::cgal
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
//! weights of their neighbors, changed as little as is needed to reproduce their positions. A
//! control point that is masked at all bound neighbors is masked at a new vertex as well. New
//! vertices have no mirror image. The model must be at rest. Other vertices keep their weights.
//! \return number of new vertices
//! \throws InputError if the model was not bound, or naming a vertex that is not at rest, that no
//! neighbors connect with bound ones, or that lies outside the convex hull of the control points
//! that may move it. The model is then unchanged
template <class Model>
Index bind_new_vertices(Model& model, const std::string& weights = kWeights) {
  static_assert(!std::is_same_v<Model, TetMesh>, "the vertices of a TetMesh do not change");
  auto rows = internal::rows_in(model, weights);
  if (rows.rest.size() == 0 || rows.cage.size() == 0) {
    internal::refuse_without_weights(internal::name_of_rest(weights));
  }
  auto are_bound = internal::bound_vertices(model, weights);
  internal::require_at_rest(model, rows.rest, are_bound);
  std::vector<OpenMesh::VertexHandle> open;
  for (const auto vertex : model.vertices()) {
    if (!are_bound[static_cast<std::size_t>(vertex.idx())]) open.push_back(vertex);
  }
  const auto count = static_cast<Index>(open.size());
  if (count == 0) return 0;
  const auto cage = get_rest_cage(model, weights);
  const auto n = static_cast<Index>(cage.cols());
  internal::NewMasks masks(rows, n, static_cast<Index>(model.n_vertices()));
  const auto bind_with = [&](auto& property, std::size_t most) {
    auto block = property.data_vector();
    internal::bind_new(model, block, cage, most, rows.rest, masks, std::move(open),
                       std::move(are_bound));
    property.data_vector() = std::move(block);
    internal::set_masks(rows, masks.all(), n, static_cast<Index>(model.n_vertices()));
    internal::write_rows(model, rows, weights);
  };
  if (internal::find_property<Influences>(model, weights)) {
    auto& property = internal::get_property<Influences>(model, weights);
    bind_with(property, property.most());
  } else {
    weights_property(model, weights);
    bind_with(internal::get_property<Wide<double>>(model, weights), 0);
  }
  return count;
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
