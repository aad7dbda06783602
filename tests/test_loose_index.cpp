// The loose hierarchy against a plain list: what hangs in a node lies within its loose box, and counts are right.
#include <map>
#include <random>
#include <set>

#include <doctest/doctest.h>

#include "gridcull/grid/loose_index.h"

using namespace gridcull;

namespace {

struct Walk {
  const LooseIndex& index;
  std::set<Slot> met{};
  std::uint32_t visit(const LooseIndex::NodeId& id) {
    if (!index.exists(id) || index.node(id).below == 0) return 0;
    const Bounds box = index.loose_box(id);
    std::uint32_t count = 0;
    index.each(index.node(id).first, [&](const BallRows::Item& item, BallRows::Place place) {
      ++count;
      CHECK(met.insert(item.slot).second);
      CHECK(item.marks == static_cast<std::uint8_t>(item.slot));
      CHECK(index.place_of(item.slot) == place);
      inside(box, item.ball);
    });
    if (id.level > 0) {
      for (int child = 0; child < (1 << index.dimension()); ++child) {
        count += visit({id.level - 1, 2 * id.x + (child & 1), 2 * id.y + (child >> 1 & 1), 2 * id.z + (child >> 2)});
      }
    }
    CHECK(index.node(id).below == count);
    return count;
  }
  void inside(const Bounds& box, const LooseBall& ball) const {
    for (int k = 0; k < index.dimension(); ++k) {
      CHECK(ball.centre[k] - ball.radius >= box.min[k]);
      CHECK(ball.centre[k] + ball.radius <= box.max[k]);
    }
  }
};

void check(const LooseIndex& index, const std::map<Slot, LooseBall>& truth) {
  Walk walk{index};
  const int d = index.dimension();
  for (int root = 0; root < (1 << d); ++root) walk.visit({index.top(), root & 1, root >> 1 & 1, root >> 2});
  CHECK(walk.met.size() == truth.size());
  CHECK(index.size() == truth.size());
  for (const auto& [slot, ball] : truth) {
    CHECK(walk.met.contains(slot));
    CHECK(index.ball(slot).centre == ball.centre);
    CHECK(index.item(index.place_of(slot)).slot == slot);
    CHECK(index.item(index.place_of(slot)).wide == slot + 60);
    CHECK(index.item(index.place_of(slot)).tall == slot + 120);
  }
}

void run(int dimension, const Bounds& box, double side, unsigned seed) {
  CAPTURE(seed);
  CAPTURE(dimension);
  std::mt19937 random(seed);
  const auto unit = [&] { return std::uniform_real_distribution<double>(0.0, 1.0)(random); };
  LooseIndex index(dimension, box, side);
  const std::uint32_t slots = 60;
  index.reserve(slots);
  for (Slot slot = 0; slot < slots; ++slot) {
    index.set_marks(slot, static_cast<std::uint8_t>(slot));
    index.set_filling(slot, static_cast<std::uint8_t>(slot + 60), static_cast<std::uint8_t>(slot + 120));
  }
  std::map<Slot, LooseBall> truth, remembered;
  for (int step = 0; step < 400; ++step) {
    const auto slot = static_cast<Slot>(random() % slots);
    if (random() % 4 == 0) {
      index.erase(slot);
      truth.erase(slot);
      remembered.erase(slot);
    } else {
      LooseBall ball{{}, random() % 3 == 0 ? side * 0.5 : box.size().x * std::pow(unit(), 6.0)};
      for (int k = 0; k < dimension; ++k) ball.centre[k] = box.min[k] + box.size()[k] * unit();
      if (random() % 8 == 0) ball.centre.x = box.max.x;
      if (random() % 8 == 0) ball.centre.y = box.min.y;
      const bool enters = index.takes(ball) && random() % 5 != 0;
      if (enters) {
        index.place(slot, ball);
        truth[slot] = ball;
        remembered.erase(slot);
        // A little way, with the radius that it has.
        LooseBall moved = ball;
        moved.centre.x += 0.01 * side;
        if (index.takes(moved) && (random() % 2 == 0 ? index.follow(slot, moved.centre) : index.follow(slot, moved))) {
          truth[slot] = moved;
        }
      } else {
        index.erase(slot);
        index.remember(slot, ball);
        truth.erase(slot);
        remembered[slot] = ball;
      }
    }
    if (step % 40 != 39) continue;
    check(index, truth);
    for (const auto& [kept, ball] : remembered) {
      CHECK_FALSE(index.holds(kept));
      CHECK(index.ball(kept).centre == ball.centre);
      CHECK(index.item(index.place_of(kept)).slot == kept);
      CHECK(index.item(index.place_of(kept)).marks == static_cast<std::uint8_t>(kept));
    }
  }
}

}  // namespace

TEST_CASE("a loose index holds what was placed, where it was placed") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    run(3, {{0.0, -3.0, 5.0}, {100.0, 50.0, 40.0}}, 2.0, seed);
    run(2, {{-40.0, -3.0, 0.0}, {60.0, 90.0, 0.0}}, 1.0, seed);
    run(3, {{1e8, 1e8, 1e8}, {1e8 + 1.0, 1e8 + 3.0, 1e8 + 0.5}}, 0.001, seed);
    run(2, {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, 5.0, seed);  // a box without width: one node
  }
}

TEST_CASE("a huge box gets coarser cells instead of more memory") {
  LooseIndex index(3, {{0.0, 0.0, 0.0}, {1e6, 1e6, 1e3}}, 0.5);
  index.reserve(1);
  index.place(0, {{10.0, 10.0, 10.0}, 0.1});
  CHECK(index.node_bytes() < 16u << 20);
}
