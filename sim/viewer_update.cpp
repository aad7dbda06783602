#include <cmath>

#include "gridcull/sim/scene_json.h"

namespace gridcull {

std::string fault_of(const SceneViewer* viewer, const ViewerUpdate& update) {
  if (update.position && update.follows) return "expected either \"position\" or \"follows\", found both";
  if (!viewer && !update.position && !update.follows) {
    return "a new viewer needs \"position\" or \"follows\"";
  }
  const bool follows = update.follows || (viewer && viewer->follows && !update.position);
  if (update.offset && !follows) return "\"offset\" needs an object that the viewer follows";
  return "";
}

void update_viewer(SceneViewer& viewer, const ViewerUpdate& update) {
  viewer.id = update.id;
  if (update.position) {
    viewer.follows.reset();
    viewer.pose.position = *update.position;
  }
  if (update.follows) {
    if (!viewer.follows) viewer.pose.position = Vec3(0.0);
    viewer.follows = update.follows;
  }
  if (update.offset) viewer.pose.position = *update.offset;
  if (update.orientation) {
    viewer.pose.orientation = *update.orientation;
    viewer.own_direction = true;
    viewer.heading = update.heading;
  }
  if (update.range) viewer.range = *update.range;
  if (update.fov) viewer.fov = *update.fov;
  if (update.frustum) viewer.frustum = update.frustum;
}

ViewerUpdate update_of(const SceneViewer& viewer) {
  ViewerUpdate out;
  out.id = viewer.id;
  if (viewer.follows) {
    out.follows = viewer.follows;
    if (viewer.pose.position != Vec3(0.0)) out.offset = viewer.pose.position;
  } else {
    out.position = viewer.pose.position;
  }
  if (viewer.own_direction) {
    out.orientation = viewer.pose.orientation;
    out.heading = viewer.heading;
  }
  if (std::isfinite(viewer.range)) out.range = viewer.range;
  if (viewer.fov != SceneViewer{}.fov) out.fov = viewer.fov;
  out.frustum = viewer.frustum;
  return out;
}

}  // namespace gridcull
