// SPDX-License-Identifier: BSD-3-Clause
// Archives of NumPy arrays (.npz): zip files without compression.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "flbc/types.h"
#include "weights/npy_header.h"

namespace flbc::io {

//! NumPy's name of a type.
template <class Scalar>
constexpr const char* kNpyType = nullptr;
template <>
inline constexpr const char* kNpyType<double> = "<f8";
template <>
inline constexpr const char* kNpyType<float> = "<f4";
template <>
inline constexpr const char* kNpyType<std::int32_t> = "<i4";
template <>
inline constexpr const char* kNpyType<std::int64_t> = "<i8";

class NpzWriter {
 public:
  //! \param path  for messages
  NpzWriter(std::string path, std::ostream& out) : path_(std::move(path)), out_(out) {}

  //! \param data  of an array of this shape in C order \throws IoError beyond 4 GB
  template <class Scalar>
  void add(const std::string& name, const Scalar* data, const std::vector<std::int64_t>& shape) {
    std::size_t bytes = sizeof(Scalar);
    for (const auto size : shape) bytes *= static_cast<std::size_t>(size);
    add_bytes(name, kNpyType<Scalar>, shape, data, bytes);
  }

  //! The columns of a matrix become rows.
  template <class Matrix>
  void add_columns(const std::string& name, const Matrix& matrix) {
    add(name, matrix.data(), {matrix.cols(), matrix.rows()});
  }

  template <class Scalar>
  void add_list(const std::string& name, const std::vector<Scalar>& list) {
    add(name, list.data(), {static_cast<std::int64_t>(list.size())});
  }

  //! A text as an array without dimensions.
  void add_text(const std::string& name, const std::string& text) {
    add_bytes(name, "|S" + std::to_string(text.size()), {}, text.data(), text.size());
  }

  //! To be called last.
  void finish();

 private:
  void add_bytes(const std::string& name, const std::string& type,
                 const std::vector<std::int64_t>& shape, const void* data, std::size_t bytes);
  void write(const char* data, std::size_t size);

  std::string path_;
  std::ostream& out_;
  std::string directory_;
  std::size_t offset_ = 0, count_ = 0;
};

class NpzReader {
 public:
  //! Reads a file. \throws IoError; InputError if it is damaged or compressed
  explicit NpzReader(const std::string& path);

  //! \param path  for messages
  NpzReader(std::string path, std::string content);

  bool has(const std::string& name) const { return arrays_.count(name) > 0; }

  //! The numbers of an array of this number of columns (0: a list) in C order, converted.
  //! \throws InputError if there is none, it has another shape or type, or numbers do not fit
  template <class Scalar>
  std::vector<Scalar> numbers(const std::string& name, int columns = 0) const;

  //! An array as a matrix with a column per row.
  template <class Matrix>
  Matrix columns(const std::string& name) const {
    constexpr int kRows = Matrix::RowsAtCompileTime;
    const auto list = numbers<typename Matrix::Scalar>(name, kRows);
    return Eigen::Map<const Matrix>(list.data(), kRows,
                                    static_cast<Eigen::Index>(list.size()) / kRows);
  }

  std::string text(const std::string& name) const;

  [[noreturn]] void fail(const std::string& message) const;

 private:
  struct Array {
    NpyHeader header;
    std::size_t begin = 0, size = 0;  // of the numbers in the file
  };
  const Array& array(const std::string& name) const;

  std::string path_, content_;
  std::map<std::string, Array> arrays_;
};

}  // namespace flbc::io
