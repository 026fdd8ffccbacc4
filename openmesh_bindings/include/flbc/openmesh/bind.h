// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Computes weights on a model from a cage in one call. deform.h then moves the model with the
//! cage.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>

#include "flbc/meshing.h"
#include "flbc/openmesh/convert.h"
#include "flbc/openmesh/deform.h"
#include "flbc/openmesh/meshers.h"
#include "flbc/openmesh/sparsify.h"
#include "flbc/openmesh/weights.h"
#include "flbc/options.h"
#include "flbc/placement.h"
#include "flbc/report.h"

namespace flbc::openmesh {

//! Treatment of the model's vertices outside the cage. With kNearest they follow the nearest point
//! of the cage at a constant offset. kExtend needs BindOptions::max_influences = 0, because
//! negative weights cannot be reduced.
using flbc::OutsidePoints;

//! Options of bind().
struct BindOptions {
  //! Number of vertices of the domain mesh; 0: the minimum that element quality allows. The default
  //! is increased automatically if a cage needs more.
  Index vertices = kDefaultVertices;
  static constexpr Index kDefaultVertices = 10000;  //!< same as for the program flbc

  SolverOptions solver{};                        //!< method, tolerance, threads, progress
  Index max_influences = 8;                      //!< per vertex; 0 = keep all weights
  Reduction reduction = Reduction::kPoisson;     //!< how influences are reduced
  OutsidePoints outside = OutsidePoints::kFail;  //!< vertices outside the cage
  std::string weights = kWeights;                //!< name of the property
  bool persistent = false;                       //!< whether .om files store the properties
};

//! Report of bind().
struct BindReport {
  SolveReport solve{};  //!< on the domain mesh
  Quality quality{};    //!< of the final weights on the model
  Index outside = 0;    //!< number of vertices outside the cage
  double mesh_seconds = 0, solve_seconds = 0, evaluate_seconds = 0, sparsify_seconds = 0;
};

namespace internal {

//! The cage, domain and mesher to bind with. The mesher, which may be empty if there is a domain,
//! makes the domain and coarser meshes.
template <int Dim>
struct BindInput {
  const Cage<Dim>& cage;
  const PointList<Dim>& points;
  const EdgeList& edges;
  const DomainMesh<Dim>* domain;  // may be null
  Mesher<Dim> mesher;
};

//! Weights of points.
template <int Dim>
struct Binding {
  SparseWeights weights;
  RowBlock<double> offsets;  //!< of width 0 if no point lies outside
  BindReport report;
};

template <int Dim>
Binding<Dim> bind_points(const BindInput<Dim>& input, const BindOptions& options);

template <class T>
struct IsCage : std::false_type {};
template <int Dim>
struct IsCage<Cage<Dim>> : std::true_type {};

template <class AnyCage>
auto as_cage(const AnyCage& cage) {
  if constexpr (IsCage<AnyCage>::value) {
    return cage;
  } else if constexpr (kPointSize<AnyCage> == 2) {
    return to_outline(cage);
  } else {
    return to_cage(cage);
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

template <int Dim, class Mesh>
BindReport bind_to(Mesh& model, const Cage<Dim>& cage, const DomainMesh<Dim>* domain,
                   const Mesher<Dim>& mesher, const BindOptions& options) {
  if constexpr (!std::is_same_v<Mesh, TetMesh>) refuse_deleted_elements(model);
  const auto points = points_of<Dim>(model);
  const auto edges = edge_list_at<Dim>(model, points);
  auto binding = bind_points<Dim>({cage, points, edges, domain, mesher}, options);
  if (options.max_influences > 0) {
    set_influences(model, binding.weights,
                   static_cast<std::size_t>(std::min(options.max_influences, cage.size())),
                   options.weights, options.persistent);
  } else {
    set_weights(model, binding.weights.dense(), options.weights, options.persistent);
  }
  set_offsets(model, binding.offsets, options.weights, options.persistent);
  set_rest_cage(model, cage.points, options.weights, options.persistent);
  keep_rest(model, options.weights, options.persistent);
  return std::move(binding.report);
}

}  // namespace internal

//! Binds a model to a cage: meshes the interior, solves, evaluates weights at the model vertices,
//! and reduces influences. The weights become a property, which deform() uses to move the model.
//! The current vertex positions become the rest positions; restore_rest() restores them.
//!
//! The domain mesh comes from tetrahedralize(), or from triangulate() for a cage in the plane. Link
//! the component flbc::tetgen or flbc::cgal.
//! \param model  a mesh of triangles or polygons, with points of floats or doubles, or a TetMesh
//! \param cage  a Cage, or a mesh: a closed surface, or a planar mesh whose boundary is the cage
//! (points with two coordinates)
//! \throws InputError naming the defect of cage or model; OptionError, SolverError. The model is
//! then unchanged
template <class Model, class AnyCage>
BindReport bind(Model& model, const AnyCage& any_cage, const BindOptions& options = {}) {
  const auto cage = internal::as_cage(any_cage);
  if constexpr (std::is_same_v<std::decay_t<decltype(cage)>, Cage<2>>) {
    return internal::bind_to<2>(model, cage, nullptr, triangulate, options);
  } else {
    return internal::bind_to<3>(model, cage, nullptr, tetrahedralize, options);
  }
}

//! The same with a given domain mesh, which needs no component. If a mesher component is linked,
//! the solve may use it for a multilevel start.
//! \param domain  see normalize_and_validate()
template <class Model, int Dim>
BindReport bind(Model& model, const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                const BindOptions& options = {}) {
  return internal::bind_to<Dim>(model, cage, &domain, internal::linked_mesher<Dim>(), options);
}

//! Restores the vertex positions at the time of bind().
//! \throws InputError if the model was not bound
template <class Model>
void restore_rest(Model& model, const std::string& weights = kWeights) {
  const auto* rest = internal::find_property<Wide<double>>(model, internal::name_of_rest(weights));
  if (!rest) internal::refuse_without_weights(internal::name_of_rest(weights));
  for (const auto vertex : model.vertices()) {
    auto point = model.point(vertex);
    using Coordinate = std::decay_t<decltype(point[0])>;
    for (int d = 0; d < kPointSize<Model>; ++d) {
      point[d] = static_cast<Coordinate>((*rest)[vertex.idx()][static_cast<std::size_t>(d)]);
    }
    model.set_point(vertex, point);
  }
}

}  // namespace flbc::openmesh
