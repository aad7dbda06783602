// Every instruction set gives the same bits; which one runs can be forced.
#include <cstdlib>
#include <string>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/hash.h"
#include "mask_truth.h"

using namespace gridcull;
using namespace mask_truth;

namespace {

/// Sets GRIDCULL_ISA for a while.
class Forced {
 public:
  explicit Forced(const char* value) {
    if (const char* old = std::getenv("GRIDCULL_ISA")) old_ = old, had_ = true;
    value ? setenv("GRIDCULL_ISA", value, 1) : unsetenv("GRIDCULL_ISA");
  }
  ~Forced() { had_ ? setenv("GRIDCULL_ISA", old_.c_str(), 1) : unsetenv("GRIDCULL_ISA"); }

 private:
  std::string old_;
  bool had_ = false;
};

std::vector<InstructionSet> supported_sets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set : {InstructionSet::scalar, InstructionSet::avx2, InstructionSet::avx512}) {
    if (is_supported(set)) sets.push_back(set);
  }
  return sets;
}

std::string refusal(const char* value) {
  const Forced forced(value);
  try {
    choose_instruction_set();
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::usage);
    return error.what();
  }
  return {};
}

void add(StableHash& hash, std::uint64_t word) {
  hash.add(static_cast<std::uint32_t>(word));
  hash.add(static_cast<std::uint32_t>(word >> 32));
}

void add(StableHash& hash, const CoverageMask& mask) {
  for (int k = 0; k < mask.faces(); ++k) {
    const masking::Window& w = mask.face(k).window;
    hash.add(static_cast<std::uint32_t>(w.open_blocks));
    for (int i = 0; i < 8 * w.blocks * w.strips; ++i) add(hash, w.words[i]);
    for (int i = 0; i < w.coarse * w.strips; ++i) add(hash, w.full[i]);
    for (int i = 0; i < w.blocks * w.strips && w.open_blocks > 0; ++i) {
      std::uint64_t rows = ~std::uint64_t{0};
      for (int row = 0; row < 8; ++row) rows &= w.words[8 * i + row];
      REQUIRE(w.columns[i] == rows);
    }
  }
}

/// A frame of covers and tests from a seed; the same for all sets.
std::uint64_t played(InstructionSet set, std::uint64_t seed) {
  Dice dice{std::mt19937_64(seed)};
  CoverageMask mask(set);
  StableHash hash;
  for (const ViewKind kind : {ViewKind::window, ViewKind::all_round, ViewKind::wide}) {
    static constexpr int resolutions[] = {8, 24, 64, 200, 328};
    mask.begin(ViewVolume(random_view(kind, dice), 3), resolutions[dice.integer(0, 4)]);
    for (int i = 0; i < 12; ++i) {
      cover(mask, random_cone(mask, dice), dice);
      const Vec3 low = dice.power(-1, 1) * dice.direction();
      const Vec3 high = low + dice.power(-2, 1);
      hash.add(mask.open_box(low, high));
      for (int k = 0; k < 4; ++k) hash.add(open(mask, random_cone(mask, dice), dice));
    }
    add(hash, mask);
    add(hash, mask.rows());
  }
  return hash.value();
}

}  // namespace

TEST_CASE("every instruction set gives the same bits") {
  const auto sets = supported_sets();
  MESSAGE("sets: ", sets.size(), ", widest ", std::string(name_of(sets.back())));
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    CAPTURE(seed);
    const std::uint64_t expected = played(InstructionSet::scalar, seed);
    for (const InstructionSet set : sets) {
      CAPTURE(std::string(name_of(set)));
      CHECK(played(set, seed) == expected);
    }
  }
}

TEST_CASE("long slanted shapes at the finest resolution: two coarse words a strip") {
  for (const InstructionSet set : supported_sets()) {
    CAPTURE(std::string(name_of(set)));
    CoverageMask mask(set), scalar(InstructionSet::scalar);
    Dice dice{std::mt19937_64(3)};
    View view;
    view.frustum = Frustum{1.0, 1.2};
    const ViewVolume volume(view, 3);
    mask.begin(volume, 8192);
    scalar.begin(volume, 8192);
    for (int i = 0; i < 6; ++i) {
      const Cone cone = random_convex(mask, 5, dice);
      Dice same = dice;
      cover(mask, cone, dice);
      cover(scalar, cone, same);
    }
    StableHash a, b;
    add(a, mask), add(b, scalar);
    CHECK(a.value() == b.value());
    CHECK(mask.open_box(Vec3(-1e9), Vec3(1e9)) == !mask.full());
    cover_all_but(mask, {});
    CHECK(mask.full());
  }
}

TEST_CASE("the kernels of a forced set are those that run") {
  for (const InstructionSet set : supported_sets()) {
    const Forced forced(name_of(set));
    CHECK(choose_instruction_set() == set);
    for (const InstructionSet other : supported_sets()) {
      CHECK((masking::kernels_of(set).cover_polygon == masking::kernels_of(other).cover_polygon) == (set == other));
    }
  }
}

TEST_CASE("without a word the widest set is taken, other words are refused") {
  {
    const Forced unset(nullptr);
    CHECK(choose_instruction_set() == supported_sets().back());
  }
  {
    const Forced empty("");
    CHECK(choose_instruction_set() == supported_sets().back());
  }
  CHECK(refusal("sse9").find("\"sse9\"") != std::string::npos);
  CHECK(refusal("AVX2").find("expected scalar, avx2 or avx512") != std::string::npos);
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    if (!is_supported(set)) CHECK(refusal(name_of(set)).find("lacks") != std::string::npos);
  }
}
