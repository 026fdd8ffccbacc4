// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Certificates as files, which others can check (scripts/check_certificate.py).
#pragma once

#include <string>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"
#include "flbc/solver.h"

namespace flbc::app {

//! Writes an archive of NumPy arrays (.npz): cage, mesh, weights, and proof. Arrays have a row per
//! control point, vertex, or cell, as in Python.
//! \param solution  with the proof of a certificate \throws IoError
template <int Dim>
void write_certificate(const std::string& path, const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                       const Solution& solution);

}  // namespace flbc::app
