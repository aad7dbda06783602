#include "gridcull/service/watch_message.h"

#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

namespace gridcull {
namespace {

using Json = nlohmann::ordered_json;

Json point_json(const Vec3& p, int dimension) {
  Json json{p.x, p.y};
  if (dimension == 3) json.push_back(p.z);
  return json;
}

/// Where a viewer stands and how it looks, resolved: what it follows is worked in.
Json view_json(const View& view, int dimension) {
  const Quat& q = view.pose.orientation;
  Json json{{"viewer", view.viewer}, {"position", point_json(view.pose.position, dimension)}};
  if (dimension == 2) {
    json["heading"] = heading_of(q);
    json["fov"] = view.fov;
  } else {
    json["orientation"] = {q.w, q.x, q.y, q.z};
    if (view.frustum) {
      json["frustum"] = {
          {"fov_y", view.frustum->fov_y}, {"aspect", view.frustum->aspect}, {"near", view.frustum->near}};
      if (std::isfinite(view.frustum->far)) json["frustum"]["far"] = view.frustum->far;
    }
  }
  if (std::isfinite(view.range)) json["range"] = view.range;
  if (view.rides != no_id) json["rides"] = view.rides;
  return json;
}

Json stats_json(const FrameStats& stats) {
  return {{"total_us", stats.total_us},       {"discretise_us", stats.discretise_us},
          {"traverse_us", stats.traverse_us}, {"positions_read", stats.positions_read},
          {"tbv_active", stats.tbv_active},   {"tbv_revealed", stats.tbv_revealed}};
}

Scene scene_now(const Session& session) {
  Scene scene;
  scene.dimension = session.dimension();
  for (const Object& object : session.world().objects()) scene.objects.push_back({.object = object});
  return scene;
}

}  // namespace

Json watch_start(const Session& session, const std::string& id) {
  const int n = session.dimension();
  const Bounds box = session.lattice().box();
  return {{"type", "watching"},
          {"session", id},
          {"name", session.name()},
          {"method", session.method()},
          {"dimension", n},
          {"cell", session.cell()},
          {"bounds", {{"min", point_json(box.min, n)}, {"max", point_json(box.max, n)}}},
          {"seq", session.seq()},
          {"scene", Json::parse(scene_text(scene_now(session)))}};
}

Json watch_step(const Session& session, const Frame& frame) {
  const int n = session.dimension();
  Json views = Json::array(), answers = Json::array();
  for (const View& view : session.views()) views.push_back(view_json(view, n));
  for (const Answer& answer : session.answers().views) {
    answers.push_back({{"viewer", answer.viewer}, {"visible", answer.visible}});
  }
  Json step{{"type", "step"},
            {"seq", session.seq()},
            {"time", frame.time},
            {"frame", Json::parse(frame_text(frame, n))},
            {"views", std::move(views)},
            {"answers", std::move(answers)},
            {"stats", stats_json(session.answers().stats)}};
  if (const DrawnView* drawn = session.drawn()) step["drawn"] = drawn->json(n);
  return step;
}

}  // namespace gridcull
