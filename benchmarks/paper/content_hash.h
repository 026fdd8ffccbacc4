// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Whether stored numbers are still the ones that they are taken for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

#include <Eigen/Core>

namespace flbc {

//! The hash FNV-1a with 64 bits. It tells accidents, not attacks: of two contents of the same
//! length that differ in one byte the hashes differ for certain, because every step is a bijection
//! of the state; of any other two with a probability of 1 - 2^-64.
class ContentHash {
 public:
  //! Goes on with more bytes.
  void add(const char* bytes, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k) {
      state_ = (state_ ^ static_cast<unsigned char>(bytes[k])) * 1099511628211U;
    }
  }

  //! Goes on with the numbers of a matrix, column by column, without its size.
  template <class Derived>
  void add(const Eigen::PlainObjectBase<Derived>& matrix) {
    add(reinterpret_cast<const char*>(matrix.data()),
        static_cast<std::size_t>(matrix.size()) * sizeof(typename Derived::Scalar));
  }

  //! The hash of all that was added.
  std::uint64_t value() const { return state_; }

  //! The same as 16 hexadecimal digits.
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state_));
    return digits;
  }

 private:
  std::uint64_t state_ = 14695981039346656037U;
};

//! The hash of several matrices, one after the other.
template <class... Matrices>
ContentHash content_hash(const Matrices&... matrices) {
  ContentHash hash;
  (hash.add(matrices), ...);
  return hash;
}

}  // namespace flbc
