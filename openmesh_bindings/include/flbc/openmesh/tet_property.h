// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Named properties of a TetMesh with little writing, as OpenMesh's PropertyManager (VProp, EProp,
//! FProp, MProp) gives them for OpenMesh's meshes.
#pragma once

#include <string>
#include <type_traits>

#include <OpenMesh/Core/Mesh/Handles.hh>
#include <OpenMesh/Core/Utils/Property.hh>

#include "flbc/openmesh/tet_handles.h"

namespace flbc::openmesh {

class TetMesh;

//! Refers to a property of a mesh, which lives as long as the mesh or until remove_property().
//! Valid while the mesh and the property exist.
template <class PropHandle, class Mesh = TetMesh>
class TetProperty {
 public:
  using Value = typename PropHandle::Value;
  using Handle = typename PropHandle::Handle;
  using reference = typename OpenMesh::PropertyT<Value>::reference;
  using const_reference = typename OpenMesh::PropertyT<Value>::const_reference;

  //! The property with this name and type; adds it with default values if there is none.
  TetProperty(Mesh& mesh, const std::string& name) : mesh_(&mesh) {
    if (!mesh.get_property_handle(handle_, name)) mesh.add_property(handle_, name);
  }

  //! The same; a property that is added has this value everywhere.
  TetProperty(const Value& initial, Mesh& mesh, const std::string& name) : mesh_(&mesh) {
    if (mesh.get_property_handle(handle_, name)) return;
    mesh.add_property(handle_, name);
    for (int k = 0; k < static_cast<int>(mesh.template n_elements<Handle>()); ++k) at(k) = initial;
  }

  //! Wraps a property that is there. \param handle  valid
  TetProperty(Mesh& mesh, PropHandle handle) : mesh_(&mesh), handle_(handle) {}

  //! Whether the mesh has a property with this name and type.
  static bool exists(const Mesh& mesh, const std::string& name) {
    PropHandle handle;
    return mesh.get_property_handle(handle, name);
  }

  //! The value for an element. Not for properties of the mesh.
  reference operator[](Handle element) { return at(element.idx()); }
  const_reference operator[](Handle element) const { return at(element.idx()); }
  reference operator()(Handle element) { return at(element.idx()); }
  const_reference operator()(Handle element) const { return at(element.idx()); }

  //! The value. For properties of the mesh only.
  reference operator()() {
    static_assert(std::is_same_v<Handle, OpenMesh::MeshHandle>, "this needs an element");
    return at(0);
  }
  const_reference operator()() const {
    static_assert(std::is_same_v<Handle, OpenMesh::MeshHandle>, "this needs an element");
    return at(0);
  }
  reference operator*() { return (*this)(); }
  const_reference operator*() const { return (*this)(); }

  PropHandle handle() const { return handle_; }

 private:
  OpenMesh::PropertyT<Value>& all() const {
    if constexpr (std::is_same_v<Handle, OpenMesh::MeshHandle>) {
      return mesh_->mproperty(handle_);
    } else {
      return mesh_->property(handle_);
    }
  }
  reference at(int k) { return all()[k]; }
  const_reference at(int k) const {
    const auto& property = all();
    return property[k];
  }

  Mesh* mesh_;
  PropHandle handle_;
};

//! Property of vertices.
template <class T>
using TetVProp = TetProperty<OpenMesh::VPropHandleT<T>>;
//! Property of edges.
template <class T>
using TetEProp = TetProperty<OpenMesh::EPropHandleT<T>>;
//! Property of faces.
template <class T>
using TetFProp = TetProperty<OpenMesh::FPropHandleT<T>>;
//! Property of cells.
template <class T>
using TetCProp = TetProperty<CPropHandleT<T>>;
//! Property of the mesh itself.
template <class T>
using TetMProp = TetProperty<OpenMesh::MPropHandleT<T>>;

}  // namespace flbc::openmesh
