#include "gridcull/sim/import_sumo.h"

#include <cmath>

#include "gridcull/core/error.h"
#include "gridcull/sim/import_parts.h"
#include "gridcull/sim/json_text.h"
#include "gridcull/sim/sumo_buildings.h"
#include "gridcull/sim/sumo_fcd.h"
#include "gridcull/sim/sumo_shapes.h"

namespace gridcull {
namespace {

void check_positive(double value, const char* what) {
  if (value > 0.0 && value <= 1e9) return;
  std::string text = std::string(what) + ": expected a number above 0 and at most 1e9, found ";
  throw Error(ErrorCode::usage, text + short_number(value));
}

void check(const SumoOptions& options) {
  check_positive(options.vehicle_size.x, "vehicle-size: length");
  check_positive(options.vehicle_size.y, "vehicle-size: width");
  check_positive(options.person_radius, "person-radius");
  check_positive(options.max_speed, "max-speed");
  check_positive(options.person_max_speed, "max speed of persons");
  if (options.range) check_positive(*options.range, "range");
  if (options.every < 1) throw Error(ErrorCode::usage, "every: expected at least 1, found 0");
  if (!options.box) return;
  for (const double side : *options.box) {
    if (!(std::fabs(side) <= 1e9)) throw Error(ErrorCode::usage, "box: expected numbers of magnitude at most 1e9");
  }
  if (!((*options.box)[0] < (*options.box)[2] && (*options.box)[1] < (*options.box)[3])) {
    std::string found;
    for (const double side : *options.box) found += (found.empty() ? "" : ",") + short_number(side);
    throw Error(ErrorCode::usage, "box: expected x0,y0,x1,y1 with x0 < x1 and y0 < y1, found " + found);
  }
}

class Import {
 public:
  explicit Import(const SumoOptions& options) : options_(options), frames_(options.viewers, viewer(options)) {}

  Imported run(const FrameSink& sink) {
    Imported out;
    if (!options_.buildings.empty()) {
      out.scene.objects = read_sumo_buildings(options_.buildings, options_.box, out.notes);
    }
    frames_.begin_ids_at(static_cast<ObjectId>(out.scene.objects.size()));
    FcdReader reader(options_.fcd);
    FcdStep step{};
    std::optional<double> last;
    for (std::uint64_t number = 0; reader.next(step, number % options_.every != 0); ++number) {
      if (number % options_.every != 0) continue;
      check_time(step, last);
      last = step.time;
      sink(frames_.step(step.time, states(step), step.where));
      ++out.frames;
      if (options_.progress) options_.progress(out.frames);
    }
    frames_.finish();
    out.movers = frames_.movers();
    out.scene.bounds = bounds(out.scene);
    return out;
  }

 private:
  static ViewerUpdate viewer(const SumoOptions& options) {
    ViewerUpdate out;
    out.range = options.range;
    return out;
  }
  static void check_time(const FcdStep& step, const std::optional<double>& last) {
    if (!last || step.time > *last) return;
    std::string text = step.where;
    append_number(text += ": expected a time after ", *last);
    append_number(text += ", found ", step.time);
    throw Error(ErrorCode::bad_message, text);
  }
  MoverKind kind(const FcdMover& mover) const {
    if (mover.person) return {mover.id, Disc{options_.person_radius}, options_.person_max_speed, false};
    return {mover.id, Rectangle{options_.vehicle_size}, options_.max_speed, true};
  }
  bool inside(const Vec3& p) const {
    if (!options_.box) return true;
    const auto& [x0, y0, x1, y1] = *options_.box;
    return p.x >= x0 && p.x <= x1 && p.y >= y0 && p.y <= y1;
  }
  std::vector<MoverState> states(const FcdStep& step) {
    std::vector<MoverState> out;
    out.reserve(step.movers.size());
    for (const FcdMover& mover : step.movers) {
      MoverState state;
      state.heading = sumo_heading(mover.angle);
      state.position = {mover.x, mover.y, 0.0};
      if (!mover.person) {
        state.position = vehicle_middle(state.position, state.heading, options_.vehicle_size.x);
      }
      if (!inside(state.position)) continue;
      // Vehicles and persons have separate names in SUMO.
      state.id = frames_.id_of((mover.person ? "p" : "v") + mover.id, [&] { return kind(mover); });
      out.push_back(state);
    }
    return out;
  }
  std::optional<Bounds> bounds(const Scene& scene) const {
    if (options_.box) {
      const auto& [x0, y0, x1, y1] = *options_.box;
      return Bounds{{x0, y0, 0.0}, {x1, y1, 0.0}};
    }
    Bounds all = frames_.bounds();
    for (const SceneObject& object : scene.objects) {
      for (const Vec2& p : world_outline(object.object.shape, object.object.pose)) all.add({p.x, p.y, 0.0});
    }
    return whole_metres(all);
  }

  const SumoOptions& options_;
  ImportFrames frames_;
};

}  // namespace

Imported import_sumo(const SumoOptions& options, const FrameSink& sink) {
  check(options);
  return Import(options).run(sink);
}

}  // namespace gridcull
