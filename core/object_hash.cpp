#include "gridcull/core/object_hash.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "gridcull/core/hash.h"
#include "gridcull/core/scalar_field.h"

namespace gridcull {
namespace {

struct WorldHash {
  StableHash hash;

  void add(std::uint64_t value) { hash.add64(value); }
  /// -0 is 0.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }
  void add(const Vec2& v) { add(v.x), add(v.y); }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  template <class T>
  void add(const std::vector<T>& values) {
    add(std::uint64_t{values.size()});
    for (const T& value : values) add(value);
  }
  void add(const std::array<std::uint32_t, 3>& triangle) {
    for (const std::uint32_t corner : triangle) hash.add(corner);
  }

  void add(const Disc& s) { add(s.radius); }
  void add(const Rectangle& s) { add(s.size); }
  void add(const Polygon& s) { add(s.vertices); }
  void add(const Polyline& s) { add(s.vertices); }
  void add(const Sphere& s) { add(s.radius); }
  void add(const Cuboid& s) { add(s.size); }
  void add(const Prism& s) { add(s.vertices), add(s.height); }
  void add(const Convex& s) { add(s.vertices); }
  void add(const Faces& s) {
    add(s.vertices), add(s.triangles);
    if (s.closed) hash.add(1u);
  }
  void add(const Pose& pose) {
    add(pose.position);
    const Quat& q = pose.orientation;
    for (const double part : {q.w, q.x, q.y, q.z}) add(part);
  }
  void add(const LatticePoint& p) {
    for (int k = 0; k < 3; ++k) hash.add(static_cast<std::uint32_t>(p[k]));
  }
  void add(float value) { hash.add(std::bit_cast<std::uint32_t>(value + 0.0f)); }
  void add(const Volume& s) {
    const ScalarField& field = *s.field;
    add(field.frame().voxel), add(field.frame().pose), add(field.background());
    add(s.iso), hash.add(s.inside_below ? 1u : 0u);
    add(std::uint64_t{field.blocks().size()}), add(std::uint64_t{field.tiles().size()});
    for (const FieldBlock& block : field.blocks()) {
      add(block.origin);
      for (const float value : block.values) add(value);
    }
    for (const FieldTile& tile : field.tiles()) {
      add(tile.origin), hash.add(static_cast<std::uint32_t>(tile.side)), add(tile.value);
    }
  }

  void add(const Object& object) {
    hash.add(object.id);
    hash.add(static_cast<std::uint32_t>(object.shape.index()));
    std::visit([this](const auto& shape) { add(shape); }, object.shape);
    add(object.pose);
    hash.add(object.occluder ? 1u : 0u);
  }
};

}  // namespace

std::uint64_t object_hash(const Object& object) {
  WorldHash hash;
  hash.add(object);
  return hash.hash.value();
}

std::uint64_t static_world_hash(std::span<const Object> objects) {
  std::vector<const Object*> statics;
  for (const Object& object : objects) {
    if (object.is_static) statics.push_back(&object);
  }
  std::sort(statics.begin(), statics.end(), [](const Object* a, const Object* b) { return a->id < b->id; });
  WorldHash hash;
  hash.add(std::uint64_t{statics.size()});
  for (const Object* object : statics) hash.add(*object);
  return hash.hash.value();
}

}  // namespace gridcull
