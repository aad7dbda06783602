#include "gridcull/service/drawn_view.h"

#include <utility>

#include <nlohmann/json.hpp>

namespace gridcull {
namespace {

using Json = nlohmann::ordered_json;

/// In the order of CellLayer.
constexpr std::array<const char*, 6> names{"visited", "opaque", "hidden", "touched", "tbv", "line_of_sight"};

void add_point(Json& out, const Vec3& p, int dimension) {
  for (int axis = 0; axis < dimension; ++axis) out.push_back(p[axis]);
}

}  // namespace

void DrawnView::begin(ViewerId viewer) {
  viewer_ = viewer;
  for (auto& boxes : boxes_) boxes.clear();
  count_ = 0;
  volumes_.clear();
  region_.clear();
}

void DrawnView::cells(CellLayer layer, const Vec3& low, const Vec3& high) {
  if (count_++ < most_boxes) boxes_[static_cast<std::size_t>(layer)].push_back({low, high});
}

void DrawnView::tbv(ObjectId object, const Vec3& centre, double radius, bool revealed) {
  if (volumes_.size() < most_boxes) volumes_.push_back({object, centre, radius, revealed});
}

Json DrawnView::json(int dimension) const {
  Json out{{"viewer", viewer_}, {"cells", Json::object()}};
  for (std::size_t layer = 0; layer < layers; ++layer) {
    if (boxes_[layer].empty()) continue;
    Json& list = out["cells"][names[layer]] = Json::array();
    for (const Box& box : boxes_[layer]) {
      Json one = Json::array();
      add_point(one, box.low, dimension);
      add_point(one, box.high, dimension);
      list.push_back(std::move(one));
    }
  }
  for (const Volume& volume : volumes_) {
    Json centre = Json::array();
    add_point(centre, volume.centre, dimension);
    out["volumes"].push_back({{"id", volume.object},
                              {"centre", std::move(centre)},
                              {"radius", volume.radius},
                              {"revealed", volume.revealed}});
  }
  for (const Vec2& p : region_) out["region"].push_back({p.x, p.y});
  return out;
}

}  // namespace gridcull
