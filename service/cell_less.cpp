#include "gridcull/service/cell_less.h"

#include <algorithm>
#include <map>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "gridcull/grid/cover.h"
#include "gridcull/service/interrupt.h"

namespace gridcull {
namespace {

struct Workspace {
  CoverScratch scratch{};
  Cover cover{};
};

bool holds_cell(const PreparedShape& shape, const Pose& pose, const Lattice& lattice, Workspace& work) {
  shape.cover(lattice, pose, work.scratch, work.cover);
  return std::any_of(work.cover.bricks.begin(), work.cover.bricks.end(),
                     [](const BrickCover& brick) { return brick.opaque != 0; });
}

std::vector<const Object*> solid_occluders(std::span<const Object> objects, CellLess& out) {
  std::vector<const Object*> solid;
  for (const Object& object : objects) {
    if (!object.occluder) continue;
    if (is_thin(object.shape)) {
      out.thin.push_back(object.id);
    } else {
      solid.push_back(&object);
    }
  }
  std::sort(out.thin.begin(), out.thin.end());
  out.occluders = solid.size();
  return solid;
}

}  // namespace

CellLess find_cell_less(std::span<const Lattice> lattices, std::span<const Object> objects) {
  CellLess out;
  const std::vector<const Object*> solid = solid_occluders(objects, out);
  const std::size_t count = lattices.size();
  std::vector<char> holds(solid.size() * count);  // chars: each is written by one thread, beside others
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, solid.size()), [&](const auto& range) {
    Workspace work;
    for (std::size_t i = range.begin(); i < range.end() && !interrupted(); ++i) {
      const PreparedShape shape(solid[i]->shape);
      for (std::size_t k = 0; k < count; ++k) {
        holds[i * count + k] = holds_cell(shape, solid[i]->pose, lattices[k], work) ? 1 : 0;
      }
    }
  });
  stop_if_interrupted();
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<ObjectId>& ids = out.without.emplace_back();
    for (std::size_t i = 0; i < solid.size(); ++i) {
      if (holds[i * count + k] == 0) ids.push_back(solid[i]->id);
    }
    std::sort(ids.begin(), ids.end());
  }
  return out;
}

std::string ids_text(std::span<const ObjectId> ids, const Scene& scene, std::size_t most) {
  std::map<ObjectId, std::string> names;
  for (const ObjectId id : ids.first(std::min(most, ids.size()))) names.emplace(id, "");
  for (const SceneObject& object : scene.objects) {
    if (const auto listed = names.find(object.object.id); listed != names.end()) listed->second = object.name;
  }
  std::string text;
  for (const auto& [id, name] : names) {
    text += (text.empty() ? "" : ", ") + std::to_string(id) + (name.empty() ? "" : " (" + name + ")");
  }
  return text + (ids.size() > most ? ", ..." : "");
}

}  // namespace gridcull
