// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! One block of numbers, aligned for vector instructions and zero at first.
#pragma once

#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

namespace flbc {

template <class Scalar>
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size) : size_(size) {
    constexpr std::size_t kAlignment = 64;
    const std::size_t bytes = (size * sizeof(Scalar) + kAlignment - 1) / kAlignment * kAlignment;
    data_.reset(static_cast<Scalar*>(std::aligned_alloc(kAlignment, bytes)));
    if (!data_ && bytes > 0) throw std::bad_alloc();
    if (bytes > 0) std::memset(data_.get(), 0, bytes);
  }

  //! Numbers that belong to someone else and stay where they are. \param data  aligned to 64 bytes
  static AlignedArray borrow(Scalar* data, std::size_t size) {
    AlignedArray array;
    array.data_ = {data, Free{false}};
    array.size_ = size;
    return array;
  }

  Scalar* data() { return data_.get(); }
  const Scalar* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  Scalar& operator[](std::size_t i) { return data_.get()[i]; }
  const Scalar& operator[](std::size_t i) const { return data_.get()[i]; }

 private:
  struct Free {
    bool owned = true;
    void operator()(Scalar* data) const {
      if (owned) std::free(data);
    }
  };
  std::unique_ptr<Scalar[], Free> data_;
  std::size_t size_ = 0;
};

}  // namespace flbc
