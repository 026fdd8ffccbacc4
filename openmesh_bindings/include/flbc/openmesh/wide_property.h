// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A property of OpenMesh meshes whose elements are rows of values, stored in one block.
//!
//!     OpenMesh::VProp<flbc::openmesh::Wide<double>> weights(mesh, "flbc:weights");
//!     mesh.property(weights.getRawProperty()).set_shape(1, cage_size);
//!     weights[vertex][i] = 0.5;
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <type_traits>

#include "flbc/openmesh/block_property.h"
#include "flbc/openmesh/row_block.h"

namespace flbc::openmesh {

//! Value type of a wide property: an element is a block of rows of Scalars, accessed as RowsView.
template <class Scalar>
struct Wide {
  static_assert(std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>,
                "wide properties hold float or double");
};

template <class Scalar>
struct BlockOf<Wide<Scalar>> {
  using Block = RowBlock<Scalar>;
  static constexpr const char* kName =
      std::is_same_v<Scalar, float> ? "flbc::Wide<float>" : "flbc::Wide<double>";
};

//! Bytes that store_block() writes: the shape and the values.
template <class Scalar>
std::size_t stored_size(const RowBlock<Scalar>& rows);

//! Writes a block in the format of .om files. \return bytes written, 0 if the stream fails
//! \throws IoError if the block exceeds the limit of .om files, 4 GiB - 1
template <class Scalar>
std::size_t store_block(std::ostream& out, bool swap, const std::string& name,
                        const RowBlock<Scalar>& rows);

//! Reads the output of store_block(); `rows` is unchanged on failure. Memory is limited by the data
//! in the stream. \return bytes read
//! \throws InputError if this is not a block of Scalars for rows.size() elements, or is damaged.
//! OpenMesh ignores a failed stream and would loop forever, so this throws.
template <class Scalar>
std::size_t restore_block(std::istream& in, bool swap, const std::string& name,
                          RowBlock<Scalar>& rows);

}  // namespace flbc::openmesh

namespace OpenMesh {

namespace IO {

template <class Scalar>
struct binary<flbc::openmesh::Wide<Scalar>>
    : flbc::openmesh::BlockBinary<flbc::openmesh::Wide<Scalar>> {};

}  // namespace IO

//! The type that mesh.property(handle, element) returns.
template <class Scalar>
struct BasePropHandleT<flbc::openmesh::Wide<Scalar>>
    : BaseHandle, flbc::openmesh::BlockTypes<flbc::openmesh::Wide<Scalar>> {
  explicit BasePropHandleT(int index = -1) : BaseHandle(index) {}
};

//! Every element has `components` rows of `width` values, initially 1 and 0; set_shape() changes
//! this.
template <class Scalar>
class PropertyT<flbc::openmesh::Wide<Scalar>>
    : public flbc::openmesh::BlockProperty<flbc::openmesh::Wide<Scalar>> {
 public:
  using flbc::openmesh::BlockProperty<flbc::openmesh::Wide<Scalar>>::BlockProperty;

  //! Changes the shape of all elements and sets them to 0.
  //! \throws std::bad_alloc, and then nothing has changed
  void set_shape(std::size_t components, std::size_t width) {
    this->set_block_shape(components, width);
  }
  std::size_t components() const { return this->data_vector().components(); }
  std::size_t width() const { return this->data_vector().width(); }

  //! Value i of component c of element e is at [(e * components() + c) * width() + i].
  Scalar* data() { return this->data_vector().data(); }
  const Scalar* data() const { return this->data_vector().data(); }
  //! Size of all elements.
  std::size_t bytes() const {
    return this->n_elements() * this->data_vector().element_size() * sizeof(Scalar);
  }
};

}  // namespace OpenMesh

namespace flbc::openmesh {

inline BlockCreator<Wide<float>> wide_float_creator;
inline BlockCreator<Wide<double>> wide_double_creator;

}  // namespace flbc::openmesh
