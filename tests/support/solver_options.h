// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Options, problems, and real cages of solver tests.
#pragma once

#include "flbc/meshing.h"
#include "flbc/solver.h"
#include "support/model_cages.h"

namespace flbc::testing {

//! The problem of the papers, which make_problem() makes by default. Its optimum does not determine
//! the weights.
inline SolverOptions without_smoothness() {
  SolverOptions options;
  options.smoothness = 0;
  return options;
}

//! The problem of default options, whose optimum is unique.
template <int Dim>
LbcProblem<Dim> smooth_problem(const Sample<Dim>& sample) {
  return make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, *resolve({}).smoothness);
}

//! A fixed number of iterations in double precision, independent of the error.
inline SolverOptions many_iterations(int count, SolverOptions options = {}) {
  options.precision = Precision::kDouble;
  options.tolerance = 1e-100;
  options.max_iterations = count;
  return options;
}

//! A real cage.
struct Model {
  const char* name;
  const char* file;
  Index vertices;

  bool is_planar() const { return file[0] == '2'; }
};

inline std::string name_of_model(const ::testing::TestParamInfo<Model>& info) {
  return info.param.name;
}

inline DomainMesh<2> mesh_of(const Cage<2>& cage, Index vertices) {
  return triangulate(cage, {vertices});
}
inline DomainMesh<3> mesh_of(const Cage<3>& cage, Index vertices) {
  return tetrahedralize(cage, {vertices});
}

//! Mean over all weights.
inline double squared_difference(const Solution& a, const Solution& b) {
  const WeightMatrix difference = a.weights.dense() - b.weights.dense();
  return difference.squaredNorm() / static_cast<double>(difference.size());
}

}  // namespace flbc::testing
