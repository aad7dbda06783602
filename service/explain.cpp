// Which occluders cover an object is found out with the exact reference alone. Claim: the object is hidden by `by`
// alone. Begin with nobody; while the reference still sees the object past those found, it names a line of sight; the
// object is hidden in the whole world, so some occluder blocks that line, and the nearest one joins. Each round adds
// an occluder that was not there (those that are do not block the line), so the rounds end; the last one is the proof.
// In 2D each that can be spared is then taken out again.
#include "gridcull/service/explain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/grid/cover.h"
#include "gridcull/methods/local_shape.h"

namespace gridcull {
namespace {

/// A world's objects as one view of one object needs them.
class Inquiry {
 public:
  Inquiry(std::span<const Object> world, const Lattice& lattice, const View& view, ObjectId object, int rays)
      : lattice_(lattice), view_(view), rays_(rays), target_(find(world, object)), between_(those_between(world)) {}

  Explanation answer() {
    Explanation out;
    out.cells = cells();
    if (target_.id == view_.rides) return out;
    if (interior_holds(target_.shape, target_.pose, view_.pose.position)) {
      out.verdict = Explanation::Verdict::contains_viewer;
      return out;
    }
    if (!witness({})) return out;
    if (const auto ray = witness_in(between_)) {
      out.verdict = Explanation::Verdict::visible;
      out.sees = view_.pose.position + *ray * entry(target_, *ray).value_or(distance());
      return out;
    }
    out.verdict = Explanation::Verdict::hidden;
    out.by = cover();
    return out;
  }

 private:
  static const Object& find(std::span<const Object> world, ObjectId id) {
    const auto found = std::find_if(world.begin(), world.end(), [id](const Object& o) { return o.id == id; });
    if (found != world.end()) return *found;
    throw Error(ErrorCode::unknown_object, "object " + std::to_string(id) + " is not there");
  }

  /// All that a line from the viewpoint to the target can meet: such lines lie within the target's reach of the line to
  /// its middle.
  std::vector<Object> those_between(std::span<const Object> world) const {
    const Vec3 along = target_.pose.position - view_.pose.position;
    const double square = glm::dot(along, along);
    std::vector<Object> out;
    for (const Object& object : world) {
      const Vec3 to = object.pose.position - view_.pose.position;
      const double t = square > 0.0 ? std::clamp(glm::dot(to, along) / square, 0.0, 1.0) : 0.0;
      const double slack = 1e-9 * (1.0 + glm::length(to) + glm::length(along));
      if (glm::length(to - t * along) <= reach_of(target_.shape) + reach_of(object.shape) + slack)
        out.push_back(object);
    }
    return out;
  }

  double distance() const { return glm::length(target_.pose.position - view_.pose.position); }

  /// A direction in which the target is seen in such a world; none when it is not.
  std::optional<Vec3> witness_in(std::span<const Object> world) const {
    const ExactAnswer seen =
        lattice_.dimension() == 2 ? exact_visible_2d(world, view_) : ExactRays(world, rays_).visible(view_);
    const auto at = std::lower_bound(seen.visible.begin(), seen.visible.end(), target_.id);
    if (at == seen.visible.end() || *at != target_.id) return std::nullopt;
    return seen.witness[static_cast<std::size_t>(at - seen.visible.begin())];
  }
  std::optional<Vec3> witness(const std::vector<const Object*>& occluders) const {
    std::vector<Object> world{target_};
    for (const Object* occluder : occluders) world.push_back(*occluder);
    return witness_in(world);
  }

  /// Metres along the ray (unit) at which it comes into the object's interior, or crosses a wall of it.
  std::optional<double> entry(const Object& object, const Vec3& ray) const {
    const LocalShape shape = make_local_shape(object.shape);
    const Rotation turn = rotation_of(object.pose.orientation);
    const Vec3 from = turn.inverse(view_.pose.position - object.pose.position), along = turn.inverse(ray);
    double low = 0.0;
    double high = glm::length(object.pose.position - view_.pose.position) + reach_of(object.shape);
    std::vector<double> scratch;
    const auto meets = [&](double metres) { return blocks_segment(shape, from, along * metres, scratch); };
    if (!meets(high)) return std::nullopt;
    for (int step = 0; step < 100 && low < high; ++step) {
      const double middle = 0.5 * (low + high);
      (meets(middle) ? high : low) = middle;
    }
    return high;
  }

  bool may_hide(const Object& object) const {
    return object.occluder && object.id != target_.id && object.id != view_.rides &&
           !interior_holds(object.shape, object.pose, view_.pose.position);
  }

  /// Whether the ray comes near enough to meet the object at all.
  bool passes_near(const Object& object, const Vec3& ray) const {
    const Vec3 to = object.pose.position - view_.pose.position;
    const double reach = reach_of(object.shape) + 1e-9 * (1.0 + glm::length(to));
    const double along = std::max(0.0, glm::dot(to, ray));
    const Vec3 off = to - along * ray;
    return glm::dot(off, off) <= reach * reach;
  }

  const Object* nearest_blocker(const Vec3& ray, const std::vector<const Object*>& known) const {
    const double until = entry(target_, ray).value_or(std::numeric_limits<double>::infinity());
    const Object* nearest = nullptr;
    double least = until;
    for (const Object& object : between_) {
      if (!passes_near(object, ray) || !may_hide(object)) continue;
      if (std::find(known.begin(), known.end(), &object) != known.end()) continue;
      const auto at = entry(object, ray);
      if (at && *at < least) least = *at, nearest = &object;
    }
    return nearest;
  }

  std::vector<ObjectId> cover() const {
    std::vector<const Object*> found;
    while (const auto ray = witness(found)) {
      const Object* next = nearest_blocker(*ray, found);
      if (next == nullptr) break;  // a line along an edge: rounding says so or so
      found.push_back(next);
    }
    if (lattice_.dimension() == 2) spare(found);
    std::vector<ObjectId> ids;
    for (const Object* object : found) ids.push_back(object->id);
    std::sort(ids.begin(), ids.end());
    return ids;
  }

  void spare(std::vector<const Object*>& occluders) const {
    for (std::size_t i = occluders.size(); i-- > 0;) {
      std::vector<const Object*> others = occluders;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      if (!witness(others)) occluders = std::move(others);
    }
  }

  std::vector<Cell> cells() const {
    CoverScratch scratch;
    Cover cover;
    PreparedShape(target_.shape).cover(lattice_, target_.pose, scratch, cover);
    std::vector<Cell> out;
    for (const BrickCover& brick : cover.bricks) {
      for (int bit = 0; bit < 64 && out.size() < Explanation::most_cells; ++bit) {
        if ((brick.touched >> bit & 1u) != 0) out.push_back(lattice_.cell_at(brick.brick, bit));
      }
    }
    return out;
  }

  const Lattice& lattice_;
  const View& view_;
  int rays_;
  const Object& target_;
  std::vector<Object> between_;
};

nlohmann::ordered_json coordinates(const Vec3& p, int dimension) {
  nlohmann::ordered_json json{p.x, p.y};
  if (dimension == 3) json.push_back(p.z);
  return json;
}

}  // namespace

std::string verdict_text(Explanation::Verdict verdict) {
  switch (verdict) {
    case Explanation::Verdict::visible: return "visible";
    case Explanation::Verdict::hidden: return "hidden";
    case Explanation::Verdict::contains_viewer: return "contains_viewer";
    case Explanation::Verdict::outside: break;
  }
  return "outside";
}

nlohmann::ordered_json explained_json(const Explanation& explanation, int dimension) {
  nlohmann::ordered_json json{{"type", "explained"}, {"verdict", verdict_text(explanation.verdict)}};
  json["by"] = explanation.by;
  json["cells"] = nlohmann::ordered_json::array();
  for (const Cell& cell : explanation.cells) {
    nlohmann::ordered_json at{cell.x, cell.y};
    if (dimension == 3) at.push_back(cell.z);
    json["cells"].push_back(std::move(at));
  }
  json["sees"] = nlohmann::ordered_json::array();
  if (explanation.sees) json["sees"].push_back(coordinates(*explanation.sees, dimension));
  return json;
}

Explanation explain(std::span<const Object> world, const Lattice& lattice, const View& view, ObjectId object,
                    int rays) {
  return Inquiry(world, lattice, view, object, rays).answer();
}

}  // namespace gridcull
