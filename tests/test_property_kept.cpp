// Faults that were found once stay found; and the check itself finds faults that are planted.
#include <memory>

#include <doctest/doctest.h>

#include "gridcull/core/exact.h"
#include "gridcull/methods/frustum.h"
#include "kept_misses.h"
#include "property_test.h"
#include "shrink.h"

namespace gridcull::test {
namespace {

bool takes(const MethodInfo& info, int dimension) { return dimension == 2 ? info.takes_2d : info.takes_3d; }

/// A method with a fault: forgets an object, names one twice, or answers the pull instance otherwise.
class Faulty final : public Culler {
 public:
  enum class Kind { forgets, repeats, reads_late };

  Faulty(int dimension, Kind kind) : honest_(make_frustum_culler(dimension)), kind_(kind) {}

  const MethodInfo& info() const override { return honest_->info(); }
  void add(const Object& object) override { honest_->add(object); }
  void remove(ObjectId object) override { honest_->remove(object); }
  void move(ObjectId object, const Pose& pose) override { honest_->move(object, pose); }
  void set_source(PositionSource* source) override {
    if (kind_ != Kind::reads_late) honest_->set_source(source);
  }
  void announce_jump(ObjectId object) override { honest_->announce_jump(object); }
  void query(double time, std::span<const View> views, Answers& out) override {
    honest_->query(time, views, out);
    for (Answer& answer : out.views) {
      if (answer.visible.size() < 2) continue;
      if (kind_ == Kind::forgets) answer.visible.erase(answer.visible.begin() + 1);
      if (kind_ == Kind::repeats) answer.visible.push_back(answer.visible.back());
    }
  }

 private:
  std::unique_ptr<Culler> honest_;
  Kind kind_;
};

template <Faulty::Kind kind>
MethodEntry faulty_method() {
  return {frustum_culler_info(), "", [](const MethodOptions& o) -> std::unique_ptr<Culler> {
            return std::make_unique<Faulty>(o.dimension, kind);
          }};
}

std::size_t object_count(const WorldScript& script) {
  std::size_t count = script.objects.size();
  for (const ScriptFrame& frame : script.frames) count += frame.add.size();
  return count;
}

/// Looks for the first world that shows a fault by this rule, shrinks it and looks again.
void finds(const MethodEntry& method, int dimension, const std::string& rule, std::size_t most_objects) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const WorldScript script = random_world(dimension, seed);
    const auto fails = [&](const WorldScript& candidate) {
      const auto fault = check_world(candidate, method, 16);
      return fault && fault->rule == rule;
    };
    if (!fails(script)) continue;
    const WorldScript small = shrink(script, fails, 2000);
    CHECK(fails(small));
    CHECK(object_count(small) <= most_objects);
    CHECK(small.frames.size() <= 2);
    return;
  }
  FAIL("no world in 50 shows the planted fault: " << rule);
}

}  // namespace

TEST_CASE("faults that were found once") {
  for (const KeptMiss& kept : kept_misses()) {
    CAPTURE(kept.story);
    const int dimension = kept.script.dimension;
    const Truth truth(kept.script, dimension == 2 || ExactRays::available() ? 96 : 0);
    for (const MethodEntry& method : method_catalog()) {
      if (method.info.guarantee != Guarantee::conservative || !takes(method.info, dimension)) continue;
      CAPTURE(method.info.name);
      for (const char* mode : {"off", "solid", "hollow"}) {
        WorldScript script = kept.script;
        script.tbv = mode;
        Tally tally;
        const auto fault = check_world(script, method, truth, tally);
        CHECK_MESSAGE(!fault, (fault ? fault->text : std::string()));
      }
    }
  }
}

TEST_CASE("the check finds planted faults and shrinks them") {
  finds(faulty_method<Faulty::Kind::forgets>(), 2, "missed", 2);
  finds(faulty_method<Faulty::Kind::repeats>(), 2, "order", 2);
  finds(faulty_method<Faulty::Kind::reads_late>(), 2, "differs", 1);
  if (ExactRays::available()) finds(faulty_method<Faulty::Kind::forgets>(), 3, "missed", 2);
}

TEST_CASE("random worlds are the same every time") {
  for (const int dimension : {2, 3}) {
    CHECK(to_cpp(random_world(dimension, 7)) == to_cpp(random_world(dimension, 7)));
    CHECK(to_cpp(random_world(dimension, 7)) != to_cpp(random_world(dimension, 8)));
  }
}

}  // namespace gridcull::test
