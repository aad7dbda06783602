// Method `silhouette` in 3D.
//
// Claim: the answer holds every visible object X. Let p be a visible point of X: in the view volume, and the open
// segment v-p meets the interior of no occluder but X. Suppose that X was not reported. Then one of these tests failed
// for the pixel of p's direction: a node that holds X (its box), a group with X (the box about its members), X's volume
// (a ball), X as a whole or X's slice that holds the first point q of X on the ray v-p (which is visible too; slices
// cover X's front). Each asks, at a key no greater than |q|, whether any pixel that it touches is open; the pixel of
// p's direction is touched (tests are over-estimates), so it was covered: some occluder's cone holds the whole pixel
// (occluders are under-estimates), and its key lies below the test's (front_queue.h). Its ray in p's direction
// therefore meets the interior of that occluder Y before q. Y was found visible before it was pushed and is neither
// what the viewer rides on nor around the viewpoint. Y = X is impossible, X would have been reported. So v-p meets the
// interior of another occluder: p was not visible. Pixels outside the view volume's sides start covered; p is inside
// them.
// Shortcuts. What lies beyond a side of the one window has no pixel there: it is neither visible nor hides anything,
// and is not pushed. Hidden by the rectangle about its ball, which holds every pixel that the object touches, an object
// is hidden; so it is by the rectangle about its box where it stands upright, and its key is the distance of its ball
// or of the cylinder in that box, which holds it too (SilhouetteWorld::filling()), whichever is farther. Keys and
// rectangles depend on nothing that the walk finds out, so they are worked out eight at a time when a node is opened
// (mask_batch_body.h). When no test is left, occluders change no answer. Its one pixel at its nearest point (or middle)
// being open, it is reported without any outline: an answer that lets an object through needs no proof. It is as tight
// as the whole test, for the point belongs to the object's hull, and for balls and boxes also to the nearest slice;
// rounding may take it one pixel beside the outline. Objects nearer than the near plane are entered as occluders too,
// though not reported; nothing beyond the range can hide what is within it.
//
// Cost: nodes, objects and pixels in front of what is visible; what is behind covered pixels is met as nodes only.
// The order inside a bucket and the shape of the index change no answer: a test depends on the occluders of lower
// buckets only, and those on tests.
#include "gridcull/grid/silhouette_3d.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>

#include "gridcull/grid/ball_sections.h"
#include "gridcull/grid/box_distance.h"
#include "gridcull/grid/draw_volumes.h"

namespace gridcull {
namespace {

/// How much farther a solid's far end must be than its near end for slices to pay.
constexpr double worth_slicing = 2.5;

/// A mask is made of blocks of eight rows.
int whole_blocks(int resolution) { return (resolution + 7) / 8 * 8; }

/// The point of a box that is nearest to the viewpoint, or the middle of something else; relative to the viewpoint.
Vec3 front_of(const ConvexPiece& hull, const SightFrame& frame) {
  const Vec3& c = hull.centre;
  const Vec3 front = hull.kind == ConvexPiece::Kind::box ? glm::clamp(frame.apex, c - hull.half, c + hull.half) : c;
  return frame.origin + frame.rotation * front;
}

}  // namespace

void Silhouette3D::run(GridWorld& world, const View& view, Answer& answer, ViewResult& result, DrawSink* draw) {
  const auto start = std::chrono::steady_clock::now();
  const ViewVolume volume(view, world.lattice.dimension());
  world_ = &world;
  shapes_ = world.silhouettes.get();
  volume_ = &volume;
  answer_ = &answer;
  result_ = &result;
  result.seen.clear();
  result.revealed.clear();
  result.occlude_us = 0.0;  // goes on inside the traversal
  answer.viewer = view.viewer;
  answer.visible.clear();
  answer.work = {};
  drawing_ = draw != nullptr;
  walked_.clear();
  begin(view);
  walk();
  answer.work.rasters = mask_.rows();
  const auto walked = std::chrono::steady_clock::now();
  ids_.list(world.objects, result.seen, answer.visible);
  if (draw != nullptr) {
    draw_nodes(shapes_->index, walked_, *draw);
    draw_volumes(
        world, result, [&](Slot slot) { return shapes_->index.ball(slot); }, *draw);
  }
  const auto end = std::chrono::steady_clock::now();
  result.traverse_us = std::chrono::duration<double, std::micro>(walked - start).count();
  result.collect_us = std::chrono::duration<double, std::micro>(end - walked).count();
}

void Silhouette3D::begin(const View& view) {
  GridWorld& world = *world_;
  rides_ = view.rides == no_id ? none : world.objects.find(view.rides);
  const Vec3& apex = volume_->apex();
  apex_size_ = magnitude(apex);
  corner_ = shapes_->index.corner() - apex;
  limit_ = volume_->range() * (1.0 + 1e-12);
  mask_.begin(*volume_, pixels());
  mask_.clear_counts();
  sighted_ = none;
  mask_.set_outlook(outlook_);
  for (int k = 0; k < 3; ++k) outlook_.apex[k] = apex[k];
  outlook_.apex_size = apex_size_, outlook_.rounding = distance_rounding, outlook_.limit = limit_;
  nodes_.clear();
  groups_.clear();
  entries_.clear();
  occluders_.clear();
  rays_.clear();
  sliced_.clear();
  const Bounds box = world.lattice.box();
  blur_ = distance_rounding * (apex_size_ + magnitude(box.min) + magnitude(box.max));
  const double far = std::min(limit_, farthest_of_box(box.min - apex, box.max - apex));
  queue_.begin(std::min(far, distance_to_box(box.min - apex, box.max - apex)), far);
  const int top = shapes_->index.top();
  for (int root = 0; root < 8; ++root) {
    const LooseIndex::NodeId id{top, root & 1, root >> 1 & 1, root >> 2};
    if (shapes_->index.exists(id) && shapes_->index.node(id).below > 0) push_node(id);
  }
  const LooseIndex& index = shapes_->index;
  for (const Slot slot : world.outside) weigh(index.item(index.place_of(slot)), index.place_of(slot));
  weigh_rest();
  push_range(0, static_cast<std::uint32_t>(entries_.size()));
}

// A window of 512 pixels costs a few per cent more than one of 256 and a fifth of the over-estimation. A cube has six
// faces, and what a short range leaves does not need as many: a pixel at the range about as wide as a cell, which is a
// quarter of a typical occluder.
int Silhouette3D::pixels() const {
  if (resolution_ > 0) return whole_blocks(resolution_);
  if (!volume_->all_round()) return 512;
  const double wanted = 2.0 * volume_->range() / (1.25 * world_->lattice.cell());
  return wanted <= 128.0 ? 128 : wanted <= 256.0 ? 256 : 512;
}

std::uint64_t Silhouette3D::mask_bytes(int resolution) { return CoverageMask::bytes_for(whole_blocks(resolution)); }

void Silhouette3D::walk() {
  FrontQueue::Item item;
  while (!mask_.full() && queue_.any_tests() && queue_.pop(item)) {
    switch (item.kind) {
      case FrontQueue::Kind::node: open_node(nodes_[item.what]); break;
      case FrontQueue::Kind::group: look_at_group(groups_[item.what]); break;
      case FrontQueue::Kind::volume: look_at_volume(entries_[item.what]); break;
      case FrontQueue::Kind::object: look(entries_[item.what]); break;
      case FrontQueue::Kind::slice: look_at_slices(sliced_[item.what]); break;
      case FrontQueue::Kind::occluder: enter(occluders_[item.what]); break;
    }
  }
}

// A volume that is open somewhere is given up: its object is read and looked at like any other, when its own depth
// has come, so that answers seldom depend on who has a volume: where an object sticks out of its volume's ball (its own
// ball is about another middle) it may be tested a little later, against more occluders, than without.
void Silhouette3D::look_at_volume(const Entry& entry) {
  ++answer_->work.tbv_tests;
  // Most volumes that are met belong to a crowd deep behind something, and the pixels about them say so.
  if (entry.face >= 0 && !open_pixels(entry)) return;
  const BallRows::Place place = entry.place;
  const Slot slot = shapes_->index.item(place).slot;
  const LooseBall& ball = shapes_->index.item(place).ball;
  if (!mask_.open_ball(ball.centre - volume_->apex(), grown(ball))) return;
  ++answer_->work.tbv_revealed;
  result_->revealed.push_back(slot);
  const Pose pose = world_->read(slot);
  push_object(place, shapes_->ball_at(slot, pose), SilhouetteWorld::stands_upright(shapes_->index.marks(slot), pose));
}

void Silhouette3D::look(const Entry& entry) {
  ++answer_->work.object_tests;
  // Most objects that are met are hidden, and most of those are found to be by the pixels about their ball or box.
  const bool told = entry.face >= 0;
  if (told && !open_pixels(entry)) return;
  const BallRows::Item& item = shapes_->index.item(entry.place);
  const Slot slot = item.slot;
  world_->objects.prefetch(slot);
  if ((item.marks & SilhouetteWorld::is_ball) == 0) shapes_->prefetch_solid(slot);
  const bool has_volume = (item.marks & SilhouetteWorld::is_hidden) != 0;
  const LooseBall ball = has_volume ? shapes_->ball_at(slot, pose_of(slot)) : ball_of(item);
  const bool upright = has_volume ? SilhouetteWorld::stands_upright(item.marks, pose_of(slot))
                                  : SilhouetteWorld::upright_now(item.marks);
  const Vec3 centre = ball.centre - volume_->apex();
  const double radius = grown(ball);
  if (!told && !open_about(item, centre, ball.radius, radius, upright)) return;
  if (glm::dot(centre, centre) <= radius * radius && holds_viewpoint(slot)) {
    result_->seen.push_back(slot);
    return;
  }
  Sliced object{slot, 0, 0.0, 0.0};
  if (!((item.marks & SilhouetteWorld::is_ball) != 0 ? open_as_ball(ball, object) : open_whole(slot, object))) return;
  if (object.farthest > object.nearest) {
    look_at_slices(object);
  } else {
    see(slot);
  }
}

bool Silhouette3D::open_about(const BallRows::Item& item, const Vec3& centre, double radius, double grown,
                              bool upright) const {
  if (!upright) return mask_.open_about_ball(centre, grown);
  const SilhouetteWorld::Filling filling = SilhouetteWorld::filling(item, true, radius, grown);
  const Vec3 half(filling.wide, filling.wide, filling.tall);
  return mask_.open_box(centre - half, centre + half);
}

bool Silhouette3D::holds_viewpoint(Slot slot) const {
  return world_->objects[slot].shape->holds(pose_of(slot), volume_->apex());
}

const SightFrame& Silhouette3D::sight(Slot slot) {
  if (slot != sighted_) {
    const Pose& pose = pose_of(slot);
    frame_ = sight_frame(pose, rotation_of(pose.orientation), volume_->apex());
    sighted_ = slot;
  }
  return frame_;
}

bool Silhouette3D::open_whole(Slot slot, Sliced& object) {
  const SilhouetteWorld::Solid& solid = *shapes_->solid(slot);
  return solid.ball.radius > 0.0 ? open_as_ball(bounding_ball(slot, solid), object) : open_solid(slot, solid, object);
}

bool Silhouette3D::open_as_ball(const LooseBall& ball, Sliced& object) {
  const Vec3 centre = ball.centre - volume_->apex();
  if (mask_.open_towards(centre)) return true;
  if (!mask_.open_ball(centre, ball.radius)) return false;
  const std::array<double, 2> entrance = ball_entrance(glm::length(centre), ball.radius);
  object.nearest = entrance[0];
  object.farthest = entrance[1];
  return true;
}

LooseBall Silhouette3D::bounding_ball(Slot slot, const SilhouetteWorld::Solid& solid) const {
  const Pose& pose = pose_of(slot);
  const Vec3 centre = to_world(pose, rotation_of(pose.orientation), solid.ball.centre);
  return {centre, solid.ball.radius + distance_rounding * (apex_size_ + magnitude(pose.position) +
                                                           magnitude(solid.ball.centre) + solid.ball.radius)};
}

// The box around a solid, with the world's axes, is a first, cheap test.
bool Silhouette3D::open_solid(Slot slot, const SilhouetteWorld::Solid& solid, Sliced& object) {
  const SightFrame& frame = sight(slot);
  if (mask_.open_towards(front_of(solid.outer, frame))) return true;
  const Rotation& r = frame.rotation;
  const Vec3 centre = frame.origin + r * solid.box_centre;
  const double blur = distance_rounding * (apex_size_ + magnitude(pose_of(slot).position) + magnitude(solid.box_half));
  const Vec3 half = glm::abs(r.x) * solid.box_half.x + glm::abs(r.y) * solid.box_half.y +
                    glm::abs(r.z) * solid.box_half.z + Vec3(blur);
  if (!mask_.open_box(centre - half, centre + half)) return false;
  if (!outer_outline({solid.outer, frame}, outline_)) return true;
  if (!open_outline()) return false;
  if (outline_.farthest > worth_slicing * outline_.nearest) {
    object.nearest = outline_.nearest;
    object.farthest = outline_.farthest;
  }
  return true;
}

// A corner of the outline whose pixel is open, as most have that come so far, spares the test of its whole image, which
// would find that pixel.
bool Silhouette3D::open_outline() const {
  const auto rays = std::span(outline_.rays).first(static_cast<std::size_t>(outline_.count));
  return std::any_of(rays.begin(), rays.end(), [this](const Vec3& ray) { return mask_.open_towards(ray); }) ||
         mask_.open_convex(rays.data(), outline_.count);
}

// Slices reach from boundary to boundary; the nearest is looked at at once, each next one when its depth has come and
// nearer occluders are in the mask.
void Silhouette3D::look_at_slices(Sliced object) {
  if (open_slice(object)) {
    see(object.slot);
    return;
  }
  if (++object.slice == slices) return;
  const double key = object.nearest + (object.farthest - object.nearest) * object.slice / slices;
  sliced_.push_back(object);
  queue_.push(FrontQueue::Kind::slice, key, sliced_.size() - 1);
}

bool Silhouette3D::open_slice(const Sliced& object) {
  const double depth = object.farthest - object.nearest;
  const double near = object.nearest + depth * object.slice / slices;
  const double far =
      object.slice + 1 == slices ? object.farthest : object.nearest + depth * (object.slice + 1) / slices;
  const SilhouetteWorld::Solid* solid = shapes_->solid(object.slot);
  if (solid != nullptr && solid->ball.radius == 0.0) {
    const SightFrame& frame = sight(object.slot);
    switch (outer_slice({solid->outer, frame}, near, far, outline_)) {
      case Slice::empty: return false;
      case Slice::unknown: return true;
      case Slice::outline: return open_outline();
    }
  }
  const ObjectState& state = world_->objects[object.slot];
  const LooseBall tested =
      solid != nullptr ? bounding_ball(object.slot, *solid)
                       : LooseBall{pose_of(object.slot).position, std::get<Sphere>(state.shape->shape()).radius};
  const Vec3 centre = tested.centre - volume_->apex();
  const double radius = ball_slice_radius(glm::length(centre), tested.radius, far);
  return radius > 0.0 && mask_.open_ball(centre, radius);
}

void Silhouette3D::see(Slot slot) {
  const ObjectState& state = world_->objects[slot];
  if (in_view(slot)) result_->seen.push_back(slot);
  if (state.occluder) hide_behind(slot);
}

bool Silhouette3D::in_view(Slot slot) const {
  if (volume_->all_round() && !std::isfinite(volume_->range())) return true;
  const ObjectState& state = world_->objects[slot];
  // All of it well within the range, by far more than roundings: so it touches it.
  const Pose& pose = pose_of(slot);
  const Vec3 centre = pose.position - volume_->apex();
  const double within = volume_->range() * (1.0 - 1e-9) - state.reach;
  if (volume_->all_round() && within > 0.0 && glm::dot(centre, centre) < within * within) return true;
  if (!volume_->may_touch_ball(pose.position, state.reach)) return false;
  return state.round || state.shape->may_touch(*volume_, pose);
}

void Silhouette3D::hide_behind(Slot slot) {
  ++answer_->work.occluders;
  const ObjectState& state = world_->objects[slot];
  if (!state.round) {
    hide_behind_pieces(slot);
  } else {
    hide_behind_ball({pose_of(slot).position, std::get<Sphere>(state.shape->shape()).radius});
  }
}

void Silhouette3D::hide_behind_ball(const LooseBall& ball) {
  const Vec3 centre = ball.centre - volume_->apex();
  std::array<BallSection, ball_fractions.size()> sections;
  const int count = ball_sections(glm::length(centre), ball.radius, ball_fractions, sections);
  for (int i = 0; i < count; ++i) {
    const BallSection& section = sections[static_cast<std::size_t>(i)];
    occluders_.push_back({centre, section.radius, 0, 0});
    queue_.push(FrontQueue::Kind::occluder, section.key, occluders_.size() - 1);
  }
}

void Silhouette3D::hide_behind_pieces(Slot slot) {
  const SightFrame& frame = sight(slot);
  for (const ConvexPiece& piece : shapes_->solid(slot)->pieces.pieces) {
    const int count = sections({piece, frame}, sections_);
    for (int i = 0; i < count; ++i) {
      const Section& section = sections_[static_cast<std::size_t>(i)];
      push_loop(section.outline, section.key);
    }
  }
}

void Silhouette3D::push_loop(const Outline& loop, double key) {
  occluders_.push_back({{}, 0.0, static_cast<std::uint32_t>(rays_.size()), static_cast<std::uint32_t>(loop.count)});
  rays_.insert(rays_.end(), loop.rays.begin(), loop.rays.begin() + loop.count);
  queue_.push(FrontQueue::Kind::occluder, key, occluders_.size() - 1);
}

void Silhouette3D::enter(const Occluder& occluder) {
  if (occluder.radius > 0.0) {
    mask_.cover_ball(occluder.centre, occluder.radius);
  } else {
    mask_.cover_convex(&rays_[occluder.rays], static_cast<int>(occluder.count));
  }
}

std::uint64_t Silhouette3D::bytes() const {
  return mask_.bytes() + queue_.bytes() + occluders_.capacity() * sizeof(Occluder) + rays_.capacity() * sizeof(Vec3) +
         sliced_.capacity() * sizeof(Sliced) + nodes_.capacity() * sizeof(LooseIndex::NodeId) +
         groups_.capacity() * sizeof(Group) + entries_.capacity() * sizeof(Entry) +
         waiting_.capacity() * sizeof(BallRows::Place);
}

}  // namespace gridcull
