// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The properties of a TetMesh in OpenMesh's own containers.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>

#include <OpenMesh/Core/Mesh/Handles.hh>
#include <OpenMesh/Core/Utils/PropertyContainer.hh>

#include "flbc/openmesh/tet_handles.h"

namespace flbc::openmesh {

namespace internal {

//! Which of the containers has the properties of this kind of element.
template <class Handle>
inline constexpr int kContainer = -1;
template <>
inline constexpr int kContainer<OpenMesh::VertexHandle> = 0;
template <>
inline constexpr int kContainer<OpenMesh::EdgeHandle> = 1;
template <>
inline constexpr int kContainer<OpenMesh::FaceHandle> = 2;
template <>
inline constexpr int kContainer<CellHandle> = 3;
template <>
inline constexpr int kContainer<OpenMesh::MeshHandle> = 4;

}  // namespace internal

//! A container per kind of element. Copies own copies of all properties; moving and swapping leave
//! properties where they are, so that pointers to their data stay valid. A mesh that was moved from
//! has none.
class TetProperties {
 public:
  TetProperties() : containers_(std::make_unique<Containers>()) {}
  TetProperties(const TetProperties& other)
      : containers_(std::make_unique<Containers>(*other.containers_)) {}
  TetProperties(TetProperties&& other) noexcept : TetProperties() { swap(other); }
  TetProperties& operator=(TetProperties other) noexcept {
    swap(other);
    return *this;
  }
  ~TetProperties() = default;

  void swap(TetProperties& other) noexcept { containers_.swap(other.containers_); }

  //! The container of the properties of an element type (MeshHandle: of the mesh itself).
  template <class Handle>
  OpenMesh::PropertyContainer& of() {
    return (*containers_)[place<Handle>()];
  }
  template <class Handle>
  const OpenMesh::PropertyContainer& of() const {
    return (*containers_)[place<Handle>()];
  }

  //! Adds elements one by one, which for all containers of numbers takes constant time on average.
  template <class Handle>
  void grow(std::size_t size) {
    for (OpenMesh::BaseProperty* property : of<Handle>().properties()) {
      while (property && property->n_elements() < size) property->push_back();
    }
  }

 private:
  using Containers = std::array<OpenMesh::PropertyContainer, 5>;

  template <class Handle>
  static constexpr std::size_t place() {
    static_assert(internal::kContainer<Handle> >= 0,
                  "a tetrahedral mesh has vertices, edges, faces and cells only");
    return static_cast<std::size_t>(internal::kContainer<Handle>);
  }

  std::unique_ptr<Containers> containers_;
};

}  // namespace flbc::openmesh
