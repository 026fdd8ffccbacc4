// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What a mesh remembers of a solve: enough to know whether its properties still belong to it.
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
  std::string phi;
  Index control_points = 0;
  double penalty = 0;  //!< of the state that was kept; 0 if there is none to resume from
  std::string cage;    //!< hash of control points and facets
  std::string points;  //!< hash of the mesh's points
  std::string cells;   //!< hash of the mesh's connectivity
};

//! Describes a solve that is about to begin. \param options  resolved
template <int Dim>
StateRecord describe(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                     const SolverOptions& options);

//! One line.
std::string to_json(const StateRecord& record);

//! \return a record with penalty 0 where the text makes no sense: then nothing can be resumed
StateRecord parse_state_record(const std::string& json);

//! Whether the iteration itself is the same, so that its state can be gone on from.
bool same_method(const StateRecord& a, const StateRecord& b);

//! Why a state does not belong to cage and mesh any more, for messages; empty if it does.
std::string find_mismatch(const StateRecord& kept, const StateRecord& now);

}  // namespace flbc::openmesh
