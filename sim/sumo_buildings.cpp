#include "gridcull/sim/sumo_buildings.h"

#include <algorithm>

#include <pugixml.hpp>

#include "gridcull/core/bounds.h"
#include "gridcull/core/error.h"
#include "gridcull/sim/import_parts.h"
#include "gridcull/sim/sumo_shapes.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

[[noreturn]] void refuse(const std::string& place, const std::string& why) {
  throw Error(ErrorCode::bad_message, place + why);
}

/// "x,y x,y ..." (a third coordinate is passed over).
template <class Place>
std::vector<Vec2> parse_outline(std::string_view text, const Place& place) {
  std::vector<Vec2> out;
  constexpr std::string_view spaces = " \t\r\n";
  while (true) {
    const std::size_t begin = text.find_first_not_of(spaces);
    if (begin == std::string_view::npos) return out;
    text.remove_prefix(begin);
    const std::string_view point = text.substr(0, text.find_first_of(spaces));
    text.remove_prefix(point.size());
    const std::size_t comma = point.find(',');
    const std::string_view rest = comma == std::string_view::npos ? "" : point.substr(comma + 1);
    const auto x = parse_number(point.substr(0, comma));
    const auto y = parse_number(rest.substr(0, rest.find(',')));
    if (!x || !y) refuse(place(), "expected a point x,y of magnitude at most 1e9, found " + quoted(point));
    out.emplace_back(*x, *y);
  }
}

template <class Place>
double height_of(const pugi::xml_node& node, const Place& place) {
  const pugi::xml_attribute value = node.find_child_by_attribute("param", "key", "height").attribute("value");
  if (!value) return 0.0;
  const auto height = parse_number(value.value());
  if (!height || !(*height > 0.0)) {
    refuse(place(), "expected a height above 0, at most 1e9, found " + quoted(value.value()));
  }
  return *height;
}

bool meets(const std::vector<Vec2>& outline, const std::array<double, 4>& box) {
  Bounds around;
  for (const Vec2& p : outline) around.add({p.x, p.y, 0.0});
  return around.min.x <= box[2] && around.max.x >= box[0] && around.min.y <= box[3] && around.max.y >= box[1];
}

}  // namespace

std::vector<SceneObject> read_sumo_buildings(const std::string& path, const std::optional<std::array<double, 4>>& box,
                                             std::vector<std::string>& notes, std::vector<double>& heights) {
  const std::string text = read_text(path);
  const auto place = [&](std::ptrdiff_t offset) {
    const auto end = text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text.size()));
    return path + ":" + std::to_string(1 + std::count(text.begin(), end, '\n')) + ": ";
  };
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed) refuse(place(parsed.offset), std::string("expected XML: ") + parsed.description());
  const pugi::xml_node root = document.document_element();
  const std::string_view name = root.name();
  if (name != "additional" && name != "shapes") {
    refuse(place(root.offset_debug()), "expected the element <additional>, found <" + std::string(name) + ">");
  }
  std::vector<SceneObject> out;
  for (const pugi::xml_node& node : root.children("poly")) {
    if (!is_sumo_building(node.attribute("type").value())) continue;
    const auto where = [&] {
      return place(node.offset_debug()) + "polygon " + quoted(node.attribute("id").value()) + ": ";
    };
    if (node.attribute("geo").as_bool()) refuse(where(), "expected coordinates in metres, found geo coordinates");
    const std::vector<Vec2> outline = parse_outline(node.attribute("shape").value(), where);
    std::optional<SceneObject> building = sumo_building(outline, node.attribute("id").value());
    if (!building) {
      const std::size_t points = distinct_points(merged_outline(outline));
      notes.push_back(where() + std::to_string(points) + " distinct points, at least 3 are needed: skipped");
      continue;
    }
    if (box && !meets(outline, *box)) continue;
    building->object.id = static_cast<ObjectId>(out.size());
    out.push_back(std::move(*building));
    heights.push_back(height_of(node, where));
  }
  return out;
}

}  // namespace gridcull
