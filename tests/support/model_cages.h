// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A few lines that read the real models as cages, so that tests of cages do not depend on the
//! library's own file code.
#pragma once

#include <filesystem>
#include <fstream>

#include "support/test.h"

#ifndef FLBC_MODELS_DIR
#define FLBC_MODELS_DIR ""
#endif

namespace flbc::testing {

//! \param name  in the folder of models, or a full path
inline std::string model_path(const std::string& name) {
  return std::filesystem::path(FLBC_MODELS_DIR) / name;
}

inline bool has_model(const std::string& name) {
  return std::ifstream(model_path(name)).good();
}

//! The sound ones among the real cages.
constexpr const char* kRealCages2D[] = {"2d/woody-control-edgeset.obj",
                                        "2d/cactus-control-edgeset.obj",
                                        "2d/LBClogo-control-edgeset.obj"};
constexpr const char* kRealCages3D[] = {"3d/horse_cage.obj", "3d/armadillo_cage.obj",
                                        "3d/shark_cage.obj", "3d/beast_cage.obj",
                                        "3d/arm_cage.obj",   "3d/clothing_cage.obj"};

//! Positive indices only, as in all those files. In 3D polygons become fans of triangles, in 2D
//! polylines become edges.
template <int Dim>
Cage<Dim> load_cage(const std::string& name) {
  std::ifstream file(model_path(name));
  if (!file) throw std::runtime_error("cannot open " + model_path(name));
  std::vector<Vector<Dim>> points;
  std::vector<std::vector<Index>> facets;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Vector<Dim> point;
      for (int axis = 0; axis < Dim; ++axis) words >> point(axis);
      points.push_back(point);
    } else if (kind == (Dim == 2 ? "l" : "f")) {
      std::vector<Index> polygon;
      for (std::string word; words >> word;) polygon.push_back(std::stoi(word) - 1);
      const std::size_t count = polygon.size();
      for (std::size_t k = Dim - 1; k < count; ++k) {
        if constexpr (Dim == 2) {
          facets.push_back({polygon[k - 1], polygon[k]});
        } else {
          facets.push_back({polygon[0], polygon[k - 1], polygon[k]});
        }
      }
    }
  }
  Cage<Dim> cage;
  cage.points.resize(Dim, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) cage.points.col(i) = points[i];
  cage.facets.resize(Dim, facets.size());
  for (std::size_t i = 0; i < facets.size(); ++i) {
    for (int k = 0; k < Dim; ++k) cage.facets(k, i) = facets[i][k];
  }
  return cage;
}

}  // namespace flbc::testing
