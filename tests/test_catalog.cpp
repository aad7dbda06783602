// The scene catalog, small: every method there is on every generated scene there is, held against the exact
// reference. Both catalogs are iterated, so a new method or scene is tested without being listed here; it only needs a
// line of golden hashes. The large catalog is tests/long/catalog.sh.
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/exact.h"
#include "gridcull/core/hash.h"
#include "gridcull/methods/catalog.h"
#include "gridcull/service/judge.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/replay.h"

using namespace gridcull;

namespace {

constexpr std::uint32_t frames = 21;
constexpr std::uint64_t judged_every = 5;  // frames 0, 5 ... 20
constexpr int rays = 96;                   // 3D: rough, and enough for hundreds of visible objects

/// Golden hashes of all answers (sim/stats.h's pvs_hash), "method/scene/TBVs". They are the same in every build, at
/// every number of threads, pushed or pulled. To renew them after a change that is meant to change answers, run
/// `gridcull_tests --source-file='*/test_catalog.cpp'`: each difference prints its new line.
const std::map<std::string, std::uint64_t> golden{
    {"voxel/spheres/off", 0x6E514466193A7237ull},
    {"voxel/spheres/solid", 0x6E514466193A7237ull},
    {"voxel/spheres/hollow", 0xE2A446E4FBBD63C1ull},
    {"frustum/spheres/off", 0xF6ACD22CA989B400ull},
    {"silhouette/spheres/off", 0x1D10F84FA1531D9Eull},
    {"silhouette/spheres/solid", 0x1D10F84FA1531D9Eull},
    {"silhouette/spheres/hollow", 0x1D10F84FA1531D9Eull},
    {"silhouette/city/off", 0xC20800C66518E8EDull},
    {"silhouette/city/solid", 0xC20800C66518E8EDull},
    {"silhouette/city/hollow", 0xC20800C66518E8EDull},
    {"voxel/city/off", 0x2D45EB49C1F4BFD7ull},
    {"voxel/city/solid", 0x2D45EB49C1F4BFD7ull},
    {"voxel/city/hollow", 0x2D45EB49C1F4BFD7ull},
    {"frustum/city/off", 0x125801922B512654ull},
    {"extended-projections/spheres/off", 0xF6ACD22CA989B400ull},
    {"extended-projections/city/off", 0x64CC4282EEC8CD08ull},
    {"silhouette/discs/off", 0x19D24441F30A11F3ull},
    {"silhouette/discs/solid", 0x19D24441F30A11F3ull},
    {"silhouette/discs/hollow", 0x19D24441F30A11F3ull},
    {"voxel/discs/off", 0xA222A8A3B538F846ull},
    {"voxel/discs/solid", 0xA222A8A3B538F846ull},
    {"voxel/discs/hollow", 0xA222A8A3B538F846ull},
    {"frustum/discs/off", 0x3F2E3DBCE9D57B72ull},
    {"silhouette/town/off", 0xA9EF41D168CE9BCEull},
    {"silhouette/town/solid", 0xA9EF41D168CE9BCEull},
    {"silhouette/town/hollow", 0xA9EF41D168CE9BCEull},
    {"voxel/town/off", 0x335C4D4C14D93826ull},
    {"voxel/town/solid", 0x335C4D4C14D93826ull},
    {"voxel/town/hollow", 0x335C4D4C14D93826ull},
    {"frustum/town/off", 0xE1B1528B2FD90625ull},
    {"silhouette/maze/off", 0xC5A44E16F79D3B4Cull},
    {"silhouette/maze/solid", 0xC5A44E16F79D3B4Cull},
    {"silhouette/maze/hollow", 0xC5A44E16F79D3B4Cull},
    {"voxel/maze/off", 0x9735EAC5306B57FCull},
    {"voxel/maze/solid", 0x9735EAC5306B57FCull},
    {"voxel/maze/hollow", 0x9735EAC5306B57FCull},
    {"frustum/maze/off", 0x9011FDD08A371AB5ull},
    {"shadow-frusta/spheres/off", 0xD072B171AC04A3BBull},
    {"shadow-frusta/city/off", 0x16ACC4217B474C66ull},
    {"shadow-frusta/discs/off", 0x7DCC60CE7537D596ull},
    {"shadow-frusta/town/off", 0x84839629BEE214C7ull},
    {"shadow-frusta/maze/off", 0xDC11ACE15534EB7Eull},
};

/// A size that takes well below a second a replay. Scenes that are not named take the first line.
GenerateOptions small(std::string_view scene) {
  GenerateOptions options{.count = 100, .frames = frames};
  if (scene == "spheres") options.count = 1500, options.cell = 1.0;
  if (scene == "city") options.blocks = 8, options.viewers = 3;
  if (scene == "discs") options.count = 300;
  if (scene == "maze") options.count = 12;
  return options;
}

/// The TBV modes that make a difference to the method.
std::vector<std::string> tbv_modes(const MethodEntry& method) {
  if (method.options.find("--tbv") == std::string_view::npos) return {"off"};
  return {"off", "solid", "hollow"};
}

struct Case {
  std::string_view scene;
  const MethodEntry& method;
  std::string tbv;

  std::string name() const { return std::string(method.info.name) + "/" + std::string(scene) + "/" + tbv; }
};

/// Replays a case and hands each step to `look`.
template <class Look>
void replay_case(const Case& c, int threads, Feed feed, const Look& look) {
  const auto generator = make_generator(c.scene, small(c.scene));
  const Scene& scene = generator->scene();
  const MethodOptions options{scene.dimension, *scene.bounds, *scene.cell, c.tbv, threads};
  const auto culler = c.method.make(options);
  Replay replay(*culler, scene, generator.get(), feed);
  while (replay.step()) look(replay);
}

std::uint64_t answers_hash(const Case& c, int threads, Feed feed) {
  StableHash hash;
  std::uint64_t volumes = 0;
  replay_case(c, threads, feed, [&](const Replay& replay) {
    for (const Answer& answer : replay.answers().views) hash.add(answer);
    volumes += replay.answers().stats.tbv_active;
  });
  CHECK((volumes > 0) == (c.tbv != "off"));
  return hash.value();
}

Verdict judge(const Case& c) {
  Judge judge(make_generator(c.scene, small(c.scene))->scene().dimension, rays);
  replay_case(c, 1, Feed::push, [&judge](const Replay& replay) {
    if (replay.frame() % judged_every == 0) judge.judge(replay);
  });
  return judge.verdict();
}

std::string golden_line(const std::string& name, std::uint64_t hash) {
  char line[80];
  std::snprintf(line, sizeof line, "{\"%s\", 0x%016llXull},", name.c_str(), static_cast<unsigned long long>(hash));
  return line;
}

/// Calls `look(Case)` for every method, every generated scene that it takes, and every TBV mode.
template <class Look>
void for_each_case(const Look& look) {
  for (const std::string_view scene : generated_scenes()) {
    const int dimension = make_generator(scene, small(scene))->scene().dimension;
    for (const MethodEntry& method : method_catalog()) {
      if (dimension == 2 ? !method.info.takes_2d : !method.info.takes_3d) continue;
      for (const std::string& tbv : tbv_modes(method)) look(Case{scene, method, tbv});
    }
  }
}

const MethodEntry& frustum_only() {
  for (const MethodEntry& method : method_catalog()) {
    if (method.info.name == "frustum") return method;
  }
  throw std::logic_error("the catalog has no method frustum");
}

bool has_static_occluders(std::string_view scene) {
  const auto generator = make_generator(scene, small(scene));
  for (const SceneObject& object : generator->scene().objects) {
    if (object.object.is_static && object.object.occluder) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("every method misses nobody on every generated scene, and hides somebody") {
  int judged = 0;
  for_each_case([&judged](const Case& c) {
    CAPTURE(c.name());
    const int dimension = make_generator(c.scene, small(c.scene))->scene().dimension;
    if (dimension == 3 && !ExactRays::available()) {
      MESSAGE("skipped: built without Embree");
      return;
    }
    const Verdict verdict = judge(c);
    CHECK(verdict.frames == 5);
    REQUIRE(verdict.queries >= verdict.frames);
    REQUIRE(verdict.exact > verdict.queries);
    if (c.method.info.guarantee == Guarantee::conservative) {
      for (const Miss& miss : verdict.misses) {
        FAIL_CHECK("missed: frame " << miss.frame << ", viewer " << miss.viewer << ", object " << miss.object);
      }
    }
    ++judged;
    if (c.method.info.name == "frustum") return;
    if (!c.method.info.moving_occluders && !has_static_occluders(c.scene)) return;
    // At least a tenth of what is hidden in the view volume: a method that hides nothing is seen.
    const Verdict loose = judge({c.scene, frustum_only(), "off"});
    REQUIRE(loose.exact == verdict.exact);
    REQUIRE(loose.reported > loose.exact);
    CHECK(10 * (loose.reported - verdict.reported) > loose.reported - loose.exact);
  });
  CHECK(judged > 0);
}

TEST_CASE("answers have golden hashes, at 1 and 4 threads, pushed and pulled") {
  for_each_case([](const Case& c) {
    if (c.method.info.guarantee != Guarantee::conservative) return;  // core/culler.h: sampled ones are exempt
    CAPTURE(c.name());
    const std::uint64_t hash = answers_hash(c, 1, Feed::push);
    CHECK(answers_hash(c, 4, Feed::push) == hash);
    CHECK(answers_hash(c, 4, Feed::pull) == hash);
    const auto known = golden.find(c.name());
    if (known == golden.end() || known->second != hash)
      FAIL_CHECK("golden hash is now " << golden_line(c.name(), hash));
  });
}
