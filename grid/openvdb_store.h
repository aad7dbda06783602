// The static store in OpenVDB's trees (Museth 2013): one leaf of a tree for 8 x 8 x 8 bricks that hold anything.
// Only openvdb_*.cpp see OpenVDB's headers; openvdb_missing.cpp takes their place where it is not there.
#pragma once

#include <memory>

#include "gridcull/grid/static_store.h"

namespace gridcull {

/// Whether this gridcull was built with OpenVDB.
bool has_openvdb();

/// Throws Error(limit) for a lattice of more cells along an axis than OpenVDB's coordinates count: 2^31.
void check_openvdb_lattice(const Lattice& lattice);

/// Throws as check_openvdb_lattice() does, and Error(usage) without OpenVDB.
std::unique_ptr<StaticStore> make_openvdb_store(const Lattice& lattice);

}  // namespace gridcull
