// Cells are cubes that are halved while they see more than their budget, down to a least size. A child tests only what
// its parent sees, objects and motion regions alike, and draws only occluders that its parent sees: hidden from a cell
// is hidden from its parts, and an occluder that is hidden adds nothing to what hides it. (That is not quite so for its
// shadow: what hides the occluder from every point of the parent also hides what the occluder hides from there; so
// nothing is lost.) A cell wholly inside an occluder is left out: whoever is there gets the view volume's answer.
//
// Largest cells are independent, so any number of threads gives the same bytes; the state to go on from is the largest
// cells that are done.
#include "gridcull/methods/extended_bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "gridcull/core/error.h"
#include "gridcull/core/memory_limit.h"
#include "gridcull/methods/bytes.h"
#include "gridcull/methods/extended_baked.h"
#include "gridcull/methods/extended_visibility.h"
#include "gridcull/methods/parallel.h"

namespace gridcull {
namespace {

using namespace extended;

constexpr std::array settings{
    BakeSetting{"largest-cell", "edge of the cells to begin with, in cells of the lattice", 8.0, 1e-3, 1e6, false},
    BakeSetting{"halvings", "how often a cell may be halved", 2.0, 0.0, 8.0, true},
    BakeSetting{"budget", "a cell that sees no more static objects and motion regions is not halved", 50.0, 0.0, 1e9,
                true},
    BakeSetting{"gain", "a cell is halved only where its centre sees less than this share of what the cell sees", 0.95,
                0.0, 1.0, false},
    BakeSetting{"heading", "degrees by which cells are turned about the vertical, so that they lie along the streets",
                0.0, -180.0, 180.0, false},
    BakeSetting{"ceiling",
                "viewers stand at most this many metres above the floor; 0: 2 m above what moves, any height where "
                "nothing does",
                0.0, 0.0, 1e9, false},
    BakeSetting{"region", "edge of a motion region, in cells of the lattice", 2.0, 1e-3, 1e6, false},
    BakeSetting{"map", "pixels along a depth map's side", 128.0, 8.0, 4096.0, true},
    BakeSetting{"planes", "projection planes in each of six directions", 4.0, 1.0, 16.0, true},
    BakeSetting{"occluders", "for each direction, on average", 64.0, 2.0, 1e6, true},
    BakeSetting{"sweep", "1: a plane also gets what the one before it hides; 0: not", 1.0, 0.0, 1.0, true}};

constexpr std::uint32_t most_regions = 200'000;
constexpr double most_roots = 1e7;
constexpr double sample_share = 1e-3;  // of a cell: a sample view is that of a cell all but a point

double value_of(const ExtendedBakeOptions& options, std::string_view name) {
  const auto found = std::find_if(settings.begin(), settings.end(), [&](const auto& s) { return s.name == name; });
  return bake_setting(options.settings, *found);
}

/// Metres above the floor up to which viewers are expected.
double ceiling_of(std::span<const Object> objects, const ExtendedBakeOptions& options, double floor) {
  const double asked = value_of(options, "ceiling");
  if (asked > 0.0) return asked;
  double top = -std::numeric_limits<double>::infinity();
  for (const Object& object : objects) {
    if (!object.is_static) top = std::max(top, make_occludee(object).box.max.z);
  }
  constexpr double above_movers = 2.0;
  return top > floor ? top - floor + above_movers : std::numeric_limits<double>::infinity();
}

CellLattice choose_lattice(std::span<const Object> objects, const ExtendedBakeOptions& options, double floor) {
  CellLattice out;
  out.heading = value_of(options, "heading") * (std::numbers::pi / 180.0);
  const Rotation axes = out.axes();
  Bounds turned;  // the world's box in the lattice's axes
  for (const double x : {options.bounds.min.x, options.bounds.max.x}) {
    for (const double y : {options.bounds.min.y, options.bounds.max.y}) turned.add(axes.inverse({x, y, 0.0}));
  }
  out.origin = axes * turned.min;
  out.origin.z = std::max(options.bounds.min.z, floor);
  out.levels = static_cast<std::uint32_t>(value_of(options, "halvings"));
  const double largest = value_of(options, "largest-cell") * options.cell;
  out.step = std::ldexp(largest, -static_cast<int>(out.levels));
  Vec3 size = turned.size();
  size.z = std::clamp(options.bounds.max.z - out.origin.z, 0.0, ceiling_of(objects, options, out.origin.z));
  double all = 1.0;
  for (int k = 0; k < 3; ++k) {
    const double n = std::max(1.0, std::ceil(size[k] / largest - 1e-9));
    all *= n;
    if (!(all <= most_roots)) throw Error(ErrorCode::limit, "bake: more than 10,000,000 cells; raise --largest-cell");
    out.count[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(n);
  }
  return out;
}

CellSettings cell_settings(const ExtendedBakeOptions& options) {
  CellSettings out;
  out.resolution = static_cast<int>(value_of(options, "map"));
  out.planes = static_cast<int>(value_of(options, "planes"));
  out.occluders = static_cast<int>(value_of(options, "occluders"));
  out.sweep = value_of(options, "sweep") != 0.0;
  return out;
}

Occludee region_occludee(const Bounds& box) {
  Occludee out;
  out.box = box;
  for (int i = 0; i < 8; ++i) {
    out.points.emplace_back((i & 1) ? box.max.x : box.min.x, (i & 2) ? box.max.y : box.min.y,
                            (i & 4) ? box.max.z : box.min.z);
  }
  return out;
}

/// Whether all of the cell lies in one convex piece of an occluder.
bool is_inside(const ViewCell& cell, const Occluder& occluder) {
  if (occluder.thin) return false;
  const Vec3 reach{reach_along(cell, {1, 0, 0}), reach_along(cell, {0, 1, 0}), reach_along(cell, {0, 0, 1})};
  const Vec3 low = cell.centre - reach, high = cell.centre + reach;
  for (int k = 0; k < 3; ++k) {
    if (low[k] < occluder.box.min[k] || high[k] > occluder.box.max[k]) return false;
  }
  return std::any_of(occluder.pieces.begin(), occluder.pieces.end(), [&](const Piece& piece) {
    return std::all_of(piece.normals.begin(), piece.normals.end(), [&](const Vec3& normal) {
      double most = -std::numeric_limits<double>::infinity();
      for (const Vec3& p : piece.polytope.points) most = std::max(most, glm::dot(normal, p - cell.centre));
      return reach_along(cell, normal) <= most;
    });
  });
}

class Bake {
 public:
  Bake(std::span<const Object> objects, const ExtendedBakeOptions& options)
      : settings_(cell_settings(options)),
        budget_(static_cast<std::size_t>(value_of(options, "budget"))),
        gain_(value_of(options, "gain")),
        arena_(std::clamp(options.threads, 1, tbb::info::default_concurrency())) {
    check_memory(options);
    std::vector<const Object*> pointers;
    for (const Object& object : objects) pointers.push_back(&object);
    scene_ = make_static_scene(pointers, least_angle(settings_.resolution));
    lattice_ = choose_lattice(objects, options, scene_.floor.height);
    regions_ = choose_regions(objects, options.bounds, value_of(options, "region") * options.cell, scene_.floor.height,
                              most_regions);
    objects_ = static_cast<std::uint32_t>(scene_.occludees.size());
    for (std::uint32_t i = 0; i < regions_.size(); ++i) {
      scene_.occludees.push_back(region_occludee(regions_.box(i)));
    }
    std::vector<Bounds> boxes;
    for (const Occludee& o : scene_.occludees) boxes.push_back(o.box);
    scene_.tree.build(boxes);
    for (int i = 0; i < arena_.max_concurrency(); ++i) {
      lookers_.push_back(std::make_unique<CellLooker>(scene_, settings_));
    }
  }

  std::optional<std::vector<std::byte>> run(std::span<const std::byte> resume, BakeListener& listener) {
    std::vector<RootCells> roots = read_state(resume);
    const std::size_t all = lattice_.roots(), batch = 4 * static_cast<std::size_t>(arena_.max_concurrency());
    for (std::size_t done = roots.size(); done < all; done = roots.size()) {
      if (!listener.progress(static_cast<double>(done) / static_cast<double>(all))) {
        listener.checkpoint(state_of(roots));
        return std::nullopt;
      }
      roots.resize(std::min(all, done + batch));
      for_each_on(arena_, done, roots.size(), [&](std::size_t i, std::size_t worker) {
        divide(lattice_.corner(static_cast<std::uint32_t>(i)), 0, {}, *lookers_[worker], roots[i]);
      });
    }
    ByteWriter out;
    BakedCells(lattice_, regions_, objects_, roots).write(out);
    return out.take();
  }

 private:
  /// Each thread looks out of a cell and of a point of it (worth_halving()).
  void check_memory(const ExtendedBakeOptions& options) const {
    const auto threads = static_cast<std::uint64_t>(arena_.max_concurrency());
    refuse_above(options.max_memory, threads * (2 * view_bytes(settings_) + looker_bytes(settings_)),
                 "--map: maps of " + std::to_string(settings_.resolution) + " pixels along a side, " +
                     std::to_string(settings_.planes) + " planes in six directions, two cells for each of " +
                     std::to_string(threads) + " threads need");
  }

  /// What a cell's parents see and which occluders they touch: what these hide is hidden from the cell by them.
  struct Known {
    const std::vector<std::uint32_t>* visible = nullptr;  ///< null: nothing is known
    std::vector<ObjectId> touching{};
  };

  void divide(const std::array<std::uint64_t, 3>& at, std::uint32_t level, const Known& known, CellLooker& looker,
              RootCells& out) const {
    const ViewCell cell = lattice_.cell(at, level);
    if (std::any_of(scene_.occluders.begin(), scene_.occluders.end(),
                    [&](const Occluder& o) { return is_inside(cell, o); })) {
      out.nodes.push_back(NodeKind::none);
      return;
    }
    CellView view;
    looker.look(cell, true, no_id, known.visible, view);
    Known now{&view.visible, {}};
    std::set_union(view.touching.begin(), view.touching.end(), known.touching.begin(), known.touching.end(),
                   std::back_inserter(now.touching));
    if (level == lattice_.levels || view.visible.size() <= budget_ || !worth_halving(cell, view, looker)) {
      out.nodes.push_back(NodeKind::leaf);
      LeafSet& leaf = out.leaves.emplace_back();
      leaf.visible = std::move(view.visible);
      for (const ObjectId id : now.touching) leaf.touching.push_back(place_of(id));
      return;
    }
    view.outlooks.planes.clear();  // maps of the parents are not kept
    view.outlooks.planes.shrink_to_fit();
    out.nodes.push_back(NodeKind::split);
    const std::uint64_t half = std::uint64_t{1} << (lattice_.levels - level - 1);
    for (std::uint64_t child = 0; child < 8; ++child) {
      divide({at[0] + half * (child & 1), at[1] + half * (child >> 1 & 1), at[2] + half * (child >> 2)}, level + 1, now,
             looker, out);
    }
  }

  /// The paper's more elaborate criterion: "compare the PVS to sample views from within the cell". Above the roofs a
  /// point sees all that the cell sees, and no halving helps. What one point sees says nothing of the cell's corners,
  /// so this is a guess about size, never about what is visible.
  bool worth_halving(const ViewCell& cell, const CellView& view, CellLooker& looker) const {
    if (gain_ >= 1.0) return true;
    ViewCell centre = cell;
    centre.half *= sample_share;
    CellView sample;
    looker.look(centre, true, no_id, &view.visible, sample);
    return static_cast<double>(sample.visible.size()) < gain_ * static_cast<double>(view.visible.size());
  }

  std::uint32_t place_of(ObjectId id) const {
    const auto end = scene_.occludees.begin() + objects_;
    const auto found = std::lower_bound(scene_.occludees.begin(), end, id,
                                        [](const Occludee& o, ObjectId wanted) { return o.id < wanted; });
    return static_cast<std::uint32_t>(found - scene_.occludees.begin());
  }

  std::vector<std::byte> state_of(std::span<const RootCells> roots) const {
    ByteWriter out;
    out.u64(scene_.occludees.size());  // static objects are in the head; regions depend on moving ones
    for (int k = 0; k < 3; ++k) out.f64(regions_.origin[k]), out.f64(regions_.edge[k]);
    out.u64(roots.size());
    for (const RootCells& root : roots) write_root(root, out);
    return out.take();
  }
  std::vector<RootCells> read_state(std::span<const std::byte> state) const {
    std::vector<RootCells> roots;
    if (state.empty()) return roots;
    ByteReader in(state, "the bake's state");
    bool same = in.u64() == scene_.occludees.size();
    for (int k = 0; k < 3; ++k) same = in.f64() == regions_.origin[k] && in.f64() == regions_.edge[k] && same;
    if (!same) in.refuse("begun with other moving objects");
    const std::size_t count = in.count(1);
    if (count > lattice_.roots()) in.refuse("altered: more cells than there are");
    for (std::size_t i = 0; i < count; ++i) {
      roots.push_back(read_root(in, lattice_.levels, static_cast<std::uint32_t>(scene_.occludees.size())));
    }
    in.finish();
    return roots;
  }

  CellLattice lattice_{};
  MotionRegions regions_{};
  CellSettings settings_;
  std::size_t budget_;
  double gain_;
  mutable tbb::task_arena arena_;
  StaticScene scene_{};
  std::uint32_t objects_ = 0;
  std::vector<std::unique_ptr<CellLooker>> lookers_{};
};

std::string line(const char* name, const std::string& value) { return std::string(name) + "  " + value + "\n"; }

}  // namespace

std::span<const BakeSetting> extended_bake_settings() { return settings; }

std::optional<std::vector<std::byte>> bake_extended_projections(std::span<const Object> objects,
                                                                const ExtendedBakeOptions& options,
                                                                std::span<const std::byte> resume,
                                                                BakeListener& listener) {
  return Bake(objects, options).run(resume, listener);
}

std::string describe_extended_projections(std::span<const std::byte> payload) {
  ByteReader in(payload, "extended projections");
  const BakedCells cells(in);
  in.finish();
  const SetSizes sizes = cells.sizes();
  const auto number = [](std::uint64_t n) { return std::to_string(n); };
  return line("viewing cells", number(sizes.leaves)) + line("motion regions", number(cells.regions().size())) +
         line("a cell sees", number(sizes.leaves == 0 ? 0 : sizes.entries / sizes.leaves) + " of " +
                                 number(cells.objects() + cells.regions().size()) + " objects and regions") +
         line("sets", number(sizes.delta) + " bytes as differences; as bits " + number(sizes.bits) + ", as lists " +
                          number(sizes.plain));
}

}  // namespace gridcull
