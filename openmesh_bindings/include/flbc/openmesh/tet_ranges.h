// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The ranges of loops over a TetMesh. A range is valid until the mesh gets or loses elements.
#pragma once

#include <cstddef>
#include <iterator>

#include <OpenMesh/Core/Mesh/Handles.hh>

#include "flbc/openmesh/tet_handles.h"

namespace flbc::openmesh {

namespace internal {

//! The types of a forward iterator over handles; they are made on the fly, not stored.
template <class HandleType>
struct HandleIterator {
  using iterator_category = std::forward_iterator_tag;
  using value_type = HandleType;
  using difference_type = std::ptrdiff_t;
  using pointer = const HandleType*;
  using reference = HandleType;
};

//! What an entry of the list of a vertex refers to: the cell with this corner, ...
struct CellOfCorner {
  using Handle = CellHandle;
  Handle operator()(int corner) const { return Handle(corner / 4); }
};
//! ... the edge with this end, ...
struct EdgeOfEnd {
  using Handle = OpenMesh::EdgeHandle;
  Handle operator()(int end) const { return Handle(end / 2); }
};
//! ... or the vertex at that edge's other end.
struct OppositeEnd {
  using Handle = OpenMesh::VertexHandle;
  Handle operator()(int end) const { return Handle(edge_vertices[end ^ 1]); }
  const int* edge_vertices = nullptr;
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

//! A few neighbours whose indices stand side by side.
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

  //! No range check is performed.
  Handle operator[](std::size_t k) const { return Handle(first_[k]); }

 private:
  const int* first_;
  std::size_t size_;
};

//! The neighbours of a vertex: a closed list of which the vertex knows the last entry.
template <class Convert>
class ListRange {
 public:
  using Handle = typename Convert::Handle;

  class iterator : public internal::HandleIterator<Handle> {
   public:
    iterator() = default;
    iterator(const int* next, int last, int entry, Convert convert)
        : next_(next), last_(last), entry_(entry), convert_(convert) {}
    Handle operator*() const { return convert_(entry_); }
    iterator& operator++() {
      entry_ = entry_ == last_ ? -1 : next_[entry_];
      return *this;
    }
    iterator operator++(int) {
      const iterator old = *this;
      ++*this;
      return old;
    }
    bool operator==(const iterator& other) const { return entry_ == other.entry_; }
    bool operator!=(const iterator& other) const { return entry_ != other.entry_; }

   private:
    const int* next_ = nullptr;
    int last_ = -1;
    int entry_ = -1;  // -1 past the last one
    Convert convert_;
  };

  //! \param next  entry -> entry \param last  -1 if the list is empty
  ListRange(const int* next, int last, Convert convert = {})
      : next_(next), last_(last), convert_(convert) {}
  iterator begin() const { return iterator(next_, last_, last_ < 0 ? -1 : next_[last_], convert_); }
  iterator end() const { return iterator(next_, last_, -1, convert_); }
  bool empty() const { return last_ < 0; }

  //! Walks the list.
  std::size_t size() const { return static_cast<std::size_t>(std::distance(begin(), end())); }

 private:
  const int* next_;
  int last_;
  Convert convert_;
};

}  // namespace flbc::openmesh
