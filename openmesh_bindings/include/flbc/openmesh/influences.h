// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A property of OpenMesh meshes for sparse weights: a few control points with their weights per
//! element.
//!
//!     OpenMesh::VProp<flbc::openmesh::Influences> weights(mesh, "flbc:weights");
//!     for (std::size_t j = 0; j < weights[vertex].count(); ++j)
//!       use(weights[vertex].control_point(j), weights[vertex].weight(j));
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "flbc/openmesh/block_property.h"
#include "flbc/openmesh/wide_property.h"

namespace flbc::openmesh {

//! A view of the weights of one element: pairs of a control point and its weight, the same number
//! for every element. Unused pairs come last and have weight 0. A copy of the view refers to the
//! same values. Assigning to it copies the values, as copy_property() and copy_to() of OpenMesh
//! expect. Valid until the property changes its number of elements or its shape.
//! \tparam Weight  double, or const double for read-only views
template <class Weight>
class InfluencesView {
 public:
  using ControlPoint =
      std::conditional_t<std::is_const_v<Weight>, const std::uint32_t, std::uint32_t>;

  //! \param control_points, weights  1 x size()
  InfluencesView(RowsView<ControlPoint> control_points, RowsView<Weight> weights)
      : control_points_(control_points), weights_(weights) {}
  InfluencesView(const InfluencesView& view) = default;

  //! A writable view converts to a read-only view.
  template <class Other, class = std::enable_if_t<std::is_same_v<const Other, Weight>>>
  InfluencesView(const InfluencesView<Other>& view)
      : InfluencesView(view.control_points_, view.weights_) {}

  //! Copies the numbers. \throws InputError if the numbers of pairs differ
  InfluencesView& operator=(const InfluencesView& view) = default;
  template <class Other>
  InfluencesView& operator=(const InfluencesView<Other>& view) {
    control_points_ = view.control_points_;
    weights_ = view.weights_;
    return *this;
  }

  //! Number of pairs, used or not.
  std::size_t size() const { return weights_.width(); }

  //! Number of pairs whose weight is not 0.
  std::size_t count() const {
    return static_cast<std::size_t>(
        std::count_if(weights(), weights() + size(), [](double weight) { return weight != 0; }));
  }

  //! The control point of pair j < size(); used pairs are ascending.
  ControlPoint& control_point(std::size_t j) const { return control_points_[j]; }
  //! Its weight.
  Weight& weight(std::size_t j) const { return weights_[j]; }

  ControlPoint* control_points() const { return control_points_.data(); }
  Weight* weights() const { return weights_.data(); }

 private:
  template <class Other>
  friend class InfluencesView;

  RowsView<ControlPoint> control_points_;
  RowsView<Weight> weights_;
};

//! Like a std::vector whose elements are `most` pairs each. The pairs of element e start at index e
//! * most() of control_points() and weights(). New pairs are 0.
class InfluenceBlock {
 public:
  InfluenceBlock() : InfluenceBlock(0, 0) {}
  //! No elements yet. \param num_control_points  n \param most  pairs per element
  InfluenceBlock(std::size_t num_control_points, std::size_t most)
      : num_control_points_(num_control_points), control_points_(1, most), weights_(1, most) {}

  std::size_t size() const { return weights_.size(); }
  std::size_t num_control_points() const { return num_control_points_; }
  std::size_t most() const { return weights_.width(); }
  std::uint32_t* control_points() { return control_points_.data(); }
  const std::uint32_t* control_points() const { return control_points_.data(); }
  double* weights() { return weights_.data(); }
  const double* weights() const { return weights_.data(); }

  InfluencesView<double> operator[](std::size_t e) { return {control_points_[e], weights_[e]}; }
  InfluencesView<const double> operator[](std::size_t e) const {
    return {control_points_[e], weights_[e]};
  }

  void reserve(std::size_t elements) {
    control_points_.reserve(elements);
    weights_.reserve(elements);
  }
  void resize(std::size_t elements) {
    control_points_.resize(elements);
    weights_.resize(elements);
  }
  //! Keeps the shape, frees the memory.
  void clear() { *this = InfluenceBlock(num_control_points_, most()); }
  void swap(std::size_t first, std::size_t second) {
    control_points_.swap(first, second);
    weights_.swap(first, second);
  }
  void copy(std::size_t from, std::size_t to) {
    control_points_.copy(from, to);
    weights_.copy(from, to);
  }

 private:
  std::size_t num_control_points_;
  RowBlock<std::uint32_t> control_points_;
  RowBlock<double> weights_;
};

//! Value type of a property with few weights per element, accessed as InfluencesView.
struct Influences {
  using Block = InfluenceBlock;
};

}  // namespace flbc::openmesh

namespace OpenMesh {

//! The type that mesh.property(handle, element) returns.
template <>
struct BasePropHandleT<flbc::openmesh::Influences>
    : BaseHandle, flbc::openmesh::BlockTypes<flbc::openmesh::Influences> {
  explicit BasePropHandleT(int index = -1) : BaseHandle(index) {}
};

//! Every element has the same number of pairs, initially 0; set_shape() changes it.
template <>
class PropertyT<flbc::openmesh::Influences>
    : public flbc::openmesh::BlockProperty<flbc::openmesh::Influences> {
 public:
  using BlockProperty::BlockProperty;

  //! Changes the number of pairs of all elements and sets them to 0.
  //! \param num_control_points  n \param most  pairs per element
  void set_shape(std::size_t num_control_points, std::size_t most) {
    set_block_shape(num_control_points, most);
  }
  std::size_t num_control_points() const { return data_vector().num_control_points(); }
  std::size_t most() const { return data_vector().most(); }
};

}  // namespace OpenMesh
