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
#include <utility>

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

//! Whether an array's size can change; else its memory may be someone else's.
template <class Array, class = void>
constexpr bool kHasResize = false;
template <class Array>
constexpr bool kHasResize<Array, std::void_t<decltype(std::declval<Array&>().resize(0))>> = true;

//! Writes to a stream.
class ByteWriter {
 public:
  //! \param out  outlives it
  explicit ByteWriter(std::ostream& out) : out_(out) {}

  void bytes(const char* data, std::size_t size) {
    out_.write(data, static_cast<std::streamsize>(size));
  }

  //! Numbers, enumerations, arrays of what can be copied by its bytes, and matrices, both with
  //! their sizes.
  template <class... Values>
  void operator()(const Values&... values) {
    (add(values), ...);
  }

  //! An array that is empty or has this size.
  template <class Array>
  void empty_or(std::size_t, const Array& array) {
    add(array);
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

  //! Arrays that cannot be resized must have the size that they had.
  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }

  //! An array that cannot be resized, and is empty so far: it stays so or gets this size.
  template <class Array>
  void empty_or(std::size_t size, Array& array) {
    const auto count = size_of<Array>();
    if (count != 0 && count != size) refuse_size();
    array = Array(count);
    take_numbers(array);
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
    if constexpr (std::is_same_v<Value, bool>) {
      std::uint8_t byte = 0;
      get(byte);
      if (byte > 1) throw InputError("a flag in it is neither set nor not");
      value = byte == 1;
    } else if constexpr (!std::is_class_v<Value>) {
      take(reinterpret_cast<char*>(&value), sizeof value);
    } else {
      if constexpr (kIsMatrix<Value>) {
        resize_matrix(value);
      } else if constexpr (kHasResize<Value>) {
        value.resize(size_of<Value>());
      } else if (size_of<Value>() != value.size()) {
        refuse_size();
      }
      take_numbers(value);
    }
  }
  template <class Array>
  std::size_t size_of() {
    return static_cast<std::size_t>(count(sizeof *std::declval<Array&>().data()));
  }
  template <class Array>
  void take_numbers(Array& array) {
    take(reinterpret_cast<char*>(array.data()),
         sizeof *array.data() * static_cast<std::size_t>(array.size()));
  }
  template <class Matrix>
  void resize_matrix(Matrix& matrix) {
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
