// Shapes as JSON (FORMATS, "Scene").
#pragma once

#include <string>

#include "gridcull/core/shape.h"
#include "gridcull/sim/json_tree.h"

namespace gridcull {

/// A valid shape of this dimension.
Shape read_shape(const JsonRef& json, int dimension);
void append_shape(std::string& out, const Shape& shape);

}  // namespace gridcull
