// Viewing cells of a lattice, looked out of when somebody first stands in them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <tbb/task_arena.h>

#include "gridcull/core/bounds.h"
#include "gridcull/methods/extended_visibility.h"

namespace gridcull::extended {

/// A lattice cell, or its part below the scene's floor, and an occluder that does not count for it (no_id: all count).
struct CellKey {
  std::array<std::int64_t, 3> at{};
  bool below = false;
  ObjectId without = no_id;
  auto operator<=>(const CellKey&) const = default;
};

class CellCache {
 public:
  /// Throws Error(limit) where not even the maps of three cells fit into `max_bytes`: one kept, and for one view its
  /// cell and that cell without an occluder.
  CellCache(const Bounds& bounds, double edge, const CellSettings& settings, std::uint64_t max_bytes, int threads);

  /// How many views' cells may be asked for between two trim()s.
  std::size_t views_at_once() const { return views_at_once_; }

  /// Forgets all cells; from now on `scene` is looked at, which outlives its use.
  void reset(const StaticScene& scene);

  /// The lattice cell that holds a point; nothing where the lattice is too fine for the doubles there.
  std::optional<CellKey> key_of(const Vec3& point) const;
  /// Makes sure that all these cells are there. The same bits at any number of threads.
  void need(std::vector<CellKey>& keys);
  /// A cell that need() was asked for since the last trim().
  const CellView& at(const CellKey& key) const { return *cells_.at(key).view; }
  /// Forgets the cells that nobody needed for longest until the others fit into a quarter of the memory.
  void trim();

 private:
  ViewCell cell_of(const CellKey& key) const;

  struct Entry {
    std::unique_ptr<CellView> view{};
    std::uint64_t used = 0;  ///< the need() that asked last
  };
  Vec3 origin_{0.0};
  double floor_ = 0.0;
  double edge_;
  CellSettings settings_;
  std::uint64_t kept_bytes_;
  std::size_t views_at_once_ = 1;
  tbb::task_arena arena_;
  std::vector<std::unique_ptr<CellLooker>> lookers_{};
  std::map<CellKey, Entry> cells_{};
  std::vector<std::pair<const CellKey*, CellView*>> missing_{};
  std::uint64_t needs_ = 0;
};

}  // namespace gridcull::extended
