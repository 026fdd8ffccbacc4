// SPDX-License-Identifier: BSD-3-Clause
// Cost of binding and moving an OpenMesh model instead of plain arrays, as comma-separated values:
//
//   flbc_bench_bind CAGE MODEL [PAIRS] [--frames]
//
// Alternates bind() with the steps that flbc run takes for the same (mesh, solve, evaluate,
// reduce) or, with --frames, deform() by the property with deform() of SparseWeights on arrays, and
// prints seconds or milliseconds of the last pair and the median of the pairs' ratios. With
// --frames as many threads as there are cores spin at the end while deform() is timed again. A 3D
// cage and model, as .obj. flbc_bench_bind_debug is the same without optimisation, linked to the
// same library: what a user's debug build sees.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <numeric>
#include <string>
#include <thread>
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
using FloatModel = OpenMesh::PolyMesh_ArrayKernelT<>;

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
  double steps = 0, bound = 0;
  for (int pair = 0; pair < pairs; ++pair) {
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
  }
  std::printf("vertices,steps_seconds,bind_seconds,ratio\n%zu,%.4g,%.4g,%.4g\n", model.n_vertices(),
              steps, bound, median(ratios));
}

// Milliseconds of a frame. The median is that of a frame which no other program interrupts.
struct Frames {
  double mean, median;
};

Frames time_frames(const std::function<void()>& frame) {
  constexpr int kFrames = 200;
  std::vector<double> times(kFrames);
  for (double& time : times) time = 1e3 * seconds_of(frame);
  return {std::accumulate(times.begin(), times.end(), 0.0) / kFrames, median(times)};
}

// Keeps cores busy while it lives.
class Spinners {
 public:
  explicit Spinners(int count) {
    for (int k = 0; k < count; ++k) {
      threads_.emplace_back([this] {
        while (!ended_) {
        }
      });
    }
  }
  ~Spinners() {
    ended_ = true;
    for (auto& thread : threads_) thread.join();
  }
  Spinners(const Spinners&) = delete;
  Spinners& operator=(const Spinners&) = delete;

 private:
  std::atomic<bool> ended_ = false;
  std::vector<std::thread> threads_;
};

// The mean frame while as many threads as there are cores spin, relative to the quiet one.
template <class AnyModel>
double busy_over_quiet(AnyModel& model, const PointList<3>& pose) {
  const auto measure = [&] { return time_frames([&] { openmesh::deform(model, pose); }).mean; };
  const double quiet = measure();
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const Spinners spinners(cores);
  return measure() / quiet;
}

template <class AnyModel>
void compare_frames(const char* points_of, const SparseWeights& weights, AnyModel& model,
                    const PointList<3>& pose, int pairs) {
  std::vector<double> ratios;
  Frames arrays{}, property{};
  for (int pair = 0; pair < pairs; ++pair) {
    PointList<3> points;
    for (int turn = 0; turn < 2; ++turn) {
      if ((pair + turn) % 2 == 0) {
        arrays = time_frames([&] { points = deform(weights, pose); });
      } else {
        property = time_frames([&] { openmesh::deform(model, pose); });
      }
    }
    ratios.push_back(property.median / arrays.median);
  }
  std::printf("%zu,%s,%.4g,%.4g,%.4g,%.4g\n", model.n_vertices(), points_of, arrays.median,
              property.median, median(ratios), busy_over_quiet(model, pose));
}

// The same vertices with points of floats, without faces: moving needs none.
FloatModel in_single_precision(const Model& model) {
  FloatModel copy;
  for (const auto vertex : model.vertices()) {
    copy.add_vertex(OpenMesh::vector_cast<FloatModel::Point>(model.point(vertex)));
  }
  openmesh::set_influences(copy, SparseWeights(openmesh::get_weights(model)), kMost);
  return copy;
}

void measure_frames(const Cage<3>& cage, Model& model, int pairs) {
  const SparseWeights weights(openmesh::get_weights(model));
  const PointList<3> pose = 1.5 * cage.points;
  auto single = in_single_precision(model);
  std::printf("vertices,points_of,arrays_ms,property_ms,ratio,busy_over_quiet\n");
  compare_frames("doubles", weights, model, pose, pairs);
  compare_frames("floats", weights, single, pose, pairs);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const bool frames = argc > 1 && std::string(argv[argc - 1]) == "--frames";
    if (frames) --argc;
    if (argc < 3) {
      std::fprintf(stderr, "usage: flbc_bench_bind CAGE.obj MODEL.obj [PAIRS] [--frames]\n");
      return 1;
    }
    const int pairs = argc > 3 ? std::max(1, std::atoi(argv[3])) : 5;
    const auto cage = std::get<Cage<3>>(io::to_cage(io::read_polygons(argv[1]), argv[1]));
    auto model = load_model(argv[2]);
    openmesh::bind(model, cage);
    if (frames) {
      measure_frames(cage, model, pairs);
    } else {
      compare_binding(cage, model, pairs);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
