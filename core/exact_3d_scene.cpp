// Embree 3: spheres as its own points, boxes, hulls and faces as triangles, prisms (whose outlines may be concave
// or cross themselves) and volumes as user geometry with the analytic stretches. Coordinates are relative to the
// world's middle, so that floats are as good as they can be.
#include "gridcull/core/exact_3d_scene.h"

#if GRIDCULL_HAS_EMBREE
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "gridcull/core/embree_device.h"
#include "gridcull/core/error.h"

namespace gridcull::exact {

#if GRIDCULL_HAS_EMBREE

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// What the callbacks of one geometry need: the solid of each primitive.
struct Part {
  const std::vector<Solid>* solids = nullptr;
  Vec3 middle{0.0};
  std::vector<std::uint32_t> solid_of;
};

/// Embree hands this back to the callbacks of a ray.
struct RayContext {
  RTCIntersectContext base;
  const std::vector<char>* skip;
  Vec3 eye;
  Vec3 ray;
};

void filter(const RTCFilterFunctionNArguments* args) {
  const auto* part = static_cast<const Part*>(args->geometryUserPtr);
  const auto* context = reinterpret_cast<const RayContext*>(args->context);
  const std::uint32_t solid = part->solid_of[RTCHitN_primID(args->hit, args->N, 0)];
  if ((*context->skip)[solid]) args->valid[0] = 0;
}

void prism_bounds(const RTCBoundsFunctionArguments* args) {
  const auto* part = static_cast<const Part*>(args->geometryUserPtr);
  const Bounds& box = (*part->solids)[part->solid_of[args->primID]].world_box;
  const auto pad = [](double x, float towards) {
    return std::nextafter(std::nextafter(static_cast<float>(x), towards), towards);
  };
  const Vec3 low = box.min - part->middle, high = box.max - part->middle;
  *args->bounds_o = {pad(low.x, -infinite), pad(low.y, -infinite), pad(low.z, -infinite), 0.0F,
                     pad(high.x, infinite), pad(high.y, infinite), pad(high.z, infinite), 0.0F};
}

void prism_intersect(const RTCIntersectFunctionNArguments* args) {
  const auto* part = static_cast<const Part*>(args->geometryUserPtr);
  const auto* context = reinterpret_cast<const RayContext*>(args->context);
  const std::uint32_t solid = part->solid_of[args->primID];
  if (!args->valid[0] || (*context->skip)[solid]) return;
  auto* ray = reinterpret_cast<RTCRayHit*>(args->rayhit);
  std::vector<Stretch> stretches;
  add_stretches((*part->solids)[solid], context->eye, context->ray, stretches);
  for (const Stretch& s : stretches) {
    const float t = static_cast<float>(s.begin);
    if (!(t > ray->ray.tnear && t < ray->ray.tfar)) continue;
    ray->ray.tfar = t;
    ray->hit.geomID = args->geomID;
    ray->hit.primID = args->primID;
    return;
  }
}

/// Nothing occludes here: shadow rays are not used.
void prism_occluded(const RTCOccludedFunctionNArguments*) {}

void refuse(const char* what) { throw Error(ErrorCode::internal, std::string("Embree: ") + what); }

}  // namespace

struct RayScene::Detail {
  RTCDevice device = embree_device();
  RTCScene scene = nullptr;
  Vec3 middle{0.0};
  double blur = 0.0;
  Part spheres, meshes, prisms;    ///< prisms: and volumes
  std::vector<const Part*> parts;  ///< by geometry id

  ~Detail() {
    if (scene != nullptr) rtcReleaseScene(scene);
  }

  void attach(RTCGeometry geometry, Part& part) {
    rtcSetGeometryUserData(geometry, &part);
    rtcCommitGeometry(geometry);
    const unsigned id = rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    parts.resize(std::max<std::size_t>(parts.size(), id + 1), nullptr);
    parts[id] = &part;
  }

  template <class T>
  T* buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) const {
    auto* data = static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count));
    if (data == nullptr) refuse("no memory for a buffer");
    return data;
  }

  void add_spheres(const std::vector<Solid>& solids) {
    if (spheres.solid_of.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    using Point = std::array<float, 4>;
    auto* out = buffer<Point>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, spheres.solid_of.size());
    for (const std::uint32_t i : spheres.solid_of) {
      const Vec3 c = solids[i].position - middle;
      *out++ = {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z),
                static_cast<float>(solids[i].radius)};
    }
    attach(geometry, spheres);
  }

  void add_meshes(const std::vector<Solid>& solids) {
    std::size_t vertices = 0, triangles = 0;
    for (const Solid& s : solids) {
      if (s.triangles.empty()) continue;
      vertices += s.vertices.size(), triangles += s.triangles.size();
    }
    if (triangles == 0) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    using Corner = std::array<float, 3>;
    using Triple = std::array<std::uint32_t, 3>;
    auto* corner = buffer<Corner>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices);
    auto* triple = buffer<Triple>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
    std::uint32_t base = 0;
    for (std::uint32_t i = 0; i < solids.size(); ++i) {
      const Solid& s = solids[i];
      if (s.triangles.empty()) continue;
      for (const Vec3& p : s.vertices) {
        const Vec3 c = p - middle;
        *corner++ = {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
      }
      for (const auto& t : s.triangles) {
        *triple++ = {base + t[0], base + t[1], base + t[2]};
        meshes.solid_of.push_back(i);
      }
      base += static_cast<std::uint32_t>(s.vertices.size());
    }
    attach(geometry, meshes);
  }

  void add_prisms() {
    if (prisms.solid_of.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(prisms.solid_of.size()));
    rtcSetGeometryBoundsFunction(geometry, prism_bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, prism_intersect);
    rtcSetGeometryOccludedFunction(geometry, prism_occluded);
    attach(geometry, prisms);
  }
};

RayScene::RayScene(const std::vector<Solid>& solids) : detail_(std::make_unique<Detail>()) {
  Detail& d = *detail_;
  Bounds world;
  for (const Solid& s : solids) world.add(s.world_box.min), world.add(s.world_box.max);
  if (!world.empty()) {
    d.middle = world.centre();
    // Floats keep 24 bits; a ray's hit is good to a few of the last of them.
    d.blur = 1e-6 * std::max(1e-3, glm::length(world.size()));
  }
  d.scene = rtcNewScene(d.device);
  rtcSetSceneFlags(d.scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  for (Part* part : {&d.spheres, &d.meshes, &d.prisms}) part->solids = &solids, part->middle = d.middle;
  for (std::uint32_t i = 0; i < solids.size(); ++i) {
    if (solids[i].kind == SolidKind::sphere) d.spheres.solid_of.push_back(i);
    if (solids[i].kind == SolidKind::prism || solids[i].kind == SolidKind::volume) d.prisms.solid_of.push_back(i);
  }
  d.add_spheres(solids);
  d.add_meshes(solids);
  d.add_prisms();
  rtcJoinCommitScene(d.scene);
  if (rtcGetDeviceError(d.device) != RTC_ERROR_NONE) refuse("the scene was refused");
}

RayScene::~RayScene() = default;

RayScene::Hit RayScene::first(const Vec3& eye, const Vec3& ray, double limit, const std::vector<char>& skip) const {
  RayContext context{};
  rtcInitIntersectContext(&context.base);
  context.base.filter = filter;
  context.skip = &skip;
  context.eye = eye;
  context.ray = ray;
  const Vec3 from = eye - detail_->middle;
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(from.x);
  query.ray.org_y = static_cast<float>(from.y);
  query.ray.org_z = static_cast<float>(from.z);
  query.ray.dir_x = static_cast<float>(ray.x);
  query.ray.dir_y = static_cast<float>(ray.y);
  query.ray.dir_z = static_cast<float>(ray.z);
  query.ray.tnear = static_cast<float>(detail_->blur);
  query.ray.tfar = static_cast<float>(std::min(limit, 1e30));
  query.ray.mask = 0xFFFF'FFFFu;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  if (!(query.ray.tfar > query.ray.tnear)) return {};
  rtcIntersect1(detail_->scene, &context.base, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {detail_->parts[query.hit.geomID]->solid_of[query.hit.primID], static_cast<double>(query.ray.tfar)};
}

double RayScene::blur() const { return detail_->blur; }

#else

struct RayScene::Detail {};

RayScene::RayScene(const std::vector<Solid>&) {
  throw Error(ErrorCode::usage, "built without Embree: no 3D reference (Debian: libembree-dev)");
}
RayScene::~RayScene() = default;
RayScene::Hit RayScene::first(const Vec3&, const Vec3&, double, const std::vector<char>&) const { return {}; }
double RayScene::blur() const { return 0.0; }

#endif

}  // namespace gridcull::exact
