// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Local barycentric coordinates on a mesh of OpenMesh's, or a TetMesh: gradients, duals and
//! weights are properties of the mesh.
#pragma once

#include <string>
#include <type_traits>

#include "flbc/coarse_to_fine.h"
#include "flbc/content_hash.h"
#include "flbc/openmesh/deform.h"
#include "flbc/openmesh/domain.h"
#include "flbc/openmesh/meshers.h"
#include "flbc/openmesh/property_storage.h"
#include "flbc/openmesh/state_record.h"
#include "flbc/openmesh/state_text.h"
#include "flbc/openmesh/weights.h"
#include "flbc/solver.h"

namespace flbc::openmesh {

//! The properties that solve() leaves on the mesh.
struct PropertyOptions {
  //! The weights: a row of n doubles per vertex (flbc/openmesh/wide_property.h), a copy of the
  //! result, whose negative weights have been projected away.
  std::string weights = kWeights;

  //! First part of the names of the state's properties, such as "flbc:splitting_state" and
  //! "flbc:iterate", or "flbc:gradient", "flbc:tv_dual" and "flbc:integrability_dual"; the mesh
  //! property "flbc:state" says what they belong to.
  std::string state_prefix = "flbc:";

  //! The weight functions phi_i on the cells, a row of n doubles >= 0 per cell of type
  //! Wide<double>. What is there under this name is taken instead of SolverOptions::phi; if nothing
  //! is, the computed ones are left there. Empty: neither.
  std::string phi{};

  //! Keep the state, so that a later call with the same method goes on from it. The iteration then
  //! works in place, on whole rows of floats or doubles and with distances of the mesh itself. Else
  //! it has memory of its own and solves as solve() of a cage and a mesh does, in less time:
  //! Precision::kHalf, SolverOptions::active_pairs, SolverOptions::distances.
  bool keep_state = false;

  //! Do not go on from a state that is there.
  bool restart = false;

  //! Mark the weights, the state and phi for .om files.
  bool persistent = false;
};

//! The report of a solve on a mesh.
struct MeshSolveReport : SolveReport {
  bool resumed = false;   //!< whether it went on from the state on the mesh
  std::string restart{};  //!< why it did not: "there is no state", "the method was ...", and so on
};

namespace internal {

//! How far, relative to the cage's size, a boundary vertex may be beside it: OpenMesh's text
//! formats and its default points keep single precision.
constexpr double kSinglePrecision = 1e-6;

//! phi as it stands on the mesh. \return n x F; empty if there is no such property
//! \throws InputError if it is none of n control points, or a number is negative or not finite
template <class Mesh>
Eigen::MatrixXd phi_of(const Mesh& mesh, const std::string& name, Index control_points) {
  typename PropertyHandles<Mesh>::template Cell<Wide<double>> handle;
  if (name.empty() || !mesh.get_property_handle(handle, name)) return {};
  Eigen::MatrixXd phi = to_matrix(mesh.property(handle).data_vector());
  require_phi(phi, control_points, name);
  return phi;
}

//! Leaves phi where there is none yet.
template <class Mesh>
void leave_phi(Mesh& mesh, const WeightFunctions& phi, const PropertyOptions& properties) {
  if (properties.phi.empty()) return;
  typename PropertyHandles<Mesh>::template Cell<Wide<double>> handle;
  if (!mesh.get_property_handle(handle, properties.phi)) {
    mesh.add_property(handle, properties.phi);
    auto& rows = mesh.property(handle);
    rows.set_shape(1, static_cast<std::size_t>(phi.rows()));
    for (Eigen::Index s = 0; s < phi.cols(); ++s) {
      Eigen::Map<Eigen::VectorXd>(rows[static_cast<int>(s)].data(), phi.rows()) = phi.col(s);
    }
  }
  if (properties.persistent) mesh.property(handle).set_persistent(true);
}

//! The problem with the phi that is on the mesh; if there is none, its own is left there.
template <int Dim, class Mesh>
LbcProblem<Dim> problem_on(Mesh& mesh, const Cage<Dim>& cage, Domain<Dim> domain,
                           Eigen::MatrixXd phi, DistanceScheme scheme,
                           const PropertyOptions& properties) {
  auto problem = make_problem(cage, std::move(domain.mesh), std::move(domain.topology),
                              phi.size() > 0 ? DistanceScheme::kConstant : scheme);
  if (phi.size() > 0) problem.phi = WeightFunctions(std::move(phi));
  leave_phi(mesh, problem.phi, properties);
  return problem;
}

//! The record of the state on the mesh.
template <class Mesh>
OpenMesh::MPropHandleT<StateText> record_handle(Mesh& mesh, const PropertyOptions& properties) {
  OpenMesh::MPropHandleT<StateText> handle;
  const std::string name = properties.state_prefix + "state";
  if (!mesh.get_property_handle(handle, name)) mesh.add_property(handle, name);
  return handle;
}

//! Decides whether to go on from the state on the mesh, which stays as it is.
//! \param options  as the caller gave them; gets the penalty with which to go on
template <class Mesh>
MeshSolveReport begin(const std::string& kept_text, const StateRecord& record,
                      const PropertyOptions& properties, SolverOptions& options,
                      PropertyStorage<Mesh>& storage) {
  MeshSolveReport report;
  const auto kept = parse_state_record(kept_text);
  report.restart = properties.restart ? "it was asked for" : why_restart(kept, record);
  if (!report.restart.empty()) return report;
  const auto resolved = resolve(options);
  const bool same_penalty = options.penalty == 0 || options.penalty == kept.requested_penalty ||
                            options.penalty == kept.used_penalty;
  auto reason = find_mismatch(kept, record);
  if (reason.empty() && !same_penalty && !rescales_duals(resolved.method)) {
    reason = "it was made under another penalty, which method " + kept.method + " cannot change";
  }
  if (!reason.empty()) {
    throw InputError("the state '" + properties.state_prefix +
                     "state' on the mesh cannot be gone on from: " + reason +
                     "; ask for a restart");
  }
  if (!storage.is_complete(resolved)) {
    report.restart = "the state is incomplete";
    return report;
  }
  if (options.penalty == 0) options.penalty = kept.requested_penalty;
  storage.resume(kept.penalty, same_penalty ? 1 : kept.used_penalty / options.penalty);
  report.resumed = true;
  return report;
}

}  // namespace internal

//! solve() on a mesh that is known to suit.
template <int Dim, class Mesh>
MeshSolveReport solve_on(Mesh& mesh, const Cage<Dim>& cage, SolverOptions options,
                         const PropertyOptions& properties, const CoarseMesher<Dim>& mesher) {
  validate(options);
  auto domain = make_domain(mesh);
  auto phi = internal::phi_of(mesh, properties.phi, cage.size());
  auto record = describe(cage, domain.mesh, resolve(options), phi);
  const auto handle = internal::record_handle(mesh, properties);
  PropertyStorage<Mesh> storage(mesh, properties.state_prefix, cage.size());
  auto report = internal::begin(mesh.property(handle), record, properties, options, storage);
  record.requested_penalty = options.penalty;

  snap_to_cage(cage, domain.topology, internal::kSinglePrecision, domain.mesh);
  const bool in_place = properties.keep_state || report.resumed;
  Solution solution;
  if (!in_place && properties.phi.empty()) {
    solution = flbc::solve(cage, domain.mesh, domain.topology, options, mesher);
  } else {
    const auto problem = internal::problem_on(mesh, cage, std::move(domain), std::move(phi),
                                              options.phi, properties);
    if (!properties.phi.empty()) record.phi = content_hash(problem.phi.dense()).text();
    // Until it is through, what is on the mesh is no state to go on from.
    mesh.property(handle) = to_json(record);
    storage.rescale_duals(options.precision);
    try {
      solution = flbc::solve(problem, options, mesher, in_place ? &storage : nullptr);
    } catch (...) {
      storage.remove();
      throw;
    }
  }
  static_cast<SolveReport&>(report) = std::move(solution.report);
  set_weights(mesh, solution.weights, properties.weights, properties.persistent);
  set_rest_cage(mesh, cage.points, properties.weights, properties.persistent);
  record.penalty = properties.keep_state ? storage.penalty() : 0;
  record.used_penalty = report.penalty;
  record.finished = true;
  mesh.property(handle) = to_json(record);
  if (!properties.keep_state) storage.remove();
  if (properties.persistent) mesh.mproperty(handle).set_persistent(true);
  if (properties.persistent && properties.keep_state) storage.set_persistent();
  return report;
}

//! Solves on a mesh of the cage's interior: a triangle mesh in the plane or a TetMesh. Properties
//! as in PropertyOptions; the mesh itself does not change. Boundary vertices beside the cage by no
//! more than 1e-6 of its size count as on it. The solver's tables of facets are read once, from the
//! mesh's own edges or faces.
//!
//! Going on from a state under another penalty, the gradient methods rescale the duals; the others
//! refuse. Another method, precision or phi begins anew, as the report says. After an exception
//! from the iteration there is no state any more.
//! \param mesher  makes coarser meshes to start from where that pays (flbc/coarse_to_fine.h); {} for
//! none. By default that of the component which the program links besides flbc::openmesh,
//! flbc::cgal in the plane and flbc::tetgen in space, if it does (SolverOptions::coarse_to_fine
//! switches it off)
//! \throws InputError naming the element if mesh and cage do not belong together, if the mesh has
//! deleted elements, or if there is a state that belongs to another cage, mesh or penalty;
//! OptionError, SolverError
template <class Mesh, int Dim>
MeshSolveReport solve(
    Mesh& mesh, const Cage<Dim>& cage, const SolverOptions& options = {},
    const PropertyOptions& properties = {},
    const MesherArgument<Dim>& mesher = internal::coarse_mesher(internal::linked_mesher<Dim>())) {
  if constexpr (std::is_same_v<Mesh, TetMesh>) {
    static_assert(Dim == 3, "tetrahedra do not fill a cage in the plane");
    return solve_on<Dim>(mesh, cage, options, properties, mesher);
  } else {
    constexpr bool kIsSurface = Dim == 3;
    static_assert(!kIsSurface,
                  "this is a surface; use bind: a solve needs a mesh of the cage's interior");
    static_assert(kIsSurface || Mesh::IsTriMesh,
                  "a domain in the plane has triangles: use a TriMesh");
    if constexpr (!kIsSurface && Mesh::IsTriMesh) {
      return solve_on<Dim>(mesh, cage, options, properties, mesher);
    }
  }
}

}  // namespace flbc::openmesh
