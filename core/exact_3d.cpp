// The 3D reference: dense rays through a pyramid or the six faces of a cube, one jittered ray a pixel, and rays aimed
// at what none of them met. Embree finds candidates in floats; what the eye is next to, and what the near plane cuts,
// is judged in doubles ray by ray. The answer is a lower bound.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/core/exact_3d_judge.h"
#include "gridcull/core/exact_3d_scene.h"

namespace gridcull {
namespace exact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using EachRow = std::function<void()>;

/// 0 .. 1 from a pixel's number: the same in every run, no pattern that a scene could line up with
/// (the finalizer of MurmurHash3).
double jitter(std::uint64_t number) {
  number ^= number >> 33;
  number *= 0xFF51'AFD7'ED55'8CCDull;
  number ^= number >> 33;
  number *= 0xC4CE'B9FE'1A85'EC53ull;
  number ^= number >> 33;
  return static_cast<double>(number >> 11) * 0x1p-53;
}

/// Collects one view's answer ray by ray.
class Looker {
 public:
  Looker(const std::vector<Solid>& solids, const RayScene& scene, const View& view)
      : solids_(solids), scene_(scene), view_(view), skip_(solids.size(), 0), sights_(solids.size()) {
    for (std::uint32_t i = 0; i < solids.size(); ++i) {
      const Solid& s = solids[i];
      if (s.id == view.rides) {
        skip_[i] = gone_[i] = 1;
      } else if (surely_holds(s, view_.eye())) {
        skip_[i] = 1;
        gone_[i] = 1;
        sights_[i].seen = true;
      } else if (rough_distance(s, view_.eye()) <= 16.0 * scene.blur()) {
        // Floats cannot tell on which side of it the eye is.
        skip_[i] = 1;
        close_.push_back(i);
      }
    }
  }

  const ViewLimits& limits() const { return view_; }

  void shoot(const Vec3& ray) {
    ++ray_number_;
    if (!view_.holds(ray)) return;
    const Stretch part = view_.part(ray);
    double blocked = infinity, close_touch = infinity;
    for (const std::uint32_t i : close_) {
      const Along along = look_along(view_, solids_[i], ray, scratch_);
      blocked = std::min(blocked, along.entry);
      close_touch = std::min(close_touch, along.touch);
    }
    if (view_.has_near() && (blocked < part.begin || close_touch <= part.begin)) return judge(ray);
    const double limit = std::min(blocked, part.end);
    for (RayScene::Hit hit; (hit = scene_.first(view_.eye(), ray, limit, skip_)).solid != RayScene::none;) {
      if (hit.distance < part.begin) return judge(ray);
      see(hit.solid, ray);
      if (solids_[hit.solid].occluder) {
        blocked = std::min(blocked, hit.distance);
        break;
      }
      skip_[hit.solid] = 1;  // seen, and in nobody's way from now on
    }
    for (const std::uint32_t i : close_) {
      const double touch = look_along(view_, solids_[i], ray, scratch_).touch;
      if (std::isfinite(touch) && touch <= part.end && touch <= blocked + view_.tie_at(touch)) see(i, ray);
    }
  }

  /// Rays at the middle and about it of everything that no ray has met so far.
  void aim() {
    for (std::uint32_t i = 0; i < solids_.size(); ++i) {
      if (gone_[i] || sights_[i].seen) continue;
      const Solid& s = solids_[i];
      if (glm::length(s.position - view_.eye()) - s.reach > view_.range()) continue;
      for_targets(s, [&](const Vec3& target) {
        const Vec3 d = target - view_.eye();
        const double distance = glm::length(d);
        if (!sights_[i].seen && distance > 0.0) shoot(d / distance);
      });
    }
  }

  ExactAnswer answer() const {
    std::vector<std::pair<ObjectId, Vec3>> found;
    for (std::uint32_t i = 0; i < solids_.size(); ++i) {
      if (sights_[i].seen) found.emplace_back(solids_[i].id, sights_[i].along);
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    ExactAnswer out;
    out.lower_bound = true;
    for (const auto& [id, along] : found) out.visible.push_back(id), out.witness.push_back(along);
    return out;
  }

 private:
  /// Prefers a witness away from edges: the second of two rays in a row that met the solid.
  struct Sight {
    bool seen = false;
    bool twice = false;
    std::uint64_t last = 0;
    Vec3 along{0.0};
  };

  void see(std::uint32_t solid, const Vec3& ray) {
    Sight& s = sights_[solid];
    const bool again = s.seen && s.last + 1 == ray_number_;
    if (!s.seen || (again && !s.twice)) s.along = ray;
    s.twice = s.twice || again;
    s.seen = true;
    s.last = ray_number_;
  }

  /// In doubles: everything along the ray up to the second thing that hides, or the first beyond the near plane.
  void judge(const Vec3& ray) {
    std::vector<std::uint32_t> candidates = close_;
    std::vector<std::uint32_t> marked;
    const Stretch part = view_.part(ray);
    int hiding = 0;
    for (RayScene::Hit hit; (hit = scene_.first(view_.eye(), ray, part.end, skip_)).solid != RayScene::none;) {
      candidates.push_back(hit.solid);
      marked.push_back(hit.solid);
      skip_[hit.solid] = 1;
      if (solids_[hit.solid].occluder && (++hiding == 2 || hit.distance >= part.begin)) break;
    }
    for (const std::uint32_t i : marked) skip_[i] = 0;
    std::vector<const Solid*> others;
    for (const std::uint32_t i : candidates) others.push_back(&solids_[i]);
    for (const std::uint32_t i : candidates) {
      if (seen_past(view_, solids_[i], others, ray, scratch_)) see(i, ray);
    }
  }

  template <class Use>
  void for_targets(const Solid& s, const Use& use) const {
    if (s.kind != SolidKind::sphere) {
      const Vec3 middle = s.world_box.centre();
      use(middle);
      for (std::size_t k = 0; k < s.vertices.size(); ++k) {
        const Vec3 &p = s.vertices[k], &q = s.vertices[(k + 1) % s.vertices.size()];
        use(p + 0.02 * (middle - p));
        if (s.kind == SolidKind::volume) use(p);
        use(0.5 * (p + q) + 0.02 * (middle - 0.5 * (p + q)));
      }
      return;
    }
    use(s.position);
    const Vec3 towards = s.position - view_.eye();
    const Vec3 aside =
        std::fabs(towards.z) < std::fabs(towards.x) + std::fabs(towards.y) ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
    const Vec3 u = glm::normalize(glm::cross(towards, aside)), v = glm::normalize(glm::cross(towards, u));
    constexpr double diagonal = 0.70710678118654752;
    for (const double r : {0.55 * s.radius, 0.97 * s.radius}) {
      for (const double a : {-1.0, 0.0, 1.0}) {
        for (const double b : {-1.0, 0.0, 1.0}) {
          const double scale = a != 0.0 && b != 0.0 ? diagonal : 1.0;
          if (a != 0.0 || b != 0.0) use(s.position + r * scale * (a * u + b * v));
        }
      }
    }
  }

  const std::vector<Solid>& solids_;
  const RayScene& scene_;
  ViewLimits view_;
  std::vector<char> skip_;  ///< not met by rays: gone, close, or seen and in nobody's way
  std::vector<char> gone_ = std::vector<char>(solids_.size(), 0);  ///< ridden or holding the eye
  std::vector<std::uint32_t> close_;
  std::vector<Sight> sights_;
  std::vector<Stretch> scratch_;
  std::uint64_t ray_number_ = 0;
};

/// One ray a pixel over [-tx, tx] x [-ty, ty] at depth 1 along `axes.x`.
void shoot_window(Looker& looker, const Rotation& axes, double tx, double ty, int columns, int rows,
                  const EachRow& each_row) {
  for (int row = 0; row < rows; ++row) {
    if (each_row) each_row();
    for (int column = 0; column < columns; ++column) {
      const auto number =
          static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(columns) + static_cast<std::uint64_t>(column);
      const double x = (column + jitter(2 * number)) / columns, y = (row + jitter(2 * number + 1)) / rows;
      looker.shoot(glm::normalize(axes.x + (2.0 * x - 1.0) * tx * axes.y + (2.0 * y - 1.0) * ty * axes.z));
    }
  }
}

void shoot_cube(Looker& looker, const Rotation& axes, int rays, const EachRow& each_row) {
  shoot_window(looker, axes, 1.0, 1.0, rays, rays, each_row);
  shoot_window(looker, {-axes.x, -axes.y, axes.z}, 1.0, 1.0, rays, rays, each_row);
  shoot_window(looker, {axes.y, -axes.x, axes.z}, 1.0, 1.0, rays, rays, each_row);
  shoot_window(looker, {-axes.y, axes.x, axes.z}, 1.0, 1.0, rays, rays, each_row);
  shoot_window(looker, {axes.z, axes.y, -axes.x}, 1.0, 1.0, rays, rays, each_row);
  shoot_window(looker, {-axes.z, axes.y, axes.x}, 1.0, 1.0, rays, rays, each_row);
}

/// Directions `angle` (radians) off the ray, `count` of them around it.
std::vector<Vec3> cone(const Vec3& ray, double angle, int count) {
  const Vec3 aside = std::fabs(ray.z) < 0.7 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  const Vec3 u = glm::normalize(glm::cross(ray, aside)), v = glm::cross(ray, u);
  // Points of the unit circle by rational parameters: no trigonometry, evenly enough.
  std::vector<Vec3> out;
  for (int k = 0; k < count; ++k) {
    const double t = std::fabs(2.0 * (k + 0.5) / count - 1.0) * 2.0 - 1.0;
    const double x = (1.0 - t * t) / (1.0 + t * t), y = 2.0 * t / (1.0 + t * t);
    out.push_back(glm::normalize(ray + angle * ((2 * k < count ? x : -x) * u + y * v)));
  }
  return out;
}

}  // namespace
}  // namespace exact

struct ExactRays::Detail {
  std::vector<exact::Solid> solids;
  exact::RayScene scene;
  int rays;

  Detail(std::span<const Object> world, int count) : solids(exact::make_solids(world)), scene(solids), rays(count) {}
};

bool ExactRays::available() {
#if GRIDCULL_HAS_EMBREE
  return true;
#else
  return false;
#endif
}

ExactRays::ExactRays(std::span<const Object> world, int rays) {
  if (rays < 1 || rays > 65536) throw Error(ErrorCode::usage, "expected 1 .. 65536 rays along a frustum's height");
  detail_ = std::make_unique<Detail>(world, rays);
}
ExactRays::~ExactRays() = default;
ExactRays::ExactRays(ExactRays&&) noexcept = default;
ExactRays& ExactRays::operator=(ExactRays&&) noexcept = default;

ExactAnswer ExactRays::visible(const View& view, const std::function<void()>& each_row) const {
  exact::Looker looker(detail_->solids, detail_->scene, view);
  const exact::ViewLimits& limits = looker.limits();
  if (limits.all_round()) {
    exact::shoot_cube(looker, limits.axes(), detail_->rays, each_row);
  } else {
    const double columns = std::clamp(std::round(detail_->rays * view.frustum->aspect), 1.0, 65536.0);
    exact::shoot_window(looker, limits.axes(), limits.tangent_x(), limits.tangent_y(), static_cast<int>(columns),
                        detail_->rays, each_row);
  }
  looker.aim();
  return looker.answer();
}

bool ExactRays::confirm(const View& view, ObjectId object, const Vec3& direction) const {
  const exact::ViewLimits limits(view);
  const auto target = std::find_if(detail_->solids.begin(), detail_->solids.end(),
                                   [&](const exact::Solid& s) { return s.id == object; });
  if (target == detail_->solids.end() || object == view.rides) return false;
  if (exact::surely_holds(*target, limits.eye())) return true;
  const double length = glm::length(direction);
  if (!(length > 0.0)) return false;
  const Vec3 middle = direction / length;
  // All that a ray of the bundle could meet: balls about the middle ray, widened by the bundle's angle.
  constexpr double bundle = 3e-5, aside = 1e-5, corner = 1e-7;  // radians
  std::vector<const exact::Solid*> others;
  for (const exact::Solid& s : detail_->solids) {
    if (!s.occluder || s.id == view.rides || exact::surely_holds(s, limits.eye())) continue;
    const Vec3 d = s.position - limits.eye();
    const double reach = s.reach * (1.0 + 1e-9) + bundle * glm::length(d);
    if (glm::length(glm::cross(d, middle)) <= reach && glm::dot(d, middle) >= -reach) others.push_back(&s);
  }
  // Seen with positive solid angle: along three rays that span a little cone, and along its middle.
  std::vector<exact::Stretch> scratch;
  const auto sees = [&](const Vec3& ray) { return exact::seen_past(limits, *target, others, ray, scratch); };
  const auto sees_cone = [&](const Vec3& ray) {
    const std::vector<Vec3> corners = exact::cone(ray, corner, 3);
    return sees(ray) && std::all_of(corners.begin(), corners.end(), sees);
  };
  if (sees_cone(middle)) return true;
  for (const double angle : {3.0 * corner, aside}) {
    const std::vector<Vec3> around = exact::cone(middle, angle, 8);
    if (std::any_of(around.begin(), around.end(), sees_cone)) return true;
  }
  return false;
}

}  // namespace gridcull
