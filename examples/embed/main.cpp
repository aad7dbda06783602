// A simulator of its own: two cars and a pedestrian move around a house, and after every step it asks
// gridcull who may see whom.
#include <array>
#include <cstdio>

#include <gridcull/grid/engine.h>

using namespace gridcull;

int main() {
  constexpr ObjectId house = 0, red_car = 1, blue_car = 2, pedestrian = 3;
  constexpr std::array names{"house", "red car", "blue car", "pedestrian"};

  // The world: 100 m x 60 m on cells of half a metre, one house in the middle of it.
  GridEngine engine({.dimension = 2, .bounds = {{0, 0, 0}, {100, 60, 0}}, .cell = 0.5});
  engine.add({.id = house, .shape = Rectangle{{20, 12}}, .pose = {{50, 30, 0}}, .is_static = true});

  // Everything else moves. max_speed (m/s) lets the engine forget about an object while it is hidden.
  Pose red{{20, 15, 0}}, blue{{85, 45, 0}, turn_about_z(3.14)}, walker{{52, 40, 0}};
  engine.add({.id = red_car, .shape = Rectangle{{4.5, 1.8}}, .pose = red, .max_speed = 20});
  engine.add({.id = blue_car, .shape = Rectangle{{4.5, 1.8}}, .pose = blue, .max_speed = 20});
  engine.add({.id = pedestrian, .shape = Disc{0.25}, .pose = walker, .max_speed = 3});

  Answers answers;
  for (int step = 0; step < 5; ++step) {
    const double time = 1.0 * step;  // seconds

    // Push: tell the engine every move. For an object that is hidden this costs next to nothing.
    red.position.x = 20 + 12 * time;
    blue.position.x = 85 - 3 * time;
    walker.position.y = 40 + 1.5 * time;
    engine.move(red_car, red);
    engine.move(blue_car, blue);
    engine.move(pedestrian, walker);

    // Ask for both drivers at once: all round, 80 m far. Drivers do not see their own cars.
    const std::array views{View{.viewer = 1, .pose = red, .range = 80, .rides = red_car},
                           View{.viewer = 2, .pose = blue, .range = 80, .rides = blue_car}};
    engine.query(time, views, answers);
    for (const Answer& answer : answers.views) {
      std::printf("%.0f s, the driver of the %s may see:", time, names[answer.viewer]);
      for (const ObjectId seen : answer.visible) std::printf(" [%s]", names[seen]);
      std::printf("\n");
    }
  }
}
