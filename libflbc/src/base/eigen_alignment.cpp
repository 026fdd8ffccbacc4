// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/types.h"

#ifdef __GNUC__
namespace flbc::abi {

template <int max_align_bytes, bool malloc_already_aligned>
const char EigenAlignment<max_align_bytes, malloc_already_aligned>::is_not_that_of_libflbc = 0;

template struct EigenAlignment<EIGEN_MAX_ALIGN_BYTES, EIGEN_MALLOC_ALREADY_ALIGNED != 0>;

}  // namespace flbc::abi
#endif
