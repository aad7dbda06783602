#include "gridcull/sim/world.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_set>
#include <utility>

#include "gridcull/core/error.h"
#include "gridcull/sim/json_text.h"
#include "gridcull/sim/scene_json.h"

namespace gridcull {
namespace {

std::string source(const Frame& frame) { return (frame.where.empty() ? "frame" : frame.where) + ": "; }

/// The place in a list of a frame, for a refusal.
std::string at(const Frame& frame, std::string_view list, std::size_t i, std::string_view key = "") {
  return source(frame) + "/" + std::string(list) + "/" + std::to_string(i) + std::string(key) + ": ";
}

[[noreturn]] void refuse_unknown(const std::string& place, std::string_view what, std::uint32_t id,
                                 const std::string& which = "") {
  throw Error(ErrorCode::unknown_object, place + "expected the id of " + std::string(what) + " that is there, found " +
                                             std::to_string(id) + which);
}

[[noreturn]] void refuse(const std::string& place, const std::string& why) {
  throw Error(ErrorCode::bad_frame, place + why);
}

[[noreturn]] void refuse_twice(const std::string& place, std::uint32_t id) {
  refuse(place, "expected each id once, found " + std::to_string(id) + " twice");
}

/// Ids in bulk are one string of bytes, which has no places that a pointer could name.
constexpr const char* bulk_ids = "/set_ids: ";

[[noreturn]] void refuse_unknown_move(const Frame& frame, std::size_t i) {
  if (!frame.set.empty()) refuse_unknown(at(frame, "set", i, "/id"), "an object", frame.moved(i));
  refuse_unknown(source(frame) + bulk_ids, "an object", frame.moved(i), " at place " + std::to_string(i));
}

/// What a place may be away from the origin along an axis, metres (FORMATS: magnitudes of numbers).
constexpr double edge_of_world = 1e9;

double largest(const Vec3& p) { return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}); }

double length_of_offset(const SceneViewer& viewer) {
  return viewer.follows ? glm::length(viewer.pose.position) * (1.0 + 1e-8) : 0.0;
}

bool out_of_world(const Pose& base, const SceneViewer& viewer) {
  return largest(to_world(base, rotation_of(base.orientation), viewer.pose.position)) > edge_of_world;
}

/// Whether an object is moved twice. Ids that ascend, the usual case of the longest list, are seen without a table.
bool moves_one_twice(const Frame& frame) {
  bool ascending = true;
  for (std::size_t i = 1; i < frame.moves(); ++i) ascending &= frame.moved(i - 1) < frame.moved(i);
  if (ascending) return false;
  std::vector<ObjectId> ids(frame.moves());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = frame.moved(i);
  return first_repeated(ids).has_value();
}

void keep_farthest(double& farthest, const BulkMoves& bulk) {
  if (!bulk.positions) return;
  for (const Pose& pose : bulk.poses) farthest = std::max(farthest, largest(pose.position));
}

}  // namespace

/// What a frame does, found out before anything is changed.
struct World::Plan {
  std::unordered_set<ObjectId> removed{}, added{}, set{};
  std::unordered_set<ViewerId> dropped{};
  std::vector<SceneViewer> viewers{};  ///< after their updates
  bool same_places = false;            ///< the frame moves what the last one moved, in the same order
  double farthest_object = 0.0, longest_offset = 0.0;
};

World::World(const Scene& scene) : dimension_(scene.dimension) {
  for (const SceneObject& object : scene.objects) {
    const ObjectId id = object.object.id;
    if (dimension_of(object.object.shape) != dimension_) {
      throw Error(ErrorCode::bad_scene, "object " + std::to_string(id) + ": its shape is not of the scene's dimension");
    }
    if (has(id)) throw Error(ErrorCode::bad_scene, "object " + std::to_string(id) + ": the id is there twice");
    insert(object.object);
  }
  for (const SceneViewer& viewer : scene.viewers) {
    const std::string name = "viewer " + std::to_string(viewer.id);
    if (viewer.follows && !has(*viewer.follows)) {
      throw Error(ErrorCode::bad_scene,
                  name + ": follows object " + std::to_string(*viewer.follows) + ", which is not there");
    }
    if (viewer.follows && out_of_world(object(*viewer.follows).pose, viewer)) {
      throw Error(ErrorCode::bad_scene, name + ": expected a viewpoint of magnitude at most 1e9");
    }
    longest_offset_ = std::max(longest_offset_, length_of_offset(viewer));
    if (!viewers_.emplace(viewer.id, viewer).second)
      throw Error(ErrorCode::bad_scene, name + ": the id is there twice");
  }
}

bool World::has_after(ObjectId id, const Plan& plan) const {
  return plan.added.contains(id) || (has(id) && !plan.removed.contains(id));
}

void World::check_objects(const Frame& frame, Plan& plan) const {
  for (std::size_t i = 0; i < frame.remove.size(); ++i) {
    const ObjectId id = frame.remove[i];
    if (!has(id)) refuse_unknown(at(frame, "remove", i), "an object", id);
    if (!plan.removed.insert(id).second) refuse_twice(at(frame, "remove", i), id);
  }
  for (std::size_t i = 0; i < frame.add.size(); ++i) {
    const Object& object = frame.add[i].object;
    if (object.id == no_id) refuse(at(frame, "add", i, "/id"), "expected an id");
    if (plan.added.contains(object.id)) refuse_twice(at(frame, "add", i, "/id"), object.id);
    if (has_after(object.id, plan)) {
      refuse(at(frame, "add", i, "/id"),
             "expected a new id, found " + std::to_string(object.id) + ", which is there already");
    }
    if (dimension_of(object.shape) != dimension_) {
      refuse(at(frame, "add", i, "/shape"), "expected a " + std::to_string(dimension_) + "D shape");
    }
    plan.added.insert(object.id);
  }
  check_moves(frame, plan);
}

/// A simulator names its objects in the same order frame after frame: the last place is tried first.
void World::check_moves(const Frame& frame, Plan& plan) const {
  const std::size_t count = frame.moves();
  if (!frame.set.empty() && !frame.bulk.ids.empty()) {
    throw Error(ErrorCode::bad_frame, source(frame) + "/set: expected moves in a list or in bulk, found both");
  }
  std::size_t same = 0;
  while (same < count && same_place(same, frame.moved(same))) ++same;
  // Then they are as different as the last frame's.
  plan.same_places = same == count && frame.remove.empty();
  if (plan.same_places) return;
  const bool twice = moves_one_twice(frame);
  for (std::size_t i = 0; i < count; ++i) {
    const ObjectId id = frame.moved(i);
    const bool as_before = frame.remove.empty() && same_place(i, id);
    if (!as_before && !has_after(id, plan)) refuse_unknown_move(frame, i);
    if (!twice || plan.set.insert(id).second) continue;
    refuse_twice(frame.set.empty() ? source(frame) + bulk_ids : at(frame, "set", i, "/id"), id);
  }
}

void World::check_viewers(const Frame& frame, Plan& plan) const {
  for (std::size_t i = 0; i < frame.drop_viewers.size(); ++i) {
    const ViewerId id = frame.drop_viewers[i];
    if (!viewers_.contains(id)) refuse_unknown(at(frame, "drop_viewers", i), "a viewer", id);
    if (!plan.dropped.insert(id).second) refuse_twice(at(frame, "drop_viewers", i), id);
  }
  std::unordered_set<ViewerId> named;
  for (std::size_t i = 0; i < frame.viewers.size(); ++i) {
    const ViewerUpdate& update = frame.viewers[i];
    if (update.id == no_id) refuse(at(frame, "viewers", i, "/id"), "expected an id");
    if (!named.insert(update.id).second) refuse_twice(at(frame, "viewers", i, "/id"), update.id);
    const auto known = viewers_.find(update.id);
    const bool is_new = known == viewers_.end() || plan.dropped.contains(update.id);
    const SceneViewer* viewer = is_new ? nullptr : &known->second;
    const std::string fault = fault_of(viewer, update);
    if (!fault.empty()) refuse(at(frame, "viewers", i), fault);
    const bool as_before = viewer && viewer->follows && viewer->follows == update.follows;
    if (update.follows && !as_before && !has_after(*update.follows, plan)) {
      refuse_unknown(at(frame, "viewers", i, "/follows"), "an object", *update.follows);
    }
    update_viewer(plan.viewers.emplace_back(viewer ? *viewer : SceneViewer{}), update);
  }
}

Pose World::pose_after(ObjectId id, const Frame& frame) const {
  Pose out;
  const auto added =
      std::find_if(frame.add.begin(), frame.add.end(), [id](const auto& o) { return o.object.id == id; });
  if (added != frame.add.end()) {
    out = added->object.pose;
  } else {
    out = object(id).pose;
  }
  for (std::size_t i = 0; i < frame.moves(); ++i) {
    if (frame.moved(i) != id) continue;
    const ObjectMove move = frame.set.empty() ? frame.bulk.at(i) : frame.set[i];
    if (move.position) out.position = *move.position;
    if (move.orientation) out.orientation = *move.orientation;
    break;
  }
  return out;
}

/// A viewer that follows an object stands where no number of the frame says: offsets are added to places.
void World::check_viewpoints(const Frame& frame, Plan& plan) const {
  plan.farthest_object = farthest_object_;
  plan.longest_offset = longest_offset_;
  for (const SceneObject& o : frame.add)
    plan.farthest_object = std::max(plan.farthest_object, largest(o.object.pose.position));
  for (const ObjectMove& move : frame.set) {
    if (move.position) plan.farthest_object = std::max(plan.farthest_object, largest(*move.position));
  }
  keep_farthest(plan.farthest_object, frame.bulk);
  for (const SceneViewer& viewer : plan.viewers)
    plan.longest_offset = std::max(plan.longest_offset, length_of_offset(viewer));
  if (plan.farthest_object + plan.longest_offset <= edge_of_world) return;
  const auto check = [&](const SceneViewer& viewer, const std::string& place) {
    if (!viewer.follows || !has_after(*viewer.follows, plan)) return;
    if (out_of_world(pose_after(*viewer.follows, frame), viewer)) {
      refuse(place, "viewer " + std::to_string(viewer.id) + ": expected a viewpoint of magnitude at most 1e9");
    }
  };
  for (std::size_t i = 0; i < plan.viewers.size(); ++i) check(plan.viewers[i], at(frame, "viewers", i));
  for (const auto& [id, viewer] : viewers_) {
    const auto same = [id = id](const SceneViewer& v) { return v.id == id; };
    if (plan.dropped.contains(id) || std::any_of(plan.viewers.begin(), plan.viewers.end(), same)) continue;
    check(viewer, source(frame));
  }
}

void World::apply(const Frame& frame) {
  if (time_ && !(frame.time > *time_)) {
    std::string text = source(frame);
    append_number(text += "/time: expected a time after ", *time_);
    append_number(text += ", found ", frame.time);
    throw Error(ErrorCode::bad_frame, text);
  }
  Plan plan;
  check_objects(frame, plan);
  check_viewers(frame, plan);
  check_viewpoints(frame, plan);

  time_ = frame.time;
  farthest_object_ = plan.farthest_object;
  longest_offset_ = plan.longest_offset;
  for (const ObjectId id : frame.remove) erase(id);
  for (const SceneObject& object : frame.add) insert(object.object);
  if (!plan.same_places) find_set(frame);
  set_places_.resize(frame.moves());
  move_objects(frame);
  for (const ViewerId id : frame.drop_viewers) viewers_.erase(id);
  for (SceneViewer& viewer : plan.viewers) viewers_.insert_or_assign(viewer.id, std::move(viewer));
}

void World::find_set(const Frame& frame) {
  set_places_.resize(frame.moves(), objects_.size());
  for (std::size_t i = 0; i < set_places_.size(); ++i) {
    if (!same_place(i, frame.moved(i))) set_places_[i] = index_.at(frame.moved(i));
  }
}

void World::move_objects(const Frame& frame) {
  for (std::size_t i = 0; i < frame.set.size(); ++i) {
    const ObjectMove& move = frame.set[i];
    Pose& pose = objects_[set_places_[i]].pose;
    if (move.position) pose.position = *move.position;
    if (move.orientation) pose.orientation = *move.orientation;
  }
  const BulkMoves& bulk = frame.bulk;
  constexpr std::size_t ahead = 16;  // nothing is read that says where the next ones are: they can be fetched before
  for (std::size_t i = 0; i < bulk.ids.size(); ++i) {
    if (i + ahead < bulk.ids.size()) {
      const Pose& later = objects_[set_places_[i + ahead]].pose;
      __builtin_prefetch(&later, 1);
      __builtin_prefetch(&later.orientation.z, 1);
    }
    Pose& pose = objects_[set_places_[i]].pose;
    if (bulk.positions) pose.position = bulk.poses[i].position;
    if (bulk.orientations) pose.orientation = bulk.poses[i].orientation;
  }
}

void World::insert(const Object& object) {
  index_.emplace(object.id, objects_.size());
  objects_.push_back(object);
  ids_.push_back(object.id);
  farthest_object_ = std::max(farthest_object_, largest(object.pose.position));
}

void World::erase(ObjectId id) {
  const auto place = index_.find(id);
  const std::size_t hole = place->second;
  index_.erase(place);
  if (hole + 1 != objects_.size()) {
    objects_[hole] = std::move(objects_.back());
    ids_[hole] = ids_.back();
    index_[ids_[hole]] = hole;
  }
  objects_.pop_back();
  ids_.pop_back();
}

const Object& World::object(ObjectId id) const {
  const auto place = index_.find(id);
  if (place == index_.end()) throw Error(ErrorCode::unknown_object, "object " + std::to_string(id) + " is not there");
  return objects_[place->second];
}

void World::views(std::vector<View>& out) const {
  out.clear();
  for (const auto& [id, viewer] : viewers_) {
    View view;
    view.viewer = id;
    view.pose = viewer.pose;
    if (!viewer.own_direction) view.pose.orientation = Quat{};
    if (viewer.follows) {
      const auto place = index_.find(*viewer.follows);
      if (place == index_.end()) continue;
      const Pose& base = objects_[place->second].pose;
      view.pose.position = to_world(base, rotation_of(base.orientation), viewer.pose.position);
      if (!viewer.own_direction) view.pose.orientation = base.orientation;
      view.rides = *viewer.follows;
    }
    view.range = viewer.range;
    view.fov = viewer.fov;
    view.frustum = viewer.frustum;
    out.push_back(view);
  }
}

std::vector<View> World::views() const {
  std::vector<View> out;
  views(out);
  return out;
}

}  // namespace gridcull
