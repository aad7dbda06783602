#if defined(__x86_64__)
#include "gridcull/grid/mask_lanes_avx2.h"
#define GRIDCULL_MASK_SET avx2
#include "gridcull/grid/mask_kernels_body.h"
#endif
