// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights as properties, in the forms in which OpenMesh users hold them, and what they are for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <OpenMesh/Core/Utils/Property.hh>

#include "flbc/cage.h"
#include "flbc/errors.h"
#include "flbc/openmesh/wide_property.h"

namespace flbc::openmesh {

//! Name of the property of weights, a row of n numbers per vertex.
inline constexpr const char* kWeights = "flbc:weights";

//! Attaches weights to the vertices of any mesh, for example a model's.
//! \param weights  n x V \throws InputError if their number is not that of the vertices
template <class Mesh>
void set_weights(Mesh& mesh, const WeightMatrix& weights, const std::string& name = kWeights) {
  if (weights.cols() != static_cast<Eigen::Index>(mesh.n_vertices())) {
    throw InputError("weights for " + std::to_string(weights.cols()) +
                     " points do not belong to a mesh with " + std::to_string(mesh.n_vertices()) +
                     " vertices");
  }
  OpenMesh::VPropHandleT<Wide<double>> handle;
  if (!mesh.get_property_handle(handle, name)) mesh.add_property(handle, name);
  auto& rows = mesh.property(handle);
  rows.set_shape(1, static_cast<std::size_t>(weights.rows()));
  for (Eigen::Index v = 0; v < weights.cols(); ++v) {
    Eigen::Map<Eigen::VectorXd>(rows.data() + static_cast<std::size_t>(v) * rows.stride(),
                                weights.rows()) = weights.col(v);
  }
}

//! The property of weights. \throws InputError if the mesh has none of this name
template <class Mesh>
const OpenMesh::PropertyT<Wide<double>>& weights_property(const Mesh& mesh,
                                                          const std::string& name = kWeights) {
  OpenMesh::VPropHandleT<Wide<double>> handle;
  if (!mesh.get_property_handle(handle, name)) {
    throw InputError("the mesh has no weights: there is no vertex property '" + name + "'");
  }
  return mesh.property(handle);
}

//! n x V.
template <class Mesh>
WeightMatrix get_weights(const Mesh& mesh, const std::string& name = kWeights) {
  const auto& rows = weights_property(mesh, name);
  return Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>(
      rows.data(), static_cast<Eigen::Index>(rows.width()),
      static_cast<Eigen::Index>(rows.n_elements()),
      Eigen::OuterStride<>(static_cast<Eigen::Index>(rows.stride())));
}

//! Writes the weights as VProp<std::vector<double>> of this name, which survives .om files for
//! programs that know nothing of this library.
template <class Mesh>
void write_vectors(Mesh& mesh, const std::string& name, const std::string& from = kWeights) {
  const auto& rows = weights_property(mesh, from);
  OpenMesh::VPropHandleT<std::vector<double>> handle;
  if (!mesh.get_property_handle(handle, name)) mesh.add_property(handle, name);
  for (const auto v : mesh.vertices()) {
    const double* row = rows.data() + static_cast<std::size_t>(v.idx()) * rows.stride();
    mesh.property(handle, v).assign(row, row + rows.width());
  }
}

//! Writes the weights above a threshold as VProp<std::vector<std::uint32_t>> name + "_indices" and
//! VProp<std::vector<double>> name + "_values", control points ascending.
//! \param threshold  of the absolute value; 0 keeps all that are not zero
template <class Mesh>
void write_pairs(Mesh& mesh, const std::string& name, double threshold = 0,
                 const std::string& from = kWeights) {
  const auto& rows = weights_property(mesh, from);
  OpenMesh::VPropHandleT<std::vector<std::uint32_t>> indices;
  OpenMesh::VPropHandleT<std::vector<double>> values;
  if (!mesh.get_property_handle(indices, name + "_indices")) {
    mesh.add_property(indices, name + "_indices");
  }
  if (!mesh.get_property_handle(values, name + "_values")) {
    mesh.add_property(values, name + "_values");
  }
  for (const auto v : mesh.vertices()) {
    auto& kept = mesh.property(indices, v);
    auto& numbers = mesh.property(values, v);
    kept.clear();
    numbers.clear();
    const double* row = rows.data() + static_cast<std::size_t>(v.idx()) * rows.stride();
    for (std::size_t i = 0; i < rows.width(); ++i) {
      if (!(std::abs(row[i]) > threshold)) continue;
      kept.push_back(static_cast<std::uint32_t>(i));
      numbers.push_back(row[i]);
    }
  }
}

//! Moves the mesh's points to where a deformed cage takes them, x = sum_i w_i c_i. A third
//! coordinate of a plane mesh stays.
//! \throws InputError if the cage has another number of control points than there are weights
template <class Mesh, int Dim>
void deform(Mesh& mesh, const Cage<Dim>& cage, const std::string& name = kWeights) {
  const auto& rows = weights_property(mesh, name);
  if (rows.width() != static_cast<std::size_t>(cage.size())) {
    throw InputError("weights for " + std::to_string(rows.width()) +
                     " control points do not belong to a cage with " + std::to_string(cage.size()));
  }
  for (const auto v : mesh.vertices()) {
    const Eigen::Map<const Eigen::VectorXd> row(
        rows.data() + static_cast<std::size_t>(v.idx()) * rows.stride(), cage.size());
    const Vector<Dim> moved = cage.points * row;
    auto point = mesh.point(v);
    for (int d = 0; d < Dim; ++d) {
      using Coordinate = std::decay_t<decltype(point[d])>;
      point[d] = static_cast<Coordinate>(moved[d]);
    }
    mesh.set_point(v, point);
  }
}

}  // namespace flbc::openmesh
