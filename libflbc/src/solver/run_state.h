// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The state of a whole run as bytes (Progress::write_state), put together by those who have a part
//! of it: solve() itself, the coarser meshes, the method.
#pragma once

#include <functional>
#include <vector>

#include "flbc/byte_archive.h"
#include "flbc/cage.h"
#include "flbc/distance_weights.h"
#include "flbc/domain_mesh.h"
#include "flbc/options.h"
#include "flbc/report.h"

namespace flbc {

//! State of a run besides that of the iteration.
struct RunRecord {
  DistanceMatrix distances{};  //!< behind phi, n x V; empty for kConstant
  DistanceReport source{};
  double setup_seconds = 0;
  double solve_seconds = 0;           //!< until the state was written
  std::vector<LevelReport> levels{};  //!< coarser meshes that it started from
};

//! Options by which a method's part of the state is offered to whoever is told of the progress.
SolverOptions offering(SolverOptions options, std::function<void(ByteWriter&)> write);

//! Options by which nothing is offered.
SolverOptions offering_nothing(SolverOptions options);

//! Options by which reports of coarser meshes go in front of a state that is offered.
SolverOptions offering_levels(SolverOptions options, std::vector<LevelReport> levels);

//! Options by which the record of solve() goes in front of that.
//! \param distances  outlive the run; the seconds go on from now
template <int Dim>
SolverOptions offering_record(SolverOptions options, const Cage<Dim>& cage,
                              const DomainMesh<Dim>& mesh, const DistanceMatrix& distances,
                              const DistanceReport& source, double setup_seconds,
                              double solve_seconds);

//! Takes both off the front of options.resume_from, which the method's part remains of.
//! \throws InputError if the state is of another problem, other options or another version
template <int Dim>
RunRecord take_record(SolverOptions& options, const Cage<Dim>& cage, const DomainMesh<Dim>& mesh);

//! \throws InputError unless what was read can be part of a state
void require_undamaged(bool can_be);

//! To be called when a method has read its part. \param report  as the state has it
//! \throws InputError if something is left, or if the number of iterations is none of such a run
void require_whole_state(const ByteReader& read, const SolveReport& report,
                         const SolverOptions& options);

//! \throws OptionError if options.resume_from is not empty
void refuse_state(const SolverOptions& options);

}  // namespace flbc
