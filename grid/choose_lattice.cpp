#include "gridcull/grid/choose_lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "gridcull/core/volume_body.h"

namespace gridcull {
namespace {

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

/// 10 to the power, from exact products and one division: the same bits everywhere.
double power_of_ten(int exponent) {
  double value = 1.0;
  for (int i = 0; i < std::abs(exponent); ++i) value *= 10.0;
  return exponent < 0 ? 1.0 / value : value;
}

double step_times(double step, int exponent) {
  return exponent < 0 ? step / power_of_ten(-exponent) : step * power_of_ten(exponent);
}

constexpr double steps[] = {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
constexpr int least_exponent = -9, greatest_exponent = 10;

/// The greatest round number at most `size`, or the least there is.
double round_down(double size) {
  double best = step_times(1.0, least_exponent);
  for (int exponent = least_exponent; exponent <= greatest_exponent; ++exponent) {
    for (const double step : steps) {
      const double candidate = step_times(step, exponent);
      if (candidate <= size) best = candidate;
    }
  }
  return best;
}

double count_cells(int dimension, const Vec3& extent, double cell) {
  double cells = 1.0;
  for (int axis = 0; axis < dimension; ++axis) cells *= std::fmax(1.0, std::ceil(extent[axis] / cell));
  return cells;
}

/// The least round number that is at least `size` and leads to few enough cells.
double enlarge(int dimension, const Vec3& extent, double size) {
  for (int exponent = least_exponent; exponent <= greatest_exponent; ++exponent) {
    for (const double step : steps) {
      const double candidate = step_times(step, exponent);
      if (candidate >= size && count_cells(dimension, extent, candidate) <= most_cells) return candidate;
    }
  }
  return step_times(1.0, greatest_exponent + 1);
}

/// Upper median of the smaller dimensions; nothing when there are none.
std::optional<double> median_size(std::span<const Object> objects, bool occluders_only) {
  std::vector<double> sizes;
  for (const Object& object : objects) {
    const double size = smaller_dimension(object.shape);
    if (size > 0.0 && (object.occluder || !occluders_only)) sizes.push_back(size);
  }
  if (sizes.empty()) return std::nullopt;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

void choose_cell(int dimension, std::span<const Object> objects, const Vec3& extent, LatticeChoice& choice) {
  double wanted = 0.0;
  if (const auto occluders = median_size(objects, true)) {
    wanted = round_down(*occluders / 4.0);
    choice.cell_reason = "a quarter of the median smaller side of the occluders (" + text(*occluders) + " m)";
  } else if (const auto all = median_size(objects, false)) {
    wanted = round_down(*all / 4.0);
    choice.cell_reason = "nothing occludes: a quarter of the median smaller side of all objects (" + text(*all) + " m)";
  } else {
    const double greatest = std::max({extent.x, extent.y, extent.z});
    wanted = greatest > 0.0 ? round_down(greatest / 64.0) : 1.0;
    choice.cell_reason = "no object has an interior: a 64th of the bounds";
  }
  choice.cell = wanted;
  if (count_cells(dimension, extent, wanted) > most_cells) {
    choice.cell = enlarge(dimension, extent, wanted);
    choice.cell_reason += ", enlarged from " + text(wanted) + " m to keep to 4 million cells";
  }
}

/// Whole cells around the bounds, moved by a 1024th of a cell.
void round_outward(int dimension, double cell, Bounds& bounds) {
  const double beyond = (1.0 - 1.0 / 1024.0) * cell;
  for (int axis = 0; axis < dimension; ++axis) {
    bounds.min[axis] = std::floor(bounds.min[axis] / cell) * cell - beyond;
    bounds.max[axis] = std::ceil(bounds.max[axis] / cell) * cell;
  }
}

Vec2 extent_of(const std::vector<Vec2>& points) {
  Bounds box;
  for (const Vec2& p : points) box.add({p.x, p.y, 0.0});
  return {box.size().x, box.size().y};
}

struct SmallerDimension {
  double operator()(const Disc& s) const { return 2.0 * s.radius; }
  double operator()(const Rectangle& s) const { return std::min(s.size.x, s.size.y); }
  double operator()(const Polygon& s) const {
    const Vec2 size = extent_of(s.vertices);
    return std::min(size.x, size.y);
  }
  double operator()(const Polyline&) const { return 0.0; }
  double operator()(const Sphere& s) const { return 2.0 * s.radius; }
  double operator()(const Cuboid& s) const { return std::min({s.size.x, s.size.y, s.size.z}); }
  double operator()(const Prism& s) const {
    const Vec2 size = extent_of(s.vertices);
    return std::min({size.x, size.y, s.height});
  }
  double operator()(const Convex& s) const { return least_side(s.vertices); }
  double operator()(const Faces& s) const { return s.closed ? least_side(s.vertices) : 0.0; }
  double operator()(const Volume& s) const { return least_side(s.body->outer); }

 private:
  static double least_side(const std::vector<Vec3>& vertices) {
    Bounds box;
    for (const Vec3& p : vertices) box.add(p);
    return std::min({box.size().x, box.size().y, box.size().z});
  }
};

}  // namespace

double smaller_dimension(const Shape& shape) { return std::visit(SmallerDimension{}, shape); }

void add_extent(const Object& object, Bounds& bounds) {
  const Vec3& position = object.pose.position;
  if (const auto* disc = std::get_if<Disc>(&object.shape)) {
    bounds.add(position - Vec3(disc->radius, disc->radius, 0.0));
    bounds.add(position + Vec3(disc->radius, disc->radius, 0.0));
  } else if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
    bounds.add_ball(position, sphere->radius);
  } else if (dimension_of(object.shape) == 2) {
    for (const Vec2& p : world_outline(object.shape, object.pose)) bounds.add({p.x, p.y, 0.0});
  } else {
    for (const Vec3& p : world_vertices(object.shape, object.pose)) bounds.add(p);
  }
}

LatticeChoice choose_lattice(int dimension, std::span<const Object> objects, std::optional<Bounds> bounds,
                             std::optional<double> cell, const Bounds& ways) {
  LatticeChoice choice{};
  if (bounds) {
    choice.bounds = *bounds;
    choice.bounds_reason = "as asked";
  } else {
    choice.bounds = ways;
    for (const Object& object : objects) add_extent(object, choice.bounds);
    choice.bounds_reason = ways.empty() ? "the box of all objects, rounded outward to whole cells"
                                        : "the box of all objects and their ways, rounded outward to whole cells";
  }
  const bool empty = choice.bounds.empty();
  if (empty) {
    choice.bounds_reason = "nothing is there: one cell";
    choice.bounds.min = choice.bounds.max = Vec3(0.0);
  }
  if (cell) {
    choice.cell = *cell;
    choice.cell_reason = "as asked";
  } else if (empty) {
    choice.cell = 1.0;
    choice.cell_reason = "nothing is there";
  } else {
    choose_cell(dimension, objects, choice.bounds.size(), choice);
  }
  if (!bounds && !empty && choice.cell > 0.0) round_outward(dimension, choice.cell, choice.bounds);
  return choice;
}

}  // namespace gridcull
