// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The memory of a wide property: rows of numbers for all elements, in one aligned block.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "flbc/openmesh/rows_view.h"
#include "base/padded_rows.h"

namespace flbc::openmesh {

//! Like a std::vector whose elements are `components` rows of `width` numbers each: element e,
//! component c, number i is at data()[(e * components() + c) * stride() + i]. New numbers are zero,
//! padding stays zero, and the block is aligned to 64 bytes.
template <class Scalar>
class RowBlock {
  static_assert(std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>);

 public:
  static constexpr std::size_t kAlignment = 64;

  RowBlock() = default;
  //! No elements yet. \throws std::bad_alloc if already one could not be addressed
  RowBlock(std::size_t components, std::size_t width) : components_(components), width_(width) {
    if (width > kMostNumbers) throw std::bad_alloc();
    stride_ = padded(width);
    if (stride_ > 0 && components > kMostNumbers / stride_) throw std::bad_alloc();
  }
  RowBlock(const RowBlock& block) : RowBlock(block.components_, block.width_) {
    reallocate(block.size_);
    size_ = block.size_;
    copy_numbers(block.data_, size_ * element_size(), data_);
  }
  RowBlock(RowBlock&& block) noexcept { exchange_with(block); }
  RowBlock& operator=(RowBlock block) noexcept {
    exchange_with(block);
    return *this;
  }

  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  std::size_t components() const { return components_; }
  std::size_t width() const { return width_; }
  std::size_t stride() const { return stride_; }
  //! Numbers of one element with their padding.
  std::size_t element_size() const { return components_ * stride_; }
  Scalar* data() { return data_; }
  const Scalar* data() const { return data_; }

  RowsView<Scalar> operator[](std::size_t e) {
    return {data_ + e * element_size(), components_, width_, stride_};
  }
  RowsView<const Scalar> operator[](std::size_t e) const {
    return {data_ + e * element_size(), components_, width_, stride_};
  }

  void reserve(std::size_t elements) {
    if (elements > capacity_) reallocate(elements);
  }

  //! Grows by doubling, because OpenMesh makes room for every new element with a call of its own.
  void resize(std::size_t elements) {
    if (elements > capacity_) reallocate(std::max(elements, grown_capacity()));
    if (elements < size_) set_zero(elements, size_);
    size_ = elements;
  }

  //! Keeps the shape, frees the memory.
  void clear() { *this = RowBlock(components_, width_); }

  //! Makes elements of so many rows of what are elements of one row each.
  void regroup(std::size_t components) {
    assert(components_ == 1 && components > 0 && size_ % components == 0);
    components_ = components;
    size_ /= components;
    capacity_ /= components;
  }

  void swap(std::size_t first, std::size_t second) {
    if (first == second) return;
    Scalar* const numbers = data_ + first * element_size();
    std::swap_ranges(numbers, numbers + element_size(), data_ + second * element_size());
  }
  void copy(std::size_t from, std::size_t to) {
    if (from == to) return;
    copy_numbers(data_ + from * element_size(), element_size(), data_ + to * element_size());
  }

 private:
  static constexpr std::size_t kMostNumbers =
      std::numeric_limits<std::size_t>::max() / 4 / sizeof(Scalar);

  std::size_t grown_capacity() const { return capacity_ <= kMostNumbers ? 2 * capacity_ : 0; }

  static void copy_numbers(const Scalar* from, std::size_t count, Scalar* to) {
    if (count > 0) std::memcpy(to, from, count * sizeof(Scalar));
  }
  void set_zero(std::size_t first, std::size_t last) {
    std::fill(data_ + first * element_size(), data_ + last * element_size(), Scalar(0));
  }

  // Numbers from size_ to the capacity are zero, always. calloc gives large blocks without touching
  // them: their pages come to exist where and when they are first used.
  void reallocate(std::size_t capacity) {
    if (element_size() > 0 && capacity > kMostNumbers / element_size()) throw std::bad_alloc();
    std::size_t bytes = capacity * element_size() * sizeof(Scalar);
    std::unique_ptr<void, Free> memory;
    void* data = nullptr;
    if (bytes > 0) {
      std::size_t space = bytes + kAlignment - 1;
      memory.reset(std::calloc(space, 1));
      if (!memory) throw std::bad_alloc();
      data = memory.get();
      std::align(kAlignment, bytes, data, space);
    }
    copy_numbers(data_, size_ * element_size(), static_cast<Scalar*>(data));
    memory_ = std::move(memory);
    data_ = static_cast<Scalar*>(data);
    capacity_ = capacity;
  }

  void exchange_with(RowBlock& block) noexcept {
    std::swap(memory_, block.memory_);
    std::swap(data_, block.data_);
    std::swap(size_, block.size_);
    std::swap(capacity_, block.capacity_);
    std::swap(components_, block.components_);
    std::swap(width_, block.width_);
    std::swap(stride_, block.stride_);
  }

  struct Free {
    void operator()(void* memory) const { std::free(memory); }
  };
  std::unique_ptr<void, Free> memory_;
  Scalar* data_ = nullptr;  // the first aligned place in memory_
  std::size_t size_ = 0, capacity_ = 0;
  std::size_t components_ = 1, width_ = 0, stride_ = 0;
};

}  // namespace flbc::openmesh
