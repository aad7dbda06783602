#include "crowd.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

using namespace gridcull;

namespace {

constexpr float radius = 0.25F, walking_speed = 1.4F;  // metres, m/s
constexpr double top_speed = 3.0;                      // m/s: what max_speed promises; being pushed aside included

dtCrowdAgentParams params_of(float speed) {
  dtCrowdAgentParams out{};
  out.radius = radius;
  out.height = 1.8F;
  out.maxAcceleration = 8.0F;
  out.maxSpeed = speed;
  out.collisionQueryRange = 12.0F * radius;
  out.pathOptimizationRange = 30.0F * radius;
  out.separationWeight = 2.0F;
  out.updateFlags = DT_CROWD_ANTICIPATE_TURNS | DT_CROWD_OBSTACLE_AVOIDANCE | DT_CROWD_SEPARATION |
                    DT_CROWD_OPTIMIZE_VIS | DT_CROWD_OPTIMIZE_TOPO;
  out.obstacleAvoidanceType = 3;
  return out;
}

}  // namespace

Crowd::Crowd(const FloorPlan& plan, const CrowdOptions& options)
    : options_(options), goals_(plan.rooms), mesh_(make_nav_mesh(plan, radius)), crowd_(dtAllocCrowd()) {
  if (!crowd_ || !crowd_->init(options.people, radius, mesh_.get())) throw std::runtime_error("DetourCrowd: no crowd");
  build(plan);
  fill(plan);
}

void Crowd::build(const FloorPlan& plan) {
  scene_.bounds = Bounds{{0, 0, 0}, {std::ceil(plan.width), std::ceil(plan.depth), 0}};
  scene_.cell = 1.0;  // metres
  for (const Wall& wall : plan.walls) {
    SceneObject& object = scene_.objects.emplace_back();
    object.object.id = static_cast<ObjectId>(scene_.objects.size() - 1);
    object.object.shape = Rectangle{wall.size()};
    object.object.pose.position = Vec3(wall.centre(), 0.0);
    object.object.is_static = true;
  }
}

void Crowd::fill(const FloorPlan& plan) {
  std::uniform_real_distribution<double> along(1.0, plan.width - 1.0), across(1.0, plan.depth - 1.0);
  std::uniform_real_distribution<float> pace(0.6F * walking_speed, walking_speed);
  for (int person = 0; person < options_.people; ++person) {
    const std::array<float, 3> at{static_cast<float>(along(dice_)), 0.0F, static_cast<float>(across(dice_))};
    const dtCrowdAgentParams params = params_of(pace(dice_));
    if (crowd_->addAgent(at.data(), &params) != person) throw std::runtime_error("DetourCrowd: no room for an agent");
    headings_.push_back(0.0);
    send_on(person);
  }
}

/// To another room.
void Crowd::send_on(int person) {
  const Vec2 goal = goals_[std::uniform_int_distribution<std::size_t>(0, goals_.size() - 1)(dice_)];
  const std::array<float, 3> near{static_cast<float>(goal.x), 0.0F, static_cast<float>(goal.y)};
  std::array<float, 3> at{};
  dtPolyRef polygon = 0;
  const dtStatus found = crowd_->getNavMeshQuery()->findNearestPoly(near.data(), crowd_->getQueryExtents(),
                                                                    crowd_->getFilter(0), &polygon, at.data());
  if (dtStatusSucceed(found) && polygon != 0) crowd_->requestMoveTarget(person, polygon, at.data());
}

Vec3 Crowd::place(int person) const {
  const float* at = crowd_->getAgent(person)->npos;
  return {at[0], at[2], 0.0};
}

ObjectId Crowd::id(int person) const {
  return static_cast<ObjectId>(scene_.objects.size()) + static_cast<ObjectId>(person);
}

std::string Crowd::name(ObjectId person) const { return "person" + std::to_string(person - scene_.objects.size()); }

void Crowd::step() {
  crowd_->update(static_cast<float>(options_.step), nullptr);
  for (int person = 0; person < options_.people; ++person) {
    const dtCrowdAgent& agent = *crowd_->getAgent(person);
    // They look where they walk; who stands keeps looking where they looked.
    if (std::hypot(agent.vel[0], agent.vel[2]) > 0.1F) {
      headings_[static_cast<std::size_t>(person)] = std::atan2(agent.vel[2], agent.vel[0]);
    }
    const bool there = agent.targetState == DT_CROWDAGENT_TARGET_VALID &&
                       std::hypot(agent.npos[0] - agent.targetPos[0], agent.npos[2] - agent.targetPos[2]) < 1.5F;
    if (there || agent.targetState == DT_CROWDAGENT_TARGET_NONE || agent.targetState == DT_CROWDAGENT_TARGET_FAILED) {
      send_on(person);
    }
  }
}

Frame Crowd::first_frame() const {
  Frame out;
  for (int person = 0; person < options_.people; ++person) {
    SceneObject& object = out.add.emplace_back();
    object.object.id = id(person);
    object.object.shape = Disc{radius};
    object.object.pose.position = place(person);
    object.object.max_speed = top_speed;
    object.heading = 0.0;
    object.name = name(id(person));
    if (person >= options_.viewers) continue;
    ViewerUpdate& viewer = out.viewers.emplace_back();
    viewer.id = viewer.follows.emplace(id(person));
    viewer.range = options_.range;
    viewer.fov = options_.fov * (std::numbers::pi / 180.0);
  }
  return out;
}

bool Crowd::next(Frame& out) {
  if (static_cast<double>(steps_) * options_.step > options_.seconds + 1e-9) return false;
  if (steps_ == 0) {
    out = first_frame();
  } else {
    step();
    out = {};
    for (int person = 0; person < options_.people; ++person) {
      const double heading = headings_[static_cast<std::size_t>(person)];
      out.set.push_back({id(person), place(person), turn_about_z(heading), heading});
    }
  }
  out.time = static_cast<double>(steps_++) * options_.step;
  return true;
}
