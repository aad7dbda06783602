#if defined(__x86_64__)
#include "gridcull/grid/mask_lanes_avx512.h"
#define GRIDCULL_MASK_SET avx512
#include "gridcull/grid/mask_kernels_body.h"
#endif
