// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The memory of an iteration, for callers who want to hold it themselves: as properties of a mesh,
//! or to resume.
#pragma once

#include <cstddef>

#include "flbc/options.h"

namespace flbc {

//! The arrays that an iteration keeps between two steps.
enum class StateArray {
  kIterate,               //!< w, on vertices (kLbc2014); 2 w - W, scaled (kValue)
  kRelaxedIterate,        //!< W, on vertices, scaled (kValue)
  kNonNegativityDual,     //!< q = u + dual of u = w, u >= 0, on vertices (kLbc2014); q - W, scaled
                          //!< (kValue)
  kSplittingState,        //!< y = z + dual of z = grad w, on cells (kLbc2014); grad W - y, scaled
                          //!< (kValue)
  kGradient,              //!< g, on cells (kGradient, kPaper)
  kExtrapolatedGradient,  //!< 2 g - g before, on cells (the same)
  kTvDual,                //!< dual of Z = G, on cells (the same)
  kIntegrabilityDual,     //!< duals of X = G S_X and Y = G S_Y, on facets (the same)
  kPeriodDual             //!< duals of the period constraints, one element for the mesh (the same)
};

//! Shape of one array: element-major, then `components` rows of `stride` numbers, of which the
//! first n, one per control point, count and the others stay zero.
struct StateShape {
  StateArray array;        //!< which one
  std::size_t elements;    //!< number of vertices, cells or facets, 1 for the mesh
  std::size_t components;  //!< rows per element
  std::size_t stride;      //!< numbers per row, >= n
  Precision precision;     //!< kHalf (two bytes), kSingle (float) or kDouble
};

//! Provides the memory. The iteration works on it in place, so it must not move during a solve.
class StateStorage {
 public:
  virtual ~StateStorage() = default;

  //! Provides one array.
  //! \param shape  which one, and how many numbers it has
  //! \return memory aligned to 64 bytes; what an earlier run left there if penalty() > 0, else
  //! anything
  virtual void* allocate(const StateShape& shape) = 0;

  //! Whether there is room for half precision, which the iteration does without otherwise.
  virtual bool holds_half() const { return false; }

  //! The penalty passed to keep_penalty() by the run whose state is there, from which to go on; 0 =
  //! start afresh.
  virtual double penalty() const = 0;

  //! Called at the end of a run.
  //! \param penalty  used last, on the published scale (published_penalty.h), > 0
  virtual void keep_penalty(double penalty) = 0;
};

}  // namespace flbc
