// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The steps of finding out what is wrong with a cage and with weights.
#pragma once

#include "report/check_report.h"

namespace flbc::app {

//! The beginning of a report: the cage's defects, or facts about a cage without any.
//! \param file  of the cage
template <int Dim>
CheckReport<Dim> check_cage(const Cage<Dim>& cage, const std::string& file);

//! Adds what is to be said about the weights of a mesh's vertices.
//! \throws InputError if the sizes do not belong together, or the mesh is none of the cage
template <int Dim>
void check_weights_of(CheckReport<Dim>& report, const DomainMesh<Dim>& domain,
                      const WeightMatrix& weights);

//! The same for points anywhere, which tells less.
template <int Dim>
void check_weights_of(CheckReport<Dim>& report, const PointList<Dim>& points,
                      const WeightMatrix& weights);

}  // namespace flbc::app
