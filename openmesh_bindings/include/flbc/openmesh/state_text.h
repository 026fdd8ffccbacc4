// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A property of text that, once loaded from an .om file, goes into the next one as well.
#pragma once

#include <string>

#include <OpenMesh/Core/Utils/Property.hh>
#include <OpenMesh/Core/Utils/PropertyCreator.hh>

namespace flbc::openmesh {

//! Value type of a property whose elements are std::string: the mesh property "flbc:state".
struct StateText {};

}  // namespace flbc::openmesh

namespace OpenMesh {

//! The type that mesh.property(handle) returns.
template <>
struct BasePropHandleT<flbc::openmesh::StateText> : public BaseHandle {
  using Value = flbc::openmesh::StateText;
  using value_type = Value;
  using vector_type = PropertyT<std::string>::vector_type;
  using reference = std::string&;
  using const_reference = const std::string&;

  explicit BasePropHandleT(int index = -1) : BaseHandle(index) {}
};

//! As OpenMesh's property of strings.
template <>
class PropertyT<flbc::openmesh::StateText> : public PropertyT<std::string> {
 public:
  using Value = flbc::openmesh::StateText;
  using value_type = Value;

  using PropertyT<std::string>::PropertyT;
  PropertyT* clone() const override { return new PropertyT(*this); }
  std::string get_storage_name() const override { return "flbc::StateText"; }
  std::size_t restore(std::istream& in, bool swap_bytes) override {
    const std::size_t bytes = PropertyT<std::string>::restore(in, swap_bytes);
    set_persistent(true);
    return bytes;
  }
};

namespace IO {

//! Tells OpenMesh that it can be saved, and under which name.
template <>
struct binary<flbc::openmesh::StateText> {
  using value_type = flbc::openmesh::StateText;
  static const bool is_streamable = true;
  static std::size_t size_of() { return UnknownSize; }
  static std::size_t size_of(const value_type&) { return UnknownSize; }
  static std::string type_identifier() { return "flbc::StateText"; }
};

}  // namespace IO
}  // namespace OpenMesh

namespace flbc::openmesh {

//! Makes the property of a file in a mesh that has none of its name, as WideCreator does.
class StateTextCreator : public OpenMesh::PropertyCreatorImpl<StateTextCreator> {
 public:
  using type = StateText;
  StateTextCreator() {
    OpenMesh::PropertyCreationManager::instance().register_property_creator(this);
  }
  std::string type_string() override { return OpenMesh::IO::binary<type>::type_identifier(); }
};
inline StateTextCreator state_text_creator;

}  // namespace flbc::openmesh
