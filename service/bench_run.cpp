#include "gridcull/service/bench_run.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>

#include <malloc.h>

#include "gridcull/core/error.h"
#include "gridcull/core/hash.h"
#include "gridcull/grid/engine.h"
#include "gridcull/service/bench_course.h"
#include "gridcull/service/bench_source.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/sim/stats.h"

namespace gridcull {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_moves = 1'000'000;  // kept for one run

double microseconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::micro>(to - from).count();
}

/// What malloc() has given out.
std::uint64_t allocated_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<std::uint64_t>(info.uordblks) + static_cast<std::uint64_t>(info.hblkhd);
}

/// Memory in use by two measures: resident memory misses what fits in pages that were there already, malloc() what is
/// mapped past it.
struct MemoryMark {
  std::uint64_t resident, allocated;
  static MemoryMark now() { return {resident_bytes(), allocated_bytes()}; }
  std::uint64_t growth_since(const MemoryMark& before) const {
    const auto more = [](std::uint64_t a, std::uint64_t b) { return a > b ? a - b : 0; };
    return std::max(more(resident, before.resident), more(allocated, before.allocated));
  }
};

/// A contender at work.
class Runner {
 public:
  Runner(const BenchScene& scene, BenchRow& row, bool pull) : scene_(&scene), row_(&row), pull_(pull) {}

  bool out() const { return !row_->refused.empty() || stopped_; }

  /// A run of frames; makes the culler when there is none.
  void run(std::span<const CourseFrame> frames, const BenchReferee& referee, bool first_repeat, double seconds,
           const std::function<void()>& tick) {
    const bool measure_memory = !culler_ && first_repeat;
    if (measure_memory) malloc_trim(0);
    const MemoryMark before = measure_memory ? MemoryMark::now() : MemoryMark{};
    if (!culler_ && !make()) return;
    for (const CourseFrame& frame : frames) {
      step(frame);
      if (measure_memory && frame.number == 0) {
        row_->memory_bytes = MemoryMark::now().growth_since(before);
        if (const auto* engine = dynamic_cast<const GridEngine*>(culler_.get())) {
          row_->held_bytes = engine->memory().total();
        }
      }
      if (first_repeat) count(frame, referee);
      tick();
      stop_if_interrupted();
    }
    // In the first repeat at least one run; later repeats only whole ones count.
    stopped_ = used_us_ > 1e6 * seconds;
  }

  void end_repeat() {
    culler_.reset();
    source_.reset();
    if (!out() || row_->repeats == 0) ++row_->repeats;
  }

 private:
  bool make() {
    try {
      const auto start = Clock::now();
      culler_ = row_->contender.method->make(row_->contender.options);
      for (const SceneObject& object : scene_->scene.objects) culler_->add(object.object);
      const double us = microseconds(start, Clock::now());
      if (pull_) {
        source_ = std::make_unique<CourseSource>(scene_->scene);
        culler_->set_source(source_.get());
      }
      row_->load_us = row_->repeats == 0 ? us : std::min(row_->load_us, us);
      return true;
    } catch (const Error& error) {
      row_->refused = error.what();
      return false;
    }
  }

  void step(const CourseFrame& frame) {
    if (source_) source_->take(frame);
    const auto start = Clock::now();
    if (source_) {
      source_->feed(*culler_, frame);
    } else {
      feed(*culler_, frame);
    }
    const auto fed = Clock::now();
    culler_->query(frame.time, frame.views, answers_);
    const auto end = Clock::now();
    row_->moves.add(frame.number, microseconds(start, fed));
    row_->query.add(frame.number, microseconds(fed, end));
    row_->total.add(frame.number, microseconds(start, end));
    used_us_ += microseconds(start, end);
  }

  void count(const CourseFrame& frame, const BenchReferee& referee) {
    ++row_->frames;
    row_->queries += answers_.views.size();
    row_->positions_read_mean += static_cast<double>(answers_.stats.positions_read);
    row_->reported.push_back(0.0);
    for (const Answer& answer : answers_.views) {
      row_->reported.back() += static_cast<double>(answer.visible.size());
      hash_.add(answer);
      row_->pvs_mean += static_cast<double>(answer.visible.size());
      row_->cells_visited += static_cast<double>(answer.work.cells_visited);
      row_->object_tests += static_cast<double>(answer.work.object_tests);
      row_->occluders += static_cast<double>(answer.work.occluders);
      row_->rasters += static_cast<double>(answer.work.rasters);
    }
    row_->hash = hash_.value();
    referee.judge(frame.number, answers_, row_->verdict);
  }

  const BenchScene* scene_;
  BenchRow* row_;
  bool pull_;
  std::unique_ptr<CourseSource> source_{};  // outlives the culler that asks it
  std::unique_ptr<Culler> culler_{};
  Answers answers_{};
  StableHash hash_{};
  double used_us_ = 0.0;
  bool stopped_ = false;
};

/// The next run of at most `most` frames; empty at the end. Fewer where much moves.
void read_run(Course& course, BenchReferee& referee, bool first_repeat, std::size_t most,
              std::vector<CourseFrame>& out) {
  out.clear();
  std::size_t moves = 0;
  while (out.size() < most && moves < most_moves) {
    CourseFrame frame;
    if (!course.next(frame)) return;
    stop_if_interrupted();
    if (first_repeat) referee.prepare(frame.number, course.world(), frame.views);
    moves += frame.moved.size();
    out.push_back(std::move(frame));
  }
}

/// Sums become means.
void finish(BenchRow& row) {
  const double frames = std::max(1.0, static_cast<double>(row.frames));
  const double queries = std::max(1.0, static_cast<double>(row.queries));
  row.positions_read_mean /= frames;
  for (double* sum : {&row.pvs_mean, &row.cells_visited, &row.object_tests, &row.occluders, &row.rasters}) {
    *sum /= queries;
  }
}

std::uint64_t length_of(const BenchScene& scene, const BenchSettings& settings) {
  Course course(scene, settings.frames, settings.every);
  std::uint64_t frames = 0;
  for (CourseFrame frame; course.next(frame);) {
    ++frames;
    stop_if_interrupted();
  }
  return frames;
}

BenchSceneResult describe(const BenchScene& scene, std::span<const Contender> contenders) {
  BenchSceneResult result;
  result.label = scene.label;
  result.family_of_objects = scene.family_of_objects();
  result.family_of_viewers = scene.family_of_viewers();
  result.dimension = scene.scene.dimension;
  result.objects = scene.scene.objects.size();
  result.viewers = scene.scene.viewers.size();
  for (const SceneObject& object : scene.scene.objects) result.movers += object.object.is_static ? 0 : 1;
  result.rows.resize(contenders.size());
  for (std::size_t i = 0; i < contenders.size(); ++i) result.rows[i].contender = contenders[i];
  return result;
}

}  // namespace

double BenchRow::over_estimation() const {
  return verdict.exact == 0 ? std::numeric_limits<double>::quiet_NaN()
                            : static_cast<double>(verdict.reported) / static_cast<double>(verdict.exact);
}

BenchSceneResult run_bench_scene(const BenchScene& scene, std::span<const Contender> contenders,
                                 const BenchSettings& settings, const std::function<void()>& tick) {
  BenchSceneResult result = describe(scene, contenders);
  BenchReferee referee(scene.scene.dimension, settings.judged, length_of(scene, settings), settings.rays);
  std::vector<Runner> runners;
  for (BenchRow& row : result.rows) runners.emplace_back(scene, row, settings.pull);
  std::vector<CourseFrame> frames;
  for (int repeat = 0; repeat < settings.repeats; ++repeat) {
    Course course(scene, settings.frames, settings.every);
    for (std::size_t turn = 0; read_run(course, referee, repeat == 0, settings.run, frames), !frames.empty(); ++turn) {
      // Each run begins with another contender, and every other repeat goes backwards: nobody always comes first, or
      // always behind the one who empties the caches.
      for (std::size_t i = 0; i < runners.size(); ++i) {
        const std::size_t place = (i + turn) % runners.size();
        Runner& runner = runners[repeat % 2 == 0 ? place : runners.size() - 1 - place];
        if (!runner.out()) runner.run(frames, referee, repeat == 0, settings.seconds, tick);
      }
    }
    for (Runner& runner : runners) runner.end_repeat();
  }
  result.exact = referee.exact();
  std::uint64_t queries = 0, exact = 0;
  for (BenchRow& row : result.rows) {
    finish(row);
    if (row.verdict.queries > queries) queries = row.verdict.queries, exact = row.verdict.exact;
  }
  result.exact_mean = queries == 0 ? std::numeric_limits<double>::quiet_NaN()
                                   : static_cast<double>(exact) / static_cast<double>(queries);
  return result;
}

}  // namespace gridcull
