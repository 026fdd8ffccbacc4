// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/types.h"

#ifdef __GNUC__
namespace flbc::abi {

template <>
const char EigenAlignment<EIGEN_MAX_ALIGN_BYTES,
                          EIGEN_MALLOC_ALREADY_ALIGNED != 0>::is_not_that_of_libflbc = 0;

}  // namespace flbc::abi
#endif
