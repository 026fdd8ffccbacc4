// SPDX-License-Identifier: BSD-3-Clause
#include "support/reference_optimum.h"

#include <filesystem>
#include <fstream>

#ifndef FLBC_TEST_DATA_DIR
#error "FLBC_TEST_DATA_DIR has to be the folder tests/data"
#endif

namespace flbc::testing {
namespace {

// Reads an expected item and throws if another one follows.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), file_(path) {
    while (file_.peek() == '#') file_.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    check("a readable file");
  }

  template <class Value>
  Value value(const std::string& key) {
    expect_key(key);
    Value value{};
    file_ >> value;
    check(key);
    return value;
  }

  // The rows of the file become columns. Sizes that are not known yet are -1.
  template <class Scalar>
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> columns(const std::string& key,
                                                                Eigen::Index count,
                                                                Eigen::Index size) {
    expect_key(key);
    Eigen::Index found_count = 0, found_size = 0;
    file_ >> found_count >> found_size;
    if (!file_ || found_size != size || found_count < 1 || (count >= 0 && found_count != count)) {
      fail("the size of " + key);
    }
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> matrix(size, found_count);
    for (auto column : matrix.colwise()) {
      for (Scalar& entry : column) file_ >> entry;
    }
    check(key);
    return matrix;
  }

  void expect_end() {
    if (!(file_ >> std::ws).eof()) fail("the end");
  }

 private:
  void expect_key(const std::string& key) {
    std::string found;
    if (!(file_ >> found) || found != key) fail(key);
  }
  void check(const std::string& wanted) const {
    if (!file_) fail(wanted);
  }
  [[noreturn]] void fail(const std::string& wanted) const {
    throw std::runtime_error(path_ + ": this is not " + wanted + ", which was expected here");
  }

  std::string path_;
  std::ifstream file_;
};

template <int Dim>
typename ReferenceOptimum<Dim>::Variant read_variant(Reader& reader, const std::string& variant,
                                                     Index vertices, Index control_points) {
  typename ReferenceOptimum<Dim>::Variant result;
  result.objective = reader.value<double>(variant + "_objective");
  result.gap = reader.value<double>(variant + "_gap");
  result.weights = reader.columns<double>(variant + "_weights", vertices, control_points);
  return result;
}

// After the name and the dimension.
template <int Dim>
ReferenceOptimum<Dim> read_rest(Reader& reader, const std::string& name) {
  ReferenceOptimum<Dim> result;
  result.name = name;
  result.cage.points = reader.columns<double>("cage_points", -1, Dim);
  result.cage.facets = reader.columns<Index>("cage_facets", -1, Dim);
  result.mesh.points = reader.columns<double>("points", -1, Dim);
  result.mesh.cells = reader.columns<Index>("cells", -1, Dim + 1);
  const Index vertices = result.mesh.num_vertices(), n = result.cage.size();
  result.phi = reader.columns<double>("phi", result.mesh.num_cells(), n);
  result.unconstrained = read_variant<Dim>(reader, "unconstrained", vertices, n);
  result.non_negative = read_variant<Dim>(reader, "non_negative", vertices, n);
  reader.expect_end();
  return result;
}

}  // namespace

template <int Dim>
std::vector<ReferenceOptimum<Dim>> reference_optima() {
  const std::filesystem::path folder = std::filesystem::path(FLBC_TEST_DATA_DIR) / "references";
  std::vector<ReferenceOptimum<Dim>> result;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".txt") continue;
      Reader reader(entry.path().string());
      const auto name = reader.value<std::string>("name");
      if (reader.value<int>("dimension") == Dim) result.push_back(read_rest<Dim>(reader, name));
    }
  }
  if (result.empty()) throw std::runtime_error(folder.string() + ": no reference optima here");
  std::sort(result.begin(), result.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  return result;
}

template std::vector<ReferenceOptimum<2>> reference_optima();
template std::vector<ReferenceOptimum<3>> reference_optima();

}  // namespace flbc::testing
