// One ray through the middle of each pixel against all occluders (Embree), the nearest depths in a pyramid of greatest
// depths (methods/depth_pyramid.h), and the box of each object in the view volume tested against it: hidden when every
// pixel that its box touches is nearer than the box. A view in all directions takes six pictures of a cube's faces,
// each of about as many pixels as the one picture of a frustum.
//
// Sampled: what shows between two rays only is missed. Embree works in floats; a box counts as nearer than it is by
// 1e-5 of its depth, so that an object's own rays do not hide it.
//
// One thread, the tree included. Times: the tree's rebuild is `discretise`, rays are `traverse`, the pyramid is
// `occlude`, the tests are `collect`. Counts: cells_visited are pyramid pixels read, rasters are rays.
#include "gridcull/methods/depth_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "gridcull/core/error.h"
#include "gridcull/core/memory_limit.h"
#include "gridcull/core/trigonometry.h"
#include "gridcull/methods/depth_pyramid.h"
#include "gridcull/methods/depth_scene.h"
#include "gridcull/methods/flat_world.h"
#include "gridcull/methods/lap.h"
#include "gridcull/methods/view_test.h"
#include "gridcull/methods/world_culler.h"

namespace gridcull {
namespace {

/// Depth, left, up of points relative to the eye.
using Corners = std::vector<Vec3>;

void add_box(const Vec3& middle, const Vec3& x, const Vec3& y, const Vec3& z, Corners& out) {
  for (int k = 0; k < 8; ++k) {
    out.push_back(middle + ((k & 1) != 0 ? x : -x) + ((k & 2) != 0 ? y : -y) + ((k & 4) != 0 ? z : -z));
  }
}

/// A box turned to the picture, around a ball.
void add_ball(const DepthWindow& window, const Vec3& centre, double radius, Corners& out) {
  add_box(window.axes.inverse(centre - window.eye), {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}, out);
}

/// The corners of what an object is tested with: its own box turned with it (a ball's: to the picture), or its bound.
void corners_in(const DepthWindow& window, const FlatObject& flat, Corners& out) {
  out.clear();
  const Vec3& half = flat.local.half;
  const Pose& pose = flat.object.pose;
  if (flat.bound && flat.bound->round) {
    const Ball& ball = flat.bound->ball;
    add_ball(window, to_world(pose, flat.rotation, ball.centre), ball.radius, out);
  } else if (flat.bound) {
    const Vec3 origin = pose.position - window.eye;
    for (const Vec3& v : flat.bound->boundary.vertices) out.push_back(window.axes.inverse(origin + flat.rotation * v));
  } else if (flat.local.kind == LocalShape::Kind::ball) {
    add_ball(window, flat.centre, half.x, out);
  } else {
    add_box(window.axes.inverse(flat.centre - window.eye), window.axes.inverse(half.x * flat.rotation.x),
            window.axes.inverse(half.y * flat.rotation.y), window.axes.inverse(half.z * flat.rotation.z), out);
  }
}

/// Whether all corners lie outside one side of the picture's pyramid.
bool is_beside(const DepthWindow& w, const Corners& corners) {
  bool left = true, right = true, above = true, below = true, behind = true;
  for (const Vec3& p : corners) {
    const double across = w.tangent_x * p.x, upright = w.tangent_y * p.x;
    left = left && p.y > across;
    right = right && p.y < -across;
    above = above && p.z > upright;
    below = below && p.z < -upright;
    behind = behind && p.x <= 0.0;
  }
  return left || right || above || below || behind;
}

enum class Place { beside, at_eye, in_picture };

/// Pixels that the box touches and its least depth.
Place project(const DepthWindow& w, const Corners& corners, PixelBox& pixels, double& depth) {
  if (is_beside(w, corners)) return Place::beside;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double left = infinity, right = -infinity, top = infinity, bottom = -infinity;
  depth = infinity;
  for (const Vec3& p : corners) {
    if (!(p.x > 1e-6)) return Place::at_eye;
    depth = std::min(depth, p.x);
    const double x = 0.5 * w.width * (1.0 - p.y / (p.x * w.tangent_x));
    const double y = 0.5 * w.height * (1.0 - p.z / (p.x * w.tangent_y));
    left = std::min(left, x), right = std::max(right, x);
    top = std::min(top, y), bottom = std::max(bottom, y);
  }
  if (right < 0.0 || left > w.width || bottom < 0.0 || top > w.height) return Place::beside;
  const auto pixel = [](double at, int count) {
    return static_cast<int>(std::fmin(std::fmax(at, 0.0), static_cast<double>(count - 1)));
  };
  pixels = {pixel(left, w.width), pixel(top, w.height), pixel(right, w.width), pixel(bottom, w.height)};
  return Place::in_picture;
}

/// Pixels along a face of the cube that stands for a picture in all directions: about as many in all.
int face_of(const DepthRaysOptions& o) {
  return std::max(1, static_cast<int>(std::lround(std::sqrt(1.0 * o.width * o.height))));
}

/// One picture, or the six of a view in all directions.
std::uint64_t picture_bytes(const DepthRaysOptions& o) {
  return std::max(DepthPyramid::bytes_for(o.width, o.height), 6 * DepthPyramid::bytes_for(face_of(o), face_of(o)));
}

class DepthRays final : public WorldCuller<FlatWorld> {
 public:
  explicit DepthRays(const DepthRaysOptions& options)
      : WorldCuller(3, options.bound),
        options_(options),
        face_(face_of(options)),
        scene_(options.bounds.empty() ? Vec3(0.0) : options.bounds.centre()) {}

  const MethodInfo& info() const override { return depth_rays_info(); }

  void query(double time, std::span<const View> views, Answers& out) override {
    Lap whole, lap;
    FrameStats stats;
    world_.begin_frame(time, views, stats);
    scene_.update(world_);
    stats.discretise_us = lap.next();
    out.views.resize(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) answer(views[i], out.views[i], stats);
    stats.total_us = whole.next();
    out.stats = stats;
  }

 private:
  void answer(const View& view, Answer& answer, FrameStats& stats) {
    Lap lap;
    answer.viewer = view.viewer;
    answer.visible.clear();
    answer.work = {};
    const ViewTest test(view, 3);
    find_skipped(view);
    open_windows(view, test.volume());
    stats.collect_us += lap.next();
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      pyramids_[i].resize(windows_[i].width, windows_[i].height);
      scene_.shoot(windows_[i], skipped_, pyramids_[i].pixels());
      answer.work.rasters += pyramids_[i].pixels().size();
    }
    stats.traverse_us += lap.next();
    for (std::size_t i = 0; i < windows_.size(); ++i) pyramids_[i].build();
    stats.occlude_us += lap.next();
    collect(view, test, answer);
    stats.collect_us += lap.next();
  }

  void collect(const View& view, const ViewTest& test, Answer& answer) {
    const auto objects = world_.objects();
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
      const FlatObject& flat = objects[i];
      if (flat.object.id == view.rides) continue;
      ++answer.work.object_tests;
      // What holds the viewpoint is reported even where it leaves the volume's other side.
      const bool holds = std::find(holders_.begin(), holders_.end(), i) != holders_.end();
      if (holds || (test.may_touch(flat) && may_show(flat, answer.work))) answer.visible.push_back(flat.object.id);
    }
    std::sort(answer.visible.begin(), answer.visible.end());
  }

  bool may_show(const FlatObject& flat, WorkCounts& work) {
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      PixelBox pixels;
      double depth = 0.0;
      corners_in(windows_[i], flat, corners_);
      const Place place = project(windows_[i], corners_, pixels, depth);
      if (place == Place::beside) continue;
      if (place == Place::at_eye) return true;
      if (pyramids_[i].may_show(pixels, static_cast<float>(depth * (1.0 - 1e-5)), work.cells_visited)) return true;
    }
    return false;
  }

  /// What the viewer rides on and what holds it is met by no ray.
  void find_skipped(const View& view) {
    const auto objects = world_.objects();
    if (all_.size() != objects.size()) {
      all_.resize(objects.size());
      for (std::uint32_t i = 0; i < all_.size(); ++i) all_[i] = i;
    }
    holders_.clear();
    world_.add_holders(view.pose.position, all_, holders_);
    skipped_ = holders_;
    const std::uint32_t ridden = world_.find(view.rides);
    if (ridden != FlatWorld::nowhere) skipped_.push_back(ridden);
  }

  /// One window for a frustum, six for all directions.
  void open_windows(const View& view, const ViewVolume& volume) {
    windows_.clear();
    DepthWindow window;
    window.eye = volume.apex();
    window.axes = rotation_of(view.pose.orientation);
    window.far = volume.range();
    if (view.frustum) {
      const SinCos half = stable_sincos(0.5 * view.frustum->fov_y);
      window.tangent_y = half.sin / half.cos;
      window.tangent_x = window.tangent_y * view.frustum->aspect;
      window.width = options_.width;
      window.height = options_.height;
      windows_.push_back(window);
    } else {
      window.width = window.height = face_;
      const Rotation a = window.axes;
      for (const Rotation& axes : {a, Rotation{-a.x, -a.y, a.z}, Rotation{a.y, -a.x, a.z}, Rotation{-a.y, a.x, a.z},
                                   Rotation{a.z, a.y, -a.x}, Rotation{-a.z, a.y, a.x}}) {
        window.axes = axes;
        windows_.push_back(window);
      }
    }
    if (pyramids_.size() < windows_.size()) pyramids_.resize(windows_.size());
  }

  DepthRaysOptions options_;
  int face_;
  DepthScene scene_;
  std::vector<DepthWindow> windows_{};
  std::vector<DepthPyramid> pyramids_{};
  std::vector<std::uint32_t> all_{}, holders_{}, skipped_{};
  Corners corners_{};
};

}  // namespace

const MethodInfo& depth_rays_info() {
  static constexpr MethodInfo info{"depth-rays",
                                   "Embree depth rays and a hierarchical depth test, as game engines do; one thread",
                                   Guarantee::sampled,
                                   false,
                                   true,
                                   true};
  return info;
}

std::unique_ptr<Culler> make_depth_rays(const DepthRaysOptions& options) {
  constexpr int most = 8192;
  if (options.width < 1 || options.width > most || options.height < 1 || options.height > most) {
    throw Error(ErrorCode::usage, "resolution: expected 1 .. 8192 rays along each side, found " +
                                      std::to_string(options.width) + "x" + std::to_string(options.height));
  }
  refuse_above(options.max_memory, picture_bytes(options),
               "resolution: the six pictures of a view in all directions, of as many pixels as " +
                   std::to_string(options.width) + "x" + std::to_string(options.height) + " each, need");
  return std::make_unique<DepthRays>(options);
}

}  // namespace gridcull
