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

//! How to mesh with about so many vertices. \param roughly  in one run of the mesher
template <int Dim>
MeshingOptions<Dim> meshing_options(Index vertices, bool roughly) {
  MeshingOptions<Dim> options;
  options.vertices = vertices;
  options.roughly = roughly;
  return options;
}

//! Meshes a cage. Parameters as above.
inline DomainMesh<2> mesh_of(const Cage<2>& cage, Index vertices, bool roughly = false) {
  return triangulate(cage, meshing_options<2>(vertices, roughly));
}
inline DomainMesh<3> mesh_of(const Cage<3>& cage, Index vertices, bool roughly = false) {
  return tetrahedralize(cage, meshing_options<3>(vertices, roughly));
}

}  // namespace flbc::bench
