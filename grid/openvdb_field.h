// Fields of floats from .vdb files, level sets and fog volumes of any program. No type of OpenVDB's is seen here.
#pragma once

#include <cstdint>
#include <string>

#include "gridcull/core/scalar_field.h"

namespace gridcull {

/// What a field may take at most unless told otherwise, bytes.
constexpr std::uint64_t default_field_memory = std::uint64_t{4} << 30;

/// A float grid of a .vdb file: the one of that name, or with an empty name the first one. Throws Error(io) when the
/// file cannot be read, Error(bad_scene) for one that is no .vdb, was cut short or is of a version unknown to OpenVDB,
/// that has no such grid, where it is of another type, its voxels are not cubes or its values not finite; Error(usage)
/// where gridcull was built without OpenVDB; Error(limit) when it would take more than `max_memory`.
ScalarField read_scalar_field(const std::string& path, const std::string& grid_name = {},
                              std::uint64_t max_memory = default_field_memory);

}  // namespace gridcull
