// The top of the tree is grown breadth first, its cells of each level in parallel; from some size on each cell is built
// depth first by one thread (SubtreeBuilder). Every cell's random numbers come from its own seed, so the tree is the
// same whoever works on it and when.
//
// A break keeps the parts that are done. The top is grown again then: it takes a small share of the time, and gives
// the same cells.
#include "gridcull/methods/five_d_bake.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "gridcull/core/error.h"
#include "gridcull/core/memory_limit.h"
#include "gridcull/methods/bytes.h"
#include "gridcull/methods/five_d_payload.h"
#include "gridcull/methods/five_d_subtree.h"
#include "gridcull/methods/parallel.h"

namespace gridcull {
namespace {

constexpr std::uint64_t seed = 1999;

/// The rays that the top's cells keep while they wait, at most.
constexpr std::size_t waiting_bytes = std::size_t{128} << 20;

/// A node of the top.
struct TopNode {
  FiveDSplit split{};
  std::array<std::size_t, 2> child{0, 0};  ///< 0: it is a part's root
  std::size_t part = 0;
};

class Bake {
 public:
  Bake(std::span<const Object> objects, int dimension, const Bounds& bounds, const FiveDOptions& options)
      : options_(options),
        scene_(objects, dimension, bounds, options),
        test_(options.s_thresh, options.a, options.b),
        arena_(std::min(options.threads, tbb::info::default_concurrency())) {}

  const FiveDSpace& space() const { return scene_.space(); }

  void grow_top() {
    CellWork root;
    root.cell = space().whole();
    root.seed = seed;
    root.budget = static_cast<std::uint32_t>(options_.cells);
    top_.emplace_back();
    parts_.push_back(std::move(root));
    owner_.push_back(0);
    for (std::size_t before = 0; parts_.size() != before && parts_.size() < wanted_parts();) {
      before = parts_.size();
      grow_level();
    }
    built_.resize(parts_.size());
    is_built_.assign(parts_.size(), 0);
  }

  void build_parts() {
    for_each_on(arena_, 0, parts_.size(), [&](std::size_t i, std::size_t) { build_part(i); });
  }

  FiveDBaked result() const {
    FiveDBaked out;
    out.space = space();
    out.rays = top_rays_;
    join(0, out);
    return out;
  }

  std::vector<std::byte> state() const;
  void resume(std::span<const std::byte> state);

  void ask_to_stop() { stop_ = true; }
  bool stopped() const { return stop_; }
  double share() const { return std::min(1.0, static_cast<double>(done_) * 0x1p-50); }

 private:
  /// As many that the threads come out even and little is lost in a break, as few that their rays find room.
  std::size_t wanted_parts() const {
    const std::size_t bytes =
        sizeof(KeptRay) * static_cast<std::size_t>(options_.estimate_rays) * std::max<std::size_t>(1, scene_.members());
    return std::min(std::clamp<std::size_t>(waiting_bytes / bytes, 16, 256),
                    std::max<std::size_t>(1, static_cast<std::size_t>(options_.cells) / 8));
  }

  void grow_level() {
    std::vector<std::optional<FiveDSplit>> splits(parts_.size());
    std::vector<std::uint64_t> rays(parts_.size(), 0);
    for_each_on(arena_, 0, parts_.size(), [&](std::size_t i, std::size_t) {
      FiveDScene::Scratch scratch;
      splits[i] = choose_split(scene_, options_, parts_[i], scratch, rays[i]);
    });
    for (std::size_t i = 0, count = parts_.size(); i < count; ++i) {
      top_rays_ += rays[i];
      if (!splits[i]) continue;
      std::array<CellWork, 2> halves = divide(scene_, parts_[i], *splits[i]);
      TopNode& node = top_[owner_[i]];
      node.split = *splits[i];
      node.child = {top_.size(), top_.size() + 1};
      const std::size_t first = top_.size();
      top_.push_back({{}, {0, 0}, i});
      top_.push_back({{}, {0, 0}, parts_.size()});
      owner_[i] = first;
      owner_.push_back(first + 1);
      parts_[i] = std::move(halves[0]);
      parts_.push_back(std::move(halves[1]));
    }
  }

  void build_part(std::size_t i) {
    if (stop_ || is_built_[i] != 0) return;
    SubtreeBuilder builder(scene_, options_, test_, done_, stop_);
    Subtree part = builder.build(std::move(parts_[i]));
    if (stop_) return;
    built_[i] = std::move(part);
    is_built_[i] = 1;
  }

  void join(std::size_t at, FiveDBaked& out) const {
    const TopNode& node = top_[at];
    if (node.child[0] == 0) {
      const Subtree& part = built_[node.part];
      append(out.tree, part.tree, space());
      out.cells += part.cells;
      out.rays += part.rays;
      return;
    }
    const std::size_t number = out.tree.nodes.size();
    out.tree.nodes.push_back({static_cast<std::uint8_t>(node.split.axis), node.split.step, 0});
    join(node.child[0], out);
    out.tree.nodes[number].second = static_cast<std::uint32_t>(out.tree.nodes.size());
    join(node.child[1], out);
    merge_equal_leaves(out.tree, number, space());
  }

  FiveDOptions options_;
  FiveDScene scene_;
  SequentialTest test_;
  tbb::task_arena arena_;
  std::vector<TopNode> top_{};
  std::vector<CellWork> parts_{};
  std::vector<std::size_t> owner_{};  ///< by part: its node in the top
  std::vector<Subtree> built_{};
  std::vector<std::uint8_t> is_built_{};
  std::uint64_t top_rays_ = 0;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<bool> stop_{false};
};

/// The space, then each part that is done: its number, counts and tree.
std::vector<std::byte> Bake::state() const {
  ByteWriter out;
  write_space(out, space());
  out.u64(parts_.size());
  out.u64(static_cast<std::uint64_t>(std::count(is_built_.begin(), is_built_.end(), 1)));
  for (std::size_t i = 0; i < built_.size(); ++i) {
    if (is_built_[i] == 0) continue;
    out.u64(i);
    out.u64(built_[i].cells);
    out.u64(built_[i].rays);
    write_tree(out, built_[i].tree, space());
  }
  return out.take();
}

void Bake::resume(std::span<const std::byte> state) {
  constexpr std::string_view name = "unfinished bake";
  ByteReader in(state, name);
  ByteWriter here;
  write_space(here, space());
  if (!std::ranges::equal(in.bytes(here.span().size()), here.span()) || in.u64() != parts_.size()) {
    in.refuse("begun with other moving objects or another program; remove it to begin anew");
  }
  for (std::size_t left = in.count(32); left > 0; --left) {
    const std::uint64_t i = in.u64();
    if (i >= built_.size() || is_built_[i] != 0) in.refuse("altered: a part that is not there, or twice");
    built_[i].cells = in.u64();
    built_[i].rays = in.u64();
    built_[i].tree = read_tree(in, space(), name);
    is_built_[i] = 1;
    done_ += static_cast<std::uint64_t>(parts_[i].share * 0x1p50);
  }
  in.finish();
}

/// The leaves' sets when there are as many leaves and motion boxes as allowed, twice: in parts and joined.
void check_memory(std::span<const Object> objects, const FiveDOptions& options) {
  const auto statics = std::count_if(objects.begin(), objects.end(), [](const Object& o) { return o.is_static; });
  const std::uint64_t words =
      (static_cast<std::uint64_t>(statics) + static_cast<std::uint64_t>(options.boxes) + 63) / 64;
  const std::uint64_t leaves =
      static_cast<std::uint64_t>(options.cells) * static_cast<std::uint64_t>(options.intervals);
  refuse_above(options.max_memory, 2 * leaves * words * sizeof(std::uint64_t),
               "--cells: " + std::to_string(options.cells) + " cells with " + std::to_string(options.boxes) +
                   " motion boxes may take");
}

/// Another thread works; this one tells the listener how far it is.
void build_and_report(Bake& bake, BakeListener& listener) {
  std::exception_ptr fault;
  std::atomic<bool> ended{false};
  std::thread worker([&] {
    try {
      bake.build_parts();
    } catch (...) {
      fault = std::current_exception();
    }
    ended = true;
  });
  try {
    while (!ended && !bake.stopped()) {
      if (!listener.progress(bake.share())) bake.ask_to_stop();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  } catch (...) {
    bake.ask_to_stop();
    worker.join();
    throw;
  }
  worker.join();
  if (fault) std::rethrow_exception(fault);
}

}  // namespace

std::optional<FiveDBaked> bake_five_d(std::span<const Object> objects, int dimension, const Bounds& bounds,
                                      const FiveDOptions& options, std::span<const std::byte> resume,
                                      BakeListener* listener) {
  if (options.threads < 1 || options.threads > 256) {
    throw Error(ErrorCode::usage, "threads: expected 1 .. 256, found " + std::to_string(options.threads));
  }
  check_memory(objects, options);
  Bake bake(objects, dimension, bounds, options);
  bake.grow_top();
  if (!resume.empty()) bake.resume(resume);
  if (listener == nullptr) {
    bake.build_parts();
  } else {
    build_and_report(bake, *listener);
    if (bake.stopped()) {
      listener->checkpoint(bake.state());
      return std::nullopt;
    }
    (void)listener->progress(1.0);
  }
  return bake.result();
}

}  // namespace gridcull
