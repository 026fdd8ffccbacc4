// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights as vertex properties. A name has one property, in one of two forms: Wide<double> with
//! all n weights per vertex, or Influences with the nonzero weights.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>

#include <OpenMesh/Core/Utils/Property.hh>

#include "flbc/cage.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/openmesh/elements.h"
#include "flbc/openmesh/influences.h"
#include "flbc/openmesh/wide_property.h"

namespace flbc::openmesh {

//! Name of the property of weights.
inline constexpr const char* kWeights = "flbc:weights";

//! Name of the property of their gradients (gradients.h).
inline std::string gradients_name(const std::string& weights = kWeights) {
  return weights + ":gradients";
}

namespace internal {

//! \return the property of the vertices with this name and type; null if there is none
template <class T, class Mesh>
const OpenMesh::PropertyT<T>* find_property(const Mesh& mesh, const std::string& name) {
  OpenMesh::VPropHandleT<T> handle;
  return mesh.get_property_handle(handle, name) ? &mesh.property(handle) : nullptr;
}

//! The property with this name and type, made if there is none.
template <class T, class Mesh>
OpenMesh::PropertyT<T>& get_property(Mesh& mesh, const std::string& name) {
  OpenMesh::VPropHandleT<T> handle;
  if (!mesh.get_property_handle(handle, name)) mesh.add_property(handle, name);
  return mesh.property(handle);
}

template <class T, class Mesh>
void remove_property(Mesh& mesh, const std::string& name) {
  OpenMesh::VPropHandleT<T> handle;
  if (mesh.get_property_handle(handle, name)) mesh.remove_property(handle);
}

void require_number_of_vertices(Eigen::Index in_weights, std::size_t in_mesh);
void require_control_points(std::size_t in_weights, Eigen::Index in_cage);
[[noreturn]] void refuse_without_weights(const std::string& name);

//! \throws InputError if the numbers of vertices and of rows of weights differ
void require_vertices(std::size_t vertices, std::size_t rows);

SparseWeights to_sparse(const RowBlock<double>& rows);
SparseWeights to_sparse(const InfluenceBlock& block);

//! \param most  pairs per point; 0 = the maximum over all points
InfluenceBlock to_influences(const SparseWeights& weights, std::size_t most);

//! Finds or adds a wide property with a shape. \return the property, and whether it existed with
//! this shape; otherwise its values are 0
template <class Handle, class Mesh>
std::pair<OpenMesh::PropertyT<typename Handle::Value>*, bool> attach_rows(Mesh& mesh,
                                                                          const std::string& name,
                                                                          std::size_t components,
                                                                          std::size_t width) {
  Handle handle;
  bool is_there = mesh.get_property_handle(handle, name);
  if (!is_there) mesh.add_property(handle, name);
  OpenMesh::PropertyT<typename Handle::Value>* property;
  if constexpr (std::is_same_v<typename Handle::Handle, OpenMesh::MeshHandle>) {
    property = &mesh.mproperty(handle);
  } else {
    property = &mesh.property(handle);
  }
  is_there = is_there && property->components() == components && property->width() == width;
  if (!is_there) property->set_shape(components, width);
  return {property, is_there};
}

std::string name_of_cage(const std::string& weights);
std::string name_of_offset(const std::string& weights);
std::string name_of_rest(const std::string& weights);
std::string name_of_masks(const std::string& weights);
std::string name_of_mirror(const std::string& weights);
std::string name_of_held(const std::string& weights);

//! What a binding has next to its weights, as properties store it; without elements: nothing.
//! Values of new vertices are 0.
struct BindingRows {
  //! Per vertex: Dim values to add to weighted control points. Only vertices outside have some;
  //! they are negligible where the weights include them.
  RowBlock<double> offsets{};
  RowBlock<double> rest{};      //!< per vertex: its position at rest
  RowBlock<double> cage{};      //!< a row of Dim values per control point
  RowBlock<double> kinds{};     //!< per vertex: the row of `masks`, from 1; 0: none
  RowBlock<double> masks{};     //!< a row of n values per set of masked control points: 1 = masked
  RowBlock<double> partners{};  //!< per vertex: its number, and that of its image; from 1; 0: none
  RowBlock<double> mirror{};    //!< the axis, and the image of each control point
  RowBlock<double> held{};      //!< a value per control point: 1 = a joint holds it
};

//! Calls a function for each property of BindingRows: action(handle, name, member).
template <class Action>
void visit_rows(const std::string& weights, const Action& action) {
  const OpenMesh::VPropHandleT<Wide<double>> of_vertices;
  const OpenMesh::MPropHandleT<Wide<double>> of_mesh;
  action(of_vertices, name_of_offset(weights), &BindingRows::offsets);
  action(of_vertices, name_of_rest(weights), &BindingRows::rest);
  action(of_mesh, name_of_cage(weights), &BindingRows::cage);
  action(of_vertices, name_of_masks(weights), &BindingRows::kinds);
  action(of_mesh, name_of_masks(weights), &BindingRows::masks);
  action(of_vertices, name_of_mirror(weights), &BindingRows::partners);
  action(of_mesh, name_of_mirror(weights), &BindingRows::mirror);
  action(of_mesh, name_of_held(weights), &BindingRows::held);
}

template <class Mesh>
auto& wide_property(Mesh& mesh, OpenMesh::VPropHandleT<Wide<double>> handle) {
  return mesh.property(handle);
}
template <class Mesh>
auto& wide_property(Mesh& mesh, OpenMesh::MPropHandleT<Wide<double>> handle) {
  return mesh.mproperty(handle);
}

//! Removes the property of this name in the form other than T, with the properties that other
//! weights would contradict.
template <class T, class Mesh>
void make_way_for(Mesh& mesh, const std::string& name) {
  if constexpr (!std::is_same_v<T, Influences>) remove_property<Influences>(mesh, name);
  if constexpr (!std::is_same_v<T, Wide<double>>) remove_property<Wide<double>>(mesh, name);
  visit_rows(name, [&](auto handle, const std::string& other, auto member) {
    if (member == &BindingRows::rest || member == &BindingRows::cage) return;
    if (mesh.get_property_handle(handle, other)) mesh.remove_property(handle);
  });
  typename Elements<Mesh>::template CellProperty<Wide<double>> gradients;
  if (mesh.get_property_handle(gradients, gradients_name(name))) mesh.remove_property(gradients);
}

}  // namespace internal

//! Attaches weights to the vertices of any mesh, such as a model, as Wide<double>.
//! \param weights  of V points
//! \throws InputError if their number is not the number of vertices
template <class Mesh>
void set_weights(Mesh& mesh, const SparseWeights& weights, const std::string& name = kWeights) {
  internal::require_number_of_vertices(weights.num_points(), mesh.n_vertices());
  internal::make_way_for<Wide<double>>(mesh, name);
  auto& rows = internal::get_property<Wide<double>>(mesh, name);
  const auto n = static_cast<std::size_t>(weights.num_control_points());
  rows.set_shape(1, n);
  std::fill_n(rows.data(), n * mesh.n_vertices(), 0.0);
  for (Index v = 0; v < weights.num_points(); ++v) {
    double* row = rows.data() + static_cast<std::size_t>(v) * n;
    weights.visit(v, [row](Index i, double weight) { row[i] = weight; });
  }
}

//! Attaches weights to the vertices of any mesh as Influences.
//! \param most  pairs per vertex; 0 = the maximum over all vertices
//! \throws InputError if their number is not the number of vertices, or a vertex has more than
//! `most`
template <class Mesh>
void set_influences(Mesh& mesh, const SparseWeights& weights, std::size_t most = 0,
                    const std::string& name = kWeights) {
  internal::require_number_of_vertices(weights.num_points(), mesh.n_vertices());
  auto block = internal::to_influences(weights, most);
  internal::make_way_for<Influences>(mesh, name);
  internal::get_property<Influences>(mesh, name).data_vector() = std::move(block);
}

//! The property of weights in the form Wide<double>.
//! \throws InputError if the mesh has no weights of this name
template <class Mesh>
const OpenMesh::PropertyT<Wide<double>>& weights_property(const Mesh& mesh,
                                                          const std::string& name = kWeights) {
  const auto* rows = internal::find_property<Wide<double>>(mesh, name);
  if (!rows) internal::refuse_without_weights(name);
  return *rows;
}

//! The weights of the V vertices, from either form.
//! \throws InputError if the mesh has no weights of this name, or clean() has removed vertices but
//! not their properties
template <class Mesh>
SparseWeights get_weights(const Mesh& mesh, const std::string& name = kWeights) {
  const auto* influences = internal::find_property<Influences>(mesh, name);
  auto weights = influences ? internal::to_sparse(influences->data_vector())
                            : internal::to_sparse(weights_property(mesh, name).data_vector());
  internal::require_vertices(mesh.n_vertices(), static_cast<std::size_t>(weights.num_points()));
  return weights;
}

//! Stores the rest cage with the weights, as MProp<Wide<double>> with one element: a row of Dim
//! values per control point.
template <class Mesh, int Dim>
void set_rest_cage(Mesh& mesh, const PointList<Dim>& control_points,
                   const std::string& weights = kWeights) {
  OpenMesh::MPropHandleT<Wide<double>> handle;
  const auto name = internal::name_of_cage(weights);
  if (!mesh.get_property_handle(handle, name)) mesh.add_property(handle, name);
  auto& property = mesh.mproperty(handle);
  property.set_shape(static_cast<std::size_t>(control_points.cols()), Dim);
  property[0].matrix() = control_points.transpose();
}

//! The cage stored by set_rest_cage(); empty if there is none. \return Dim x n
template <class Mesh>
Eigen::MatrixXd get_rest_cage(const Mesh& mesh, const std::string& weights = kWeights) {
  OpenMesh::MPropHandleT<Wide<double>> handle;
  if (!mesh.get_property_handle(handle, internal::name_of_cage(weights))) return {};
  return mesh.mproperty(handle)[0].matrix().transpose();
}

}  // namespace flbc::openmesh
