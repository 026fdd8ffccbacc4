// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A tetrahedral mesh in OpenMesh's manner: handles, ranges, circulators, properties.
#pragma once

#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include <OpenMesh/Core/Geometry/VectorT.hh>

#include "flbc/domain_mesh.h"
#include "flbc/openmesh/tet_connectivity.h"
#include "flbc/openmesh/tet_properties.h"
#include "flbc/openmesh/tet_property.h"

namespace flbc::openmesh {

//! Vertices with points, edges, faces and tetrahedra. It is made at once from a DomainMesh or by
//! adding vertices and cells; there are no deleted elements: to remove some, build the mesh anew.
//!
//! Properties are OpenMesh's PropertyT in OpenMesh's PropertyContainer, for vertices, edges, faces
//! (with OpenMesh's property handles), cells (CPropHandleT) and the mesh. They always have as many
//! elements as the mesh. Where they are accessed no range check is performed.
class TetMesh : public TetConnectivity {
 public:
  using Point = OpenMesh::Vec3d;

  //! A mesh with these vertices and cells. \throws InputError as assign() does
  static TetMesh from(const DomainMesh<3>& mesh);

  //! Replaces points and cells. Cells with negative volume are turned round (their last two
  //! vertices change places). Properties stay and are resized: what the elements hold that there
  //! were before is left as it was, new ones have default values.
  //! \throws InputError naming the element, and changes nothing, if normalize_and_validate() does
  void assign(const DomainMesh<3>& mesh);
  void assign(const PointList<3>& points, const CellList<3>& cells);

  //! The same for a mesh that normalize_and_validate() has seen; only the connectivity is made.
  //! \throws InputError, and changes nothing, if add_cell() would
  void assign_valid(const DomainMesh<3>& mesh);

  //! The points and cells in their order.
  DomainMesh<3> domain() const;

  //! Removes all elements. Properties stay and are empty.
  void clear();

  //! Provides memory; adding fewer elements than this moves no properties.
  void reserve(std::size_t vertices, std::size_t edges, std::size_t faces, std::size_t cells);

  //! Adds a vertex that belongs to no cell yet.
  VertexHandle add_vertex(const Point& point);

  //! Adds a cell with those of its edges and faces that are not there yet. It should be positively
  //! oriented: (b - a) x (c - a) . (d - a) > 0; geometry is not checked here.
  //! \throws InputError, and changes nothing, if a vertex does not exist or occurs twice, or if a
  //! face has two cells already
  CellHandle add_cell(VertexHandle a, VertexHandle b, VertexHandle c, VertexHandle d);

  const Point& point(VertexHandle vertex) const { return points_[index(vertex)]; }
  Point& point(VertexHandle vertex) { return points_[index(vertex)]; }
  void set_point(VertexHandle vertex, const Point& point) { points_[index(vertex)] = point; }

  //! The number of elements of a kind; 1 for OpenMesh::MeshHandle.
  template <class Handle>
  std::size_t n_elements() const {
    if constexpr (std::is_same_v<Handle, VertexHandle>) {
      return n_vertices();
    } else if constexpr (std::is_same_v<Handle, EdgeHandle>) {
      return n_edges();
    } else if constexpr (std::is_same_v<Handle, FaceHandle>) {
      return n_faces();
    } else if constexpr (std::is_same_v<Handle, CellHandle>) {
      return n_cells();
    } else {
      static_assert(std::is_same_v<Handle, OpenMesh::MeshHandle>, "there are no such elements");
      return 1;
    }
  }

  //! Adds a property with default values. \param handle  becomes valid
  template <class PropHandle>
  void add_property(PropHandle& handle, const std::string& name = "<unknown>") {
    using Handle = typename PropHandle::Handle;
    auto& container = properties_.of<Handle>();
    handle = PropHandle(container.add(typename PropHandle::Value(), name));
    container.resize(n_elements<Handle>());
  }

  //! Removes a property with its data. \param handle  becomes invalid; an invalid one does nothing
  template <class PropHandle>
  void remove_property(PropHandle& handle) {
    if (handle.is_valid()) properties_.of<typename PropHandle::Handle>().remove(handle);
    handle.reset();
  }

  //! Looks for a property with this name and the handle's type.
  //! \param handle  becomes invalid if there is none \return whether there is one
  template <class PropHandle>
  bool get_property_handle(PropHandle& handle, const std::string& name) const {
    const auto& container = properties_.of<typename PropHandle::Handle>();
    handle = PropHandle(container.handle(typename PropHandle::Value(), name));
    return handle.is_valid();
  }

  //! The property itself; for a property of the mesh, its one value.
  template <class PropHandle>
  decltype(auto) property(PropHandle handle) {
    return access<PropHandle>(properties_.of<typename PropHandle::Handle>().property(handle));
  }
  template <class PropHandle>
  decltype(auto) property(PropHandle handle) const {
    return access<PropHandle>(properties_.of<typename PropHandle::Handle>().property(handle));
  }

  //! A property of the mesh itself, as a property with one element.
  template <class T>
  OpenMesh::PropertyT<T>& mproperty(OpenMesh::MPropHandleT<T> handle) {
    return properties_.of<OpenMesh::MeshHandle>().property(handle);
  }
  template <class T>
  const OpenMesh::PropertyT<T>& mproperty(OpenMesh::MPropHandleT<T> handle) const {
    return properties_.of<OpenMesh::MeshHandle>().property(handle);
  }

  //! A property's value for an element.
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

  //! The container of the properties of a kind of element; whoever adds to it resizes it.
  template <class Handle>
  OpenMesh::PropertyContainer& properties() {
    return properties_.of<Handle>();
  }
  template <class Handle>
  const OpenMesh::PropertyContainer& properties() const {
    return properties_.of<Handle>();
  }

  //! Swaps points, cells and properties; pointers to the data of properties stay valid.
  void swap(TetMesh& other) noexcept;
  friend void swap(TetMesh& a, TetMesh& b) noexcept { a.swap(b); }

 private:
  static std::size_t index(VertexHandle vertex) { return static_cast<std::size_t>(vertex.idx()); }

  template <class PropHandle, class Property>
  static decltype(auto) access(Property& property) {
    if constexpr (std::is_same_v<typename PropHandle::Handle, OpenMesh::MeshHandle>) {
      return property[0];
    } else {
      return (property);
    }
  }

  void resize_properties();

  std::vector<Point> points_;
  TetProperties properties_;
};

}  // namespace flbc::openmesh
