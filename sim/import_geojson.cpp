#include "gridcull/sim/import_geojson.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gridcull/core/bounds.h"
#include "gridcull/core/error.h"
#include "gridcull/core/trigonometry.h"
#include "gridcull/sim/import_parts.h"
#include "gridcull/sim/json_tree.h"
#include "gridcull/sim/sumo_shapes.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

using Ring = std::vector<Vec2>;

/// A polygon as the file gives it: the outer ring, then holes.
struct Footprint {
  std::vector<Ring> rings;
  std::string name;
  std::string where;
  std::optional<double> height;
};

/// Metres a degree of latitude and of longitude there (WGS 84).
struct Plane {
  Vec2 origin{0.0};
  Vec2 metres{1.0};

  static Plane at(const Vec2& origin) {
    constexpr double equator = 6378137.0, eccentricity2 = 6.69437999014e-3;
    constexpr double degree = std::numbers::pi / 180.0;
    const SinCos latitude = stable_sincos(origin.y * degree);
    const double w2 = 1.0 - eccentricity2 * latitude.sin * latitude.sin, w = std::sqrt(w2);
    return {origin, {equator / w * latitude.cos * degree, equator * (1.0 - eccentricity2) / (w2 * w) * degree}};
  }
  Vec2 operator()(const Vec2& p) const { return (p - origin) * metres; }
};

/// The number that a text begins with, "12.5 m".
std::optional<double> leading_number(std::string_view text) {
  return parse_number(text.substr(0, text.find_first_not_of("0123456789.+-eE")));
}

std::optional<double> positive_property(const JsonRef& properties, std::string_view key) {
  const auto value = properties.find(key);
  if (!value) return std::nullopt;
  std::optional<double> number;
  if (value->is_string()) {
    number = leading_number(value->string());
  } else if (value->is_number()) {
    number = value->number();
  }
  if (!number || !(*number > 0.0)) return std::nullopt;  // maps hold "unknown", 0 and null: as if it were not there
  return number;
}

class Reader {
 public:
  Reader(const GeojsonOptions& options, std::vector<std::string>& notes) : options_(options), notes_(notes) {}

  std::vector<Footprint> read() {
    const JsonTree tree(read_text(options_.file), options_.file, ErrorCode::bad_message);
    const JsonRef root = tree.root();
    const std::string_view type = root.at("type").string();
    if (type == "FeatureCollection") {
      for (const JsonRef& feature : root.at("features").items()) read_feature(feature);
    } else if (type == "Feature") {
      read_feature(root);
    } else {
      root.at("type").refuse("\"FeatureCollection\" or \"Feature\"");
    }
    if (others_ > 0) notes_.push_back(std::to_string(others_) + " features that are no polygons: skipped");
    return std::move(found_);
  }

 private:
  void read_feature(const JsonRef& feature) {
    if (feature.at("type").string() != "Feature") feature.at("type").refuse("\"Feature\"");
    const JsonRef geometry = feature.at("geometry");
    if (geometry.is_null()) {
      ++others_;
      return;
    }
    const std::string_view type = geometry.at("type").string();
    Footprint like;
    like.where = feature.pointer();
    read_properties(feature, like);
    if (type == "Polygon") {
      read_polygon(geometry.at("coordinates"), like);
    } else if (type == "MultiPolygon") {
      for (const JsonRef& part : geometry.at("coordinates").items()) read_polygon(part, like);
    } else {
      ++others_;
    }
  }
  void read_properties(const JsonRef& feature, Footprint& out) const {
    if (const auto id = feature.find("id"); id && id->is_string()) out.name = id->string();
    const auto properties = feature.find("properties");
    if (!properties || properties->is_null()) return;
    if (const auto name = properties->find("name"); name && name->is_string()) out.name = name->string();
    out.height = positive_property(*properties, "height");
    if (!out.height) out.height = positive_property(*properties, "building:height");
    const auto levels = positive_property(*properties, "building:levels");
    constexpr double greatest = 1e9;  // of a scene's coordinates
    if (!out.height && levels && *levels * options_.level_height <= greatest) {
      out.height = *levels * options_.level_height;
    }
  }
  void read_polygon(const JsonRef& rings, Footprint like) {
    for (const JsonRef& ring : rings.items()) {
      Ring& points = like.rings.emplace_back();
      for (const JsonRef& point : ring.items()) {
        const std::vector<JsonRef> parts = point.items();
        if (parts.size() < 2) point.refuse("a position [x, y]");
        points.push_back({parts[0].number(), parts[1].number()});
        if (!options_.metres && !(std::fabs(points.back().x) <= 180.0 && std::fabs(points.back().y) <= 89.9)) {
          point.refuse("degrees of longitude and latitude (coordinates in metres: --metres)");
        }
      }
    }
    found_.push_back(std::move(like));
  }

  const GeojsonOptions& options_;
  std::vector<std::string>& notes_;
  std::vector<Footprint> found_;
  std::uint64_t others_ = 0;
};

/// One outline with the holes joined to the outer ring by bridges that are walked both ways: what lies inside by the
/// even-odd rule stays the same, for a bridge's two sides cancel.
Ring one_outline(const std::vector<Ring>& rings) {
  if (rings.empty() || rings[0].empty()) return {};
  Ring out = rings[0];
  const Vec2 start = out.front();
  if (out.back() != start) out.push_back(start);
  for (std::size_t i = 1; i < rings.size(); ++i) {
    Ring hole = rings[i];
    if (hole.empty()) continue;
    if (hole.back() != hole.front()) hole.push_back(hole.front());
    out.insert(out.end(), hole.begin(), hole.end());
    out.push_back(start);
  }
  return out;
}

Vec2 middle_of(const std::vector<Footprint>& footprints) {
  Bounds box;
  for (const Footprint& footprint : footprints) {
    for (const Vec2& p : footprint.rings.empty() ? Ring{} : footprint.rings[0]) box.add({p.x, p.y, 0.0});
  }
  if (box.empty()) return {0.0, 0.0};
  const auto rounded = [](double degrees) { return std::round(degrees * 1000.0) / 1000.0; };
  return {rounded(box.centre().x), rounded(box.centre().y)};
}

}  // namespace

Imported import_geojson(const GeojsonOptions& options) {
  Imported out;
  const std::vector<Footprint> footprints = Reader(options, out.notes).read();
  const Plane plane = options.metres ? Plane{} : Plane::at(options.origin ? *options.origin : middle_of(footprints));
  out.scene.dimension = options.height ? 3 : 2;
  Bounds box;
  std::uint64_t guessed = 0;
  for (const Footprint& footprint : footprints) {
    Ring outline = one_outline(footprint.rings);
    for (Vec2& p : outline) p = plane(p);
    auto object = sumo_building(outline, footprint.name);
    if (!object) {
      out.notes.push_back(options.file + ": " + footprint.where + ": fewer than 3 distinct points: skipped");
      continue;
    }
    object->object.id = static_cast<ObjectId>(out.scene.objects.size());
    double height = 0.0;
    if (options.height) {
      guessed += !footprint.height;
      height = footprint.height.value_or(*options.height);
      object->object.shape = Prism{std::get<Polygon>(object->object.shape).vertices, height};
    }
    for (const Vec2& p : outline) {
      box.add({p.x, p.y, 0.0});
      box.add({p.x, p.y, height});
    }
    out.scene.objects.push_back(std::move(*object));
  }
  if (guessed > 0)
    out.notes.push_back(std::to_string(guessed) + " buildings without a height: " + short_number(*options.height) +
                        " m");
  if (!options.metres) {
    out.notes.push_back("(0, 0) is longitude " + std::to_string(plane.origin.x) + ", latitude " +
                        std::to_string(plane.origin.y));
  }
  // In 3D they are derived with the cell, so that opaque cells begin right above the ground.
  if (!box.empty() && !options.height) {
    out.scene.bounds = Bounds{glm::floor(box.min), glm::max(glm::ceil(box.max), glm::floor(box.min) + 1.0)};
    out.scene.bounds->min.z = out.scene.bounds->max.z = 0.0;
  }
  return out;
}

}  // namespace gridcull
