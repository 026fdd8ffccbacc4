// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Bindings as files: archives of NumPy arrays (.npz), whose weights scipy.sparse.load_npz() reads.
#pragma once

#include <string>
#include <variant>

#include "flbc/binding.h"

namespace flbc::io {

using AnyBinding = std::variant<Binding<2>, Binding<3>>;

//! Writes a binding. A row belongs to a point, a vertex, a facet, or a cell:
//! - format, shape, indptr, indices, data: the weights, P x n, as SciPy stores them
//! - cage (n x Dim), facets, points (P x Dim), offsets, edges, edge_weights, outside
//! - mask_sizes (M x 2), mask_control_points, mask_points: the M masks, one after the other
//! - solid_sizes, solid_points: the same for solid regions, if there are any
//! - mirror_images (n), mirror_partners (P)
//! - domain (V x Dim), cells, domain_indptr, domain_indices, domain_data
//! - info: JSON of the rest: version, policy for points outside, method
//! \throws IoError; InputError if a weight is not finite
template <int Dim>
void write_binding(const std::string& path, const Binding<Dim>& binding);

//! Reads a binding that write_binding() has written. \throws IoError; InputError naming the array
AnyBinding read_binding(const std::string& path);

//! The content of such a file. \throws InputError if a weight is not finite
template <int Dim>
std::string encode_binding(const Binding<Dim>& binding);

//! The inverse. \throws InputError naming the array
AnyBinding decode_binding(std::string content);

//! Whether a file may hold a binding, by its extension.
bool is_binding_file(const std::string& path);

}  // namespace flbc::io
