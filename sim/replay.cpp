#include "gridcull/sim/replay.h"

#include <algorithm>
#include <cmath>

namespace gridcull {

Replay::Replay(Culler& culler, const Scene& scene, FrameSource* frames, Feed feed)
    : culler_(culler), frames_(frames), feed_(feed), world_(scene) {
  for (const SceneObject& object : scene.objects) culler_.add(object.object);
  if (feed_ == Feed::pull) culler_.set_source(this);
}

Replay::~Replay() {
  if (feed_ != Feed::pull) return;
  try {
    culler_.set_source(nullptr);
  } catch (...) {  // a destructor must not throw, and there is nobody left to ask
  }
}

Pose Replay::pose(ObjectId object) { return world_.object(object).pose; }

bool Replay::take_frame() {
  if (frames_) return frames_->next(current_);
  current_ = Frame{};
  return next_frame_ == 0;
}

bool Replay::step() {
  if (!take_frame()) return false;
  before_.clear();
  if (feed_ == Feed::pull) note_places();
  const std::optional<double> last = world_.time();
  world_.apply(current_);
  feed_objects(last ? current_.time - *last : 0.0);
  world_.views(views_);
  culler_.query(current_.time, views_, answers_);
  ++next_frame_;
  return true;
}

void Replay::note_places() {
  for (std::size_t i = 0; i < current_.moves(); ++i) {
    // An unknown id is refused by apply(); one that is added in this frame has no place before it.
    const ObjectId id = current_.moved(i);
    before_.push_back(world_.has(id) ? world_.object(id).pose.position : Vec3(0.0));
  }
}

void Replay::feed_objects(double seconds) {
  for (const ObjectId id : current_.remove) culler_.remove(id);
  std::vector<ObjectId> added;
  for (const SceneObject& object : current_.add) {
    // Where it stands at the end of the frame: a `set` of the same frame is then done.
    culler_.add(world_.object(object.object.id));
    added.push_back(object.object.id);
  }
  std::sort(added.begin(), added.end());
  moves_.clear();
  const BulkMoves& bulk = current_.bulk;
  if (feed_ == Feed::push && added.empty() && bulk.positions && bulk.orientations) {
    // Whole poses as they came: nobody has to look the objects up.
    for (std::size_t i = 0; i < bulk.ids.size(); ++i) moves_.push_back({bulk.ids[i], bulk.poses[i]});
    return culler_.move_all(moves_);
  }
  for (std::size_t i = 0; i < current_.moves(); ++i) {
    if (added.empty() || !std::binary_search(added.begin(), added.end(), current_.moved(i))) {
      feed_move(world_.set_object(i), feed_ == Feed::pull ? before_[i] : Vec3(0.0), seconds);
    }
  }
  culler_.move_all(moves_);
}

void Replay::feed_move(const Object& object, const Vec3& before, double seconds) {
  if (feed_ == Feed::push || object.is_static) {
    moves_.push_back({object.id, object.pose});
    return;
  }
  // Without max_speed there is no bounding volume to leave, before the first query there is none yet.
  if (!object.max_speed || next_frame_ == 0) return;
  const double way = glm::length(object.pose.position - before);
  if (way > *object.max_speed * seconds * (1.0 + 1e-9)) culler_.announce_jump(object.id);
}

}  // namespace gridcull
