// Objects coming, going and moving between frames, and their way between the matrices I and T.
#include <algorithm>
#include <limits>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/core/memory_limit.h"
#include "gridcull/grid/engine_state.h"
#include "gridcull/grid/silhouette_3d.h"
#include "gridcull/grid/silhouette_task_2d.h"
#include "gridcull/grid/view_task.h"

namespace gridcull {
namespace {

Lattice make_lattice(const GridOptions& o) {
  return {o.dimension, o.bounds, o.cell, o.max_memory, o.store == StoreKind::dense ? Room::whole : Room::where_needed};
}

/// Every task has a mask of its own, beside the matrices that all share. The standard ones, 0.2 MB each, are not
/// counted: a grid that fits is not to be refused for them.
void check_masks(const GridOptions& o, const Lattice& lattice) {
  if (o.hiding != Hiding::silhouette || o.dimension != 3 || o.resolution == 0) return;
  // Cells that take room where something is are counted by their store.
  const std::uint64_t matrices =
      o.store == StoreKind::dense ? Lattice::bytes_for(o.dimension, lattice.cells()) : std::uint64_t{0};
  const auto bytes_of = [&](int resolution) {
    return matrices + static_cast<std::uint64_t>(o.threads) * Silhouette3D::mask_bytes(resolution);
  };
  refuse_resolution(o.max_memory, o.resolution,
                    "the grid and a mask of six faces for each thread (" + std::to_string(o.threads) + ") need",
                    bytes_of);
}

std::unique_ptr<ViewAnswerer> make_answerer(const GridOptions& o) {
  if (o.hiding == Hiding::voxel) return std::make_unique<ViewTask>();
  if (o.dimension == 2) return std::make_unique<SilhouetteTask2D>();
  return std::make_unique<Silhouette3D>(o.resolution, choose_instruction_set());
}

}  // namespace

GridEngine::State::State(const GridOptions& o)
    : options(o),
      world(make_lattice(o), o.hiding == Hiding::silhouette, o.bound, o.store, o.max_memory),
      terms(o.cell) {
  check_masks(o, world.lattice);
  for (int i = 0; i < o.threads; ++i) tasks.push_back(make_answerer(o));
}

Slot GridEngine::State::slot_of(ObjectId object) const {
  const Slot slot = world.objects.find(object);
  if (slot == none) throw Error(ErrorCode::unknown_object, "object " + std::to_string(object) + " is not there");
  return slot;
}

void GridEngine::State::add(const Object& object) {
  const std::string where = "object " + std::to_string(object.id) + ": ";
  if (object.id == no_id) throw Error(ErrorCode::bad_scene, where + "expected an id of at most 2^32 - 2");
  if (world.objects.find(object.id) != none) throw Error(ErrorCode::bad_scene, where + "the id is there already");
  if (dimension_of(object.shape) != options.dimension) {
    throw Error(ErrorCode::bad_scene, where + "expected a " + std::to_string(options.dimension) + "D shape, found " +
                                          std::string(name_of(object.shape)));
  }
  if (object.max_speed && !(*object.max_speed >= 0.0 && *object.max_speed <= 1e9)) {
    throw Error(ErrorCode::bad_scene, where + "expected max_speed 0 .. 1e9");
  }
  check_pose(object.pose, object.id, options.dimension);
  validate(object.shape);
  PreparedShape shape(object.shape);
  const Slot slot = world.objects.add(object.id);
  ObjectState& state = world.objects[slot];
  state.shape.emplace(std::move(shape));
  state.reach = state.shape->reach();
  state.round = std::holds_alternative<Disc>(object.shape) || std::holds_alternative<Sphere>(object.shape);
  world.objects.whereabouts(slot).pose = object.pose;
  state.occluder = object.occluder;
  state.is_static = object.is_static;
  const double max_speed = object.max_speed ? *object.max_speed : -1.0;
  world.objects.set_max_speed(slot, max_speed);
  state.may_hide = state.moves() && max_speed >= 0.0;
  if (max_speed > 0.0) state.term = static_cast<float>(terms.first(max_speed));
  state.known = object.is_static && options.static_cells && options.static_cells->find(object) != nullptr;
  state.tiled = world.tiles != nullptr && world.tiles->adopt(object, slot);
  state.place = Place::waiting;
  waiting.push_back(slot);
  const std::size_t slots = world.objects.size();
  if (world.silhouettes) {
    world.silhouettes->reserve(slots);
    world.silhouettes->add(slot, object.shape, object.occluder);
  } else {
    world.tbv.reserve(slots);
    world.hollow.reserve(slots);
  }
  expiries.reserve(slots);
  seen.resize(slots, 0);
  if (follows_at_once() && slots > stale.capacity()) stale.reserve(slots + slots / 8);
  // No frame may run out of memory between taking somebody out of the index and listing it there.
  if (slots > world.outside.capacity()) world.outside.reserve(slots + slots / 8);
  seen[slot] = 0;
}

void GridEngine::State::remove(Slot slot) {
  ObjectState& state = world.objects[slot];
  const Place place = state.place;
  leave_tiles(slot);
  leave_grid(slot);
  // Only the lists that can hold the slot are searched, from the back: what came last mostly goes first.
  const auto drop = [&](std::vector<Slot>& list) {
    const auto found = std::find(list.rbegin(), list.rend(), slot);
    if (found != list.rend()) list.erase(std::next(found).base());
  };
  if (place == Place::waiting) drop(waiting);
  if (place == Place::active && !state.is_static) unlist_active(slot);
  if (state.jumped) drop(jumped);
  if (world.objects.whereabouts(slot).pushed == round) {
    for (auto* list : {&pushed, &pushed_strays}) {
      std::erase_if(*list, [&](const Pushed& p) { return p.slot == slot; });
    }
  }
  if (world.silhouettes) world.silhouettes->remove(slot);
  world.objects.remove(slot);
}

void GridEngine::State::set_outside(Slot slot, bool outside) {
  ObjectState& state = world.objects[slot];
  if (state.outside == outside) return;
  if (outside) {
    world.outside.push_back(slot);
    state.outside_place = static_cast<std::uint32_t>(world.outside.size() - 1);
    state.outside = true;
    return;
  }
  state.outside = false;
  const Slot last = world.outside.back();
  world.outside[state.outside_place] = last;
  world.objects[last].outside_place = state.outside_place;
  world.outside.pop_back();
}

// Known cells are used once, when the object is first entered: later changes are discretised.
void GridEngine::State::find_cells(Slot slot) {
  ObjectState& state = world.objects[slot];
  if (!state.known) return state.shape->cover(world.lattice, world.objects.pose(slot), scratch, cover_buffer);
  const StaticCells& cells = *options.static_cells;
  const StaticCells::Member& member = *cells.find_id(state.id);
  const auto bricks = cells.of(member);
  cover_buffer.bricks.assign(bricks.begin(), bricks.end());
  cover_buffer.outside = member.outside;
  state.known = false;
}

// Stale until all is done: whoever is torn out of it by want of memory is covered in the next frame.
void GridEngine::State::cover(Slot slot) {
  ObjectState& state = world.objects[slot];
  if (world.silhouettes) {
    hang(slot);
  } else if (state.tiled) {
    set_outside(slot, world.tiles->reaches_outside(state.id));
  } else {
    find_cells(slot);
    world.matrix.update(slot, cover_buffer, state.occluder, state.is_static, state.entries);
    set_outside(slot, cover_buffer.outside);
  }
  world.objects.whereabouts(slot).stale = false;
}

// The object's own ball, in the index.
void GridEngine::State::hang(Slot slot) {
  SilhouetteWorld& shapes = *world.silhouettes;
  Whereabouts& where = world.objects.whereabouts(slot);
  const Pose& pose = where.pose;
  shapes.note_stance(slot, pose);
  if ((where.marks & SilhouetteWorld::is_loose) != 0) {
    // Neither the object's state nor its shape is needed, and both are cold.
    const double wanted = room(slot);
    const bool follows = shapes.index.slack(slot) >= wanted && shapes.index.follow(slot, pose.position);
    if (!follows && !shapes.enter(slot, {pose.position, shapes.index.ball(slot).radius}, wanted)) {
      set_outside(slot, true);
      return unleash(slot);
    }
    where.leash = shapes.leash(slot);
    where.marks = shapes.index.marks(slot);
    return;
  }
  shapes.place(slot, pose);
  shapes.rows.remove(slot);
  if (!shapes.follow(slot, pose)) set_outside(slot, !shapes.enter(slot, shapes.ball_at(slot, pose), room(slot)));
  if (!world.objects[slot].moves()) {
    if (options.dimension == 2) shapes.note_static(slot);
    return;
  }
  const float leash = shapes.loosen(slot);
  if (leash < 0.0F) return;
  // Not all at full length: whoever is of a size and a speed would come back in the same frames.
  where.leash = static_cast<float>(TbvTerm::spread(leash, slot, 0));
  where.marks = shapes.index.marks(slot);
}

void GridEngine::State::unleash(Slot slot) {
  Whereabouts& where = world.objects.whereabouts(slot);
  where.leash = -1.0F;
  if ((where.marks & SilhouetteWorld::is_loose) != 0) world.silhouettes->tighten(slot);
  where.marks = 0;
}

void GridEngine::State::leave_tiles(Slot slot) {
  ObjectState& state = world.objects[slot];
  if (state.tiled) world.tiles->release(state.id);
  state.tiled = false;
}

void GridEngine::State::leave_grid(Slot slot) {
  ObjectState& state = world.objects[slot];
  if (state.place == Place::hidden) take_volume(slot);
  if (world.silhouettes) {
    world.silhouettes->leave(slot);
  } else {
    world.matrix.remove(state.is_static, state.entries);
  }
  set_outside(slot, false);
}

void GridEngine::State::activate(Slot slot) {
  ObjectState& state = world.objects[slot];
  if (state.place == Place::hidden) take_volume(slot);
  set_outside(slot, false);
  state.place = Place::active;
  if (world.silhouettes) world.silhouettes->set_hidden(slot, false);
  mark_stale(slot);
  list_active(slot);
}

void GridEngine::State::list_active(Slot slot) {
  world.objects[slot].active_place = static_cast<std::uint32_t>(active.size());
  active.push_back(slot);
}

void GridEngine::State::unlist_active(Slot slot) {
  const std::uint32_t place = world.objects[slot].active_place;
  active[place] = active.back();
  world.objects[active[place]].active_place = place;
  active.pop_back();
}

void GridEngine::State::hide(Slot slot) {
  if (!world.silhouettes) leave_grid(slot);
  ObjectState& state = world.objects[slot];
  state.place = Place::hidden;
  if (world.silhouettes) {
    unleash(slot);
    world.silhouettes->set_hidden(slot, true);
  }
  while (lengthen_term(slot)) {
  }
  give_volume(slot);
}

// A volume that reaches into bricks that somebody sees would be revealed at once.
bool GridEngine::State::lengthen_term(Slot slot) {
  ObjectState& state = world.objects[slot];
  const double max_speed = world.objects.max_speed(slot);
  if (!(max_speed > 0.0)) return false;
  const SilhouetteWorld* shapes = world.silhouettes.get();
  const double widest = shapes != nullptr ? 0.5 * shapes->index.side(shapes->index.top()) : terms.widest();
  const auto longer = static_cast<float>(terms.longer(state.term, max_speed, widest));
  if (!(longer > state.term)) return false;
  const TbvMatrix::Ball grown{world.objects.pose(slot).position, TbvTerm::radius(max_speed, longer, state.reach)};
  if (shapes != nullptr ? !looks_deep({grown.centre, grown.radius})
                        : !world.tbv.fits(grown) || world.near_seen(grown)) {
    return false;
  }
  state.term = longer;
  return true;
}

// Wider volumes hang in coarser nodes, which reach farther towards the viewers: once those are opened, everything in
// them is looked at in every frame.
bool GridEngine::State::looks_deep(const LooseBall& ball) const {
  const LooseIndex& index = world.silhouettes->index;
  return index.takes(ball) && !index.lately_opened(ball);
}

TbvMatrix::Ball GridEngine::State::volume(Slot slot) const {
  if (!world.silhouettes) return world.tbv.ball(slot);
  const LooseBall& ball = world.silhouettes->index.ball(slot);
  return {ball.centre, ball.radius};
}

// The ball that holds the object from now until the expiry that it notes.
TbvMatrix::Ball GridEngine::State::next_ball(Slot slot) {
  ObjectState& state = world.objects[slot];
  const double max_speed = world.objects.max_speed(slot);
  double seconds = std::numeric_limits<double>::infinity();
  if (max_speed > 0.0) seconds = TbvTerm::spread(state.term, slot, state.renewals++);
  // Far from time 0 the sum is rounded, perhaps to a later time: the volume must hold until that.
  const double expiry = now + seconds;
  expiries.push(slot, expiry);
  const Vec3& centre = world.objects.pose(slot).position;
  const TbvMatrix::Ball ball{centre, TbvTerm::radius(max_speed, expiry - now, state.reach)};
  leash_in_volume(slot, centre, ball);
  return ball;
}

void GridEngine::State::give_volume(Slot slot) {
  ++volumes;
  place_volume(slot, next_ball(slot));
}

// Solid volumes are always right; an outline is used only where the engine can prove it: it lies wholly in the
// lattice and encloses no viewer now, and viewers that jump are checked against it (note_viewers).
void GridEngine::State::place_volume(Slot slot, const TbvMatrix::Ball& ball) {
  if (world.silhouettes) {
    set_outside(slot, !world.silhouettes->enter(slot, {ball.centre, ball.radius}));
    return;
  }
  world.tbv.set_ball(slot, ball);
  if (!world.tbv.fits(ball)) {
    set_outside(slot, true);
    return;
  }
  ObjectState& state = world.objects[slot];
  state.hollow = options.tbv == TbvMode::hollow && world.hollow.insert(slot, ball, viewers.cells());
  if (!state.hollow) world.tbv.insert(slot, ball);
}

// Most volumes stay in the same place of T when they expire, which costs little.
void GridEngine::State::renew_volume(Slot slot) {
  const bool stays = options.tbv != TbvMode::hollow && world.tbv.holds(slot);
  if (!stays) take_volume(slot);
  lengthen_term(slot);
  if (!stays) return give_volume(slot);
  const TbvMatrix::Ball ball = next_ball(slot);
  if (world.tbv.fits(ball)) return world.tbv.renew(slot, ball);
  world.tbv.erase(slot);
  place_volume(slot, ball);
}

void GridEngine::State::take_volume(Slot slot) {
  ObjectState& state = world.objects[slot];
  expiries.erase(slot);
  --volumes;
  if (world.silhouettes) {
    // Left where it is: it is placed anew at once, or erased in leave_grid().
    set_outside(slot, false);
    return;
  }
  if (state.hollow) {
    world.hollow.erase(slot);
    state.hollow = false;
  } else if (world.tbv.holds(slot)) {
    world.tbv.erase(slot);
  }
  set_outside(slot, false);
}

}  // namespace gridcull
