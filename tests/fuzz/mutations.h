// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Calls of the public functions with damaged arguments: points, indices, poses, phi, and weights.
//! Every call must return or throw flbc::Error.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "flbc/types.h"

namespace flbc::fuzz {

//! Damages arguments at random, the same way for the same seed.
class Mutator {
 public:
  explicit Mutator(std::uint32_t seed) : random_(seed) {}

  //! A number in [0, limit), or 0 if the limit is not positive.
  Index below(Eigen::Index limit) {
    return limit > 0 ? static_cast<Index>(random_() % static_cast<std::uint64_t>(limit)) : 0;
  }

  template <class T>
  T one_of(std::initializer_list<T> values) {
    return values.begin()[below(static_cast<Eigen::Index>(values.size()))];
  }

  //! Makes one of the calls.
  void call_one(std::initializer_list<std::function<void()>> calls) {
    calls.begin()[below(static_cast<Eigen::Index>(calls.size()))]();
  }

  //! Damages a matrix of numbers or indices in a third of the calls.
  template <class Matrix>
  void damage(Matrix& matrix) {
    if (below(3) != 0) return;
    if (below(5) == 0) {
      resize(matrix);
      return;
    }
    for (Index times = 1 + below(3); times > 0 && matrix.size() > 0; --times) {
      auto& entry = matrix.data()[below(matrix.size())];
      entry = other(entry, matrix);
    }
  }

  //! The same for a list of indices.
  template <class Entry>
  void damage(std::vector<Entry>& list) {
    using Row = Eigen::Matrix<Entry, 1, Eigen::Dynamic>;
    Row row = Eigen::Map<Row>(list.data(), 1, static_cast<Eigen::Index>(list.size()));
    damage(row);
    list.assign(row.data(), row.data() + row.size());
  }

 private:
  // Changes the number of columns or, if it is not fixed, of rows.
  template <class Matrix>
  void resize(Matrix& matrix) {
    const Eigen::Index columns = below(4) == 0 ? 0 : matrix.cols() + below(3) - 1;
    if (Matrix::RowsAtCompileTime != Eigen::Dynamic || below(2) == 0) {
      matrix = Matrix(matrix.leftCols(std::min(columns, matrix.cols())));
    } else {
      matrix = Matrix(matrix.topRows(below(matrix.rows() + 1)));
    }
  }

  template <class Matrix>
  double other(double value, const Matrix& matrix) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    switch (below(4)) {
      case 0:
        return one_of({std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity, 1e300,
                       -1e300, 1e155, 1e15, 1e-300, 5e-324, -0.0, 0.0});
      case 1:
        return matrix.data()[below(matrix.size())];
      case 2:
        return -value + one_of({0.0, 1.0, 1e-7});
      default:
        return value + std::ldexp(1.0, -below(50)) * one_of({-1.0, 1.0});
    }
  }

  template <class Entry, class Matrix>
  Entry other(Entry value, const Matrix& matrix) {
    if (below(2) == 0) return matrix.data()[below(matrix.size())];
    return one_of<Entry>({static_cast<Entry>(-1),
                          value < 64 ? static_cast<Entry>(value + 1) : Entry{},
                          std::numeric_limits<Entry>::max(), std::numeric_limits<Entry>::min(),
                          static_cast<Entry>(below(64))});
  }

  std::mt19937 random_;
};

//! A public function, or a few that are used together.
struct Call {
  std::string name;
  void (*make)(Mutator& mutator);  //!< with damaged arguments; may throw flbc::Error
};

//! The calls of the core, in 2D and 3D, and those of the bindings to OpenMesh.
std::vector<Call> core_calls();
std::vector<Call> openmesh_calls();

//! All of them.
std::vector<Call> all_calls();

//! Makes a call.
//! \param seed  of the damage
//! \return whether the arguments were accepted
//! \throws any exception except flbc::Error, as a finding
bool accepts(const Call& call, std::uint32_t seed);

}  // namespace flbc::fuzz
