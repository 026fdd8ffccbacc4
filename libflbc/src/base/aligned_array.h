// SPDX-License-Identifier: BSD-3-Clause
// An array aligned for vector instructions, initially zero.
#pragma once

#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

namespace flbc {

template <class Scalar>
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size) : size_(size) {
    constexpr std::size_t kAlignment = 64;
    if (size == 0) return;
    // New memory from the system is already zero, and is placed near the thread that touches it
    // first.
    const std::size_t room = size + kAlignment / sizeof(Scalar);
    void* const block = std::calloc(room, sizeof(Scalar));
    if (block == nullptr) throw std::bad_alloc();
    void* aligned = block;
    std::size_t bytes = room * sizeof(Scalar);
    std::align(kAlignment, size * sizeof(Scalar), aligned, bytes);
    data_ = {static_cast<Scalar*>(aligned), Free{block}};
  }

  AlignedArray(AlignedArray&& other) noexcept
      : data_(std::move(other.data_)), size_(std::exchange(other.size_, 0)) {}
  AlignedArray& operator=(AlignedArray&& other) noexcept {
    data_ = std::move(other.data_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }

  Scalar* data() { return data_.get(); }
  const Scalar* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  Scalar& operator[](std::size_t i) { return data_.get()[i]; }
  const Scalar& operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  struct Free {
    void* block = nullptr;
    void operator()(Scalar*) const { std::free(block); }
  };
  std::unique_ptr<Scalar[], Free> data_;
  std::size_t size_ = 0;
};

}  // namespace flbc
