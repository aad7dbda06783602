#include "property_test.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "shrink.h"

namespace gridcull::test {
namespace {

std::uint64_t number_from_environment(const char* name, std::uint64_t otherwise) {
  const char* value = std::getenv(name);
  return value == nullptr || *value == '\0' ? otherwise : std::strtoull(value, nullptr, 10);
}

constexpr int most_faults = 3;  // each is shrunk, which takes a while

bool takes(const MethodInfo& info, int dimension) { return dimension == 2 ? info.takes_2d : info.takes_3d; }

}  // namespace

std::string shrunk_report(const WorldScript& script, const MethodEntry& method, int rays, const Fault& fault) {
  const WorldScript small = shrink(script, [&](const WorldScript& candidate) {
    const auto again = check_world(candidate, method, rays);
    return again && again->rule == fault.rule;
  });
  const auto last = check_world(small, method, rays);
  return (last ? last->text : std::string("not the same twice")) + "\n" + to_cpp(small);
}

namespace {

struct Contender {
  const MethodEntry* method;
  Tally tally{};
  int faults = 0;
};

void judge(Contender& c, const WorldScript& script, const Truth& truth, std::uint64_t seed, int rays) {
  const auto fault = check_world(script, *c.method, truth, c.tally);
  if (!fault) return;
  ++c.faults;
  // A run that only asks whether anything is wrong (tests/planted) need not wait for the smallest example.
  if (number_from_environment("GRIDCULL_PROPERTY_SHRINK", 1) == 0) {
    FAIL_CHECK(c.method->info.name << ", " << script.dimension << "D, seed " << seed << ": " << fault->text);
    return;
  }
  MESSAGE(c.method->info.name << ", seed " << seed << ": " << fault->text << "; shrinking, this may take a while");
  FAIL_CHECK("method " << c.method->info.name << ", " << script.dimension << "D, seed " << seed << ": " << fault->text
                       << "\nshrunk: " << shrunk_report(script, *c.method, rays, *fault));
}

}  // namespace

void run_campaign(const Campaign& campaign) {
  const std::uint64_t first = number_from_environment("GRIDCULL_PROPERTY_SEED", 1);
  const std::uint64_t worlds = campaign.worlds * number_from_environment("GRIDCULL_PROPERTY_SCENES", 1);
  std::vector<Contender> contenders;
  for (const MethodEntry& method : method_catalog()) {
    if (method.info.guarantee == Guarantee::conservative && takes(method.info, campaign.dimension)) {
      contenders.push_back({&method});
    }
  }
  for (std::uint64_t seed = first; seed < first + worlds; ++seed) {
    const WorldScript script = random_world(campaign.dimension, seed);
    const Truth truth(script, campaign.rays);
    for (Contender& c : contenders) {
      if (c.faults < most_faults) judge(c, script, truth, seed, campaign.rays);
    }
  }
  double best_share = 0.0;  // of the objects in view, hidden by the best method
  std::uint64_t jumps = 0;
  for (const Contender& c : contenders) {
    const Tally& t = c.tally;
    MESSAGE(c.method->info.name << " " << campaign.dimension << "D: " << t.views << " views, in view " << t.in_view
                                << ", answered " << t.answered << ", visible " << t.visible << "; volumes revealed "
                                << t.revealed << ", expired " << t.expired << ", jumps " << t.jumps);
    CHECK(t.answered > 0);
    CHECK(t.answered <= t.in_view);
    if (campaign.rays > 0) CHECK(t.visible > 0);
    jumps = std::max(jumps, t.jumps);
    best_share = std::max(best_share, 1.0 - static_cast<double>(t.answered) / static_cast<double>(t.in_view));
  }
  // Worlds in which nothing is hidden and nothing jumps would test nothing.
  CHECK(best_share > campaign.least_hidden);
  CHECK(jumps > campaign.worlds / 4);
}

}  // namespace gridcull::test
