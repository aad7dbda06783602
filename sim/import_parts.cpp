#include "gridcull/sim/import_parts.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "gridcull/core/error.h"
#include "gridcull/sim/json_text.h"

namespace gridcull {

ImportFrames::ImportFrames(ViewerChoice choice, ViewerUpdate viewer)
    : choice_(std::move(choice)), viewer_(viewer), chosen_names_(choice_.names.begin(), choice_.names.end()) {}

Frame ImportFrames::step(double time, std::vector<MoverState> movers, const std::string& where) {
  std::sort(movers.begin(), movers.end(), [](const MoverState& a, const MoverState& b) { return a.id < b.id; });
  Frame out;
  out.time = time;
  out.where = where;
  std::set<ObjectId> now;
  std::vector<ObjectId> added;
  for (const MoverState& mover : movers) {
    const MoverKind& kind = kinds_.at(mover.id);
    if (!now.insert(mover.id).second) {
      throw Error(ErrorCode::bad_message,
                  where + ": expected each id once in a step, found " + quoted(kind.name) + " twice");
    }
    bounds_.add_ball(mover.position, reach_of(kind.shape));
    if (alive_.contains(mover.id)) {
      out.set.push_back({mover.id, mover.position, turn_about_z(mover.heading), mover.heading});
      continue;
    }
    SceneObject& object = out.add.emplace_back();
    object.object.id = mover.id;
    object.object.shape = kind.shape;
    object.object.pose = {mover.position, turn_about_z(mover.heading)};
    object.object.max_speed = kind.max_speed;
    object.name = kind.name;
    object.heading = mover.heading;
    added.push_back(mover.id);
  }
  for (const ObjectId id : alive_) {
    if (now.contains(id)) continue;
    out.remove.push_back(id);
    if (viewers_.erase(id) > 0) out.drop_viewers.push_back(id);
  }
  alive_ = std::move(now);
  choose_viewers(added, out);
  return out;
}

void ImportFrames::choose_viewers(const std::vector<ObjectId>& added, Frame& out) {
  if (choice_.count) {
    for (const ObjectId id : alive_) {
      if (viewers_.size() >= *choice_.count) break;
      if (!viewers_.contains(id) && kinds_.at(id).counted) give_viewer(id, out);
    }
    return;
  }
  for (const ObjectId id : added) {
    const MoverKind& kind = kinds_.at(id);
    const bool chosen = chosen_names_.contains(kind.name);
    if (chosen) met_names_.insert(kind.name);
    if (choice_.all ? kind.counted : chosen) give_viewer(id, out);
  }
}

void ImportFrames::give_viewer(ObjectId id, Frame& out) {
  ViewerUpdate viewer = viewer_;
  viewer.id = id;
  viewer.follows = id;
  out.viewers.push_back(viewer);
  viewers_.insert(id);
}

void ImportFrames::finish() const {
  if (choice_.all || choice_.count) return;
  for (const std::string& name : chosen_names_) {
    if (!met_names_.contains(name)) {
      throw Error(ErrorCode::usage,
                  "viewers: expected ids that the file has, found " + quoted(name) + ", which never appears");
    }
  }
}

std::optional<Bounds> whole_metres(const Bounds& bounds) {
  if (bounds.empty()) return std::nullopt;
  Bounds out;
  for (int axis = 0; axis < 2; ++axis) {
    out.min[axis] = std::floor(bounds.min[axis]);
    out.max[axis] = std::max(std::ceil(bounds.max[axis]), out.min[axis] + 1.0);
  }
  out.min.z = out.max.z = 0.0;
  return out;
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size() || !(std::fabs(value) <= 1e9)) return std::nullopt;
  return value;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string quoted(std::string_view text) {
  std::string out;
  append_string(out, text.substr(0, 60));
  return out;
}

}  // namespace gridcull
