// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Finds edges and faces by their vertices while a TetMesh is built.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace flbc::openmesh {

//! A hash table from N vertices, ascending, to an element's number: linear time whatever the mesh,
//! also where thousands of faces meet in one vertex. Nothing is ever taken out.
template <std::size_t N>
class SimplexTable {
 public:
  using Key = std::array<int, N>;

  std::size_t size() const { return size_; }

  //! Provides memory for so many keys in all.
  void reserve(std::size_t size) {
    std::size_t num_slots = kLeastSlots;
    while (is_too_full(size, num_slots)) num_slots *= 2;
    if (num_slots > slots_.size()) rehash(num_slots);
  }

  //! \return the number that was inserted with the key, -1 if none was
  int find(const Key& key) const { return slots_.empty() ? -1 : slots_[place(key)].number; }

  //! \return the number that belongs to the key: what it had, or else `number` from now on
  int insert(const Key& key, int number) {
    if (is_too_full(size_ + 1, slots_.size())) reserve(size_ + 1);
    Slot& slot = slots_[place(key)];
    if (slot.number < 0) {
      slot = {key, number};
      ++size_;
    }
    return slot.number;
  }

 private:
  static constexpr std::size_t kLeastSlots = 64;

  struct Slot {
    Key key;
    int number;  // -1: free
  };

  static bool is_too_full(std::size_t size, std::size_t num_slots) {
    return 3 * size > 2 * num_slots;
  }

  // In line, where == would call memcmp().
  static bool is_same(const Key& a, const Key& b) {
    for (std::size_t k = 0; k < N; ++k) {
      if (a[k] != b[k]) return false;
    }
    return true;
  }

  static std::uint64_t hash(const Key& key) {
    std::uint64_t hash = 0;
    for (const int vertex : key) {
      hash = (hash ^ static_cast<std::uint32_t>(vertex)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return hash;
  }

  // Where the key is, or where it would go. Keys of neighbouring vertices share a small part of the
  // table, because cells that are added one after another mostly are neighbours and memory is slow.
  // Where that part is full, as it is if very many faces meet in a vertex, the whole table serves.
  std::size_t place(const Key& key) const {
    constexpr std::size_t kSlotsPerVertex = 16;
    constexpr std::size_t kSlotsNearby = 64;
    constexpr int kTriesNearby = 8;
    const std::size_t mask = slots_.size() - 1;
    const std::uint64_t h = hash(key);
    std::size_t slot =
        (static_cast<std::size_t>(key[0]) * kSlotsPerVertex + h % kSlotsNearby) & mask;
    for (int k = 0; k < kTriesNearby; ++k, slot = (slot + 1) & mask) {
      if (slots_[slot].number < 0 || is_same(slots_[slot].key, key)) return slot;
    }
    slot = (h >> 6) & mask;
    while (slots_[slot].number >= 0 && !is_same(slots_[slot].key, key)) slot = (slot + 1) & mask;
    return slot;
  }

  void rehash(std::size_t num_slots) {
    const auto old = std::exchange(slots_, std::vector<Slot>(num_slots, Slot{Key{}, -1}));
    for (const Slot& slot : old) {
      if (slot.number >= 0) slots_[place(slot.key)] = slot;
    }
  }

  std::vector<Slot> slots_;  // a power of two of them, at most two thirds full
  std::size_t size_ = 0;
};

}  // namespace flbc::openmesh
