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

// Where vertices of a binding that move meet vertices without weights, for reports: the number of
// edges across the cage, the control points to hold still, and for each pose the largest jump.
// Without facets of the cage, there are none.
template <int Dim>
nlohmann::ordered_json border_json(const Binding<Dim>& binding,
                                   const std::vector<Pose<Dim>>& poses);

// Prints where the deformation jumps at such edges, and what to hold still; without poses, what to
// hold still in any. Of points without edges it prints that this is not checked.
// \param file  of the model
template <int Dim>
void warn_border(const Binding<Dim>& binding, const std::string& file,
                 const std::vector<Pose<Dim>>& poses);

// Makes the joint of --joint, unless the text is empty. For poses, it prints which control points
// the joint holds, how many cells it spans, and the slope of the displacement at the border before
// and after.
// \param file  of the model or the binding, for messages \param poses  null: nothing is printed
template <int Dim>
void join(Binding<Dim>& binding, const std::string& joint, const std::string& file,
          const std::vector<Pose<Dim>>* poses = nullptr);

// Prints how many cells of a volume mesh, or polygons of a model in the plane, are inverted in a
// pose, if there are any. Surfaces have none.
template <int Dim>
void warn_inverted(const MovableModel<Dim>& model, const PointList<Dim>& posed,
                   const std::string& file, const std::string& pose);

}  // namespace flbc::app
