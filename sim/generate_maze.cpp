// A maze: 2D corridors on a lattice, from a random spanning tree (depth-first with backtracking), with
// walkers. Nearly everything is hidden.
#include <array>
#include <cmath>
#include <utility>

#include "gridcull/sim/generate_parts.h"

namespace gridcull {
namespace {

constexpr double pitch = 5.0;  // metres from corridor to corridor
// Three cells of 0.5 m. The lattice begins half a cell before the walls, so that two of three lie wholly inside and
// none touches a face.
constexpr double wall = 1.5;

/// Directions: 0 = +x, 1 = +y, 2 = -x, 3 = -y.
constexpr std::array<std::pair<int, int>, 4> steps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

class Maze final : public GeneratedWorld {
 public:
  explicit Maze(const GenerateOptions& options)
      : GeneratedWorld(options, 300), side_(static_cast<int>(options.count.value_or(20))) {
    const double edge = pitch * side_ + 0.5 * wall;
    scene_.dimension = 2;
    scene_.cell = options.cell.value_or(0.5);
    const double low = -0.5 * (wall + *scene_.cell);
    scene_.bounds = Bounds{{low, low, 0.0}, {edge, edge, 0.0}};
    open_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), 0);
    dig();
    for (int line = 0; line <= side_; ++line) {
      build(line, true);
      build(line, false);
    }
    std::vector<ObjectId> ids;
    for (int i = 0; i < std::max(1, side_ * side_ / 4); ++i) ids.push_back(start_walker());
    ride(ids, options.viewers.value_or(10));
  }

 private:
  struct Walker {
    ObjectId id;
    int cell;       ///< behind it
    int direction;  ///< of the way to the next cell's middle
    double way;     ///< metres from the middle of `cell`, 0 .. pitch
    double speed;
  };

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y * side_ + x); }
  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < side_ && y < side_; }
  bool is_open(int cell, int direction) const { return (open_[static_cast<std::size_t>(cell)] >> direction & 1) != 0; }
  int neighbour(int cell, int direction) const {
    const auto [dx, dy] = steps[static_cast<std::size_t>(direction)];
    return cell + dx + dy * side_;
  }
  Vec2 middle(int cell) const { return {pitch * (cell % side_ + 0.5), pitch * (cell / side_ + 0.5)}; }

  void dig() {
    std::vector<char> seen(open_.size(), 0);
    std::vector<int> path{0};
    seen[0] = 1;
    while (!path.empty()) {
      const int cell = path.back();
      std::array<int, 4> free{};
      std::uint32_t choices = 0;
      for (int d = 0; d < 4; ++d) {
        const auto [dx, dy] = steps[static_cast<std::size_t>(d)];
        const int x = cell % side_ + dx, y = cell / side_ + dy;
        if (inside(x, y) && !seen[index(x, y)]) free[choices++] = d;
      }
      if (choices == 0) {
        path.pop_back();
        continue;
      }
      const int d = free[random_.below(choices)];
      const int next = neighbour(cell, d);
      open_[static_cast<std::size_t>(cell)] |= static_cast<unsigned char>(1 << d);
      open_[static_cast<std::size_t>(next)] |= static_cast<unsigned char>(1 << (d + 2) % 4);
      seen[static_cast<std::size_t>(next)] = 1;
      path.push_back(next);
    }
  }
  /// Whether a wall stands on lattice line `line` beside cell number `i` along it.
  bool walled(int line, int i, bool along_x) const {
    if (line == 0 || line == side_) return true;
    const int cell = along_x ? static_cast<int>(index(i, line)) : static_cast<int>(index(line, i));
    return !is_open(cell, along_x ? 3 : 2);
  }
  /// Each run of walls on a line is one box, corner posts included.
  void build(int line, bool along_x) {
    for (int i = 0; i < side_;) {
      int end = i;
      while (end < side_ && walled(line, end, along_x)) ++end;
      if (end > i) {
        const double length = pitch * (end - i) + wall;
        const Vec2 centre{pitch * 0.5 * (i + end), pitch * line};
        if (along_x)
          add(Rectangle{{length, wall}}, {centre.x, centre.y, 0.0}).is_static = true;
        else
          add(Rectangle{{wall, length}}, {centre.y, centre.x, 0.0}).is_static = true;
      }
      i = end + 1;
    }
  }

  ObjectId start_walker() {
    Walker walker{};
    walker.cell = static_cast<int>(random_.below(static_cast<std::uint32_t>(open_.size())));
    walker.speed = random_.uniform(0.8, 2.0);
    walker.direction = choose(walker.cell, -1);
    Object& object = add(Disc{random_.uniform(0.25, 0.5)}, Vec3(middle(walker.cell), 0.0));
    object.max_speed = speed_bound(walker.speed);
    walker.id = object.id;
    walkers_.push_back(walker);
    return walker.id;
  }
  /// An open direction, not back where it came from unless in a dead end; -1 where there is none.
  int choose(int cell, int came) {
    std::array<int, 4> free{};
    std::uint32_t choices = 0;
    const int back = came < 0 ? -1 : (came + 2) % 4;
    for (int d = 0; d < 4; ++d) {
      if (d != back && is_open(cell, d)) free[choices++] = d;
    }
    return choices > 0 ? free[random_.below(choices)] : back;
  }
  void advance(Frame& out) override {
    for (Walker& walker : walkers_) {
      if (walker.direction < 0) continue;  // a maze of one cell
      walker.way += walker.speed / frames_a_second;
      if (walker.way >= pitch) {
        walker.way -= pitch;
        walker.cell = neighbour(walker.cell, walker.direction);
        walker.direction = choose(walker.cell, walker.direction);
      }
      const auto [dx, dy] = steps[static_cast<std::size_t>(walker.direction)];
      ObjectMove& move = out.set.emplace_back();
      move.id = walker.id;
      move.position = Vec3(middle(walker.cell) + walker.way * Vec2(dx, dy), 0.0);
    }
  }

  int side_;
  std::vector<unsigned char> open_{};  ///< a bit for each direction without a wall
  std::vector<Walker> walkers_{};
};

}  // namespace

std::unique_ptr<Generator> make_maze(const GenerateOptions& options) { return std::make_unique<Maze>(options); }

}  // namespace gridcull
