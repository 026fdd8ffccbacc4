// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What can be done with coordinates on a mesh: measure them and evaluate them anywhere inside.
#pragma once

#include "flbc/cell_locator.h"
#include "flbc/interpolate.h"
#include "flbc/quality.h"
