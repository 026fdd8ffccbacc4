// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What most tests include; precompiled.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "flbc/bounding_box.h"
#include "support/code_cages.h"
#include "support/dense_algebra.h"
#include "support/dimensions.h"
#include "support/errors.h"
#include "support/judge.h"
#include "support/sample_meshes.h"
#include "support/simplex.h"
#include "support/threads.h"
