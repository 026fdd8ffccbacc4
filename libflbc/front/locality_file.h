// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Locality files: JSON of masks, {"control_points": ..., "region": ...}. Both are a list of
//! numbers from 0, {"vertices": [...]}, or {"box": [lowest, highest]}; a region also {"group":
//! name} of a .obj model, or {"attribute": name} of a .ply or glTF model, above 0.5. The masks are
//! a list, or are in an object {"masks": [...], "conflicts": "relax", "reach": [{"control_points":
//! ..., "factor": 0.5}], "falloff": 0.1, "solid": [{"region": ...}]}.
#pragma once

#include <string>
#include <vector>

#include "flbc/cage.h"
#include "flbc/masks.h"
#include "flbc/sparse_weights.h"

namespace flbc::app {

//! The content of a locality file.
struct Locality {
  std::vector<flbc::Mask> masks{};
  std::vector<Index> freed{};               //!< control points that "relax" removed from the masks
  std::vector<double> reach{};              //!< SolverOptions::reach
  double falloff = 0;                       //!< SolverOptions::falloff
  std::vector<std::vector<Index>> solid{};  //!< BindOptions::solid

  //! About the control points that were freed; empty if there are none.
  std::string note() const;
};

//! Reads a file, for the vertices of a model or mesh. Empty for an empty path.
//! \param points  Dim x P \param model  file of the points, for groups and attributes; may be empty
//! \param mirror_axis  BindOptions::mirror_axis
//! \throws IoError; InputError naming the file and the entry
template <int Dim>
Locality load_locality(const std::string& path, const Cage<Dim>& cage, const PointList<Dim>& points,
                       const std::string& model, int mirror_axis = -1);

}  // namespace flbc::app
