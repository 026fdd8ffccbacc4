// SPDX-License-Identifier: BSD-3-Clause
#include "files/deform_points.h"

#include <algorithm>
#include <sstream>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "front/system/held_signals.h"
#include "solve/progress_bar.h"

namespace flbc::app {
namespace {

template <int Dim>
[[noreturn]] void refuse_point(const PointMotion& motion, const NearestOnCage<Dim>& point,
                               std::int64_t first, const PointList<Dim>& batch) {
  std::ostringstream message;
  message << motion.input << ": point " << first + point.point << " at ("
          << batch.col(point.point).transpose() << ") is outside the cage, " << point.distance()
          << " from it; add --outside keep or --outside nearest";
  throw InputError(message.str());
}

}  // namespace

template <int Dim>
MovedPoints deform_points(const PointMotion& motion, const Evaluator<Dim>& evaluator,
                          const PointList<Dim>& control_points) {
  const auto pose = evaluator.pose(control_points);
  MovedPoints all;
  ProgressBar bar(motion.quiet, "moving points");
  HeldSignals held;
  const auto move = [&](const PointList<Dim>& batch, std::int64_t first) -> PointList<Dim> {
    if (held.has_signal()) throw IoError(motion.output + ": not written, because of a signal");
    const auto placement = evaluator.place(batch);
    if (motion.outside == OutsidePoints::kFail && !placement.outside.empty()) {
      refuse_point(motion, placement.outside.front(), first, batch);
    }
    auto moved = evaluator.move(placement, pose);
    all.largest = std::max(all.largest, (moved - batch).colwise().norm().maxCoeff());
    all.outside += static_cast<std::int64_t>(placement.outside.size());
    for (const auto& point : placement.outside) {
      all.farthest = std::max(all.farthest, point.distance());
    }
    bar.show("moving points",
             static_cast<double>(first + batch.cols()) / static_cast<double>(motion.layout.count));
    return moved;
  };
  io::write_file(motion.output, [&](std::ostream& out) {
    io::rewrite_points<Dim>(motion.input, motion.layout, out, move);
  });
  return all;
}

template MovedPoints deform_points(const PointMotion&, const Evaluator<2>&, const PointList<2>&);
template MovedPoints deform_points(const PointMotion&, const Evaluator<3>&, const PointList<3>&);

}  // namespace flbc::app
