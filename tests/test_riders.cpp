// What a viewer rides on, or stands in, hides nothing from that viewer, and everything from the others of the same
// query (the contract in core/culler.h): each conservative method, occluders static and moving, seen at once and after
// all have been hidden.
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/methods/catalog.h"

namespace gridcull::test {
namespace {

constexpr ObjectId cart = 1, behind = 2, other_cart = 3;

Shape block(int dimension) {
  if (dimension == 2) return Rectangle{{4, 24}};
  return Cuboid{{4, 24, 24}};
}
Shape ball(int dimension) {
  if (dimension == 2) return Disc{0.5};
  return Sphere{0.5};
}

struct Yard {
  int dimension;
  bool standing;  ///< the occluders
  double middle;  ///< z of everything

  Vec3 at(double x, double y) const { return {x, y, dimension == 3 ? middle : 0.0}; }

  std::vector<Object> objects() const {
    std::vector<Object> out{make_object(cart, block(dimension), at(16, 16), 1.0),
                            make_object(behind, ball(dimension), at(28, 16), 1.0),
                            make_object(other_cart, block(dimension), at(22, 16), 1.0)};
    out[0].is_static = out[2].is_static = standing;
    return out;
  }
};

std::unique_ptr<Culler> fill(const MethodEntry& method, const Yard& yard, const char* tbv, bool both) {
  MethodOptions options;
  options.dimension = yard.dimension;
  options.bounds = {{0, 0, 0}, {32, 32, yard.dimension == 3 ? 32.0 : 0.0}};
  options.cell = 0.5;
  options.tbv = tbv;
  options.threads = 2;
  auto culler = method.make(options);
  for (const Object& object : yard.objects()) {
    if (both || object.id != other_cart) culler->add(object);
  }
  return culler;
}

View rider(const Yard& yard, ViewerId viewer, double x, ObjectId rides) {
  View view = make_view(viewer, yard.at(x, 16));
  view.rides = rides;
  return view;
}

/// Calls f(method, yard, tbv, hides) for every conservative method; `hides`: it is one that hides anything.
template <class F>
void in_all_yards(F&& f) {
  for (const MethodEntry& method : method_catalog()) {
    if (method.info.guarantee != Guarantee::conservative) continue;
    for (const int dimension : {2, 3}) {
      if (!(dimension == 2 ? method.info.takes_2d : method.info.takes_3d)) continue;
      for (const bool standing : {true, false}) {
        for (const char* tbv : {"off", "solid", "hollow"}) {
          CAPTURE(std::string(method.info.name));
          CAPTURE(dimension);
          CAPTURE(standing);
          CAPTURE(std::string(tbv));
          const std::string_view name = method.info.name;
          const bool hides = name == "voxel" || name == "silhouette" || name == "shadow-frusta";
          f(method, Yard{dimension, standing, 16.125}, tbv, hides);
        }
      }
    }
  }
}

/// Asks in three frames; in the second nobody looks, so that all that may be hidden is.
template <class Check>
void ask(Culler& culler, const std::vector<View>& views, Check&& check) {
  Answers answers;
  for (int frame = 0; frame < 3; ++frame) {
    CAPTURE(frame);
    culler.query(frame, std::span(views).first(frame == 1 ? 0 : views.size()), answers);
    if (frame != 1) check(answers.views);
  }
}

}  // namespace

TEST_CASE("what a viewer rides on hides nothing from it") {
  in_all_yards([](const MethodEntry& method, const Yard& yard, const char* tbv, bool hides) {
    const auto culler = fill(method, yard, tbv, false);
    // Behind the cart, on its border, and one at the same place that does not ride.
    const std::vector<View> views{rider(yard, 1, 10, cart), rider(yard, 2, 14, cart), rider(yard, 3, 10, no_id)};
    ask(*culler, views, [&](const std::vector<Answer>& answers) {
      for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        CHECK(sees(answers.at(i), behind));
        CHECK(!sees(answers.at(i), cart));
      }
      CHECK(sees(answers.at(2), cart));
      if (hides) CHECK(!sees(answers.at(2), behind));
    });
  });
}

TEST_CASE("what others ride on hides from a rider") {
  in_all_yards([](const MethodEntry& method, const Yard& yard, const char* tbv, bool hides) {
    const auto culler = fill(method, yard, tbv, true);
    const std::vector<View> views{rider(yard, 1, 10, cart), rider(yard, 2, 10, other_cart), rider(yard, 3, 19, cart),
                                  rider(yard, 4, 19, other_cart)};
    ask(*culler, views, [&](const std::vector<Answer>& answers) {
      CHECK(sees(answers.at(0), other_cart));
      CHECK(sees(answers.at(1), cart));
      CHECK(sees(answers.at(2), other_cart));
      CHECK(sees(answers.at(3), behind));
      if (!hides) return;
      for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{2}}) CHECK(!sees(answers.at(i), behind));
    });
  });
}

TEST_CASE("what a viewer stands in is reported to it and hides nothing from it") {
  in_all_yards([](const MethodEntry& method, const Yard& yard, const char* tbv, bool hides) {
    const auto culler = fill(method, yard, tbv, false);
    const std::vector<View> views{rider(yard, 1, 16.25, no_id), rider(yard, 2, 14.5, no_id), rider(yard, 3, 10, no_id)};
    ask(*culler, views, [&](const std::vector<Answer>& answers) {
      for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
        CHECK(sees(answers.at(i), cart));
        CHECK(sees(answers.at(i), behind));
      }
      if (hides) CHECK(!sees(answers.at(2), behind));
    });
  });
}

}  // namespace gridcull::test
