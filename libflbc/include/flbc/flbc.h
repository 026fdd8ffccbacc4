// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! All of libflbc's core.
#pragma once

#include "flbc/boundary_values.h"
#include "flbc/cage.h"
#include "flbc/cell_field.h"
#include "flbc/certificate.h"
#include "flbc/check.h"
#include "flbc/coarse_to_fine.h"
#include "flbc/coordinates.h"
#include "flbc/deform.h"
#include "flbc/distance_weights.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "flbc/lbc_problem.h"
#include "flbc/mean_value.h"
#include "flbc/meshing.h"
#include "flbc/non_negative.h"
#include "flbc/options.h"
#include "flbc/recovery.h"
#include "flbc/report.h"
#include "flbc/solver.h"
#include "flbc/solver_state.h"
#include "flbc/sparsify.h"
#include "flbc/types.h"
#include "flbc/version.h"
