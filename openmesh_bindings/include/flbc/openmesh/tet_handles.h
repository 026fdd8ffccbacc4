// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Handles of tetrahedra and of their properties, next to those of OpenMesh.
#pragma once

#include <functional>

#include <OpenMesh/Core/Mesh/Handles.hh>
#include <OpenMesh/Core/Utils/Property.hh>

namespace flbc::openmesh {

//! Handle of a tetrahedron. Like OpenMesh handles, it is invalid unless it has an index.
struct CellHandle : OpenMesh::BaseHandle {
  explicit CellHandle(int index = -1) : OpenMesh::BaseHandle(index) {}
};

//! Handle of a property of the cells.
template <class T>
struct CPropHandleT : OpenMesh::BasePropHandleT<T> {
  using Value = T;
  using value_type = T;
  using Handle = CellHandle;

  explicit CPropHandleT(int index = -1) : OpenMesh::BasePropHandleT<T>(index) {}
  explicit CPropHandleT(const OpenMesh::BasePropHandleT<T>& base)
      : OpenMesh::BasePropHandleT<T>(base) {}
};

}  // namespace flbc::openmesh

namespace OpenMesh {

template <>
struct PropHandle<flbc::openmesh::CellHandle> {
  template <class T>
  using type = flbc::openmesh::CPropHandleT<T>;
};

}  // namespace OpenMesh

template <>
struct std::hash<flbc::openmesh::CellHandle> {
  std::size_t operator()(const flbc::openmesh::CellHandle& cell) const {
    return static_cast<std::size_t>(cell.idx());
  }
};
