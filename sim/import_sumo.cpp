#include "gridcull/sim/import_sumo.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gridcull/core/error.h"
#include "gridcull/core/world_points.h"
#include "gridcull/sim/import_parts.h"
#include "gridcull/sim/json_text.h"
#include "gridcull/sim/scene.h"
#include "gridcull/sim/sumo_buildings.h"
#include "gridcull/sim/sumo_fcd.h"
#include "gridcull/sim/sumo_shapes.h"

namespace gridcull {
namespace {

/// Of a file that a scene names, which goes into a scene of another folder.
std::string absolute_path(const std::string& file, const std::string& scene) {
  return std::filesystem::absolute(std::filesystem::path(scene).parent_path() / file).lexically_normal().string();
}

/// Buildings and movers get ids above those of static objects.
constexpr ObjectId most_static_id = 1'000'000'000;

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
  check_positive(options.vehicle_height, "vehicle-height");
  check_positive(options.person_height, "person-height");
  check_positive(options.eye_height, "eye-height");
  if (options.height) check_positive(*options.height, "height");
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
  explicit Import(const SumoOptions& options)
      : options_(options), statics_(statics_of(options)), frames_(options.viewers, viewer(options, solid())) {}

  int dimension() const { return solid() ? 3 : 2; }

  Imported run(const FrameSink& sink) {
    Imported out;
    out.scene.dimension = dimension();
    ObjectId next = 0;
    for (SceneObject& object : statics_.objects) {
      if (!object.object.is_static) continue;
      if (object.object.id >= most_static_id) {
        throw Error(ErrorCode::usage, "static: expected ids below " + std::to_string(most_static_id) + ", found " +
                                          std::to_string(object.object.id));
      }
      next = std::max(next, object.object.id + 1);
      object.mesh.reset();  // its file is named relative to that scene: the triangles themselves go along
      if (object.volume) object.volume->file = absolute_path(object.volume->file, options_.statics);
      out.scene.objects.push_back(object);
    }
    if (!options_.buildings.empty()) {
      for (SceneObject& building : buildings(out.notes)) {
        building.object.id = next++;
        out.scene.objects.push_back(std::move(building));
      }
    }
    frames_.begin_ids_at(next);
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
  static ViewerUpdate viewer(const SumoOptions& options, bool solid) {
    ViewerUpdate out;
    out.range = options.range;
    if (solid) out.offset = Vec3(0.0, 0.0, options.eye_height - 0.5 * options.vehicle_height);
    return out;
  }
  static Scene statics_of(const SumoOptions& options) {
    if (options.statics.empty()) return {};
    Scene scene = read_scene(options.statics, std::uint64_t{4} << 30, options.read_field);
    if (scene.dimension == 2 && options.height) {
      throw Error(ErrorCode::usage, "static: expected a 3D scene with --height, found a 2D one");
    }
    return scene;
  }
  bool solid() const { return options_.height.has_value() || statics_.dimension == 3; }

  std::vector<SceneObject> buildings(std::vector<std::string>& notes) const {
    std::vector<double> heights;
    std::vector<SceneObject> out = read_sumo_buildings(options_.buildings, options_.box, notes, heights);
    for (std::size_t i = 0; solid() && i < out.size(); ++i) {
      const double height = heights[i] > 0.0 ? heights[i] : options_.height.value_or(10.0);
      out[i].object.shape = Prism{std::get<Polygon>(out[i].object.shape).vertices, height};
    }
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
    if (solid()) return solid_kind(mover);
    if (mover.person) return {mover.id, Disc{options_.person_radius}, options_.person_max_speed, false};
    return {mover.id, Rectangle{options_.vehicle_size}, options_.max_speed, true};
  }
  MoverKind solid_kind(const FcdMover& mover) const {
    const double wide = 2.0 * options_.person_radius;
    if (mover.person) {
      return {mover.id, Cuboid{{wide, wide, options_.person_height}}, options_.person_max_speed, false};
    }
    return {mover.id, Cuboid{Vec3(options_.vehicle_size, options_.vehicle_height)}, options_.max_speed, true};
  }
  /// Of a mover's middle above the ground.
  double middle_height(const FcdMover& mover) const {
    if (!solid()) return 0.0;
    return 0.5 * (mover.person ? options_.person_height : options_.vehicle_height);
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
      state.position.z = middle_height(mover);
      if (!inside(state.position)) continue;
      // Vehicles and persons have separate names in SUMO.
      state.id = frames_.id_of((mover.person ? "p" : "v") + mover.id, [&] { return kind(mover); });
      out.push_back(state);
    }
    return out;
  }
  /// None where buildings stand on the ground, unless asked for: derived ones follow the cell, so that opaque cells
  /// begin right above the ground (choose_lattice()); in others `voxel` would look through beneath the buildings.
  std::optional<Bounds> bounds(const Scene& scene) const {
    if (options_.height && !options_.box) return std::nullopt;
    Bounds all = frames_.bounds(), fixed;
    for (const SceneObject& object : scene.objects) {
      for_each_world_point(object.object.shape, object.object.pose, [&](const Vec3& p) { fixed.add(p); });
      if (const auto* ball = std::get_if<Sphere>(&object.object.shape)) {
        fixed.add_ball(object.object.pose.position, ball->radius);
      } else if (const auto* disc = std::get_if<Disc>(&object.object.shape)) {
        fixed.add_ball(object.object.pose.position, disc->radius);
      }
    }
    if (!fixed.empty()) all.add(fixed.min), all.add(fixed.max);
    std::optional<Bounds> out = whole_metres(all);
    if (options_.box) {
      const auto& [x0, y0, x1, y1] = *options_.box;
      out = Bounds{{x0, y0, 0.0}, {x1, y1, 0.0}};
    }
    if (out && solid() && !all.empty()) {
      const double low = fixed.empty() ? 0.0 : std::min(0.0, fixed.min.z), high = fixed.empty() ? 0.0 : fixed.max.z;
      out->min.z = std::floor(low);
      out->max.z = std::ceil(std::max({high, options_.vehicle_height, options_.person_height}));
    }
    return out;
  }

  const SumoOptions& options_;
  Scene statics_;
  ImportFrames frames_;
};

}  // namespace

int sumo_dimension(const SumoOptions& options) {
  check(options);
  return Import(options).dimension();
}

Imported import_sumo(const SumoOptions& options, const FrameSink& sink) {
  check(options);
  return Import(options).run(sink);
}

}  // namespace gridcull
