// SPDX-License-Identifier: BSD-3-Clause
// What happens to a model that is not inside its cage as a whole: where the deformation jumps, and
// which cells turn over.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "files/movable_model.h"
#include "flbc/border.h"
#include "flbc/sparse_weights.h"
#include "poses/poses.h"

namespace flbc::app {

// Where vertices that move meet vertices without weights.
template <int Dim>
class Border {
 public:
  // \param rest  its facets may be missing; then no border is found
  // \param points  Dim x P, of the model
  Border(Cage<Dim> rest, const PointList<Dim>& points, const EdgeList& edges,
         const SparseWeights& weights);

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

// Prints how many vertices have no weights, and how many follow the nearest point of the cage at
// an offset, if there are any. \param rest  may be without facets \param file  of the model
template <int Dim>
void warn_outside(const SparseWeights& weights, const Cage<Dim>& rest, const PointList<Dim>& points,
                  const std::string& file);

// Prints how many cells of a volume mesh, or polygons of a model in the plane, are inverted in a
// pose, if there are any. Surfaces have none.
template <int Dim>
void warn_inverted(const MovableModel<Dim>& model, const PointList<Dim>& posed,
                   const std::string& file, const std::string& pose);

}  // namespace flbc::app
