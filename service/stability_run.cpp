#include "gridcull/service/stability_run.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <limits>
#include <memory>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/service/bench_sample.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/judge.h"

namespace gridcull {
namespace {

using Clock = std::chrono::steady_clock;

/// The exact sets of every frame and view.
struct Truth {
  struct FrameTruth {
    std::vector<ExactAnswer> views;
    std::unique_ptr<ExactRays> rays;  ///< 3D
  };
  std::vector<FrameTruth> frames;
};

Truth truth_of(const LimitWorld& world, int rays) {
  Truth truth;
  std::vector<Object> objects = world.objects;
  for (const LimitFrame& frame : world.frames) {
    for (const auto& [id, pose] : frame.moved) objects[id].pose = pose;
    Truth::FrameTruth& now = truth.frames.emplace_back();
    if (world.dimension == 3) now.rays = std::make_unique<ExactRays>(objects, rays);
    for (const View& view : frame.views) {
      stop_if_interrupted();
      now.views.push_back(now.rays ? now.rays->visible(view, &stop_if_interrupted) : exact_visible_2d(objects, view));
    }
  }
  return truth;
}

/// Elements of one ascending list only.
std::size_t difference(const std::vector<ObjectId>& a, const std::vector<ObjectId>& b) {
  std::vector<ObjectId> only;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
  return only.size();
}

/// Mean number of objects that come or go between frames.
template <class VisibleOf>
double changes_of(std::size_t frames, std::size_t views, const VisibleOf& visible) {
  if (frames < 2 || views == 0) return 0.0;
  std::size_t sum = 0;
  for (std::size_t f = 1; f < frames; ++f) {
    for (std::size_t v = 0; v < views; ++v) sum += difference(visible(f - 1, v), visible(f, v));
  }
  return static_cast<double>(sum) / static_cast<double>((frames - 1) * views);
}

/// One play of a world; the answers of all frames where they are wanted.
void play(const LimitWorld& world, const MethodEntry& method, TimeSamples& times, std::vector<Answers>* kept) {
  MethodOptions options;
  options.dimension = world.dimension;
  options.bounds = world.bounds;
  options.cell = world.cell;
  const std::unique_ptr<Culler> culler = method.make(options);
  for (const Object& object : world.objects) culler->add(object);
  Answers answers;
  for (std::size_t f = 0; f < world.frames.size(); ++f) {
    stop_if_interrupted();
    const LimitFrame& frame = world.frames[f];
    const auto start = Clock::now();
    for (const auto& [id, pose] : frame.moved) culler->move(id, pose);
    culler->query(frame.time, frame.views, answers);
    times.add(f, std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    if (kept != nullptr) kept->push_back(answers);
  }
}

void judge(const LimitWorld& world, const Truth& truth, const std::vector<Answers>& answers, LimitResult& result) {
  for (std::size_t f = 0; f < answers.size(); ++f) {
    for (std::size_t v = 0; v < answers[f].views.size(); ++v) {
      const Answer& answer = answers[f].views[v];
      const Judgement judgement =
          judge_answer(truth.frames[f].views[v], answer, world.frames[f].views[v], truth.frames[f].rays.get(), f);
      ++result.queries;
      result.exact += judgement.exact;
      result.reported += answer.visible.size();
      result.misses += judgement.misses.size();
    }
  }
  const std::size_t views = world.frames.front().views.size();
  result.changes = changes_of(
      answers.size(), views, [&](std::size_t f, std::size_t v) -> const auto& { return answers[f].views[v].visible; });
  result.exact_changes = changes_of(
      answers.size(),
      views, [&](std::size_t f, std::size_t v) -> const auto& { return truth.frames[f].views[v].visible; });
}

LimitResult run_one(const LimitWorld& world, const Truth& truth, double value, const MethodEntry& method, int repeats) {
  LimitResult result;
  result.value = value;
  TimeSamples times;
  try {
    for (int repeat = 0; repeat < repeats; ++repeat) {
      std::vector<Answers> answers;
      play(world, method, times, repeat == 0 ? &answers : nullptr);
      if (repeat == 0) judge(world, truth, answers, result);
    }
    result.frame_us = times.steady().median;
  } catch (const Error& error) {
    result.refused = error.what();
  }
  return result;
}

bool takes(const MethodEntry& method, int dimension) {
  return dimension == 2 ? method.info.takes_2d : method.info.takes_3d;
}

}  // namespace

double LimitResult::over_estimation() const {
  return exact == 0 ? std::numeric_limits<double>::quiet_NaN()
                    : static_cast<double>(reported) / static_cast<double>(exact);
}

std::vector<StabilityResult> run_stability(const std::vector<const MethodEntry*>& methods, int dimension,
                                           const StabilitySettings& settings, const std::function<void()>& tick,
                                           std::span<const Limit> limits) {
  std::vector<StabilityResult> results;
  for (const MethodEntry* method : methods) {
    if (!takes(*method, dimension)) continue;
    results.push_back({method, dimension, {}});
    for (const Limit& limit : limits) results.back().rows.push_back({&limit, {}});
  }
  for (std::size_t l = 0; l < limits.size(); ++l) {
    const Limit& limit = limits[l];
    for (const double value : limit.values) {
      const LimitWorld world = limit.make(value, dimension);
      const Truth truth = truth_of(world, settings.rays);
      for (StabilityResult& result : results) {
        result.rows[l].results.push_back(run_one(world, truth, value, *result.method, settings.repeats));
        tick();
      }
    }
  }
  return results;
}

}  // namespace gridcull
