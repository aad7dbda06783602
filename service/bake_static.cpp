#include "gridcull/service/bake_static.h"

#include <chrono>
#include <cstdio>
#include <filesystem>

#include "gridcull/core/error.h"
#include "gridcull/grid/openvdb_field.h"
#include "gridcull/grid/openvdb_store.h"
#include "gridcull/grid/static_cells.h"
#include "gridcull/grid/static_volume.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/static_world.h"
#include "gridcull/service/table.h"
#include "gridcull/service/text.h"
#include "gridcull/sim/import_mesh.h"

namespace gridcull {
namespace {

PreparedWorld prepare(const WorldOptions& options) {
  Scene scene;
  if (is_mesh_file(options.scene)) {
    MeshImportOptions mesh;
    mesh.file = options.scene;
    mesh.max_memory = options.max_memory;
    scene = import_mesh(mesh).scene;
  } else {
    scene = read_scene(options.scene, options.max_memory, read_scalar_field);
  }
  scene.static_volume.clear();  // the file that is to be made
  return prepare_scene(options, std::move(scene), !options.frames.empty());
}

StaticCells discretise(const PreparedWorld& world, std::uint64_t max_memory) {
  constexpr std::uint64_t whole = 1000;
  Progress bar("thousandths", whole);
  auto cells = discretise_static(world.lattice, objects_of(world.scene), max_memory, [&](double share) {
    bar.update(static_cast<std::uint64_t>(share * whole));
    return !interrupted();
  });
  if (!cells) throw Stopped{"nothing was written"};
  return std::move(*cells);
}

}  // namespace

int bake_static(const WorldOptions& options, const std::string& out) {
  if (!has_openvdb()) throw Error(ErrorCode::usage, "bake static: this gridcull was built without OpenVDB");
  WorldOptions chosen = options;
  chosen.store = name_of(StoreKind::openvdb);  // as big as the world's surface
  const PreparedWorld world = prepare(chosen);
  const auto start = std::chrono::steady_clock::now();
  const StaticCells cells = discretise(world, options.max_memory);
  if (cells.members.empty()) throw Error(ErrorCode::bad_scene, options.scene + ": expected static objects, found none");
  write_static_volume(out, cells, options.max_memory);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::uint64_t opaque = 0, touched = 0;
  for (const BrickCover& brick : cells.bricks) {
    opaque += static_cast<std::uint64_t>(std::popcount(brick.opaque));
    touched += static_cast<std::uint64_t>(std::popcount(brick.touched));
  }
  const std::string text = row("scene", options.scene + ", " + counted(cells.members.size(), "static object")) +
                           row("grid", lattice_text(world.lattice)) +
                           row("cells", std::to_string(touched) + " touched, " + std::to_string(opaque) +
                                            " of them wholly inside, by object") +
                           row("file", out + ", " + bytes_text(static_cast<double>(std::filesystem::file_size(out)))) +
                           row("time", number_text(seconds, 3) + " s");
  std::fputs(text.c_str(), stdout);
  return 0;
}

}  // namespace gridcull
