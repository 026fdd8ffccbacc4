// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! From a cage to the mesh of its interior. The functions live in optional components, because the
//! libraries behind them have copyleft licences.
#pragma once

#include "flbc/meshing_options.h"
#include "flbc/self_intersections.h"
#include "flbc/tetrahedralize.h"
#include "flbc/triangulate.h"
