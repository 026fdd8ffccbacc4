// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A tetrahedral mesh with the interface of OpenMesh: handles, ranges, circulators, properties.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <OpenMesh/Core/Utils/PropertyContainer.hh>

#include "flbc/domain_mesh.h"
#include "flbc/openmesh/tet_connectivity.h"

namespace flbc::openmesh {

//! Vertices with points, edges, faces, and tetrahedra, made from a DomainMesh. To add or remove
//! elements, assign another one.
//!
//! Properties are OpenMesh's PropertyT, with the property handles of OpenMesh for vertices, edges,
//! faces, and the mesh, and CPropHandleT for cells. They always have as many elements as the mesh.
//! Access performs no range check.
class TetMesh : public TetConnectivity {
 public:
  using Point = OpenMesh::Vec3d;

  TetMesh() = default;

  //! A mesh with these vertices and cells. \throws InputError as assign() does
  static TetMesh from(const DomainMesh<3>& mesh);

  //! Replaces points and cells. Cells with negative volume are reversed by swapping their last two
  //! vertices. Properties are kept and resized: values stay with their indices, and new elements
  //! have default values.
  //! \throws InputError naming the element if normalize_and_validate() throws; then nothing changes
  void assign(const DomainMesh<3>& mesh);

  //! The same for a mesh that passed normalize_and_validate(); only builds the connectivity.
  void assign_valid(const DomainMesh<3>& mesh);

  //! The points and cells in their order.
  DomainMesh<3> domain() const;

  const Point& point(VertexHandle vertex) const { return points_[index(vertex)]; }
  Point& point(VertexHandle vertex) { return points_[index(vertex)]; }
  void set_point(VertexHandle vertex, const Point& point) { points_[index(vertex)] = point; }

  //! The number of elements of a kind; 1 for OpenMesh::MeshHandle.
  template <class Handle>
  std::size_t n_elements() const {
    return std::array{n_vertices(), n_edges(), n_faces(), n_cells(),
                      std::size_t{1}}[kind<Handle>()];
  }

  //! Adds a property with default values. \param handle  becomes valid
  template <class PropHandle>
  void add_property(PropHandle& handle, const std::string& name = "<unknown>") {
    using Handle = typename PropHandle::Handle;
    handle = PropHandle(container<Handle>().add(typename PropHandle::Value(), name));
    container<Handle>().resize(n_elements<Handle>());
  }

  //! Removes a property with its data. \param handle  becomes invalid; an invalid handle has no
  //! effect
  template <class PropHandle>
  void remove_property(PropHandle& handle) {
    if (handle.is_valid()) container<typename PropHandle::Handle>().remove(handle);
    handle.reset();
  }

  //! Looks for a property with this name and the type of the handle.
  //! \param handle  becomes invalid if there is none \return whether there is one
  template <class PropHandle>
  bool get_property_handle(PropHandle& handle, const std::string& name) const {
    const auto& properties = properties_[kind<typename PropHandle::Handle>()];
    handle = PropHandle(properties.handle(typename PropHandle::Value(), name));
    return handle.is_valid();
  }

  //! The property itself; for a property of the mesh, its single value.
  template <class PropHandle>
  decltype(auto) property(PropHandle handle) {
    return access<PropHandle>(container<typename PropHandle::Handle>().property(handle));
  }
  template <class PropHandle>
  decltype(auto) property(PropHandle handle) const {
    return access<PropHandle>(properties_[kind<typename PropHandle::Handle>()].property(handle));
  }

  //! A property of the mesh itself, as a property with one element.
  template <class T>
  OpenMesh::PropertyT<T>& mproperty(OpenMesh::MPropHandleT<T> handle) {
    return container<OpenMesh::MeshHandle>().property(handle);
  }
  template <class T>
  const OpenMesh::PropertyT<T>& mproperty(OpenMesh::MPropHandleT<T> handle) const {
    return properties_[kind<OpenMesh::MeshHandle>()].property(handle);
  }

  //! The value of a property for an element.
  template <class PropHandle>
  typename OpenMesh::PropertyT<typename PropHandle::Value>::reference property(
      PropHandle handle, typename PropHandle::Handle element) {
    return property(handle)[element.idx()];
  }
  template <class PropHandle>
  typename OpenMesh::PropertyT<typename PropHandle::Value>::const_reference property(
      PropHandle handle, typename PropHandle::Handle element) const {
    return property(handle)[element.idx()];
  }

 private:
  static std::size_t index(VertexHandle vertex) { return static_cast<std::size_t>(vertex.idx()); }

  template <class Handle>
  static constexpr std::size_t kind() {
    constexpr bool kKinds[] = {
        std::is_same_v<Handle, VertexHandle>, std::is_same_v<Handle, EdgeHandle>,
        std::is_same_v<Handle, FaceHandle>, std::is_same_v<Handle, CellHandle>,
        std::is_same_v<Handle, OpenMesh::MeshHandle>};
    std::size_t kind = 0;
    while (kind < 5 && !kKinds[kind]) ++kind;
    return kind;
  }

  template <class Handle>
  OpenMesh::PropertyContainer& container() {
    static_assert(kind<Handle>() < 5, "a tetrahedral mesh has vertices, edges, faces, cells only");
    return properties_[kind<Handle>()];
  }

  template <class PropHandle, class Property>
  static decltype(auto) access(Property& property) {
    if constexpr (std::is_same_v<typename PropHandle::Handle, OpenMesh::MeshHandle>) {
      return property[0];
    } else {
      return (property);
    }
  }

  std::vector<Point> points_;
  std::array<OpenMesh::PropertyContainer, 5> properties_;  // per kind of element
};

}  // namespace flbc::openmesh
