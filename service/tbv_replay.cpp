#include "gridcull/service/tbv_replay.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

#include "gridcull/grid/tbv_matrix.h"
#include "gridcull/grid/tbv_octree.h"
#include "gridcull/grid/tbv_volume_tree.h"
#include "gridcull/service/interrupt.h"

namespace gridcull {
namespace {

using Clock = std::chrono::steady_clock;

double microseconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::micro>(to - from).count();
}

/// T as the engine asks it: bricks that nobody reaches cost one load.
template <class W, class F>
TbvLook look(TbvMatrix& matrix, const TbvTape::Look& at, W&& wanted, F&& f) {
  if (!matrix.may_touch(at.brick)) return {};
  return matrix.touching(at.brick, at.bits, wanted, f);
}
template <class Index, class W, class F>
TbvLook look(Index& index, const TbvTape::Look& at, W&& wanted, F&& f) {
  return index.touching(at.brick, at.bits, wanted, f);
}

std::uint64_t bytes_of(const TbvMatrix& matrix) { return matrix.matrix_bytes() + matrix.entry_bytes(); }
std::uint64_t bytes_of(const TbvOctree& octree) { return octree.bytes(); }
std::uint64_t bytes_of(const TbvVolumeTree& tree) { return tree.bytes(); }

template <class Index>
void keep_up(Index& index, const TbvTape::Frame& frame) {
  for (const Slot slot : frame.removed) index.erase(slot);
  for (const TbvTape::Volume& volume : frame.born) index.insert(volume.slot, volume.ball);
  for (const TbvTape::Volume& volume : frame.renewed) index.renew(volume.slot, volume.ball);
}

/// One index being played a tape.
template <class Index>
class Player {
 public:
  explicit Player(const TbvTape& tape) : index_(tape.lattice), found_in_(tape.slots, 0) { index_.reserve(tape.slots); }

  /// Frames count from 1 on, so that nobody counts as found before the first.
  void play(const TbvTape::Frame& frame, std::uint32_t number, TbvCost& cost) {
    const std::uint64_t written = index_.places_written();
    const auto start = Clock::now();
    keep_up(index_, frame);
    const auto kept = Clock::now();
    const TbvLook looked = look_up(frame, number);
    const auto end = Clock::now();
    cost.upkeep.add(number - 1, microseconds(start, kept));
    cost.look_up.add(number - 1, microseconds(kept, end));
    work_ = {index_.places_written() - written, looked.places, looked.volumes};
    std::sort(found_.begin(), found_.end());
  }

  struct Work {
    std::uint64_t written = 0, visited = 0, looked_at = 0;
  };
  const Work& work() const { return work_; }
  const std::vector<Slot>& found() const { return found_; }
  Index& index() { return index_; }

 private:
  TbvLook look_up(const TbvTape::Frame& frame, std::uint32_t number) {
    TbvLook sum;
    found_.clear();
    const auto wanted = [&](Slot slot) { return found_in_[slot] != number; };
    const auto found = [&](Slot slot) {
      found_in_[slot] = number;
      found_.push_back(slot);
    };
    for (const TbvTape::Look& at : frame.looks) {
      const TbvLook one = look(index_, at, wanted, found);
      sum.places += one.places;
      sum.volumes += one.volumes;
    }
    return sum;
  }

  Index index_;
  std::vector<std::uint32_t> found_in_;  // by slot: the last frame that revealed it
  std::vector<Slot> found_{};
  Work work_{};
};

void expect_reveals(const TbvTape::Frame& frame, const std::vector<Slot>& found, std::string_view index,
                    std::size_t number) {
  if (found == frame.revealed) return;
  throw std::logic_error("tbv-upkeep: frame " + std::to_string(number) + ": the " + std::string(index) + " reveals " +
                         std::to_string(found.size()) + " volumes, the engine " +
                         std::to_string(frame.revealed.size()) + " or others");
}

template <class Index>
Player<Index> play_through(const TbvTape& tape, std::size_t first, bool count, std::string_view name, TbvCost& cost,
                           const std::function<void()>& tick) {
  Player<Index> player(tape);
  for (std::size_t f = 0; f < tape.frames.size(); ++f) {
    stop_if_interrupted();
    player.play(tape.frames[f], static_cast<std::uint32_t>(f + 1), cost);
    expect_reveals(tape.frames[f], player.found(), name, f);
    if (count && f >= first) {
      cost.written += player.work().written;
      cost.visited += player.work().visited;
      cost.looked_at += player.work().looked_at;
    }
    tick();
  }
  cost.bytes = bytes_of(player.index());
  return player;
}

double cost_when_fresh(const TbvTape& tape) {
  std::vector<const TbvBall*> last(tape.slots, nullptr);
  for (const TbvTape::Frame& frame : tape.frames) {
    for (const Slot slot : frame.removed) last[slot] = nullptr;
    for (const TbvTape::Volume& volume : frame.born) last[volume.slot] = &volume.ball;
    for (const TbvTape::Volume& volume : frame.renewed) last[volume.slot] = &volume.ball;
  }
  TbvVolumeTree tree(tape.lattice);
  tree.reserve(tape.slots);
  for (Slot slot = 0; slot < last.size(); ++slot) {
    if (last[slot] != nullptr) tree.insert(slot, *last[slot]);
  }
  return tree.cost();
}

}  // namespace

TbvCosts replay_tbv_tape(const TbvTape& tape, std::size_t first, int repeats, const std::function<void()>& tick) {
  TbvCosts costs;
  costs.first = std::min(first, tape.frames.empty() ? 0 : tape.frames.size() - 1);
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const bool count = repeat == 0;
    play_through<TbvMatrix>(tape, costs.first, count, tbv_indexes[0], costs.of[0], tick);
    play_through<TbvOctree>(tape, costs.first, count, tbv_indexes[1], costs.of[1], tick);
    Player<TbvVolumeTree> tree =
        play_through<TbvVolumeTree>(tape, costs.first, count, tbv_indexes[2], costs.of[2], tick);
    costs.tree_cost = tree.index().cost();
  }
  costs.fresh_tree_cost = cost_when_fresh(tape);
  return costs;
}

}  // namespace gridcull
