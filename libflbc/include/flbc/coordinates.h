// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Operations on coordinates of a mesh: measure them, and evaluate them anywhere inside.
#pragma once

#include "flbc/cell_locator.h"
#include "flbc/interpolate.h"
#include "flbc/quality.h"
