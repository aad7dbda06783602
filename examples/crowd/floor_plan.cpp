#include "floor_plan.h"

using gridcull::Vec2;

namespace {

constexpr double thick = 0.2, room_width = 7.0, room_depth = 6.0, corridor = 3.0, hall = 10.0, door = 1.2;

/// A wall along x from x0 to x1 with its middle at y, with a door in the middle of each room.
void add_wall_with_doors(FloorPlan& plan, double y, double x0, int rooms) {
  double from = x0;
  for (int room = 0; room < rooms; ++room) {
    const double middle = x0 + (room + 0.5) * room_width;
    plan.walls.push_back({{from, y - thick / 2}, {middle - door / 2, y + thick / 2}});
    from = middle + door / 2;
  }
  plan.walls.push_back({{from, y - thick / 2}, {x0 + rooms * room_width, y + thick / 2}});
}

/// The walls between the rooms of one row, those at its ends included; y0 to y1.
void add_partitions(FloorPlan& plan, double y0, double y1, double x0, int rooms) {
  for (int room = 0; room <= rooms; ++room) {
    const double x = x0 + room * room_width;
    plan.walls.push_back({{x - thick / 2, y0}, {x + thick / 2, y1}});
    if (room < rooms) plan.rooms.emplace_back(x + room_width / 2, 0.5 * (y0 + y1));
  }
}

}  // namespace

FloorPlan make_floor_plan(int corridors, int rooms) {
  constexpr double pitch = 2.0 * room_depth + corridor;
  FloorPlan plan;
  plan.width = hall + rooms * room_width + corridor;
  plan.depth = corridors * pitch;
  plan.walls = {{{0.0, 0.0}, {plan.width, thick}},
                {{0.0, plan.depth - thick}, {plan.width, plan.depth}},
                {{0.0, thick}, {thick, plan.depth - thick}},
                {{plan.width - thick, thick}, {plan.width, plan.depth - thick}}};
  for (int number = 0; number < corridors; ++number) {
    const double south = number * pitch, north = south + pitch;
    const double lower = south + room_depth, upper = lower + corridor;  // the corridor's walls
    add_wall_with_doors(plan, lower, hall, rooms);
    add_wall_with_doors(plan, upper, hall, rooms);
    add_partitions(plan, south, lower - thick / 2, hall, rooms);
    add_partitions(plan, upper + thick / 2, north, hall, rooms);
    if (number > 0) {
      plan.walls.push_back({{hall, south - thick / 2}, {plan.width - corridor, south + thick / 2}});
    }
    const Vec2 column(hall / 2, 0.5 * (lower + upper));
    plan.walls.push_back({column - Vec2(0.4), column + Vec2(0.4)});
  }
  return plan;
}
