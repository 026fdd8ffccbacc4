// SPDX-License-Identifier: BSD-3-Clause
#include "solve/cache_key.h"

#include <sstream>

#include "flbc/content_hash.h"
#include "flbc/option_lines.h"
#include "flbc/version.h"

namespace flbc::app {
namespace {

// The numbers of matrices, or their hashes.
class Numbers {
 public:
  Numbers(std::ostream& key, bool hashed) : key_(key), hashed_(hashed) {}

  template <class Matrix>
  void add(const char* name, const Matrix& matrix) {
    key_ << name << ' ' << matrix.rows() << " x " << matrix.cols();
    if (hashed_) {
      key_ << ' ' << content_hash(matrix).text() << '\n';
      return;
    }
    key_ << '\n';
    key_.write(reinterpret_cast<const char*>(matrix.data()),
               static_cast<std::streamsize>(sizeof(typename Matrix::Scalar)) * matrix.size());
    key_ << '\n';
  }

 private:
  std::ostream& key_;
  bool hashed_;
};

template <int Dim>
std::string describe(const WeightOrigin<Dim>& origin, bool hashed) {
  std::ostringstream key;
  Numbers numbers(key, hashed);
  key << std::hexfloat;  // all bits of a number
  key << "version " << FLBC_VERSION << '\n'
      << "dim " << Dim << '\n'
      << "published_penalty " << origin.penalty << '\n'
      << "can_mesh " << origin.can_mesh << '\n'
      << "mesher " << name_of(origin.mesher) << '\n'
      << option_lines(resolve(origin.options));
  if (!hashed) key << "max_iterations " << origin.options.max_iterations << '\n';
  numbers.add("control_points", origin.cage.points);
  numbers.add("facets", origin.cage.facets);
  if (origin.domain) {
    numbers.add("domain_points", origin.domain->points);
    numbers.add("domain_cells", origin.domain->cells);
    return key.str();
  }
  key << "vertices " << origin.vertices << '\n';
  if (origin.embedded) numbers.add("embedded", *origin.embedded);
  return key.str();
}

}  // namespace

template <int Dim>
std::string key_of(const WeightOrigin<Dim>& origin) {
  return describe(origin, false);
}

template <int Dim>
std::string lines_of(const WeightOrigin<Dim>& origin) {
  return describe(origin, true);
}

#define FLBC_INSTANTIATE(Dim)                            \
  template std::string key_of(const WeightOrigin<Dim>&); \
  template std::string lines_of(const WeightOrigin<Dim>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc::app
