// From-region: an answer holds for every viewpoint of the cell, so an occluder whose interior may hold one of them does
// not count (an object that holds the viewer hides nothing from it). Whether a cell and an occluder's convex pieces
// are apart is judged along the cell's three axes and the pieces' own sides; a pair that only a plane through an edge
// of each parts counts as meeting, which is looser, not wrong. Touching counts as apart, to within rounding: such
// occluders are named in `touching`, for the caller to ask exactly about its viewpoint.
#include "gridcull/methods/extended_visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridcull::extended {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int rough_share = 8;              // the map that chooses a plane is so many times coarser
constexpr std::size_t most_distances = 12;  // tried for a plane
/// Of the coordinates: narrower pieces hide nothing. Where an outline runs back on itself rounding alone gives a
/// piece its width, and core/exact.h takes walls nearer than 1e-12 of the coordinates for one place.
constexpr double least_width = 4e-12;

/// Metres between the piece and the cell along the direction that parts them best; negative when none does.
double gap_between(const Piece& piece, const ViewCell& cell) {
  double best = -infinity;
  const auto along = [&](const Vec3& towards_cell) {
    const double length = glm::length(towards_cell);
    if (!(length > 0.0)) return;
    double nearest = -infinity;
    for (const Vec3& p : piece.polytope.points) nearest = std::max(nearest, glm::dot(towards_cell, p - cell.centre));
    best = std::max(best, (-nearest - reach_along(cell, towards_cell)) / length);
  };
  for (const Vec3& axis : {cell.axes.x, cell.axes.y, cell.axes.z}) {
    along(axis);
    along(-axis);
  }
  for (const Vec3& normal : piece.normals) along(normal);
  return best;
}

/// Metres between cell and occluder; negative when a viewpoint of the cell may lie inside it.
double gap_between(const Occluder& occluder, const ViewCell& cell) {
  if (occluder.thin) return infinity;
  double gap = infinity;
  if (occluder.ball > 0.0) {
    const Vec3 off = glm::max(glm::abs(into_cell(cell, occluder.box.centre())) - cell.half, Vec3(0.0));
    gap = glm::length(off) - occluder.ball;
  } else {
    for (const Piece& piece : occluder.pieces) gap = std::min(gap, gap_between(piece, cell));
  }
  for (const Piece& piece : occluder.covers) gap = std::min(gap, gap_between(piece, cell));
  return gap;
}

std::size_t place_of(const Facing& facing) {
  return static_cast<std::size_t>(2 * facing.axis + (facing.sign < 0.0 ? 1 : 0));
}

bool hides(const Outlooks& outlooks, const Occludee& occludee, int halvings) {
  std::uint64_t ignored = 0;
  return occludee.box.min.z >= outlooks.floor && outlooks.hides(box_in(outlooks.cell, occludee), halvings, ignored);
}

double size_of(const Vec3& p) { return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z); }

}  // namespace

double least_angle(int resolution) {
  const double pixel = 2.0 * plane_extension / resolution;
  return least_pixels * pixel * pixel;
}

void CellLooker::find_candidates(const ViewCell& cell, ObjectId without, const std::vector<std::uint32_t>* candidates) {
  candidates_.clear();
  found_.clear();
  Bounds world;  // the cell's box in the world
  const Vec3 reach{reach_along(cell, {1, 0, 0}), reach_along(cell, {0, 1, 0}), reach_along(cell, {0, 0, 1})};
  world.add(cell.centre - reach);
  world.add(cell.centre + reach);
  scene_.worth.find(world, found_);
  std::size_t next = 0;
  for (const std::uint32_t i : found_) {
    const Occluder& occluder = scene_.occluders[i];
    if (occluder.id == without) continue;
    if (candidates != nullptr) {  // both ascend by id
      const auto before = [&](std::size_t k) { return scene_.occludees[(*candidates)[k]].id < occluder.id; };
      while (next < candidates->size() && before(next)) ++next;
      if (next == candidates->size()) break;
      if (scene_.occludees[(*candidates)[next]].id != occluder.id) continue;
    }
    Candidate c;
    c.occluder = i;
    const double gap = gap_between(occluder, cell);
    const double rounding = occluder.blur + 1e-13 * (size_of(cell.centre) + size_of(cell.half));
    if (gap < -4.0 * rounding) continue;
    c.touches = gap < 1e-6 * size_of(cell.half) + 8.0 * rounding;
    c.box = into_cell(cell, occluder.box);
    c.angle = solid_angle(c.box, Vec3(0.0));
    c.polytopes = nowhere;
    candidates_.push_back(c);
  }
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return a.angle != b.angle ? a.angle > b.angle : a.occluder < b.occluder;
  });
}

/// Whether some of it lies in the pyramid that the facing's map sees.
bool CellLooker::worth_in(const Candidate& c, const Facing& facing, const Vec3& half) const {
  const Bounds box = facing(c.box);
  const double gap = box.max.z - half.z;
  if (!(gap > 1e-9 * size_of(half))) return false;
  for (const int axis : {0, 1}) {
    const double extent = plane_extension * (half[axis] + gap);
    if (box.min[axis] > extent || box.max[axis] < -extent) return false;
  }
  return true;
}

std::span<const Polytope> CellLooker::local(const ViewCell& cell, std::uint32_t candidate) {
  Candidate& c = candidates_[candidate];
  const Occluder& occluder = scene_.occluders[c.occluder];
  if (c.polytopes == nowhere) {
    c.polytopes = static_cast<std::uint32_t>(polytopes_.size());
    for (const Piece& piece : occluder.pieces) {
      Polytope& p = polytopes_.emplace_back(piece.polytope);
      for (Vec3& x : p.points) {
        if (above_floor_ && occluder.upright && x.z == scene_.floor.height) x.z -= scene_.floor.depth;
        x = into_cell(cell, x);
      }
    }
  }
  return {polytopes_.data() + c.polytopes, occluder.pieces.size()};
}

bool CellLooker::draw(Outlook& outlook, const ViewCell& cell, std::uint32_t candidate, CellView& out) {
  const Candidate c = candidates_[candidate];
  const Occluder& occluder = scene_.occluders[c.occluder];
  // Deep ones enter in more than one cut, so that they hide what is beside their far end.
  const Bounds box = outlook.facing(c.box);
  const double near = std::max(box.min.z, outlook.plane.near), far = std::min(box.max.z, outlook.plane.distance);
  const int cuts = far - near < 0.2 * (near + outlook.plane.half.z) ? 1 : 2;
  bool any = false;
  const double least = least_width * (size_of(cell.centre) + size_of(occluder.box.min) + size_of(occluder.box.max));
  const std::span<const Polytope> polytopes = local(cell, candidate);
  for (std::size_t i = 0; i < polytopes.size(); ++i) {
    if (!(occluder.pieces[i].width > least)) continue;
    const Polytope& p = polytopes[i];
    turned_.points.clear();
    for (const Vec3& x : p.points) turned_.points.push_back(outlook.facing(x));
    turned_.edges = p.edges;
    any = projector_.add(outlook.plane, turned_, occluder.blur, cuts, outlook.map) || any;
  }
  if (!occluder.concave.outline.empty()) {
    any = cover_slice(cell, outlook.facing, outlook.plane, occluder.concave, occluder.blur, outlook.map) || any;
  }
  ++out.drawn;
  if (any) {
    out.used.push_back(occluder.id);
    if (c.touches) out.touching.push_back(occluder.id);
  }
  return any;
}

std::uint64_t CellLooker::filled_at(double distance, const ViewCell& cell, const Facing& facing,
                                    std::span<const std::uint32_t> chosen) {
  const int resolution = std::max(8, settings_.resolution / rough_share);
  Outlook trial{facing, make_plane(facing.half(cell), distance, resolution), {}};
  std::swap(trial.map, rough_);
  trial.map.reset(resolution);
  CellView ignored;
  for (const std::uint32_t i : chosen) draw(trial, cell, i, ignored);
  std::swap(trial.map, rough_);
  return rough_.covered_pixels();
}

/// Planes stand just behind occluders. One plane: the paper's heuristic (6.1), the one whose map fills best. More:
/// spread over the occluders from near to far, since an occluder's view shrinks the farther it is from the plane.
void CellLooker::choose_distances(const ViewCell& cell, const Facing& facing, std::span<const std::uint32_t> chosen) {
  std::vector<double> all;
  for (const std::uint32_t i : chosen) all.push_back(facing(candidates_[i].box).max.z * (1.0 + 1e-6));
  std::sort(all.begin(), all.end());
  const auto last = std::unique(all.begin(), all.end(), [](double a, double b) { return b < 1.05 * a; });
  all.erase(last, all.end());
  const auto pick = [&all](std::size_t i, std::size_t of) { return all[of > 1 ? i * (all.size() - 1) / (of - 1) : 0]; };
  distances_.clear();
  const auto planes = std::min(static_cast<std::size_t>(settings_.planes), all.size());
  if (planes > 1 || all.size() == 1) {
    for (std::size_t i = 0; i < planes; ++i) distances_.push_back(pick(i, planes));
    return;
  }
  const std::size_t trials = std::min(most_distances, all.size());
  std::uint64_t most = 0;
  distances_.push_back(all[0]);
  for (std::size_t i = 0; i < trials; ++i) {
    const double distance = pick(i, trials);
    const std::uint64_t pixels = filled_at(distance, cell, facing, chosen);
    if (pixels > most) most = pixels, distances_[0] = distance;
  }
}

void CellLooker::draw_directions(const ViewCell& cell, CellView& out) {
  polytopes_.clear();
  lists_.assign(facings.size(), {});
  drawn_.assign(facings.size(), 0);
  const auto first = static_cast<std::size_t>((settings_.occluders + 1) / 2);
  for (std::size_t f = 0; f < facings.size(); ++f) {
    const Vec3 half = facings[f].half(cell);
    for (std::uint32_t i = 0; i < candidates_.size(); ++i) {
      if (worth_in(candidates_[i], facings[f], half)) lists_[f].push_back(i);
    }
    if (lists_[f].empty()) continue;
    drawn_[f] = std::min(first, lists_[f].size());
    const std::span<const std::uint32_t> chosen(lists_[f].data(), drawn_[f]);
    choose_distances(cell, facings[f], chosen);
    for (const double distance : distances_) {
      Outlook& outlook = out.outlooks.planes.emplace_back();
      outlook.facing = facings[f];
      outlook.plane = make_plane(half, distance, settings_.resolution);
      outlook.map.reset(settings_.resolution);
      for (const std::uint32_t i : chosen) draw(outlook, cell, i, out);
      outlook.map.build();
    }
  }
}

void CellLooker::test_tree(std::uint32_t node, CellView& out) {
  const BoxTree::Node& n = scene_.tree.nodes()[node];
  std::uint64_t ignored = 0;
  const auto items = scene_.tree.items(n);
  const Bounds box = box_in(out.outlooks.cell, n.box);
  const Cover cover = out.outlooks.cover(box, ignored);
  if (cover == Cover::all && n.box.min.z >= out.outlooks.floor) return;
  if (cover == Cover::none) {  // fully visible: nothing in it can be hidden
    out.visible.insert(out.visible.end(), items.begin(), items.end());
    return;
  }
  if (n.left != 0) {
    test_tree(n.left, out);
    test_tree(n.left + 1, out);
    return;
  }
  for (const std::uint32_t i : items) {
    if (!hides(out.outlooks, scene_.occludees[i], 0)) out.visible.push_back(i);
  }
}

/// `closely`: in halves too. Motion regions are small and many, so they are halved once at most.
void CellLooker::test(const std::vector<std::uint32_t>* candidates, bool closely, CellView& out) {
  if (candidates == nullptr) {
    if (!scene_.occludees.empty()) test_tree(0, out);
    std::sort(out.visible.begin(), out.visible.end());
    return;
  }
  for (const std::uint32_t i : *candidates) {
    const Occludee& occludee = scene_.occludees[i];
    const int halvings = !closely ? 0 : occludee.id == no_id ? std::min(1, settings_.halvings) : settings_.halvings;
    if (!hides(out.outlooks, occludee, halvings)) out.visible.push_back(i);
  }
}

/// The other half of the occluders goes where much is still visible.
void CellLooker::draw_more(const ViewCell& cell, CellView& out) {
  std::array<std::size_t, facings.size()> seen{};
  std::size_t all = 0;
  for (const std::uint32_t i : out.visible) {
    const Vec3 at = into_cell(cell, scene_.occludees[i].box.centre());
    for (std::size_t f = 0; f < facings.size(); ++f) {
      const Vec3 p = facings[f](at);
      if (p.z > std::max(std::fabs(p.x), std::fabs(p.y))) ++seen[f], ++all;
    }
  }
  const std::size_t rest = facings.size() * static_cast<std::size_t>(settings_.occluders / 2);
  std::array<std::size_t, facings.size()> end = {};
  for (std::size_t f = 0; f < facings.size(); ++f) {
    end[f] = std::min(lists_[f].size(), drawn_[f] + (all > 0 ? rest * seen[f] / all : 0));
  }
  for (Outlook& outlook : out.outlooks.planes) {
    const std::size_t f = place_of(outlook.facing);
    for (std::size_t k = drawn_[f]; k < end[f]; ++k) {
      std::uint64_t ignored = 0;
      const std::uint32_t i = lists_[f][k];
      if (look_at(outlook.plane, outlook.map, outlook.facing(candidates_[i].box), ignored) != Cover::all)
        draw(outlook, cell, i, out);
    }
  }
}

void CellLooker::sweep(CellView& out) {
  auto& planes = out.outlooks.planes;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (settings_.sweep && i > 0 && place_of(planes[i].facing) == place_of(planes[i - 1].facing)) {
      sweep_.carry(planes[i - 1].plane, planes[i - 1].map, planes[i].plane, planes[i].map);
    }
    planes[i].map.build();
  }
}

std::uint64_t view_bytes(const CellSettings& settings) {
  return facings.size() * static_cast<std::uint64_t>(settings.planes) * DepthMap::bytes_for(settings.resolution);
}

// The sweep's summed-area table, and the rough map.
std::uint64_t looker_bytes(const CellSettings& settings) {
  const std::uint64_t side = static_cast<std::uint64_t>(settings.resolution) + 1;
  return side * side * sizeof(std::uint32_t) + DepthMap::bytes_for(std::max(8, settings.resolution / rough_share));
}

void CellLooker::look(const ViewCell& cell, bool above_floor, ObjectId without,
                      const std::vector<std::uint32_t>* candidates, CellView& out) {
  above_floor_ = above_floor;
  out.outlooks.cell = cell;
  out.outlooks.floor = above_floor ? scene_.floor.height : -infinity;
  out.outlooks.planes.clear();
  out.visible.clear();
  out.used.clear();
  out.touching.clear();
  out.drawn = 0;
  find_candidates(cell, without, candidates);
  draw_directions(cell, out);
  test(candidates, false, out);
  draw_more(cell, out);
  sweep(out);
  const std::vector<std::uint32_t> before = std::move(out.visible);
  out.visible.clear();
  test(&before, true, out);
  for (auto* ids : {&out.used, &out.touching}) {
    std::sort(ids->begin(), ids->end());
    ids->erase(std::unique(ids->begin(), ids->end()), ids->end());
  }
}

}  // namespace gridcull::extended
