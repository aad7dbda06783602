#include "gridcull/grid/static_cells.h"

#include <algorithm>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/core/object_hash.h"
#include "gridcull/grid/cover.h"

namespace gridcull {

bool StaticCells::fit(const Lattice& lattice) const {
  return lattice.dimension() == dimension && lattice.cell() == cell && lattice.cells() == cells &&
         lattice.origin().x == origin.x && lattice.origin().y == origin.y && lattice.origin().z == origin.z;
}

const StaticCells::Member* StaticCells::find_id(ObjectId id) const {
  const auto at = std::lower_bound(members.begin(), members.end(), id,
                                   [](const Member& member, ObjectId wanted) { return member.id < wanted; });
  return at == members.end() || at->id != id ? nullptr : &*at;
}

const StaticCells::Member* StaticCells::find(const Object& object) const {
  const Member* member = find_id(object.id);
  return member != nullptr && member->hash == object_hash(object) ? member : nullptr;
}

Bounds bounds_of(const StaticCells& cells) {
  const bool solid = cells.dimension == 3;
  // Half a cell less: rounding up again gives the number of cells.
  const Vec3 along(static_cast<double>(cells.cells.x) - 0.5, static_cast<double>(cells.cells.y) - 0.5,
                   solid ? static_cast<double>(cells.cells.z) - 0.5 : 0.0);
  return {cells.origin, cells.origin + cells.cell * along};
}

Lattice lattice_of(const StaticCells& cells, std::uint64_t max_memory, Room room) {
  return {cells.dimension, bounds_of(cells), cells.cell, max_memory, room};
}

void check_brick_memory(std::uint64_t bricks, std::uint64_t max_memory) {
  if (bricks * sizeof(BrickCover) > max_memory) refuse_memory(max_memory);
}

void refuse_memory(std::uint64_t max_memory) {
  throw Error(ErrorCode::limit, "the cells of static objects need more than the " + std::to_string(max_memory) +
                                    " bytes allowed (--max-memory); larger cells need fewer");
}

std::optional<StaticCells> discretise_static(const Lattice& lattice, std::span<const Object> objects,
                                             std::uint64_t max_memory, const std::function<bool(double)>& progress) {
  std::vector<const Object*> statics;
  for (const Object& object : objects) {
    if (object.is_static) statics.push_back(&object);
  }
  std::sort(statics.begin(), statics.end(), [](const Object* a, const Object* b) { return a->id < b->id; });
  StaticCells out;
  out.dimension = lattice.dimension();
  out.origin = lattice.origin();
  out.cell = lattice.cell();
  out.cells = lattice.cells();
  out.world = static_world_hash(objects);
  CoverScratch scratch;
  Cover cover;
  for (const Object* object : statics) {
    PreparedShape(object->shape).cover(lattice, object->pose, scratch, cover);
    check_brick_memory(out.bricks.size() + cover.bricks.size(), max_memory);
    out.members.push_back({object->id, object_hash(*object), out.bricks.size(), cover.bricks.size(), cover.outside});
    for (BrickCover brick : cover.bricks) {
      if (!object->occluder) brick.opaque = 0;
      out.bricks.push_back(brick);
    }
    if (!progress(static_cast<double>(out.members.size()) / static_cast<double>(statics.size()))) return std::nullopt;
  }
  return out;
}

}  // namespace gridcull
