// SPDX-License-Identifier: BSD-3-Clause
// The binary part of a .glb file. Only for glb_writer.cpp, which includes the underlying library.
#pragma once

#include <tiny_gltf.h>

#include <cstring>
#include <string>
#include <type_traits>

#include <Eigen/Core>

#include "flbc/errors.h"

namespace flbc::gltf {

template <class Number>
constexpr int component_type() {
  if constexpr (std::is_same_v<Number, std::uint8_t>) return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  if constexpr (std::is_same_v<Number, std::uint16_t>) {
    return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  }
  if constexpr (std::is_same_v<Number, std::uint32_t>) return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if constexpr (std::is_same_v<Number, float>) return TINYGLTF_COMPONENT_TYPE_FLOAT;
}

inline int element_type(Eigen::Index rows) {
  switch (rows) {
    case 1:
      return TINYGLTF_TYPE_SCALAR;
    case 2:
      return TINYGLTF_TYPE_VEC2;
    case 3:
      return TINYGLTF_TYPE_VEC3;
    case 4:
      return TINYGLTF_TYPE_VEC4;
    default:
      return TINYGLTF_TYPE_MAT4;
  }
}

//! Appends to the single buffer of a model.
class GlbBuffer {
 public:
  explicit GlbBuffer(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

  //! \return the number of the buffer view
  int add_bytes(const void* bytes, std::size_t size, int target) {
    // A larger buffer, with its description, might exceed the 32-bit length of the file.
    constexpr std::size_t kMaxBytes = 4'000'000'000;
    constexpr std::size_t kAlignment = 4;
    auto& data = model_.buffers[0].data;
    data.resize((data.size() + kAlignment - 1) / kAlignment * kAlignment);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
    if (view.byteOffset + size > kMaxBytes) {
      throw InputError("it has too many vertices: a .glb file cannot be larger than 4 GB");
    }
    data.resize(view.byteOffset + size);
    std::memcpy(data.data() + view.byteOffset, bytes, size);
    model_.bufferViews.push_back(view);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  //! Appends one column per element. \return the number of the accessor
  template <class Number, class Matrix>
  int add_accessor(const Matrix& columns, int target, bool has_bounds = false) {
    // The values must be contiguous. NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
    const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic> numbers =
        columns.template cast<Number>();
    tinygltf::Accessor accessor;
    accessor.bufferView = add_bytes(
        numbers.data(), static_cast<std::size_t>(numbers.size()) * sizeof(Number), target);
    accessor.componentType = component_type<Number>();
    accessor.type = element_type(numbers.rows());
    accessor.count = static_cast<std::size_t>(numbers.cols());
    if (has_bounds) {
      for (const auto& row : numbers.rowwise()) {
        accessor.minValues.push_back(row.minCoeff());
        accessor.maxValues.push_back(row.maxCoeff());
      }
    }
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  template <class Number, class Matrix>
  int add_attribute(const Matrix& columns, bool has_bounds = false) {
    return add_accessor<Number>(columns, TINYGLTF_TARGET_ARRAY_BUFFER, has_bounds);
  }

  //! Vertex indices; the largest value of each type is not a valid index.
  template <class Matrix>
  int add_indices(const Matrix& elements, Eigen::Index num_vertices) {
    const auto indices = elements.reshaped(1, elements.size());
    constexpr int kTarget = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
    return num_vertices <= std::numeric_limits<std::uint16_t>::max()
               ? add_accessor<std::uint16_t>(indices, kTarget)
               : add_accessor<std::uint32_t>(indices, kTarget);
  }

 private:
  tinygltf::Model& model_;
};

}  // namespace flbc::gltf
