#include "hand_made_builder.h"

namespace gridcull::test {
namespace {

SceneBuilder scene(std::string name) { return {"3d: " + std::move(name), 3}; }
Shape cuboid(double x, double y, double z) { return Cuboid{{x, y, z}}; }
Shape sphere(double radius) { return Sphere{radius}; }

/// A flat prism, about round.
Shape disc(double radius, double height) {
  Prism prism{{}, height};
  for (int i = 0; i < 16; ++i) {
    const Rotation turn = rotation_of(turn_about_z(i * std::numbers::pi / 8.0));
    prism.vertices.emplace_back(radius * turn.x.x, radius * turn.x.y);
  }
  return prism;
}

/// Eight corners of an octahedron-like crystal of this half width.
Shape crystal(double r) {
  return Convex{{{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}, {0, 0, 0}}};
}

/// A square of two triangles in the plane x = 0.
Shape screen(double half) {
  return Faces{{{0, -half, -half}, {0, half, -half}, {0, half, half}, {0, -half, half}}, {{{0, 1, 2}}, {{0, 2, 3}}}};
}

void add_plain(std::vector<HandMadeScene>& out) {
  out.push_back(scene("a box hides a sphere behind it, not those beside and above")
                    .eye({0, 0, 0})
                    .object(0, cuboid(2, 6, 6), {10, 0, 0})
                    .object(1, sphere(1), {20, 0, 0})
                    .object(2, sphere(1), {20, 12, 0})
                    .object(3, sphere(1), {20, 0, 12})
                    .sees({0, 2, 3})
                    .hides({1}));
  out.push_back(scene("tall objects are seen over low ones")
                    .eye({0, 0, 1.6})
                    .object(0, cuboid(2, 100, 4), {10, 0, 2})
                    .object(1, cuboid(10, 10, 30), {30, 0, 15})
                    .object(2, cuboid(10, 10, 4), {30, 20, 2})
                    .object(3, sphere(1), {50, 0, 1})
                    .sees({0, 1})
                    .hides({2, 3}));
  out.push_back(scene("a bridge: under it is open, its deck hides what stands on it")
                    .eye({0, 0, 1.6})
                    .object(0, cuboid(10, 40, 1), {20, 0, 5})
                    .object(1, sphere(1), {40, 0, 1})
                    .object(2, sphere(0.5), {24, 0, 6})
                    .sees({0, 1})
                    .hides({2}));
  out.push_back(scene("a sphere hides what fits into its shadow cone")
                    .eye({0, 0, 0})
                    .object(0, sphere(2), {10, 0, 0})
                    .object(1, sphere(3.8), {20, 0, 0})
                    .object(2, sphere(4.5), {20, 0, 0})
                    .sees({0, 2})
                    .hides({1}));
  // Its front is hidden by the small ball; what shows of it stands before the disc, at depths on both sides of the
  // disc's: a slice of it that is tested after the disc has entered is lost.
  out.push_back(scene("a ball that pokes through a disc shows a ring before it")
                    .eye({0, 0, 0})
                    .object(0, sphere(0.75), {0, 0, 3})
                    .object(1, sphere(3), {0, 0, 10})
                    .object(2, disc(2.75, 0.1), {0, 0, 7.9})
                    .sees({0, 1, 2}));
  out.push_back(scene("abutting boxes leave no gap, not even where four meet")
                    .eye({0, 0, 0})
                    .object(0, cuboid(2, 4, 4), {10, 2, 2})
                    .object(1, cuboid(2, 4, 4), {10, -2, 2})
                    .object(2, cuboid(2, 4, 4), {10, 2, -2})
                    .object(3, cuboid(2, 4, 4), {10, -2, -2})
                    .object(4, sphere(1), {20, 0, 0})
                    .sees({0, 1, 2, 3})
                    .hides({4}));
  out.push_back(scene("a gap between boxes shows what is behind")
                    .eye({0, 0, 0})
                    .object(0, cuboid(2, 4, 8), {10, 2.2, 0})
                    .object(1, cuboid(2, 4, 8), {10, -2.2, 0})
                    .object(2, sphere(1), {20, 0, 0})
                    .sees({0, 1, 2}));
  out.push_back(scene("a crystal hides by its middle, not beyond its tips")
                    .eye({0, 0, 0})
                    .object(0, crystal(3), {10, 0, 0})
                    .object(1, sphere(1), {20, 0, 0})
                    .object(2, sphere(1), {20, 6, 6})
                    .sees({0, 2})
                    .hides({1}));
}

void add_viewers(std::vector<HandMadeScene>& out) {
  out.push_back(scene("a viewer inside objects sees them and through them")
                    .eye({0, 0, 0})
                    .object(0, sphere(3))
                    .object(1, cuboid(8, 8, 8), {1, 1, 1}, 30)
                    .object(2, sphere(1), {20, 0, 0})
                    .object(3, sphere(1), {40, 0, 0})
                    .sees({0, 1, 2})
                    .hides({3}));
  out.push_back(scene("a viewer on the ground does not see below it")
                    .eye({0, 0, 0})
                    .object(0, cuboid(100, 100, 2), {0, 0, -1})
                    .object(1, sphere(1), {5, 0, -8})
                    .object(2, sphere(1), {5, 0, 2})
                    .object(3, sphere(0.5), {5, 0, -1})
                    .sees({0, 2})
                    .hides({1, 3}));
  out.push_back(scene("a viewer on a box's corner")
                    .eye({10, 10, 10})
                    .object(0, cuboid(10, 10, 10), {15, 15, 15})
                    .object(1, sphere(1), {30, 30, 30})
                    .object(2, sphere(1), {0, 0, 0})
                    .object(3, sphere(1), {30, 30, 5})
                    .sees({0, 2, 3})
                    .hides({1}));
  out.push_back(scene("a rider neither sees its vehicle nor is hidden by it")
                    .eye({0, 0, 1})
                    .rides(7)
                    .object(7, cuboid(4, 2, 1.5), {1, 0, 0.75})
                    .object(1, sphere(1), {20, 0, 1})
                    .object(8, cuboid(4, 4, 4), {6, 0, 10})
                    .sees({1, 8})
                    .hides({7}));
}

void add_transparent_and_thin(std::vector<HandMadeScene>& out) {
  out.push_back(scene("what never hides is seen and hides nothing, one behind another")
                    .eye({0, 0, 0})
                    .object(0, cuboid(2, 20, 20), {10, 0, 0})
                    .clear()
                    .object(1, sphere(2), {15, 0, 0})
                    .clear()
                    .object(2, sphere(3), {25, 0, 0})
                    .object(3, sphere(1), {35, 0, 0})
                    .sees({0, 1, 2})
                    .hides({3}));
  out.push_back(scene("a thin screen hides, from either side")
                    .eye({0, 0, 0})
                    .object(0, screen(5), {10, 0, 0})
                    .object(1, screen(5), {-10, 0, 0})
                    .object(2, sphere(1), {20, 0, 0})
                    .object(3, sphere(1), {-20, 0, 0})
                    .object(4, sphere(1), {20, 0, 15})
                    .sees({0, 1, 4})
                    .hides({2, 3}));
}

void add_prisms(std::vector<HandMadeScene>& out) {
  const std::vector<Vec2> pocket{{-5, -6}, {5, -6}, {5, -4}, {-3, -4}, {-3, 4}, {5, 4}, {5, 6}, {-5, 6}};
  out.push_back(scene("a courtyard seen from behind hides what is in it")
                    .eye({0, 0, 1})
                    .object(0, Prism{pocket, 8}, {15, 0, 0})
                    .object(1, sphere(1), {15, 0, 1})
                    .sees({0})
                    .hides({1}));
  out.push_back(scene("a courtyard seen from its opening, or from above, shows it")
                    .eye({40, 0, 1})
                    .object(0, Prism{pocket, 8}, {15, 0, 0})
                    .object(1, sphere(1), {15, 0, 1})
                    .object(2, sphere(1), {0, 0, 1})
                    .sees({0, 1})
                    .hides({2}));
  out.push_back(scene("a courtyard from above")
                    .eye({15, 0, 60})
                    .object(0, Prism{pocket, 8}, {15, 0, 0})
                    .object(1, sphere(1), {15, 0, 1})
                    .object(2, sphere(0.5), {15, 5, -5})
                    .sees({0, 1})
                    .hides({2}));
  // Self-crossing: two triangles that meet in a line; the even-odd rule leaves its notches open.
  const std::vector<Vec2> bow{{-4, 4}, {4, -4}, {4, 4}, {-4, -4}};
  out.push_back(scene("a self-crossing prism: the notch is open, the wings are not")
                    .eye({0, 30, 2})
                    .object(0, Prism{bow, 4})
                    .object(1, sphere(0.5), {0, 2, 2})
                    .object(2, sphere(0.5), {-3, -8, 2})
                    .sees({0, 1})
                    .hides({2}));
  out.push_back(scene("a prism lying on its side")
                    .eye({0, 0, 0})
                    .object(0, Prism{{{-3, -3}, {3, -3}, {3, 3}, {-3, 3}}, 2}, {10, 0, 0})
                    .object(1, sphere(0.5), {20, 0, 2})
                    .object(2, sphere(0.5), {20, 0, -2})
                    .sees({0, 2})
                    .hides({1}));
}

void add_limits(std::vector<HandMadeScene>& out) {
  out.push_back(scene("the range cuts; what reaches into it is seen")
                    .eye({0, 0, 0})
                    .range(20)
                    .object(0, sphere(2), {21, 0, 0})
                    .object(1, sphere(2), {0, 23, 0})
                    .object(2, cuboid(4, 4, 30), {0, 0, -30})
                    .sees({0, 2})
                    .hides({1}));
  out.push_back(scene("a pyramid of view, with occluders outside of it")
                    .eye({0, 0, 0}, 90)
                    .frustum(40, 2, 0, 100)
                    .object(0, sphere(1), {0, 10, 0})
                    .object(1, sphere(1), {10, 0, 0})
                    .object(2, sphere(1), {0, -10, 0})
                    .object(3, sphere(1), {0, 10, 8})
                    .object(4, sphere(2), {6, 10, 0})
                    .object(5, sphere(1), {0, 120, 40})
                    .object(6, cuboid(10, 1, 30), {-10, 15, 0})
                    .object(7, sphere(1), {-14, 30, 0})
                    .sees({0, 4, 6})
                    .hides({1, 2, 3, 5, 7}));
  out.push_back(scene("nearer than near is not seen, but hides")
                    .eye({0, 0, 0})
                    .frustum(60, 1, 5, 100)
                    .object(0, cuboid(1, 2, 6), {3, 0.5, 0})
                    .object(1, sphere(1), {20, 2, 0})
                    .object(2, sphere(1), {20, -6, 0})
                    .sees({2})
                    .hides({0, 1}));
  out.push_back(scene("what sticks out through near is seen, and alone hides what is behind")
                    .eye({0, 0, 0})
                    .frustum(60, 1, 5, 100)
                    .object(0, cuboid(8, 1, 1), {6, 0, 0})
                    .object(1, sphere(0.5), {20, 0, 0})
                    .object(2, sphere(1), {20, 8, 0})
                    .sees({0, 2})
                    .hides({1}));
  out.push_back(scene("what sticks out through near behind something nearer is hidden")
                    .eye({0, 0, 0})
                    .frustum(60, 1, 5, 100)
                    .object(0, cuboid(1, 4, 4), {1.5, 0, 0})
                    .object(1, cuboid(8, 2, 2), {7, 0, 0})
                    .hides({0, 1}));
  out.push_back(scene("the ground that one stands on is seen beyond near, and nothing in it")
                    .eye({0, 0, 0})
                    .frustum(60, 1, 5, 100)
                    .object(0, cuboid(100, 100, 2), {0, 0, -1})
                    .object(1, sphere(0.5), {10, 0, -1})
                    .object(2, sphere(1), {10, 0, 2})
                    .sees({0, 2})
                    .hides({1}));
  out.push_back(
      scene("a pearl half sunk into a ball, near its rim, is before the rim and behind the ball's nearest point")
          .eye({0, 0, 0})
          .frustum(60, 1, 0, 100)
          .object(0, sphere(10), {30, 0, 0})
          .object(1, sphere(0.3), {23.57, 7.66, 0})
          .object(2, sphere(0.3), {23.57, 0, 7.66})
          .object(3, sphere(0.3), {32, 4, 0})
          .sees({0, 1, 2})
          .hides({3}));
  out.push_back(scene("far is a plane")
                    .eye({0, 0, 0})
                    .frustum(90, 1, 0, 20)
                    .object(0, sphere(1), {18, 16, 0})
                    .object(1, sphere(1), {22, 0, 0})
                    .object(2, sphere(3), {22, -10, 0})
                    .sees({0, 2})
                    .hides({1}));
}

}  // namespace

std::vector<HandMadeScene> hand_made_scenes_3d() {
  std::vector<HandMadeScene> out;
  add_plain(out);
  add_viewers(out);
  add_transparent_and_thin(out);
  add_prisms(out);
  add_limits(out);
  return out;
}

}  // namespace gridcull::test
