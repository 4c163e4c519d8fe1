#pragma once

#include "sim/kernel_level.h"

/// The table of a level: name_v2, name_v3 or name_v4. A sanitised build has the kernels of the least level
/// alone (see cmake/LatherKernels.cmake), and machine_has() no other.
#ifdef LATHER_LEAST_KERNEL_LEVEL_ALONE
#define LATHER_AT_LEVEL(level, name) (static_cast<void>(level), name##_v2)
#else
#define LATHER_AT_LEVEL(level, name) lather::at_level(level, name##_v2, name##_v3, name##_v4)
#endif
