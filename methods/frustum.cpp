#include "gridcull/methods/frustum.h"

#include <chrono>
#include <cmath>
#include <map>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/core/view_volume.h"

namespace gridcull {
namespace {

class FrustumCuller final : public Culler {
 public:
  explicit FrustumCuller(int dimension) : dimension_(dimension) {}

  const MethodInfo& info() const override { return frustum_culler_info(); }

  void add(const Object& object) override {
    if (dimension_of(object.shape) != dimension_) {
      throw Error(ErrorCode::bad_scene,
                  "object " + std::to_string(object.id) + ": expected a " + std::to_string(dimension_) + "D shape");
    }
    validate(object.shape);
    if (object.id == no_id || !objects_.emplace(object.id, object).second) {
      throw Error(ErrorCode::bad_scene, "object " + std::to_string(object.id) + ": the id is there already");
    }
  }
  void remove(ObjectId object) override { objects_.erase(find(object)); }
  void move(ObjectId object, const Pose& pose) override { find(object)->second.pose = pose; }
  void set_source(PositionSource* source) override { source_ = source; }
  void announce_jump(ObjectId object) override { find(object); }

  void query(double time, std::span<const View> views, Answers& out) override {
    const auto start = std::chrono::steady_clock::now();
    if (!std::isfinite(time) || (started_ && !(time > now_))) {
      throw Error(ErrorCode::bad_frame, "time: expected more than " + std::to_string(now_));
    }
    now_ = time;
    started_ = true;
    out.stats = {};
    read_positions(out.stats);
    out.views.resize(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) answer(views[i], out.views[i]);
    const auto end = std::chrono::steady_clock::now();
    out.stats.total_us = std::chrono::duration<double, std::micro>(end - start).count();
    out.stats.collect_us = out.stats.total_us;
  }

 private:
  std::map<ObjectId, Object>::iterator find(ObjectId object) {
    const auto found = objects_.find(object);
    if (found == objects_.end()) {
      throw Error(ErrorCode::unknown_object, "object " + std::to_string(object) + " is not there");
    }
    return found;
  }

  void read_positions(FrameStats& stats) {
    for (auto& [id, object] : objects_) {
      if (object.is_static) continue;
      if (source_ != nullptr) object.pose = source_->pose(id);
      ++stats.positions_read;
    }
  }

  void answer(const View& view, Answer& answer) const {
    const ViewVolume volume(view, dimension_);
    answer.viewer = view.viewer;
    answer.visible.clear();
    answer.work = {};
    for (const auto& [id, object] : objects_) {
      if (id == view.rides) continue;
      ++answer.work.object_tests;
      if (volume.may_touch(object.shape, object.pose) || interior_holds(object.shape, object.pose, volume.apex())) {
        answer.visible.push_back(id);
      }
    }
  }

  int dimension_;
  std::map<ObjectId, Object> objects_;
  PositionSource* source_ = nullptr;
  double now_ = 0.0;
  bool started_ = false;
};

}  // namespace

const MethodInfo& frustum_culler_info() {
  static constexpr MethodInfo info{
      "frustum", "view volume only, nothing is hidden by anything", Guarantee::conservative, true, true, true};
  return info;
}

std::unique_ptr<Culler> make_frustum_culler(int dimension) { return std::make_unique<FrustumCuller>(dimension); }

}  // namespace gridcull
