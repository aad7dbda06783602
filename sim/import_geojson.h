// Import of building footprints (GeoJSON, RFC 7946) as static objects: prisms of their heights, or their outlines in
// 2D.
#pragma once

#include <optional>
#include <string>

#include "gridcull/sim/imported.h"

namespace gridcull {

struct GeojsonOptions {
  std::string file{};
  /// Metres of buildings that say nothing of their height: 3D. None: a 2D scene of the outlines.
  std::optional<double> height{};
  double level_height = 3.0;  ///< metres a storey, for `building:levels`
  bool metres = false;        ///< coordinates are metres already, and not degrees of longitude and latitude
  /// Degrees of longitude and latitude that become (0, 0). None: the middle of all, rounded to a thousandth.
  std::optional<Vec2> origin{};
};

/// Each Polygon, or part of a MultiPolygon, is a static object on the ground, ids from 0 in file order; `name` is the
/// feature's property `name`, else its id. Holes stay holes. Its height is the property `height` or `building:height`
/// (a number, or text such as "12.5 m"), else `building:levels` storeys, else options.height. Other geometries are
/// counted in `notes`. Degrees become metres on the plane that touches the WGS 84 ellipsoid at the origin (east and
/// north; within 1e-4 of lengths for 30 km around). Throws Error(io), Error(bad_message).
Imported import_geojson(const GeojsonOptions& options);

}  // namespace gridcull
