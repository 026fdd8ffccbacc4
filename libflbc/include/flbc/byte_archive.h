// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Numbers, arrays and matrices as the bytes they are in memory: for files that one machine keeps
//! for itself.
#pragma once

#include <cstdint>
#include <cstring>
#include <ostream>
#include <string_view>
#include <type_traits>

#include "flbc/content_hash.h"
#include "flbc/errors.h"
#include "flbc/types.h"

namespace flbc {

//! The hash of bytes.
inline std::uint64_t hash_of(std::string_view bytes) {
  ContentHash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

//! Whether a type is a matrix of Eigen with memory of its own.
template <class Value>
constexpr bool kIsMatrix = std::is_base_of_v<Eigen::EigenBase<Value>, Value>;

//! Writes to a stream.
class ByteWriter {
 public:
  //! \param out  outlives it
  explicit ByteWriter(std::ostream& out) : out_(out) {}

  void bytes(const char* data, std::size_t size) {
    out_.write(data, static_cast<std::streamsize>(size));
  }

  //! Numbers, enumerations, arrays of what can be copied by its bytes, and matrices, both with their
  //! sizes.
  template <class... Values>
  void operator()(const Values&... values) {
    (add(values), ...);
  }

 private:
  template <class Value>
  void add(const Value& value) {
    if constexpr (!std::is_class_v<Value>) {
      bytes(reinterpret_cast<const char*>(&value), sizeof value);
    } else {
      if constexpr (kIsMatrix<Value>) {
        add(static_cast<std::int64_t>(value.rows()));
        add(static_cast<std::int64_t>(value.cols()));
      } else {
        add(static_cast<std::int64_t>(value.size()));
      }
      bytes(reinterpret_cast<const char*>(value.data()),
            sizeof *value.data() * static_cast<std::size_t>(value.size()));
    }
  }

  std::ostream& out_;
};

//! Reads what a ByteWriter has written. \throws InputError if the bytes cannot be that
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  //! Arrays that are not empty must have the size that they had.
  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }

  //! A number of things that take `size` bytes or more each, so that there cannot be more of them
  //! than fit in what is left.
  std::int64_t count(std::size_t size) {
    std::int64_t count = 0;
    get(count);
    if (count < 0 || static_cast<std::uint64_t>(count) > rest_.size() / size) refuse_size();
    return count;
  }

  //! The bytes not read yet.
  std::string_view rest() const { return rest_; }
  bool is_at_end() const { return rest_.empty(); }

 private:
  [[noreturn]] static void refuse_size() { throw InputError("a size in it is impossible"); }

  void take(char* data, std::size_t size) {
    if (size > rest_.size()) throw InputError("it ends early");
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  template <class Value>
  void get(Value& value) {
    if constexpr (!std::is_class_v<Value>) {
      take(reinterpret_cast<char*>(&value), sizeof value);
    } else {
      if constexpr (kIsMatrix<Value>) {
        resize(value);
      } else {
        // An array with a size may be memory of someone else, who wants the numbers there.
        const auto size = static_cast<std::size_t>(count(sizeof *value.data()));
        if (value.size() > 0 && size != value.size()) refuse_size();
        if (value.size() == 0) value = Value(size);
      }
      take(reinterpret_cast<char*>(value.data()),
           sizeof *value.data() * static_cast<std::size_t>(value.size()));
    }
  }
  template <class Matrix>
  void resize(Matrix& matrix) {
    constexpr auto kSize = sizeof(typename Matrix::Scalar);
    const auto rows = count(kSize);
    const auto cols = count(kSize * static_cast<std::size_t>(rows > 0 ? rows : 1));
    constexpr auto kRows = Matrix::RowsAtCompileTime;
    if (kRows != Eigen::Dynamic && rows != kRows) refuse_size();
    matrix.resize(rows, cols);
  }

  std::string_view rest_;
};

}  // namespace flbc
