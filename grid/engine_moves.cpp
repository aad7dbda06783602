// Moves: told between frames, judged and settled at the start of the next.
//
// A crowd that is told of in every frame costs what it reads and writes: what is told, and of each object its
// Whereabouts (object_table.h) and 32 bytes for the judgement of jumps. The index is not touched as long as an object
// is on its leash.
//
// Claim: an object on its leash lies within the loose box of the node that its ball hangs in. The ball is about the
// place where the object was when the index was last told; since then it went no farther than the slack that its node
// leaves (LooseIndex::slack()), so that it lies in a ball of half the node's side about that place, which the loose box
// holds like any other that hangs there. Walks ask for its true place when they meet it (is_loose).
//
// Claim: a hidden object on its leash lies within its volume. The leash is what the volume leaves about the object's
// reach, from the place where it was when that was measured; the way since then is at most as long. So whether it left
// its volume, which jumped_since() would ask, needs not be asked, and its volume and state stay cold.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gridcull/grid/engine_state.h"

namespace gridcull {
namespace {

constexpr std::size_t ahead = 12;  // objects

/// Frames that a leash shall last at the object's greatest speed: so seldom an object costs as much as a dozen moves.
constexpr double leash_frames = 8.0;

bool same(const Pose& a, const Pose& b) {
  const Quat &p = a.orientation, &q = b.orientation;
  return a.position == b.position && p.w == q.w && p.x == q.x && p.y == q.y && p.z == q.z;
}

}  // namespace

// A wish: LooseIndex::place() bounds it.
double GridEngine::State::room(Slot slot) const {
  if (!world.objects[slot].moves()) return 0.0;
  return leash_frames * std::max(0.0, world.objects.max_speed(slot)) * (now - before);
}

// What is left of a leash is at most what is left of the slack: the way is rounded up and the difference down, by 2^-20
// of way and leash, where the roundings of a square, a root, two products, a sum and of the float are below 2^-23 of
// the greater of both. (Ways whose squares underflow are below 1e-150 m: no number of them adds up to anything.)
inline bool GridEngine::State::stays_on_leash(Whereabouts& where, const Pose& to, double square) {
  const bool upright = (where.marks & SilhouetteWorld::is_upright) != 0;
  if (upright != SilhouetteWorld::stands_upright(where.marks, to)) return false;
  const auto left = static_cast<float>((1.0 - 0x1p-20) * where.leash - (1.0 + 0x1p-20) * std::sqrt(square));
  if (!(left >= 0.0F)) return false;
  where.leash = left;
  return true;
}

// Rounded down by 2^-20, far more than what the float and the way's root round; what the sums round is below the 1e-12
// of the radius that jumped_since() allows. A source gives poses of which no leash is told.
bool GridEngine::State::leash_in_volume(Slot slot, const Vec3& position, const TbvMatrix::Ball& ball) {
  const double left = ball.radius - world.objects[slot].reach - glm::length(position - ball.centre);
  const bool within = world.source == nullptr && left >= 0.0;
  world.objects.whereabouts(slot).leash = within ? static_cast<float>((1.0 - 0x1p-20) * left) : -1.0F;
  return within;
}

// Whether it is a jump is judged when the frame's time is known. Until then: from where, and how long the farthest of
// these ways takes.
inline void GridEngine::State::note_pushed(Slot slot, double square, std::vector<Pushed>& list) {
  const double max_speed = world.objects.max_speed(slot);
  if (max_speed < 0.0) return;
  Whereabouts& where = world.objects.whereabouts(slot);
  if (where.pushed == round) {
    pushed_needs = std::numeric_limits<double>::infinity();  // two ways: look at their sum
    return;
  }
  where.pushed = round;
  // Part by part: a whole one, put together elsewhere and copied, waits for its parts to be stored.
  Pushed& kept = list.emplace_back();
  kept.slot = slot;
  kept.from = where.pose.position;
  pushed_needs = std::max(pushed_needs, square / (max_speed * max_speed));
}

void GridEngine::State::move(Slot slot, const Pose& pose) {
  Whereabouts& where = world.objects.whereabouts(slot);
  const Vec3 way = pose.position - where.pose.position;
  const double square = glm::dot(way, way);
  // Only a moving object that stands in the index or has a volume has a leash, be it at its end.
  if (stays_on_leash(where, pose, square)) {
    note_pushed(slot, square, pushed);
    where.pose = pose;
    return;
  }
  if ((where.marks & SilhouetteWorld::is_loose) == 0) return move_in_full(slot, pose, square);
  note_pushed(slot, square, pushed);
  where.pose = pose;
  mark_stale(slot);
}

void GridEngine::State::move_in_full(Slot slot, const Pose& pose, double square) {
  ObjectState& state = world.objects[slot];
  // Simulators that tell everything in every step tell of what stands still too.
  if (state.is_static && same(world.objects.pose(slot), pose)) return;
  const bool strays = state.place == Place::hidden && !leash_in_volume(slot, pose.position, volume(slot));
  // A moving object that waits was added since the last frame: it has no place there to have jumped from.
  if (state.moves() && state.place != Place::waiting) note_pushed(slot, square, strays ? pushed_strays : pushed);
  world.objects.whereabouts(slot).pose = pose;
  state.known = false;
  leave_tiles(slot);
  if (state.place == Place::hidden) return;  // settled when the frame's time is known
  mark_stale(slot);
  if (state.is_static && state.place == Place::active) {
    state.place = Place::waiting;
    waiting.push_back(slot);
  }
}

// All are checked before the first is told.
void GridEngine::State::move_all(std::span<const Move> moves) {
  told.clear();
  for (const Move& m : moves) {
    told.push_back(slot_of(m.object));
    check_pose(m.pose, m.object, options.dimension);
  }
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (i + ahead < told.size()) world.objects.prefetch_whereabouts(told[i + ahead]);
    move(told[i], moves[i].pose);
  }
}

void GridEngine::State::mark_stale(Slot slot) {
  Whereabouts& where = world.objects.whereabouts(slot);
  where.leash = -1.0F;
  if (follows_at_once() && !where.stale) {
    if (stale.size() == stale.capacity()) forget_removed();
    stale.push_back(slot);
  }
  where.stale = true;
}

// The list has room for every slot once (add()): it is full only of objects that are gone, where frames keep failing.
void GridEngine::State::forget_removed() {
  std::erase_if(stale, [&](Slot slot) { return !world.objects.whereabouts(slot).stale; });
  std::sort(stale.begin(), stale.end());  // a slot that was used again may be there twice
  stale.erase(std::unique(stale.begin(), stale.end()), stale.end());
}

// A hidden object that moved farther than its max_speed allows since the last frame may be anywhere: it is
// discretised again. Pushed moves are judged here, since only now the frame's time is known; a pull source
// announces them by the same rule. One compare says that nobody went too far; the quotients of pushed_needs are right
// to 2^-50, and half of the rule's 1e-9 is left to them. Who may have left its volume is looked at besides.
void GridEngine::State::settle_jumps(double time) {
  const double step = started ? time - before : std::numeric_limits<double>::infinity();
  const auto judge = [&](const std::vector<Pushed>& list) {
    for (const Pushed& p : list) {
      ObjectState& state = world.objects[p.slot];
      if (state.jumped || !jumped_since(p, step, time)) continue;
      state.jumped = true;
      jumped.push_back(p.slot);
    }
  };
  if (!(pushed_needs <= step * step * (1.0 + 1e-9))) judge(pushed);
  judge(pushed_strays);
  pushed_needs = 0.0;
  pushed.clear();
  pushed_strays.clear();
  if (++round == 0) {
    world.objects.forget_pushes();
    round = 1;
  }
  for (const Slot slot : jumped) {
    ObjectState& state = world.objects[slot];
    state.jumped = false;
    ++stats.jumps;
    if (state.place == Place::hidden) activate(slot);
  }
  jumped.clear();
}

bool GridEngine::State::jumped_since(const Pushed& push, double step, double time) const {
  const Vec3& position = world.objects.pose(push.slot).position;
  const Vec3 way = position - push.from;
  const double most = world.objects.max_speed(push.slot) * step;
  // The rule compares lengths; squares, which need no root, settle all that are clearly shorter.
  if (started && glm::dot(way, way) >= most * most && glm::length(way) > most * (1.0 + 1e-9)) return true;
  // A volume past its term is renewed in expire(): leaving it is no jump (the pull rule has none there either).
  const ObjectState& state = world.objects[push.slot];
  if (state.place != Place::hidden || expiries.expiry(push.slot) < time) return false;
  const TbvMatrix::Ball ball = volume(push.slot);
  return glm::length(position - ball.centre) + state.reach > ball.radius * (1.0 + 1e-12);
}

void GridEngine::State::read_active() {
  for (const Slot slot : active) {
    Whereabouts& where = world.objects.whereabouts(slot);
    const Pose old = where.pose;
    const Pose& pose = world.read_alone(slot);
    const Vec3 way = pose.position - old.position;
    if (!same(old, pose) && !stays_on_leash(where, pose, glm::dot(way, way))) mark_stale(slot);
    if (where.stale) cover(slot);
  }
}

// move() has written the poses and said who moved.
void GridEngine::State::follow_pushed() {
  for (const Slot slot : active) {
    world.note_read(world.objects[slot]);
    if (world.objects.whereabouts(slot).stale) cover(slot);
  }
}

// The same, where most moved on their leashes. All count as read; nobody was before: only hidden objects are.
void GridEngine::State::follow_stale() {
  world.positions_read += active.size();
  const LooseIndex& index = world.silhouettes->index;
  const auto soon = [&](std::size_t i, std::size_t steps) {
    return i + steps < stale.size() ? stale[i + steps] : none;
  };
  for (std::size_t i = 0; i < stale.size(); ++i) {
    // Whoever leaves its node touches memory in five places, most of them cold in a crowd.
    if (const Slot slot = soon(i, 3 * ahead / 2); slot != none) {
      world.objects.prefetch_whereabouts(slot);
      index.prefetch(slot);
    }
    if (const Slot slot = soon(i, ahead); slot != none) index.prefetch_node(slot);
    if (const Slot slot = soon(i, ahead / 2); slot != none) index.prefetch_row(slot);
    // Whoever is hidden by now, or gone, is not stale.
    if (world.objects.whereabouts(stale[i]).stale) cover(stale[i]);
  }
}

}  // namespace gridcull
