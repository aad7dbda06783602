#include "traffic.h"

#include <gridcull/sim/sumo_shapes.h>
#include <libsumo/libtraci.h>

using namespace gridcull;
using libtraci::Person;
using libtraci::Simulation;
using libtraci::Vehicle;

namespace {

constexpr double person_radius = 0.25, person_speed = 10.0, vehicle_speed = 60.0;  // metres, m/s: more than they do

ViewerUpdate viewer_with(double range) {
  ViewerUpdate out;
  out.range = range;
  return out;
}

/// What a subscription says about a vehicle or a person.
struct Place {
  Vec3 position{0.0};  ///< metres
  double angle = 0.0;  ///< degrees, SUMO's
  bool somewhere = false;
};

Place place_of(const libsumo::TraCIResults& said) {
  const auto position = said.find(libsumo::VAR_POSITION), angle = said.find(libsumo::VAR_ANGLE);
  if (position == said.end() || angle == said.end()) return {};
  const auto& at = dynamic_cast<const libsumo::TraCIPosition&>(*position->second);
  const double turn = dynamic_cast<const libsumo::TraCIDouble&>(*angle->second).value;
  const bool somewhere = at.x != libsumo::INVALID_DOUBLE_VALUE && at.y != libsumo::INVALID_DOUBLE_VALUE &&
                         turn != libsumo::INVALID_DOUBLE_VALUE;
  return {{at.x, at.y, 0.0}, turn, somewhere};
}

bool rides(const libsumo::TraCIResults& said) {
  const auto vehicle = said.find(libsumo::VAR_VEHICLE);
  return vehicle != said.end() && !dynamic_cast<const libsumo::TraCIString&>(*vehicle->second).value.empty();
}

}  // namespace

Traffic::Traffic(const TrafficOptions& options)
    : options_(options), frames_({.all = false, .count = options.equipped}, viewer_with(options.range)) {
  const std::vector<std::string> command{
      "sumo", "--configuration-file", options.config, "--step-length", std::to_string(options.step), "--end",
      "-1",   "--no-step-log",        "--no-warnings"};
  Simulation::start(command);
  if (options.begin > Simulation::getTime()) Simulation::step(options.begin);
  read_buildings();
  subscribe(Vehicle::getIDList(), Person::getIDList());
}

Traffic::~Traffic() {
  try {
    Simulation::close();
  } catch (const std::exception&) {  // SUMO has gone by itself: it is closed
  }
}

void Traffic::read_buildings() {
  Bounds all;
  for (const libsumo::TraCIPosition& corner : Simulation::getNetBoundary().value) all.add({corner.x, corner.y, 0.0});
  for (const std::string& id : libtraci::Polygon::getIDList()) {
    if (!is_sumo_building(libtraci::Polygon::getType(id))) continue;
    std::vector<Vec2> outline;
    for (const libsumo::TraCIPosition& p : libtraci::Polygon::getShape(id).value) outline.emplace_back(p.x, p.y);
    std::optional<SceneObject> building = sumo_building(outline, id);
    if (!building) continue;
    for (const Vec2& p : outline) all.add({p.x, p.y, 0.0});
    building->object.id = static_cast<ObjectId>(scene_.objects.size());
    names_[building->object.id] = id;
    scene_.objects.push_back(std::move(*building));
  }
  scene_.bounds = whole_metres(all);
  scene_.cell = 2.0;  // metres
  frames_.begin_ids_at(static_cast<ObjectId>(scene_.objects.size()));
}

void Traffic::subscribe(const std::vector<std::string>& vehicles, const std::vector<std::string>& people) {
  for (const std::string& id : vehicles) {
    Vehicle::subscribe(id, {libsumo::VAR_POSITION, libsumo::VAR_ANGLE});
    sizes_[id] = {Vehicle::getLength(id), Vehicle::getWidth(id)};
  }
  for (const std::string& id : people) {
    Person::subscribe(id, {libsumo::VAR_POSITION, libsumo::VAR_ANGLE, libsumo::VAR_VEHICLE});
  }
}

std::vector<MoverState> Traffic::states() {
  std::vector<MoverState> out;
  const auto add = [&](const std::string& name, const MoverKind& kind, const Vec3& position, double heading) {
    const ObjectId id = frames_.id_of(name, [&] { return kind; });
    names_.try_emplace(id, kind.name);
    out.push_back({id, position, heading});
  };
  for (const auto& [name, said] : Vehicle::getAllSubscriptionResults()) {
    const Place place = place_of(said);
    const auto size = sizes_.find(name);
    if (!place.somewhere || size == sizes_.end()) continue;
    const auto [length, width] = size->second;
    const double heading = sumo_heading(place.angle);
    const Vec3 middle = vehicle_middle(place.position, heading, length);
    add("v" + name, {name, Rectangle{{length, width}}, vehicle_speed, true}, middle, heading);
  }
  vehicles_ = out.size();
  for (const auto& [name, said] : Person::getAllSubscriptionResults()) {
    const Place place = place_of(said);
    if (!place.somewhere || rides(said)) continue;
    // Vehicles and people have separate names in SUMO.
    add("p" + name, {name, Disc{person_radius}, person_speed, false}, place.position, sumo_heading(place.angle));
  }
  people_ = out.size() - vehicles_;
  return out;
}

bool Traffic::next(Frame& out) {
  if (Simulation::getMinExpectedNumber() == 0) return false;
  Simulation::step();
  const double time = Simulation::getTime();
  if (time > options_.end + 0.5 * options_.step) return false;
  subscribe(Simulation::getDepartedIDList(), Simulation::getDepartedPersonIDList());
  out = frames_.step(time, states(), "SUMO, " + short_number(time) + " s");
  return true;
}
