// What stands for OpenVDB where it was not found or not wanted.
#include "gridcull/core/error.h"
#include "gridcull/grid/openvdb_field.h"
#include "gridcull/grid/openvdb_store.h"
#include "gridcull/grid/static_volume.h"

namespace gridcull {
namespace {

[[noreturn]] void refuse() {
  throw Error(ErrorCode::usage, "OpenVDB: this gridcull was built without it (Debian: libopenvdb-dev)");
}

}  // namespace

bool has_openvdb() { return false; }

void check_openvdb_lattice(const Lattice&) { refuse(); }

std::unique_ptr<StaticStore> make_openvdb_store(const Lattice&) { refuse(); }

void write_static_volume(const std::string&, const StaticCells&, std::uint64_t, int) { refuse(); }

StaticCells read_static_volume_head(const std::string&) { refuse(); }

StaticCells read_static_volume(const std::string&, std::uint64_t) { refuse(); }

std::unique_ptr<TiledCells> open_static_volume_tiles(const std::string&) { refuse(); }

ScalarField read_scalar_field(const std::string&, const std::string&, std::uint64_t) { refuse(); }

}  // namespace gridcull
