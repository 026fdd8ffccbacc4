// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Ranges for loops over a TetMesh. A range is valid until the elements of the mesh change.
#pragma once

#include <cstddef>
#include <iterator>

namespace flbc::openmesh {

namespace internal {

//! Types of a forward iterator over handles, which are created from indices on access.
template <class HandleType>
struct HandleIterator {
  using iterator_category = std::forward_iterator_tag;
  using value_type = HandleType;
  using difference_type = std::ptrdiff_t;
  using pointer = const HandleType*;
  using reference = HandleType;
};

}  // namespace internal

//! All elements of one kind, ascending.
template <class Handle>
class ElementRange {
 public:
  class iterator : public internal::HandleIterator<Handle> {
   public:
    explicit iterator(int index = 0) : index_(index) {}
    Handle operator*() const { return Handle(index_); }
    iterator& operator++() { return ++index_, *this; }
    iterator operator+(int count) const { return iterator(index_ + count); }
    iterator operator++(int) { return iterator(index_++); }
    bool operator==(const iterator& other) const { return index_ == other.index_; }
    bool operator!=(const iterator& other) const { return index_ != other.index_; }

   private:
    int index_;
  };

  explicit ElementRange(std::size_t size) : size_(static_cast<int>(size)) {}
  iterator begin() const { return iterator(0); }
  iterator end() const { return iterator(size_); }
  std::size_t size() const { return static_cast<std::size_t>(size_); }

 private:
  int size_;
};

//! The neighbors of an element.
template <class Handle>
class HandleRange {
 public:
  class iterator : public internal::HandleIterator<Handle> {
   public:
    explicit iterator(const int* place = nullptr) : place_(place) {}
    Handle operator*() const { return Handle(*place_); }
    iterator& operator++() { return ++place_, *this; }
    iterator operator++(int) { return iterator(place_++); }
    bool operator==(const iterator& other) const { return place_ == other.place_; }
    bool operator!=(const iterator& other) const { return place_ != other.place_; }

   private:
    const int* place_;
  };

  HandleRange(const int* first, std::size_t size) : first_(first), size_(size) {}
  iterator begin() const { return iterator(first_); }
  iterator end() const { return iterator(first_ + size_); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  //! No range check is performed.
  Handle operator[](std::size_t k) const { return Handle(first_[k]); }

 private:
  const int* first_;
  std::size_t size_;
};

}  // namespace flbc::openmesh
