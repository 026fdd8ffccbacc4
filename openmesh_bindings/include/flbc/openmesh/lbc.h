// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Local barycentric coordinates on a mesh of OpenMesh's, or a TetMesh: gradients, duals and
//! weights are properties of the mesh.
#pragma once

#include <string>

#include "flbc/openmesh/domain.h"
#include "flbc/openmesh/property_storage.h"
#include "flbc/openmesh/state_record.h"
#include "flbc/openmesh/weights.h"
#include "flbc/solver.h"

namespace flbc::openmesh {

//! What solve() leaves on the mesh.
struct PropertyOptions {
  //! The weights: a row of n doubles per vertex (flbc/openmesh/wide_property.h).
  std::string weights = kWeights;

  //! First part of the names of the state's properties, such as "flbc:splitting_state" and
  //! "flbc:iterate", or "flbc:gradient", "flbc:tv_dual" and "flbc:integrability_dual"; the mesh
  //! property "flbc:state" says what they belong to.
  std::string state_prefix = "flbc:";

  //! Keep the state, so that a later call with the same method goes on from it.
  bool keep_state = false;

  //! Do not go on from a state that is there.
  bool restart = false;

  //! Mark the weights and the state for .om files.
  bool persistent = false;
};

//! What the two overloads of solve() below have in common.
template <int Dim, class Mesh>
SolveReport solve_on(Mesh& mesh, const Cage<Dim>& cage, const SolverOptions& user_options,
                     const PropertyOptions& properties) {
  validate(user_options);
  const auto options = resolve(user_options);
  auto domain = make_domain(mesh);
  auto record = describe(cage, domain.mesh, options);

  OpenMesh::MPropHandleT<std::string> record_handle;
  const std::string record_name = properties.state_prefix + "state";
  PropertyStorage<Mesh> storage(mesh, properties.state_prefix, cage.size());
  if (mesh.get_property_handle(record_handle, record_name)) {
    const auto kept = parse_state_record(mesh.property(record_handle));
    if (!properties.restart && kept.penalty > 0 && same_method(kept, record)) {
      const auto reason = find_mismatch(kept, record);
      if (!reason.empty()) {
        throw InputError("the state '" + record_name +
                         "' on the mesh cannot be gone on from: " + reason + "; ask for a restart");
      }
      storage.resume(kept.penalty, options.method, options.non_negative == NonNegative::kConstraint,
                     options.precision);
    }
  } else {
    mesh.add_property(record_handle, record_name);
  }

  // OpenMesh's text formats and its default points keep single precision.
  constexpr double kSinglePrecision = 1e-6;
  snap_to_cage(cage, domain.topology, kSinglePrecision, domain.mesh);
  const auto problem =
      make_problem(cage, std::move(domain.mesh), std::move(domain.topology), options.phi);
  auto solution = flbc::solve(problem, user_options, {}, &storage);
  set_weights(mesh, solution.weights, properties.weights);
  record.penalty = properties.keep_state ? storage.penalty() : 0;
  mesh.property(record_handle) = to_json(record);
  if (!properties.keep_state) storage.remove();
  if (properties.persistent) {
    OpenMesh::VPropHandleT<Wide<double>> weights;
    mesh.get_property_handle(weights, properties.weights);
    mesh.property(weights).set_persistent(true);
    mesh.mproperty(record_handle).set_persistent(true);
    if (properties.keep_state) storage.set_persistent();
  }
  return solution.report;
}

//! Solves on a triangle mesh in the plane, a mesh of the cage's interior. Properties as in
//! PropertyOptions; the mesh itself does not change. Boundary vertices beside the cage by no more
//! than 1e-6 of its size count as on it. \throws InputError naming the element if mesh and cage do
//! not belong together, if the mesh has deleted elements, or if there is a state that belongs to
//! another cage or mesh; OptionError, SolverError
template <class Traits>
SolveReport solve(OpenMesh::TriMesh_ArrayKernelT<Traits>& mesh, const Cage<2>& cage,
                  const SolverOptions& options = {}, const PropertyOptions& properties = {}) {
  return solve_on<2>(mesh, cage, options, properties);
}

//! The same on a tetrahedral mesh.
inline SolveReport solve(TetMesh& mesh, const Cage<3>& cage, const SolverOptions& options = {},
                         const PropertyOptions& properties = {}) {
  return solve_on<3>(mesh, cage, options, properties);
}

}  // namespace flbc::openmesh
