// Generated scenes draw from core's random numbers.
#pragma once

#include "gridcull/core/random.h"
