// SPDX-License-Identifier: BSD-3-Clause
// Cost of binding and moving an OpenMesh model instead of plain arrays:
//
//   flbc_bench_bind CAGE MODEL [PAIRS]
//
// Alternates bind() with the steps that flbc run takes for the same (mesh, solve, evaluate,
// reduce), and deform() by the property with deform() of SparseWeights on arrays, and prints the
// ratio of each pair's seconds and their median. A 3D cage and model, as .obj.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <vector>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "flbc/cell_locator.h"
#include "flbc/interpolate.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "flbc/openmesh/bind.h"
#include "flbc/solver.h"

namespace {

using namespace flbc;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using Model = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

constexpr Index kMost = 8;

double seconds_of(const std::function<void()>& action) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  action();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Model load_model(const char* path) {
  const auto soup = io::read_polygons(path);
  Model model;
  for (const auto& point : soup.points) model.add_vertex({point[0], point[1], point[2]});
  for (const auto& polygon : soup.polygons) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const Index vertex : polygon) corners.emplace_back(vertex);
    model.add_face(corners);
  }
  return model;
}

// As flbc run does it.
WeightMatrix take_steps(const Cage<3>& cage, const PointList<3>& points,
                        const std::vector<std::vector<Index>>& polygons) {
  MeshingOptions<3> meshing;
  meshing.vertices = openmesh::BindOptions::kDefaultVertices;
  const auto domain = tetrahedralize(cage, meshing);
  const CoarseMesher<3> mesher = [](const Cage<3>& scaled, Index vertices) {
    return tetrahedralize(scaled, {vertices});
  };
  const auto solution = solve(cage, domain, {}, mesher);
  const auto weights = interpolate(domain, solution.weights, locate_points(domain, points));
  return reduce_by_poisson<3>(cage.points, points, edges_of_polygons(points, polygons), weights, {},
                              {kMost});
}

void compare_binding(const Cage<3>& cage, Model& model, int pairs) {
  const auto points = openmesh::points_of<3>(model);
  const auto polygons = openmesh::polygons_of(model);
  std::vector<double> ratios;
  for (int pair = 0; pair < pairs; ++pair) {
    double steps = 0, bound = 0;
    // Whichever comes second finds warmer caches and memory: take turns.
    for (int turn = 0; turn < 2; ++turn) {
      if ((pair + turn) % 2 == 0) {
        steps = seconds_of([&] { take_steps(cage, points, polygons); });
      } else {
        openmesh::restore_rest(model);
        bound = seconds_of([&] { openmesh::bind(model, cage); });
      }
    }
    ratios.push_back(bound / steps);
    std::printf("bind: steps %.3f s, bind %.3f s, ratio %.3f\n", steps, bound, ratios.back());
  }
  std::printf("bind: median ratio %.3f\n", median(ratios));
}

void compare_frames(const Cage<3>& cage, Model& model, int pairs) {
  const SparseWeights weights(openmesh::get_weights(model));
  constexpr int kFrames = 200;
  const PointList<3> pose = 1.5 * cage.points;
  std::vector<double> ratios;
  for (int pair = 0; pair < pairs; ++pair) {
    double arrays = 0, property = 0;
    PointList<3> points;
    for (int turn = 0; turn < 2; ++turn) {
      if ((pair + turn) % 2 == 0) {
        arrays = seconds_of([&] {
          for (int frame = 0; frame < kFrames; ++frame) points = deform(weights, pose);
        });
      } else {
        property = seconds_of([&] {
          for (int frame = 0; frame < kFrames; ++frame) openmesh::deform(model, pose);
        });
      }
    }
    ratios.push_back(property / arrays);
    std::printf("deform: %zu vertices, arrays %.4f ms, property %.4f ms, ratio %.3f\n",
                model.n_vertices(), 1e3 * arrays / kFrames, 1e3 * property / kFrames,
                ratios.back());
  }
  std::printf("deform: median ratio %.3f\n", median(ratios));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 3) {
      std::fprintf(stderr, "usage: flbc_bench_bind CAGE.obj MODEL.obj [PAIRS]\n");
      return 1;
    }
    const int pairs = argc > 3 ? std::max(1, std::atoi(argv[3])) : 5;
    const auto cage = std::get<Cage<3>>(io::to_cage(io::read_polygons(argv[1]), argv[1]));
    auto model = load_model(argv[2]);
    openmesh::bind(model, cage);
    compare_frames(cage, model, pairs);
    openmesh::restore_rest(model);
    compare_binding(cage, model, pairs);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
