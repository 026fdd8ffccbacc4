// SPDX-License-Identifier: BSD-3-Clause
#include "support/reference_optimum.h"

#include <filesystem>
#include <fstream>

#ifndef FLBC_TEST_DATA_DIR
#error "FLBC_TEST_DATA_DIR has to be the folder tests/data"
#endif

namespace flbc::testing {
namespace {

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), file_(path) {
    while (file_.peek() == '#') file_.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }

  // What follows this word.
  template <class Value>
  Value value(const std::string& key) {
    std::string found;
    Value value{};
    require(file_ >> found && found == key && file_ >> value, key);
    return value;
  }

  // The rows of the file become columns. Sizes that are not known yet are -1.
  template <class Scalar>
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> columns(const std::string& key,
                                                                Eigen::Index count,
                                                                Eigen::Index size) {
    const auto found = value<Eigen::Index>(key);
    require(found > 0 && (count < 0 || found == count) && value_is(size), "the size of " + key);
    Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> matrix(size, found);
    for (Scalar& entry : matrix.reshaped()) require(static_cast<bool>(file_ >> entry), key);
    return matrix;
  }

  void require(bool holds, const std::string& wanted) const {
    if (!holds) throw std::runtime_error(path_ + ": expected " + wanted);
  }
  bool is_at_end() { return (file_ >> std::ws).eof(); }

 private:
  bool value_is(Eigen::Index expected) {
    Eigen::Index found = 0;
    return file_ >> found && found == expected;
  }

  std::string path_;
  std::ifstream file_;
};

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
  const auto read = [&](const std::string& variant) {
    const auto objective = reader.value<double>(variant + "_objective");
    const auto gap = reader.value<double>(variant + "_gap");
    return typename ReferenceOptimum<Dim>::Variant{
        objective, gap, reader.columns<double>(variant + "_weights", vertices, n)};
  };
  result.unconstrained = read("unconstrained");
  result.non_negative = read("non_negative");
  reader.require(reader.is_at_end(), "the end");
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
