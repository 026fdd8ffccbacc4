// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Numbers and matrices as the bytes they are in memory: for files that one machine keeps for
//! itself.
#pragma once

#include <cstdint>
#include <cstring>
#include <ostream>
#include <string_view>
#include <type_traits>

#include "flbc/content_hash.h"
#include "flbc/errors.h"
#include "flbc/types.h"

namespace flbc::app {

inline std::uint64_t hash_of(std::string_view bytes) {
  ContentHash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

//! Writes to a stream and keeps the hash of what was written.
class ByteWriter {
 public:
  explicit ByteWriter(std::ostream& out) : out_(out) {}

  void bytes(const char* data, std::size_t size) {
    hash_.add(data, size);
    out_.write(data, static_cast<std::streamsize>(size));
  }

  //! Numbers, enumerations, and matrices with their sizes.
  template <class... Values>
  void operator()(const Values&... values) {
    (add(values), ...);
  }

  std::uint64_t hash() const { return hash_.value(); }

 private:
  template <class Value>
  std::enable_if_t<!std::is_class_v<Value>> add(const Value& value) {
    bytes(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class Derived>
  void add(const Eigen::PlainObjectBase<Derived>& matrix) {
    add(static_cast<std::int64_t>(matrix.rows()));
    add(static_cast<std::int64_t>(matrix.cols()));
    bytes(reinterpret_cast<const char*>(matrix.data()),
          sizeof(typename Derived::Scalar) * static_cast<std::size_t>(matrix.size()));
  }

  std::ostream& out_;
  ContentHash hash_;
};

//! Reads what a ByteWriter has written. \throws InputError if the bytes cannot be that
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }

  //! A number of things that take `size` bytes or more each, so that there cannot be more of them
  //! than fit in what is left.
  std::int64_t count(std::size_t size) {
    std::int64_t count = 0;
    get(count);
    if (count < 0 || static_cast<std::uint64_t>(count) > rest_.size() / size) {
      throw InputError("a size in it is impossible");
    }
    return count;
  }

  bool is_at_end() const { return rest_.empty(); }

 private:
  void take(char* data, std::size_t size) {
    if (size > rest_.size()) throw InputError("it ends early");
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  template <class Value>
  std::enable_if_t<!std::is_class_v<Value>> get(Value& value) {
    take(reinterpret_cast<char*>(&value), sizeof value);
  }
  template <class Derived>
  void get(Eigen::PlainObjectBase<Derived>& matrix) {
    constexpr auto kSize = sizeof(typename Derived::Scalar);
    const auto rows = count(kSize);
    const auto cols = count(kSize * static_cast<std::size_t>(rows > 0 ? rows : 1));
    constexpr auto kRows = Derived::RowsAtCompileTime;
    if (kRows != Eigen::Dynamic && rows != kRows) throw InputError("a size in it is impossible");
    matrix.resize(rows, cols);
    take(reinterpret_cast<char*>(matrix.data()), kSize * static_cast<std::size_t>(matrix.size()));
  }

  std::string_view rest_;
};

}  // namespace flbc::app
