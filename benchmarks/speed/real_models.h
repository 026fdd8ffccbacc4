// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Loading and meshing real cages for the benchmark programs.
#pragma once

#include <cstdio>
#include <fstream>
#include <string>

#include "flbc/lbc_problem.h"
#include "flbc/meshing.h"
#include "flbc/quality.h"

namespace flbc::bench {

//! A cage below the models folder, and how many vertices its mesh is to have.
struct Case {
  const char* name;
  const char* cage;
  Index vertices;
};

//! Calls action(case, path of its cage) for those of the cases that have this name, or for all if
//! it is empty. Cages that are absent are told on stderr and left out.
template <class Cases, class Action>
void for_each_case(const std::string& folder, const Cases& cases, const std::string& only,
                   const Action& action) {
  for (const Case& test : cases) {
    if (!only.empty() && only != test.name) continue;
    const auto path = folder + "/" + test.cage;
    if (!std::ifstream(path)) {
      std::fprintf(stderr, "%s: skipped, %s is absent\n", test.name, path.c_str());
      continue;
    }
    action(test, path);
  }
}

//! Meshes a cage with about so many vertices.
inline DomainMesh<2> mesh_of(const Cage<2>& cage, Index vertices) {
  return triangulate(cage, {vertices});
}
inline DomainMesh<3> mesh_of(const Cage<3>& cage, Index vertices) {
  return tetrahedralize(cage, {vertices});
}

}  // namespace flbc::bench
