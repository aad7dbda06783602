#include "gridcull/grid/mask_lanes_scalar.h"
#define GRIDCULL_MASK_SET scalar
#include "gridcull/grid/mask_kernels_body.h"
