// `gridcull bake static`: the cells of a scene's static objects, into a volume file.
#pragma once

#include <string>

#include "gridcull/service/world_options.h"

namespace gridcull {

/// `options.scene` may also be a model (OBJ, PLY, STL, glTF, 3DS), taken as `gridcull import mesh` takes it. Prints a
/// table. Throws Stopped on Ctrl-C; the file appears whole or not at all.
int bake_static(const WorldOptions& options, const std::string& out);

}  // namespace gridcull
