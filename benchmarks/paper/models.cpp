// SPDX-License-Identifier: BSD-3-Clause
#include "paper/models.h"

#include <stdexcept>
#include <string>

namespace flbc::bench {

const std::vector<Model>& models() {
  static const std::vector<Model> kModels = {
      {"logo", 2, "2d/LBClogo-control-edgeset.obj", 1500, 26800, 0, {3.18e-4, 4.94, 5.72e-5, 2.78}},
      {"woody",
       2,
       "2d/woody-control-edgeset.obj",
       1500,
       10800,
       12,
       {2.43e-4, 19.30, 2.30e-4, 12.43, 1.723e-10}},
      {"cactus",
       2,
       "2d/cactus-control-edgeset.obj",
       1500,
       10850,
       4,
       {5.87e-4, 22.60, 2.2e-4, 16.98, 4.083e-10}},
      {"horse", 3, "3d/horse_cage.obj", 2000, 5850, 27, {1.66e-5, 39.35, 1.21e-5, 21.87}},
      {"armadillo", 3, "3d/armadillo_cage.obj", 4000, 6640, 53, {5.2e-5, 134.65, 4.16e-5, 120.85}},
      {"shark", 3, "3d/shark_cage.obj", 2000, 6000, 0, {}},
      {"beast", 3, "3d/beast_cage.obj", 2000, 6000, 0, {}},
  };
  return kModels;
}

const Model& model(const char* name) {
  for (const auto& candidate : models()) {
    if (std::string(candidate.name) == name) return candidate;
  }
  throw std::out_of_range(std::string("no model is called ") + name);
}

}  // namespace flbc::bench
