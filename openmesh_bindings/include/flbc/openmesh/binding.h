// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A binding as properties of a mesh: weights, rest positions, offsets, rest cage, masks, and
//! mirror.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "flbc/binding.h"
#include "flbc/openmesh/convert.h"
#include "flbc/openmesh/weights.h"

namespace flbc::openmesh::internal {

//! \param dimension  of the rest cage; 0: there is none
[[noreturn]] void refuse_rest_cage(std::size_t dimension, const std::string& weights);

//! A block of zeros.
RowBlock<double> zeros(std::size_t elements, std::size_t components, std::size_t width);

//! The masks, one for each set of control points. \throws InputError if the properties are damaged
std::vector<Mask> masks_in(const BindingRows& rows);
//! \param n  control points \param count  vertices
void set_masks(BindingRows& rows, const std::vector<Mask>& masks, Index n, Index count);

//! All of a binding but rest positions.
template <int Dim>
BindingRows rows_of(const Binding<Dim>& binding);

//! A binding without edges.
//! \param positions  of the vertices, where those without weights are \param name  of the weights
template <int Dim>
Binding<Dim> binding_from(SparseWeights weights, const BindingRows& rows,
                          const RowBlock<double>& positions, const std::string& name);

//! A row per vertex.
template <class Mesh>
RowBlock<double> positions_of(const Mesh& mesh) {
  auto rows = zeros(mesh.n_vertices(), 1, static_cast<std::size_t>(kPointSize<Mesh>));
  for (const auto vertex : mesh.vertices()) {
    const auto& point = mesh.point(vertex);
    const auto row = rows[static_cast<std::size_t>(vertex.idx())];
    for (int d = 0; d < kPointSize<Mesh>; ++d) {
      row[static_cast<std::size_t>(d)] = static_cast<double>(point[d]);
    }
  }
  return rows;
}

template <class Mesh>
BindingRows rows_in(const Mesh& mesh, const std::string& weights) {
  BindingRows rows;
  visit_rows(weights, [&](auto handle, const std::string& name, auto member) {
    if (mesh.get_property_handle(handle, name)) {
      rows.*member = wide_property(mesh, handle).data_vector();
    }
  });
  return rows;
}

//! The binding that a mesh has. Vertices that were not bound have no weights.
//! \throws InputError if the mesh has no weights of this name, or weights for another cage
template <int Dim, class Mesh>
Binding<Dim> binding_of(const Mesh& mesh, const BindingRows& rows, const std::string& weights) {
  auto binding = binding_from<Dim>(get_weights(mesh, weights), rows, positions_of(mesh), weights);
  binding.edges = edge_list_at<Dim>(mesh, binding.rest());
  return binding;
}

//! Writes properties, and removes those without elements.
template <class Mesh>
void write_rows(Mesh& mesh, const BindingRows& rows, const std::string& weights) {
  visit_rows(weights, [&](auto handle, const std::string& name, auto member) {
    const auto& block = rows.*member;
    const bool is_there = mesh.get_property_handle(handle, name);
    if (block.size() == 0) {
      if (is_there) mesh.remove_property(handle);
      return;
    }
    if (!is_there) mesh.add_property(handle, name);
    wide_property(mesh, handle).data_vector() = block;
  });
}

//! Attaches a binding, in place of what has this name.
//! \param influences  per vertex, in the form Influences; more if some need more. 0: Wide<double>
template <class Mesh>
void attach(Mesh& mesh, const SparseWeights& weights, const BindingRows& rows, Index influences,
            const std::string& name) {
  if (influences == 0) {
    set_weights(mesh, weights, name);
  } else {
    Index most = (std::min)(influences, weights.num_control_points());
    for (Index v = 0; v < weights.num_points(); ++v) most = (std::max)(most, weights.count(v));
    set_influences(mesh, weights, static_cast<std::size_t>(most), name);
  }
  write_rows(mesh, rows, name);
}

}  // namespace flbc::openmesh::internal

namespace flbc::openmesh {

//! What bind() has attached, as a value with all functions of a Binding. It has no domain mesh.
//! io::write_binding() writes it to a file (flbc/io/binding_file.h).
//! \throws InputError if the mesh has no weights of this name, or of another dimension
template <int Dim, class Mesh>
Binding<Dim> get_binding(const Mesh& mesh, const std::string& weights = kWeights) {
  return internal::binding_of<Dim>(mesh, internal::rows_in(mesh, weights), weights);
}

//! Attaches a binding as bind() does, for example one that io::read_binding() has read.
//! \param mesh  at rest, with the vertices of the binding in its order
//! \param max_influences  per vertex, in the form Influences; more if some need more. 0: Wide<double>
//! \throws InputError if the vertices are not those of the binding. The mesh is then unchanged
template <class Mesh, int Dim>
void set_binding(Mesh& mesh, const Binding<Dim>& binding, Index max_influences,
                 const std::string& weights = kWeights) {
  binding.require_points(points_of<Dim>(mesh));
  auto rows = internal::rows_of(binding);
  rows.rest = internal::positions_of(mesh);
  internal::attach(mesh, binding.weights, rows, max_influences, weights);
}

}  // namespace flbc::openmesh
