#include "hand_made_builder.h"

namespace gridcull::test {
namespace {

SceneBuilder scene(std::string name) { return {"2d: " + std::move(name), 2}; }
Shape box(double length, double width) { return Rectangle{{length, width}}; }
Shape disc(double radius) { return Disc{radius}; }

void add_plain(std::vector<HandMadeScene>& out) {
  out.push_back(scene("a box hides a disc behind it, not the one beside it")
                    .eye({0, 0, 0})
                    .object(0, box(2, 6), {10, 0, 0})
                    .object(1, disc(1), {20, 0, 0})
                    .object(2, disc(1), {20, 12, 0})
                    .sees({0, 2})
                    .hides({1}));
  out.push_back(scene("a disc hides exactly what fits between its tangents")
                    .eye({0, 0, 0})
                    .object(0, disc(2), {10, 0, 0})
                    .object(1, disc(3.9), {20, 0, 0})
                    .object(2, disc(4.1), {20, 0, 0})
                    .sees({0, 2})
                    .hides({1}));
  out.push_back(scene("abutting boxes leave no gap")
                    .eye({0, 0, 0})
                    .object(0, box(2, 4), {10, 2, 0})
                    .object(1, box(2, 4), {10, -2, 0})
                    .object(2, disc(1), {20, 0, 0})
                    .sees({0, 1})
                    .hides({2}));
  out.push_back(scene("a gap between boxes shows what is behind")
                    .eye({0, 0, 0})
                    .object(0, box(2, 4), {10, 2.05, 0})
                    .object(1, box(2, 4), {10, -2.05, 0})
                    .object(2, disc(1), {20, 0, 0})
                    .sees({0, 1, 2}));
  out.push_back(scene("two halves of a screen, each alone too small, hide together")
                    .eye({0, 0, 0})
                    .object(0, box(1, 3), {10, 1, 0})
                    .object(1, box(1, 3), {12, -1, 0})
                    .object(2, box(1, 3), {25, 0, 0})
                    .sees({0, 1})
                    .hides({2}));
  out.push_back(scene("coincident front walls are both seen")
                    .eye({0, 0, 0})
                    .object(0, box(4, 4), {10, 0, 0})
                    .object(1, box(2, 4), {9, 0, 0})
                    .object(2, disc(0.5), {10, 0, 0})
                    .sees({0, 1})
                    .hides({2}));
  out.push_back(scene("overlapping objects: the one that sticks out is seen")
                    .eye({0, 0, 0})
                    .object(0, box(4, 4), {10, 0, 0})
                    .object(1, disc(1), {10, 2.5, 0})
                    .object(2, disc(1), {10, 0, 0})
                    .sees({0, 1})
                    .hides({2}));
}

void add_viewers(std::vector<HandMadeScene>& out) {
  out.push_back(scene("a viewer inside an object sees it and through it")
                    .eye({0, 0, 0})
                    .object(0, disc(3))
                    .object(1, box(8, 8), {1, 1, 0}, 30)
                    .object(2, disc(1), {20, 0, 0})
                    .object(3, disc(1), {40, 0, 0})
                    .sees({0, 1, 2})
                    .hides({3}));
  out.push_back(scene("a viewer on a box's corner: the box hides a quarter")
                    .eye({10, 10, 0})
                    .object(0, box(10, 10), {15, 15, 0})
                    .object(1, disc(1), {30, 30, 0})
                    .object(2, disc(1), {0, 0, 0})
                    .object(3, disc(1), {30, 5, 0})
                    .sees({0, 2, 3})
                    .hides({1}));
  out.push_back(scene("a viewer on a box's wall: the box hides half the world")
                    .eye({10, 12, 0})
                    .object(0, box(10, 10), {15, 15, 0})
                    .object(1, disc(1), {30, 12, 0})
                    .object(2, disc(1), {0, 12, 0})
                    .object(3, disc(3), {10, 40, 0})
                    .sees({0, 2, 3})
                    .hides({1}));
  out.push_back(scene("a viewer between two abutting boxes, on their common wall's end")
                    .eye({10, 10, 0})
                    .object(0, box(10, 10), {5, 15, 0})
                    .object(1, box(10, 10), {15, 15, 0})
                    .object(2, disc(1), {10, 30, 0})
                    .object(3, disc(1), {10, 0, 0})
                    .sees({0, 1, 3})
                    .hides({2}));
  out.push_back(scene("a viewer on the line of a wall looks along it")
                    .eye({0, 5, 0})
                    .object(0, box(10, 10), {15, 0, 0})
                    .object(1, disc(1), {30, 6.5, 0})
                    .object(2, disc(1), {30, 3, 0})
                    .sees({0, 1})
                    .hides({2}));
  out.push_back(scene("a viewer on a thin wall sees both sides; off it, one")
                    .eye({0, 0, 0})
                    .object(0, Polyline{{{0, -10}, {0, 10}}})
                    .object(1, disc(1), {5, 0, 0})
                    .object(2, disc(1), {-5, 0, 0})
                    .sees({1, 2}));
  out.push_back(scene("a rider neither sees its own vehicle nor is hidden by it")
                    .eye({0, 0, 0})
                    .rides(7)
                    .object(7, box(4, 2), {1, 0, 0})
                    .object(1, disc(1), {20, 0, 0})
                    .sees({1})
                    .hides({7}));
  out.push_back(scene("a rider in front of its own trailer sees behind the trailer")
                    .eye({0, 0, 0})
                    .rides(7)
                    .object(7, box(4, 4), {5, 0, 0})
                    .object(1, disc(1), {20, 0, 0})
                    .sees({1})
                    .hides({7}));
}

void add_transparent_and_thin(std::vector<HandMadeScene>& out) {
  out.push_back(scene("what never hides is seen and hides nothing")
                    .eye({0, 0, 0})
                    .object(0, box(2, 20), {10, 0, 0})
                    .clear()
                    .object(1, disc(1), {20, 0, 0})
                    .object(2, disc(1), {30, 0, 0})
                    .sees({0, 1})
                    .hides({2}));
  out.push_back(scene("a thin wall hides")
                    .eye({0, 0, 0})
                    .object(0, Polyline{{{10, -5}, {10, 5}}})
                    .object(1, disc(1), {20, 0, 0})
                    .object(2, disc(1), {20, 15, 0})
                    .sees({0, 2})
                    .hides({1}));
  out.push_back(scene("a bent thin wall is a room with a door")
                    .eye({0, 0, 0})
                    .object(0, Polyline{{{3, 1}, {3, 8}, {-8, 8}, {-8, -8}, {3, -8}, {3, -1}}})
                    .object(1, disc(1), {20, 0, 0})
                    .object(2, disc(1), {20, 15, 0})
                    .object(3, disc(1), {-20, 0, 0})
                    .sees({0, 1})
                    .hides({2, 3}));
  out.push_back(scene("a polygon without area is seen and hides nothing")
                    .eye({0, 0, 0})
                    .object(0, Polygon{{{10, -5}, {10, 5}, {10, 0}}})
                    .object(1, disc(1), {20, 0, 0})
                    .sees({0, 1}));
  out.push_back(scene("a spike without width hides nothing")
                    .eye({0, 0, 0})
                    .object(0, Polygon{{{10, -8}, {12, -8}, {12, -6}, {11, -6}, {11, 8}, {11, -6}, {10, -6}}})
                    .object(1, disc(1), {20, 0, 0})
                    .object(2, disc(0.5), {15, -10, 0})
                    .sees({0, 1})
                    .hides({2}));
}

void add_outlines(std::vector<HandMadeScene>& out) {
  // A pocket open to the right: who stands left sees only its back.
  const std::vector<Vec2> pocket{{10, -6}, {20, -6}, {20, -4}, {12, -4}, {12, 4}, {20, 4}, {20, 6}, {10, 6}};
  out.push_back(scene("a concave pocket seen from behind hides what is in it")
                    .eye({0, 0, 0})
                    .object(0, Polygon{pocket})
                    .object(1, disc(1), {15, 0, 0})
                    .sees({0})
                    .hides({1}));
  out.push_back(scene("a concave pocket seen from its opening shows what is in it")
                    .eye({30, 0, 0})
                    .object(0, Polygon{pocket})
                    .object(1, disc(1), {15, 0, 0})
                    .object(2, disc(1), {0, 0, 0})
                    .sees({0, 1})
                    .hides({2}));
  out.push_back(scene("a viewer in a pocket is not inside the polygon")
                    .eye({16, 0, 0})
                    .object(0, Polygon{pocket})
                    .object(1, disc(1), {0, 0, 0})
                    .object(2, disc(1), {30, 0, 0})
                    .sees({0, 2})
                    .hides({1}));
  // A bow tie: two triangles that meet at (10, 0), by the even-odd rule; above and below it is open.
  const std::vector<Vec2> bow{{10 - 4, 4}, {10 + 4, -4}, {10 + 4, 4}, {10 - 4, -4}};
  out.push_back(scene("a bow tie hides by both halves")
                    .eye({-30, 0, 0})
                    .object(0, Polygon{bow})
                    .object(1, disc(1), {30, 0, 0})
                    .object(2, disc(1), {30, 20, 0})
                    .sees({0, 2})
                    .hides({1}));
  out.push_back(scene("a bow tie from above: its notch is open, its wings are not")
                    .eye({10, 30, 0})
                    .object(0, Polygon{bow})
                    .object(1, disc(0.5), {10, 2, 0})
                    .object(2, disc(0.5), {7, -8, 0})
                    .sees({0, 1})
                    .hides({2}));
  // Five-pointed star drawn in one go: even-odd leaves its middle open.
  const std::vector<Vec2> star{{0, 10}, {5.88, -8.09}, {-9.51, 3.09}, {9.51, 3.09}, {-5.88, -8.09}};
  out.push_back(scene("the middle of a star is a hole: a viewer there is in a room")
                    .eye({0, 0, 0})
                    .object(0, Polygon{star})
                    .object(1, disc(0.5), {1, 1, 0})
                    .object(2, disc(1), {0, 20, 0})
                    .object(3, disc(1), {20, 0, 0})
                    .sees({0, 1})
                    .hides({2, 3}));
  out.push_back(scene("a ring walked as a key hole has a room inside")
                    .eye({0, 0, 0})
                    .object(0, Polygon{{{-9, -9},
                                        {9, -9},
                                        {9, 9},
                                        {-9, 9},
                                        {-9, 0},
                                        {-5, 0},
                                        {-5, 5},
                                        {5, 5},
                                        {5, -5},
                                        {-5, -5},
                                        {-5, 0},
                                        {-9, 0}}})
                    .object(1, disc(1), {3, 3, 0})
                    .object(2, disc(1), {20, 0, 0})
                    .object(3, disc(1), {-20, 1, 0})
                    .sees({0, 1})
                    .hides({2, 3}));
}

void add_limits(std::vector<HandMadeScene>& out) {
  out.push_back(scene("the range cuts; what reaches into it is seen")
                    .eye({0, 0, 0})
                    .range(20)
                    .object(0, disc(2), {21, 0, 0})
                    .object(1, disc(2), {0, 23, 0})
                    .object(2, box(2, 30), {0, -30, 0})
                    .sees({0, 2})
                    .hides({1}));
  out.push_back(scene("only the part within the range counts, and that part is hidden")
                    .eye({0, 0, 0})
                    .range(20)
                    .object(0, box(2, 12), {10, 0, 0})
                    .object(1, box(2, 200), {20, 0, 0})
                    .object(2, box(2, 16), {19, 0, 0})
                    .sees({0})
                    .hides({1, 2}));
  out.push_back(scene("an occluder that sticks out of the range hides inside it")
                    .eye({0, 0, 0})
                    .range(20)
                    .object(0, disc(15), {24, 0, 0})
                    .object(1, disc(1), {18, 0, 0})
                    .object(2, disc(1), {0, 18, 0})
                    .sees({0, 2})
                    .hides({1}));
  out.push_back(scene("field of view: ahead is seen, behind is not")
                    .eye({0, 0, 0}, 90)
                    .fov(60)
                    .object(0, disc(1), {0, 10, 0})
                    .object(1, disc(1), {10, 0, 0})
                    .object(2, disc(1), {0, -10, 0})
                    .object(3, disc(2), {7, 10, 0})
                    .sees({0, 3})
                    .hides({1, 2}));
  out.push_back(scene("an occluder mostly outside the field of view hides inside it")
                    .eye({0, 0, 0})
                    .fov(30)
                    .object(0, box(2, 20), {10, 8, 0})
                    .object(1, disc(1), {20, 2, 0})
                    .object(2, disc(1), {20, -4.2, 0})
                    .sees({0, 2})
                    .hides({1}));
  out.push_back(scene("a field of view above 180 degrees leaves out a wedge behind")
                    .eye({0, 0, 0})
                    .fov(300)
                    .object(0, disc(1), {-10, 0, 0})
                    .object(1, disc(1), {-5, 9, 0})
                    .object(2, disc(1), {0, 9, 0})
                    .sees({1, 2})
                    .hides({0}));
  out.push_back(scene("an object that holds a viewer looking away from its middle is reported")
                    .eye({3, 0, 0})
                    .fov(40)
                    .object(0, disc(4))
                    .object(1, disc(1), {20, 0, 0})
                    .object(2, disc(1), {-20, 0, 0})
                    .sees({0, 1})
                    .hides({2}));
}

}  // namespace

std::vector<HandMadeScene> hand_made_scenes_2d() {
  std::vector<HandMadeScene> out;
  add_plain(out);
  add_viewers(out);
  add_transparent_and_thin(out);
  add_outlines(out);
  add_limits(out);
  return out;
}

}  // namespace gridcull::test
