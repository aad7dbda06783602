// Few large boxes within a volume, greedily: cubes from a table of the largest ones (dynamic programming: a cube's edge
// is one more than the least of its seven neighbours'), grown along the axes in the order that gains most, each next
// one by what it adds. On a lattice that is thinned where it has many points; the boxes found are then grown point by
// point.
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "gridcull/core/volume_parts.h"

namespace gridcull {
namespace {

/// Cells of the thinned lattice at most.
constexpr double most_cells = 1 << 21;
constexpr std::size_t most_boxes = 256;

/// Cells first .. last of an axis-aligned block of them, inclusive.
using CellBox = LatticeBox;

std::int64_t volume_of(const CellBox& box) {
  const LatticePoint n = box.last - box.first + LatticePoint(1);
  return std::int64_t{n.x} * n.y * n.z;
}

/// The volume cut into equal cubes of lattice cells.
class Thinned {
 public:
  explicit Thinned(const InsidePoints& points) : points_(points), all_(points.bounds()) {
    const auto count = [&] {
      double cells = 1.0;
      for (int k = 0; k < 3; ++k) cells *= static_cast<double>(size_[k] = (all_.last[k] - all_.first[k]) / step_);
      return cells;
    };
    while (count() > most_cells) ++step_;
  }

  const LatticePoint& size() const { return size_; }
  LatticeBox points_of(const CellBox& box) const {
    return {all_.first + step_ * box.first, all_.first + step_ * (box.last + LatticePoint(1))};
  }
  bool is_solid(const LatticePoint& cell) const { return points_.all(points_of({cell, cell})); }

  /// The box's points and what more along each axis is inside, up to a step.
  LatticeBox grown(const CellBox& box) const {
    LatticeBox out = points_of(box);
    for (int k = 0; k < 3; ++k) {
      for (const int way : {-1, 1}) {
        for (int i = 1; i < step_; ++i) {
          LatticeBox slab = out;
          slab.first[k] = slab.last[k] = (way < 0 ? out.first : out.last)[k] + way;
          if (!points_.all(slab)) break;
          (way < 0 ? out.first : out.last)[k] += way;
        }
      }
    }
    return out;
  }

 private:
  const InsidePoints& points_;
  LatticeBox all_;
  int step_ = 1;
  LatticePoint size_{0};
};

/// Numbers of a cell and their sums over boxes.
class Sums {
 public:
  explicit Sums(const LatticePoint& size)
      : size_(size + LatticePoint(1)),
        table_(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
               static_cast<std::size_t>(size_.z)) {}

  /// `number(cell)` for every cell.
  template <class F>
  void fill(F&& number) {
    LatticePoint c;
    for (c.x = 0; c.x + 1 < size_.x; ++c.x) {
      for (c.y = 0; c.y + 1 < size_.y; ++c.y) {
        std::int32_t line = 0;
        for (c.z = 0; c.z + 1 < size_.z; ++c.z) {
          line += number(c);
          const LatticePoint p = c + LatticePoint(1);
          table_[at(p)] = line + table_[at({p.x - 1, p.y, p.z})] + table_[at({p.x, p.y - 1, p.z})] -
                          table_[at({p.x - 1, p.y - 1, p.z})];
        }
      }
    }
  }
  std::int64_t over(const CellBox& box) const {
    const LatticePoint a = box.first, b = box.last + LatticePoint(1);
    const auto s = [&](int x, int y, int z) { return std::int64_t{table_[at({x, y, z})]}; };
    return s(b.x, b.y, b.z) - s(a.x, b.y, b.z) - s(b.x, a.y, b.z) - s(b.x, b.y, a.z) + s(a.x, a.y, b.z) +
           s(a.x, b.y, a.z) + s(b.x, a.y, a.z) - s(a.x, a.y, a.z);
  }

 private:
  std::size_t at(const LatticePoint& p) const {
    return (static_cast<std::size_t>(p.x) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(p.y)) *
               static_cast<std::size_t>(size_.z) +
           static_cast<std::size_t>(p.z);
  }

  LatticePoint size_;
  std::vector<std::int32_t> table_;
};

class BoxFinder {
 public:
  explicit BoxFinder(const Thinned& cells)
      : size_(cells.size()),
        solid_(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
               static_cast<std::size_t>(size_.z)),
        open_(solid_.size()),
        cube_(solid_.size()),
        solid_sums_(size_),
        open_sums_(size_) {
    for_cells([&](const LatticePoint& c, std::size_t i) {
      solid_[i] = open_[i] = cells.is_solid(c) ? 1 : 0;
      cube_[i] = solid_[i] != 0 ? largest_cube(c) : 0;
    });
    solid_sums_.fill([&](const LatticePoint& c) { return solid_[at(c)]; });
  }

  std::int64_t solid_count() const {
    return solid_.empty() ? 0 : solid_sums_.over({LatticePoint(0), size_ - LatticePoint(1)});
  }

  struct Found {
    CellBox box;
    std::int64_t gain;  ///< cells of no box before
  };
  /// The next box; its cells are taken.
  std::optional<Found> next() {
    open_sums_.fill([&](const LatticePoint& c) { return open_[at(c)]; });
    Found best{{}, 0};
    for_cells([&](const LatticePoint& c, std::size_t i) {
      if (open_[i] == 0) return;
      const CellBox cube{c - LatticePoint(cube_[i] - 1), c};
      if (const std::int64_t gain = open_sums_.over(cube); gain > best.gain) best = {cube, gain};
    });
    if (best.gain == 0) return std::nullopt;
    best = grown(best.box);
    for_cells_of(best.box, [&](const LatticePoint& c) { open_[at(c)] = 0; });
    return best;
  }

 private:
  std::size_t at(const LatticePoint& p) const {
    return (static_cast<std::size_t>(p.x) * static_cast<std::size_t>(size_.y) + static_cast<std::size_t>(p.y)) *
               static_cast<std::size_t>(size_.z) +
           static_cast<std::size_t>(p.z);
  }
  template <class F>
  static void for_cells_of(const CellBox& box, F&& f) {
    LatticePoint c;
    for (c.x = box.first.x; c.x <= box.last.x; ++c.x) {
      for (c.y = box.first.y; c.y <= box.last.y; ++c.y) {
        for (c.z = box.first.z; c.z <= box.last.z; ++c.z) f(c);
      }
    }
  }
  template <class F>
  void for_cells(F&& f) const {
    std::size_t i = 0;
    for_cells_of({LatticePoint(0), size_ - LatticePoint(1)}, [&](const LatticePoint& c) { f(c, i++); });
  }

  /// With its last cell here.
  std::uint16_t largest_cube(const LatticePoint& c) const {
    if (c.x == 0 || c.y == 0 || c.z == 0) return 1;
    std::uint16_t least = cube_[at(c - LatticePoint(1))];
    for (int i = 1; i < 7; ++i) least = std::min(least, cube_[at(c - LatticePoint(i & 1, i >> 1 & 1, i >> 2 & 1))]);
    return static_cast<std::uint16_t>(least + 1);
  }

  bool is_solid(const CellBox& box) const { return solid_sums_.over(box) == volume_of(box); }

  void grow(CellBox& box, int axis) const {
    for (CellBox slab = box; slab.last[axis] + 1 < size_[axis]; ++box.last[axis]) {
      slab.first[axis] = slab.last[axis] = box.last[axis] + 1;
      if (!is_solid(slab)) break;
    }
    for (CellBox slab = box; box.first[axis] > 0; --box.first[axis]) {
      slab.first[axis] = slab.last[axis] = box.first[axis] - 1;
      if (!is_solid(slab)) break;
    }
  }
  Found grown(const CellBox& cube) const {
    constexpr std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    Found best{cube, 0};
    for (const auto& order : orders) {
      CellBox box = cube;
      for (const int axis : order) grow(box, axis);
      if (const std::int64_t gain = open_sums_.over(box); gain > best.gain) best = {box, gain};
    }
    return best;
  }

  LatticePoint size_;
  std::vector<std::uint8_t> solid_, open_;
  std::vector<std::uint16_t> cube_;
  Sums solid_sums_, open_sums_;
};

}  // namespace

std::vector<LatticeBox> solid_boxes(const InsidePoints& points) {
  const Thinned cells(points);
  std::vector<LatticeBox> out;
  if (cells.size().x < 1 || cells.size().y < 1 || cells.size().z < 1) return out;
  BoxFinder finder(cells);
  const std::int64_t all = finder.solid_count();
  while (out.size() < most_boxes) {
    const auto found = finder.next();
    // A box that adds little to those before costs more than it hides; one that stands apart is worth its while.
    if (!found) break;
    if (256 * found->gain < all && (2 * found->gain < volume_of(found->box) || 65536 * found->gain < all)) break;
    out.push_back(cells.grown(found->box));
  }
  const auto size = [](const LatticeBox& b) {
    const LatticePoint n = b.last - b.first;
    return std::int64_t{n.x} * n.y * n.z;
  };
  std::stable_sort(out.begin(), out.end(), [&](const LatticeBox& a, const LatticeBox& b) { return size(a) > size(b); });
  return out;
}

}  // namespace gridcull
