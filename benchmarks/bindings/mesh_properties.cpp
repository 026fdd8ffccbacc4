// SPDX-License-Identifier: BSD-3-Clause
// Time of the gradient ADMM on the mesh itself (flbc/openmesh/gradient_admm.h) and of the array
// kernel for the same iterates in double precision:
//
//   flbc_bench_properties [PAIRS]
//
// On a generated domain in 2D (a triangle mesh of OpenMesh) and in 3D (a TetMesh), alternates fixed
// numbers of iterations of both and prints, as comma-separated values, the seconds of the last pair
// and the median of the ratios of the pairs.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "flbc/meshing.h"
#include "flbc/openmesh/convert.h"
#include "flbc/openmesh/gradient_admm.h"
#include "solver/methods/gradient/gradient_admm.h"

namespace {

using namespace flbc;

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

// A star with 2 k corners.
Cage<2> make_cage_2d(Index k) {
  Cage<2> cage;
  cage.points.resize(2, 2 * k);
  cage.facets.resize(2, 2 * k);
  for (Index i = 0; i < 2 * k; ++i) {
    const double angle = M_PI * i / k;
    const double radius = i % 2 == 0 ? 1 : 0.6;
    cage.points.col(i) << radius * std::cos(angle), radius * std::sin(angle);
    cage.facets.col(i) << i, (i + 1) % (2 * k);
  }
  return cage;
}

// A bumpy ball: rings of k points between two poles.
Cage<3> make_cage_3d(Index k) {
  const Index rings = k / 2;
  Cage<3> cage;
  cage.points.resize(3, rings * k + 2);
  std::vector<Vector<3>> facets;
  const auto at = [&](Index ring, Index i) { return ring * k + i % k; };
  for (Index ring = 0; ring < rings; ++ring) {
    const double polar = M_PI * (ring + 1) / (rings + 1);
    for (Index i = 0; i < k; ++i) {
      const double angle = 2 * M_PI * i / k;
      const double radius = (ring + i) % 2 == 0 ? 1 : 0.8;
      cage.points.col(at(ring, i)) << radius * std::sin(polar) * std::cos(angle),
          radius * std::sin(polar) * std::sin(angle), radius * std::cos(polar);
    }
  }
  const Index north = rings * k;
  const Index south = north + 1;
  cage.points.col(north) << 0, 0, 1;
  cage.points.col(south) << 0, 0, -1;
  for (Index i = 0; i < k; ++i) {
    facets.emplace_back(north, at(0, i), at(0, i + 1));
    facets.emplace_back(south, at(rings - 1, i + 1), at(rings - 1, i));
    for (Index ring = 0; ring + 1 < rings; ++ring) {
      facets.emplace_back(at(ring, i), at(ring + 1, i), at(ring + 1, i + 1));
      facets.emplace_back(at(ring, i), at(ring + 1, i + 1), at(ring, i + 1));
    }
  }
  cage.facets.resize(3, facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) cage.facets.col(f) = facets[f].cast<Index>();
  return cage;
}

double seconds_of(const std::function<void()>& action) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  action();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

template <class Mesh>
void compare(const Cage<openmesh::kDimension<Mesh>>& cage,
             const DomainMesh<openmesh::kDimension<Mesh>>& domain, int iterations, int pairs) {
  constexpr int kDim = openmesh::kDimension<Mesh>;
  auto mesh = openmesh::to_mesh<Mesh>(domain);
  openmesh::GradientAdmm<Mesh> on_mesh(mesh, cage);
  const auto problem = make_problem(cage, domain, DistanceScheme::kSquare);
  const double penalty = on_mesh.penalty() * std::pow(problem.scale, kDim + 1);
  gradient::GradientAdmm<double, kDim> on_arrays(problem, penalty, 1, {});
  on_arrays.start_from_weights(harmonic_coordinates(problem));
  std::vector<double> ratios;
  double arrays_seconds = 0, mesh_seconds = 0;
  for (int pair = 0; pair < pairs; ++pair) {
    // Whichever comes second finds warmer caches and memory: take turns.
    for (int turn = 0; turn < 2; ++turn) {
      if ((pair + turn) % 2 == 0) {
        arrays_seconds = seconds_of([&] { on_arrays.iterate(iterations); });
      } else {
        mesh_seconds = seconds_of([&] { on_mesh.iterate(iterations); });
      }
    }
    ratios.push_back(mesh_seconds / arrays_seconds);
  }
  std::sort(ratios.begin(), ratios.end());
  std::printf("%s,gradient,%d,%d,%.4g,%.4g,%.4g\n", kDim == 2 ? "TriMesh" : "TetMesh",
              domain.num_vertices(), iterations, arrays_seconds, mesh_seconds,
              ratios[ratios.size() / 2]);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int pairs = argc > 1 ? std::max(1, std::atoi(argv[1])) : 9;
    std::printf("mesh,method,vertices,iterations,arrays_seconds,properties_seconds,ratio\n");
    const auto cage2 = make_cage_2d(13);
    compare<TriMesh>(cage2, triangulate(cage2, {10000}), 200, pairs);
    const auto cage3 = make_cage_3d(10);
    compare<openmesh::TetMesh>(cage3, tetrahedralize(cage3, {6000}), 100, pairs);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
