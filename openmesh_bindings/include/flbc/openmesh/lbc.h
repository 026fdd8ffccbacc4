// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Local barycentric coordinates on an OpenMesh mesh or a TetMesh, as mesh properties.
#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include "flbc/openmesh/deform.h"
#include "flbc/openmesh/gradients.h"
#include "flbc/openmesh/weights.h"
#include "flbc/solver.h"

namespace flbc::openmesh {

//! The properties that solve() writes.
struct PropertyOptions {
  std::string weights = kWeights;  //!< name of the weights, a row of n doubles per vertex
  bool gradients = false;          //!< also write their gradients on the cells (gradients.h)
};

//! solve() on a mesh of a valid type.
template <int Dim, class Mesh>
SolveReport solve_on(Mesh& mesh, const Cage<Dim>& cage, const SolverOptions& options,
                     const PropertyOptions& properties) {
  validate(options);
  const auto domain = snapped_domain(mesh, cage);
  auto solution = flbc::solve(cage, domain.mesh, domain.topology, options);
  set_weights(mesh, solution.weights, properties.weights);
  set_rest_cage(mesh, cage.points, properties.weights);
  internal::remove_property<Wide<double>>(mesh, internal::name_of_rest(properties.weights));
  if (properties.gradients) {
    internal::set_gradients(mesh, domain.mesh, solution.weights,
                            gradients_name(properties.weights));
  }
  return std::move(solution.report);
}

//! Solves on a domain mesh, a triangle mesh in the plane or a TetMesh, and writes the weights as
//! properties. The mesh itself does not change. The solve runs on arrays; gradient_admm.h iterates
//! on the mesh itself. Boundary vertices within 1e-6 of the cage size count as on the cage.
//! \throws InputError naming the element if the mesh does not match the cage or has deleted
//! elements; OptionError, SolverError. The properties are then unchanged
template <class Mesh, int Dim>
SolveReport solve(Mesh& mesh, const Cage<Dim>& cage, const SolverOptions& options = {},
                  const PropertyOptions& properties = {}) {
  if constexpr (std::is_same_v<Mesh, TetMesh>) {
    static_assert(Dim == 3, "tetrahedra do not fill a cage in the plane");
    return solve_on<Dim>(mesh, cage, options, properties);
  } else {
    constexpr bool kIsSurface = Dim == 3;
    static_assert(!kIsSurface,
                  "this is a surface; use bind: a solve needs a mesh of the cage interior");
    static_assert(kIsSurface || Mesh::IsTriMesh,
                  "a domain in the plane has triangles: use a TriMesh");
    if constexpr (!kIsSurface && Mesh::IsTriMesh) {
      return solve_on<Dim>(mesh, cage, options, properties);
    }
  }
}

}  // namespace flbc::openmesh
