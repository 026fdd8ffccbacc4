// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The headers of a typical program. Example: the coordinates of a square:
//!
//!     #include <flbc/flbc.h>
//!
//!     flbc::Cage<2> cage;
//!     cage.points.resize(2, 4);
//!     cage.points << 0, 1, 1, 0,
//!                    0, 0, 1, 1;
//!     cage.facets.resize(2, 4);
//!     cage.facets << 0, 1, 2, 3,
//!                    1, 2, 3, 0;
//!
//!     flbc::DomainMesh<2> mesh = flbc::triangulate(cage, {500});  // component cgal
//!     flbc::Solution solution = flbc::solve(cage, mesh);          // weights and a report
//!     Eigen::MatrixXd moved = flbc::deform(solution.weights, cage.points);  // move cage.points
//!
//! Further headers:
//! - other coordinates: harmonic.h, pointwise.h, green.h; by their names: coordinates.h
//! - fewer influences: sparsify.h
//! - checks: check.h, cage_facts.h
//! - the discretized problem: lbc_problem.h
//! - the optional component `caging`: cage_from_model.h, repair_cage.h
//! - files, by the library flbc::io: a cage is
//!   std::get<flbc::Cage<3>>(flbc::io::to_cage(flbc::io::read_polygons(path), path))
//!   (io/model_file.h, io/cage_io.h); io/mesh_io.h, io/weights_io.h
#pragma once

#include "flbc/cage.h"         // Cage, validate()
#include "flbc/deform.h"       // deform()
#include "flbc/domain_mesh.h"  // DomainMesh
#include "flbc/errors.h"       // InputError, OptionError, SolverError
#include "flbc/meshing.h"      // triangulate(), tetrahedralize()
#include "flbc/placement.h"    // place_points(), weights_at()
#include "flbc/solver.h"       // solve(), SolverOptions, Solution
#include "flbc/version.h"      // FLBC_VERSION
