// `--bounds`: whatever volume objects are tested with, nobody is missed. GRIDCULL_PROPERTY_SCENES multiplies the number
// of random worlds, as in property_test.h.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/methods/catalog.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/replay.h"
#include "property_run.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

const MethodEntry& method(std::string_view name) {
  for (const MethodEntry& entry : method_catalog()) {
    if (entry.info.name == name) return entry;
  }
  throw std::logic_error("no such method");
}

constexpr std::string_view silhouette = "silhouette", shadows = "shadow-frusta";

/// A function of its own for each kind, as the catalog's entries want them.
template <const std::string_view& name, BoundKind kind>
std::unique_ptr<Culler> make_with(const MethodOptions& options) {
  MethodOptions with = options;
  with.bound = kind;
  return make_method(name, with);
}

using Make = std::unique_ptr<Culler> (*)(const MethodOptions&);
using Makers = std::array<Make, all_bound_kinds.size()>;

template <const std::string_view& name, std::size_t... i>
Makers makers(std::index_sequence<i...>) {
  return {&make_with<name, all_bound_kinds[i]>...};
}
template <const std::string_view& name>
Makers makers() {
  return makers<name>(std::make_index_sequence<all_bound_kinds.size()>());
}

struct Contender {
  std::string_view name;
  Makers make;
};

/// Random worlds, every contender with every kind of bound.
void check_random_worlds(int dimension, std::uint64_t worlds, std::span<const Contender> contenders) {
  const int rays = dimension == 3 && ExactRays::available() ? 48 : 0;
  const char* times = std::getenv("GRIDCULL_PROPERTY_SCENES");
  worlds *= std::max(1ul, times != nullptr ? std::strtoul(times, nullptr, 10) : 1ul);
  for (const Contender& contender : contenders) {
    Tally tally;
    for (std::uint64_t seed = 9000; seed < 9000 + worlds; ++seed) {
      const WorldScript script = random_world(dimension, seed);
      const Truth truth(script, rays);
      for (std::size_t i = 0; i < contender.make.size(); ++i) {
        MethodEntry entry = method(contender.name);
        entry.make = contender.make[i];
        const auto fault = check_world(script, entry, truth, tally);
        CAPTURE(seed);
        CAPTURE(contender.name);
        CAPTURE(name_of(all_bound_kinds[i]));
        if (fault) FAIL_CHECK(fault->text);
      }
    }
    CHECK(tally.in_view > 2 * tally.views);
    CHECK(tally.answered < tally.in_view);
  }
}

/// The answers of a scene's frames, one after the other.
std::vector<std::vector<ObjectId>> answers_of(std::string_view name, MethodOptions options,
                                              const GenerateOptions& scene, std::string_view method_name) {
  const auto generator = make_generator(name, scene);
  options.dimension = generator->scene().dimension;
  options.bounds = *generator->scene().bounds;
  options.cell = *generator->scene().cell;
  const auto culler = make_method(method_name, options);
  Replay replay(*culler, generator->scene(), generator.get(), Feed::push);
  std::vector<std::vector<ObjectId>> out;
  while (replay.step()) {
    for (const Answer& answer : replay.answers().views) out.push_back(answer.visible);
  }
  return out;
}

std::size_t total(const std::vector<std::vector<ObjectId>>& answers) {
  std::size_t sum = 0;
  for (const auto& ids : answers) sum += ids.size();
  return sum;
}

bool all_within(const std::vector<std::vector<ObjectId>>& inner, const std::vector<std::vector<ObjectId>>& outer) {
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (!std::includes(outer[i].begin(), outer[i].end(), inner[i].begin(), inner[i].end())) return false;
  }
  return inner.size() == outer.size();
}

}  // namespace

TEST_CASE("nobody is missed in random 3D worlds, whatever objects are tested with") {
  check_random_worlds(3, 90, std::array{Contender{silhouette, makers<silhouette>()}});
  check_random_worlds(3, 40, std::array{Contender{shadows, makers<shadows>()}});
}

TEST_CASE("nobody is missed in random 2D worlds, whatever objects are tested with") {
  check_random_worlds(2, 200, std::array{Contender{shadows, makers<shadows>()}});
}

TEST_CASE("shadow frusta: tighter volumes report less, the object's own outline least") {
  const GenerateOptions scene{.count = 60, .blocks = 6, .frames = 4};
  const auto count = [&](std::optional<BoundKind> kind) {
    MethodOptions options;
    options.bound = kind;
    options.occluders = 24;
    return total(answers_of("city", options, scene, shadows));
  };
  const std::size_t own = count(std::nullopt), ball = count(BoundKind::sphere);
  CHECK(own <= count(BoundKind::hull));
  CHECK(count(BoundKind::box) < ball);
  CHECK(own < ball);
}

TEST_CASE("the option changes what is reported: tighter volumes report less") {
  const GenerateOptions scene{.count = 1200, .frames = 4};
  const auto count = [&](std::optional<BoundKind> kind) {
    MethodOptions options;
    options.bound = kind;
    return total(answers_of("spheres", options, scene, "silhouette"));
  };
  const std::size_t round = count(BoundKind::sphere), box = count(BoundKind::box), d26 = count(BoundKind::dop26);
  CHECK(count(std::nullopt) == round);  // a ball is tested as itself
  CHECK(count(BoundKind::hull) == round);
  CHECK(round < d26);
  CHECK(d26 < count(BoundKind::dop14));
  CHECK(count(BoundKind::dop14) < box);
}

TEST_CASE("frustum: every volume reports what the shapes do, and the box more") {
  for (const std::string_view name : {std::string_view("town"), std::string_view("city")}) {
    CAPTURE(name);
    GenerateOptions with{.count = 300, .frames = 3};
    if (name == "city") with.blocks = 6;
    if (name == "town") with.viewers = 5, with.range = 60.0;
    const auto exact = answers_of(name, {}, with, "frustum");
    std::size_t most = 0;
    for (const BoundKind kind : all_bound_kinds) {
      CAPTURE(name_of(kind));
      MethodOptions options;
      options.bound = kind;
      const auto answers = answers_of(name, options, with, "frustum");
      CHECK(all_within(exact, answers));
      most = std::max(most, total(answers));
    }
    CHECK(most > total(exact));
  }
}

TEST_CASE("depth rays take all volumes") {
  if (!ExactRays::available()) {
    MESSAGE("skipped: built without Embree");
    return;
  }
  const GenerateOptions scene{.count = 4000, .frames = 2};
  MethodOptions options;
  const std::size_t usual = total(answers_of("spheres", options, scene, "depth-rays"));
  for (const BoundKind kind : all_bound_kinds) {
    CAPTURE(name_of(kind));
    options.bound = kind;
    const std::size_t with = total(answers_of("spheres", options, scene, "depth-rays"));
    CHECK(with > 0);
    if (kind == BoundKind::sphere || kind == BoundKind::hull) CHECK(with == usual);
    if (kind == BoundKind::box) CHECK(with > usual);
  }
}

TEST_CASE("methods that test no bounds say so") {
  MethodOptions options;
  options.bound = BoundKind::dop26;
  options.bounds = {Vec3(0.0), Vec3(10.0)};
  options.dimension = 2;
  CHECK_THROWS_WITH_AS(make_method("voxel", options), doctest::Contains("--bounds"), Error);
  CHECK_THROWS_WITH_AS(make_method("pairwise-rays", options), doctest::Contains("--bounds"), Error);
  CHECK_THROWS_WITH_AS(make_method("silhouette", options), doctest::Contains("2D"), Error);
  CHECK_NOTHROW(make_method("frustum", options));
}
