// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Real cages and their meshes, for tests of the solver.
#pragma once

#include "flbc/meshing.h"
#include "support/model_cages.h"

namespace flbc::testing {

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

}  // namespace flbc::testing
