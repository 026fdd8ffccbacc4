// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The record of a solve on a mesh, by which to know whether its properties still belong to it.
#pragma once

#include <string>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/options.h"

namespace flbc::openmesh {

//! Kept as a mesh property in JSON, "flbc:state".
struct StateRecord {
  std::string method;
  std::string precision;
  std::string phi;  //!< its scheme, or a hash if the mesh has it as a property
  Index control_points = 0;
  double penalty = 0;            //!< of the state that was kept; 0 if there is none to resume from
  double requested_penalty = 0;  //!< in the options; 0 = chosen by the method
  double used_penalty = 0;       //!< used last, in the same unit
  bool finished = false;         //!< whether the run that left it came to its end
  std::string cage;              //!< hash of control points and facets
  std::string points;            //!< hash of the mesh's points
  std::string cells;             //!< hash of the mesh's connectivity
};

//! Describes a solve that is about to begin.
//! \param options  resolved, but for the penalty as they were given
//! \param phi  n x F where the mesh has it as a property, else empty
template <int Dim>
StateRecord describe(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                     const SolverOptions& options, const Eigen::MatrixXd& phi);

//! One line.
std::string to_json(const StateRecord& record);

//! \return a record with penalty 0 where the text makes no sense: then nothing can be resumed
StateRecord parse_state_record(const std::string& json);

//! Why a state is no start for this solve, for reports; empty if it is one.
std::string why_restart(const StateRecord& kept, const StateRecord& now);

//! Whether a method's duals can go on under another penalty.
bool rescales_duals(Method method);

//! Why a state does not belong to cage and mesh any more, for messages; empty if it does.
std::string find_mismatch(const StateRecord& kept, const StateRecord& now);

namespace internal {

//! \throws InputError unless these are finite numbers >= 0, a row per control point
void require_phi(const Eigen::MatrixXd& phi, Index control_points, const std::string& name);

}  // namespace internal

}  // namespace flbc::openmesh
