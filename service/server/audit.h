// Holds a share of the answers against the exact reference, in a thread of its own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/core/object.h"
#include "gridcull/core/view.h"
#include "gridcull/service/server/metrics.h"

namespace gridcull {

class Audit {
 public:
  /// `rate`: share of the answers, 0 .. 1; every 1/rate-th is taken.
  Audit(double rate, Metrics& metrics);
  /// What still waits is left unjudged.
  ~Audit();
  Audit(const Audit&) = delete;
  Audit& operator=(const Audit&) = delete;

  /// Told from the audit's thread how many objects a judged view really sees (3D: at least).
  using Told = std::function<void(ViewerId viewer, std::size_t exact)>;

  /// A frame's answers; copies the world when one of them is taken. Never waits: what finds the queue full is counted
  /// as skipped. From any thread.
  void offer(std::span<const Object> objects, int dimension, std::span<const View> views, const Answers& answers,
             Guarantee guarantee, const Told& told);

 private:
  using World = std::shared_ptr<const std::vector<Object>>;
  struct Job {
    World objects;
    int dimension;
    View view;
    Answer answer;
    Guarantee guarantee;
    Told told;
  };
  static constexpr std::size_t most_jobs = 64;
  /// Copies of worlds that wait at a time, from all sessions.
  static constexpr int most_worlds = 8;

  std::vector<std::size_t> take(std::size_t answers);
  void run();
  void judge(const Job& job);

  const double rate_;
  Metrics& metrics_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<int> worlds_ = 0;
  std::deque<Job> jobs_;
  double owed_ = 0.0;  // answers to take
  bool ending_ = false;
  std::thread thread_;  // last: it uses all the others
};

}  // namespace gridcull
