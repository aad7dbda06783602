#include "random_volumes.h"

#include <cmath>
#include <functional>

#include "gridcull/core/error.h"
#include "gridcull/core/volume.h"

namespace gridcull::test {
namespace {

class Maker {
 public:
  explicit Maker(std::mt19937_64& random) : random_(random) {}

  Volume make(double reach) {
    count_ = 2 + below(chance(0.2) ? 26 : 12);
    const int first = static_cast<int>(below(20)) - 10;
    first_ = LatticePoint(first, first + static_cast<int>(below(9)), first - static_cast<int>(below(9)));
    last_ = first_ + LatticePoint(static_cast<int>(count_));
    middle_ = 0.5 * (Vec3(first_) + Vec3(last_));
    const std::function<double(const Vec3&)> depth = kind();
    const bool below_iso = chance(0.5);
    const double iso = chance(0.5) ? 0.0 : uniform(-1.0, 1.0);
    const double sign = below_iso ? 1.0 : -1.0;
    // The outermost points may be inside: then the surface lies beyond them, towards the background.
    const auto background = static_cast<float>(iso + sign * (chance(0.2) ? 0.0 : uniform(0.1, 3.0)));
    const bool outside = below_iso ? background < iso : background > iso;  // rounded across iso
    auto field = field_of(frame(reach), outside ? static_cast<float>(iso + sign) : background, first_, last_,
                          [&](const LatticePoint& p) { return static_cast<float>(iso + sign * depth(Vec3(p))); });
    if (chance(0.15)) field = with_tile(field, static_cast<float>(iso - sign));
    return make_volume(std::make_shared<const ScalarField>(std::move(field)), iso, below_iso);
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  bool chance(double p) { return unit() < p; }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }

  FieldFrame frame(double reach) {
    FieldFrame frame;
    frame.voxel = 2.0 * reach / count_;
    if (chance(0.4)) {
      do {
        Quat& q = frame.pose.orientation;
        q = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
        if (chance(0.3)) q = {std::round(q.w), std::round(q.x), std::round(q.y), std::round(q.z)};
      } while (std::fabs(frame.pose.orientation.w) < 0.1 && std::fabs(frame.pose.orientation.z) < 0.1);
      frame.pose.orientation = normalised(frame.pose.orientation);
    }
    const Rotation r = rotation_of(frame.pose.orientation);
    frame.pose.position = -(r * (frame.voxel * middle_));
    if (chance(0.2)) frame.pose.position += Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) * reach;
    return frame;
  }

  /// Below 0 inside.
  std::function<double(const Vec3&)> kind() {
    const double r = 0.5 * count_;
    switch (below(7)) {
      case 0: return [this, r](const Vec3& p) { return glm::length(p - middle_) - 0.9 * r; };
      case 1: {
        const Vec3 lump = middle_ + 0.5 * r * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        return [this, r, lump](const Vec3& p) {
          return std::min(glm::length(p - lump) - 0.45 * r, glm::length(p - middle_) - 0.55 * r);
        };
      }
      case 2:
        return [this, r](const Vec3& p) {
          const Vec3 d = p - middle_;
          return std::hypot(std::hypot(d.x, d.y) - 0.65 * r, d.z) - 0.3 * r;
        };
      case 3: {
        const double thick = uniform(0.1, 0.8);
        return [this, r, thick](const Vec3& p) {
          const Vec3 d = glm::abs(p - middle_);
          return std::max({d.x - thick * r, d.y - 0.95 * r, d.z - 0.95 * r});
        };
      }
      case 4: return [this](const Vec3&) { return uniform(-1.0, 0.3); };
      case 5: return [this](const Vec3&) { return std::floor(uniform(-2.0, 1.5)); };
      default: return [this](const Vec3&) { return chance(0.1) ? -1.0 : 1.0; };
    }
  }

  /// Eight points an edge more, beyond all blocks.
  ScalarField with_tile(const ScalarField& field, float value) {
    LatticePoint origin = field.blocks().back().origin;
    origin.x += 8;
    return ScalarField(field.frame(), field.background(), field.blocks(), {{origin, 8, value}});
  }

  std::mt19937_64& random_;
  std::uint32_t count_ = 0;
  LatticePoint first_{0}, last_{0};
  Vec3 middle_{0.0};
};

}  // namespace

Volume random_volume(std::mt19937_64& random, double reach) {
  for (;;) {
    try {
      return Maker(random).make(reach);
    } catch (const Error&) {
      // Nothing inside: once more.
    }
  }
}

}  // namespace gridcull::test
