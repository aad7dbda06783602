// One view of a frame (Batagelo and Wu 2002, section 4.2), and what the paper leaves to the reader: viewers
// inside objects, on objects and outside the grid.
//
// Claim: the answer holds every visible object X. Let p be a point of X in the view volume such that the open
// segment v-p meets the interior of no occluder but X. Its cell c, if in the lattice, is touched by X.
// (a) Suppose c was found hidden, or some cell on the segment was. Take the first hidden cell along the
// segment. By the claims of hide_2d.h and cap_3d.cpp the segment met an opaque cell before it; nobody but X
// can own that (no other occluder's interior is met), so X fills it. The cell is in view (the cone is convex
// or the segment radial), not hidden (it comes first), hence visited, and X is in its list: X is reported.
// (b) Otherwise no cell on the segment is hidden; the rings or shells up to c were all visited, because each
// of them has a cell of the segment that is not hidden; so c was visited and X is reported, if X was in I.
// If X was hidden behind a temporal bounding volume, that volume touches c (solid) or its outline was met
// on the way (hollow), so it was revealed and X's cover tested. Points outside the lattice, and in tiles of static
// cells that are not held (tile_stream.h): look_outside().
#include "gridcull/grid/view_task.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace gridcull {
namespace {

double microseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void ViewTask::run(GridWorld& world, const View& view, Answer& answer, ViewResult& result, DrawSink* draw) {
  const auto start = std::chrono::steady_clock::now();
  const ViewVolume volume(view, world.lattice.dimension());
  world_ = &world;
  volume_ = &volume;
  answer_ = &answer;
  result_ = &result;
  result.seen.clear();
  result.revealed.clear();
  answer.viewer = view.viewer;
  answer.visible.clear();
  answer.work = {};
  occlusion_.clear();
  begin(view);
  traverse();
  result.occlude_us = occlusion_.microseconds();
  result.traverse_us = microseconds_since(start) - result.occlude_us;
  const auto collecting = std::chrono::steady_clock::now();
  collect();
  result.collect_us = microseconds_since(collecting);
  if (draw != nullptr) draw_all(*draw);
}

void ViewTask::begin(const View& view) {
  GridWorld& world = *world_;
  stamps_.resize(world.objects.size(), 0);
  if (++stamp_ == 0) {
    std::fill(stamps_.begin(), stamps_.end(), 0);
    stamp_ = 1;
  }
  found_count_ = 0;
  excluded_.clear();
  rides_ = view.rides == no_id ? none : world.objects.find(view.rides);
  viewer_ = world.lattice.cell_of(view.pose.position);
  has_window_ = grid_.reset(world.lattice, world.matrix, view.pose.position, view.range, world.max_memory);
  const Cell n = world.lattice.cells();
  const auto distance = [](std::int64_t v, std::int64_t count) {
    return std::max(std::llabs(v), std::llabs(v - count));
  };
  far_away_ =
      std::max({distance(viewer_.x, n.x), distance(viewer_.y, n.y), distance(viewer_.z, n.z)}) > greatest_distance;
  if (rides_ != none) exclude(rides_);
  find_containers();
}

void ViewTask::exclude(Slot slot) {
  excluded_.push_back(slot);
  const ObjectState& state = world_->objects[slot];
  if (!has_window_ || state.place != Place::active) return;
  const IdentifierMatrix& matrix = world_->matrix;
  for (std::uint32_t i = state.entries; i != none; i = matrix.entry(i).next_of_object) {
    const auto& entry = matrix.entry(i);
    std::size_t brick;
    if (entry.opaque == 0 || !grid_.window_brick(entry.brick, brick)) continue;
    std::uint64_t word = 0;
    matrix.each_in_brick(entry.brick, [&](const IdentifierMatrix::Entry& other) {
      if (!excluded(other.slot)) word |= other.opaque;
    });
    grid_.opaque[brick] = word;
  }
}

bool ViewTask::excluded(Slot slot) const {
  return std::find(excluded_.begin(), excluded_.end(), slot) != excluded_.end();
}

void ViewTask::find_containers() {
  // Active objects around the viewpoint: in the lists of its cell, or beyond the lattice. Hidden ones are
  // revealed at the viewer's own cell and judged there.
  pending_.clear();
  const GridWorld& world = *world_;
  if (world.lattice.holds(viewer_)) {
    const std::size_t brick = world.lattice.brick_of(viewer_);
    const std::uint64_t bit = std::uint64_t{1} << world.lattice.bit_of(viewer_);
    world.matrix.each_in_brick(brick, [&](const IdentifierMatrix::Entry& entry) {
      if (entry.touched & bit) pending_.push_back(entry.slot);
    });
    if (world.tiles) world.tiles->each_unheld_at(viewer_, [&](Slot slot) { pending_.push_back(slot); });
  } else {
    for (const Slot slot : world.outside) {
      if (world.objects[slot].place == Place::active) pending_.push_back(slot);
    }
  }
  for (const Slot slot : pending_) {
    const ObjectState& state = world.objects[slot];
    if (slot == rides_ || !state.shape->holds(world.objects.pose(slot), volume_->apex())) continue;
    exclude(slot);
    if (mark(slot)) result_->seen.push_back(slot);
  }
}

void ViewTask::traverse() {
  GridWorld& world = *world_;
  look_outside();
  if (!has_window_) return;
  if (far_away_) {
    for (std::size_t b = 0; b < grid_.brick_count(); ++b) {
      const std::size_t lattice_brick = grid_.lattice_brick(b);
      grid_.visible[b] = world.lattice.brick_cells(lattice_brick);
      look(b, grid_.visible[b]);
    }
    return;
  }
  if (grid_.holds(viewer_)) {
    // The viewer's own cell is always visible and never an occluder.
    const std::size_t brick = grid_.brick_of(viewer_);
    const std::uint64_t bit = std::uint64_t{1} << world.lattice.bit_of(viewer_);
    grid_.visible[brick] |= bit;
    ++answer_->work.cells_visited;
    look(brick, bit);
  }
  const ViewCone cone(world.lattice, *volume_, viewer_);
  if (world.lattice.dimension() == 2) {
    traverse_2d_.run(grid_, cone, viewer_, volume_->axis(), *this, answer_->work, occlusion_);
  } else {
    traverse_3d_.run(grid_, cone, viewer_, volume_->axis(), *this, answer_->work, occlusion_);
  }
}

void ViewTask::look(std::size_t brick, std::uint64_t bits) {
  GridWorld& world = *world_;
  const std::size_t lattice_brick = grid_.lattice_brick(brick);
  const bool solid = world.tbv.may_touch(lattice_brick), hollow = world.hollow.may_touch(lattice_brick);
  if (!solid && !hollow) return;
  pending_.clear();
  const auto wanted = [&](Slot slot) { return stamps_[slot] != stamp_ && slot != rides_; };
  const auto found = [&](Slot slot) { pending_.push_back(slot); };
  if (solid) answer_->work.tbv_tests += world.tbv.touching(lattice_brick, bits, wanted, found).volumes;
  if (hollow) answer_->work.tbv_tests += world.hollow.touching(lattice_brick, bits, wanted, found);
  for (const Slot slot : pending_) reveal(slot);
}

void ViewTask::look_outside() {
  GridWorld& world = *world_;
  if (world.tiles) {
    world.tiles->each_unheld(*volume_, [&](Slot slot) {
      ++answer_->work.object_tests;
      consider(slot, world.objects.pose(slot));
    });
  }
  for (const Slot slot : world.outside) {
    const ObjectState& state = world.objects[slot];
    if (state.place == Place::active) {
      ++answer_->work.object_tests;
      consider(slot, world.objects.pose(slot));
    } else {
      ++answer_->work.tbv_tests;
      const TbvMatrix::Ball& ball = world.tbv.ball(slot);
      // What may hold the viewpoint counts even where it is nearer than the near plane: containers are reported.
      const bool around = glm::length(ball.centre - volume_->apex()) <= ball.radius;
      if (around || volume_->may_touch_ball(ball.centre, ball.radius)) reveal(slot);
    }
  }
}

void ViewTask::reveal(Slot slot) {
  // A viewer neither reports nor is hidden by what it rides on: no need to look at it.
  if (slot == rides_ || !mark(slot)) return;
  if (found_count_ == found_.size()) found_.emplace_back();
  Found& found = found_[found_count_++];
  const ObjectState& state = world_->objects[slot];
  found.slot = slot;
  found.pose = world_->read(slot);
  const PreparedShape& shape = *state.shape;
  shape.cover(world_->lattice, found.pose, scratch_, found.cover);
  found.container = shape.holds(found.pose, volume_->apex());
  ++answer_->work.tbv_revealed;
  if (found.container) {
    excluded_.push_back(slot);
    return;
  }
  if (!has_window_ || !state.occluder) return;
  for (const BrickCover& b : found.cover.bricks) {
    std::size_t brick;
    if (b.opaque != 0 && grid_.window_brick(b.brick, brick)) grid_.opaque[brick] |= b.opaque;
  }
}

void ViewTask::consider(Slot slot, const Pose& pose) {
  if (slot == rides_ || !mark(slot)) return;
  const ObjectState& state = world_->objects[slot];
  if (in_view(state, pose)) result_->seen.push_back(slot);
}

bool ViewTask::in_view(const ObjectState& object, const Pose& pose) const {
  if (volume_->all_round() && !std::isfinite(volume_->range())) return true;
  // The ball first: it is at hand, the shape is not.
  if (!volume_->may_touch_ball(pose.position, object.reach)) return false;
  return object.round || object.shape->may_touch(*volume_, pose);
}

void ViewTask::collect() {
  if (has_window_) {
    grid_.for_each_brick([&](std::size_t brick, std::size_t lattice_brick) {
      if (grid_.visible[brick] != 0) collect_brick(lattice_brick, grid_.visible[brick]);
    });
  }
  for (std::size_t i = 0; i < found_count_; ++i) collect_found(found_[i]);
  ids_.list(world_->objects, result_->seen, answer_->visible);
}

void ViewTask::collect_found(const Found& found) {
  bool touched = found.cover.outside;
  for (std::size_t i = 0; has_window_ && !touched && i < found.cover.bricks.size(); ++i) {
    const BrickCover& b = found.cover.bricks[i];
    std::size_t brick;
    touched = grid_.window_brick(b.brick, brick) && (grid_.visible[brick] & b.touched) != 0;
  }
  result_->revealed.push_back(found.slot);
  if (found.container || (touched && in_view(world_->objects[found.slot], found.pose)))
    result_->seen.push_back(found.slot);
}

void ViewTask::collect_brick(std::size_t lattice_brick, std::uint64_t visible) {
  const IdentifierMatrix& matrix = world_->matrix;
  world_->note_seen(world_->tbv.block_of(lattice_brick));
  matrix.each_in_brick(lattice_brick, [&](const IdentifierMatrix::Entry& entry) {
    ++answer_->work.object_tests;
    if (entry.touched & visible) consider(entry.slot, world_->objects.pose(entry.slot));
  });
}

std::uint64_t ViewTask::bytes() const {
  std::uint64_t bytes =
      grid_.bytes() + traverse_2d_.bytes() + traverse_3d_.bytes() + stamps_.capacity() * sizeof(std::uint32_t);
  for (const Found& found : found_) bytes += sizeof(Found) + found.cover.bricks.capacity() * sizeof(BrickCover);
  return bytes;
}

}  // namespace gridcull
