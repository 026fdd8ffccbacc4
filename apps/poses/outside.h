// SPDX-License-Identifier: BSD-3-Clause
// What happens to a model that is not inside its cage as a whole: where the deformation jumps, and
// which cells turn over.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "flbc/binding.h"
#include "flbc/border.h"
#include "front/movable_model.h"
#include "front/poses.h"

namespace flbc::app {

// Where vertices that move meet vertices without weights.
template <int Dim>
class Border {
 public:
  // Without facets of the cage, no border is found.
  explicit Border(const Binding<Dim>& binding);

  bool is_empty() const { return crossings_.empty(); }

  // By how much the deformation jumps, and which control points to hold still; empty if it does
  // not jump. Without poses, what to hold still in any.
  std::string describe(const std::vector<Pose<Dim>>& poses) const;

  // The same for reports.
  nlohmann::ordered_json json(const std::vector<Pose<Dim>>& poses) const;

 private:
  BorderJump jump(const Pose<Dim>& pose) const;

  Cage<Dim> cage_;
  std::vector<BorderCrossing<Dim>> crossings_;
};

// Prints where vertices of a binding that move meet vertices without weights, and what to hold
// still, if there is such a place. Of points without edges it prints that this is not checked.
// \param file  of the model
template <int Dim>
void warn_border(const Binding<Dim>& binding, const std::string& file,
                 const std::vector<Pose<Dim>>& poses);

// Prints how many cells of a volume mesh, or polygons of a model in the plane, are inverted in a
// pose, if there are any. Surfaces have none.
template <int Dim>
void warn_inverted(const MovableModel<Dim>& model, const PointList<Dim>& posed,
                   const std::string& file, const std::string& pose);

}  // namespace flbc::app
