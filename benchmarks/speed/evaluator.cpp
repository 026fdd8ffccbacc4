// SPDX-License-Identifier: BSD-3-Clause
// Points per second of Evaluator: placed, moved, and both. Usage:
//   flbc_bench_evaluator CAGE DOMAIN WEIGHTS [THREADS]
// Weights are those of the domain mesh. Points are inside the cage: rows of a grid, as meshes have
// them, and the same points in random order.
#include "flbc/evaluator.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <random>

#include "flbc/bounding_box.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "flbc/poses.h"
#include "flbc/sparsify_error.h"

namespace flbc::bench {
namespace {

constexpr Index kBatch = 1 << 16;
constexpr double kPoints = 4e6;
constexpr int kRuns = 3;

double least_seconds(const std::function<void()>& action) {
  double least = INFINITY;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = std::chrono::steady_clock::now();
    action();
    least = std::min(
        least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

// About kPoints points of the bounding box, without those outside.
PointList<3> grid_inside(const Cage<3>& cage, const Evaluator<3>& evaluator) {
  const Vector<3> low = cage.points.rowwise().minCoeff();
  const Vector<3> extent = cage.points.rowwise().maxCoeff() - low;
  const double step = std::cbrt(extent.prod() / kPoints);
  const Eigen::Array3i count = (extent / step).array().cast<int>();
  PointList<3> points(3, static_cast<Eigen::Index>(count.cast<double>().prod()));
  Eigen::Index p = 0;
  for (int z = 0; z < count[2]; ++z) {
    for (int y = 0; y < count[1]; ++y) {
      for (int x = 0; x < count[0]; ++x) points.col(p++) = low + step * Vector<3>(x, y, z);
    }
  }
  const auto placement = evaluator.place(points);
  Eigen::Index inside = 0;
  for (p = 0; p < points.cols(); ++p) {
    if (placement.places[p].cell >= 0) points.col(inside++) = points.col(p);
  }
  return points.leftCols(inside);
}

PointList<3> shuffled(PointList<3> points) {
  std::mt19937 random(1);
  for (Eigen::Index p = points.cols() - 1; p > 0; --p) {
    points.col(p).swap(points.col(static_cast<Eigen::Index>(random() % (p + 1))));
  }
  return points;
}

void measure(const char* order, const PointList<3>& points, const Evaluator<3>& evaluator,
             const PosedDomain<3>& pose) {
  std::vector<PointList<3>> batches;
  for (Eigen::Index begin = 0; begin < points.cols(); begin += kBatch) {
    batches.push_back(
        points.middleCols(begin, std::min<Eigen::Index>(kBatch, points.cols() - begin)));
  }
  const double both = least_seconds([&] {
    for (const auto& batch : batches) evaluator.move(evaluator.place(batch), pose);
  });
  std::vector<Placement<3>> placements;
  const double placing = least_seconds([&] {
    placements.clear();
    for (const auto& batch : batches) placements.push_back(evaluator.place(batch));
  });
  const double moving = least_seconds([&] {
    for (const auto& placement : placements) evaluator.move(placement, pose);
  });
  const auto& first = placements.front();
  const double weighing = least_seconds([&] { evaluator.weights(first); });
  const double count = static_cast<double>(points.cols()) / 1e6;
  std::printf("%-8s %10.2f %14.2f %14.2f %16.2f %14.2f\n", order, count, count / placing,
              count / moving, count / both,
              1e-6 * static_cast<double>(first.points.cols()) / weighing);
}

void run(const char* cage_file, const char* domain_file, const char* weights_file, int threads) {
  const auto cage = std::get<Cage<3>>(io::to_cage(io::read_polygons(cage_file), cage_file));
  auto domain = io::read_domain<3>(domain_file);
  auto weights = io::read_sparse_weights(weights_file);
  const auto influences = count_influences(weights);
  std::printf("%d control points, %d vertices, %d cells, %.1f influences per vertex, %d threads\n",
              cage.size(), domain.num_vertices(), domain.num_cells(), influences.mean, threads);
  const Evaluator<3> evaluator(cage, std::move(domain), std::move(weights), OutsidePoints::kNearest,
                               threads);
  const auto pose = evaluator.pose(smooth_poses<3>(cage.points, 1).front());
  const auto points = grid_inside(cage, evaluator);
  std::printf(
      "millions of points (a second):\norder    points     placed         moved          "
      "placed and moved weights\n");
  measure("grid", points, evaluator, pose);
  measure("random", shuffled(points), evaluator, pose);
}

}  // namespace
}  // namespace flbc::bench

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: %s CAGE DOMAIN WEIGHTS [THREADS]\n", argv[0]);
    return 1;
  }
  try {
    flbc::bench::run(argv[1], argv[2], argv[3], argc > 4 ? std::atoi(argv[4]) : 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
