#include "gridcull/service/server/audit.h"

#include <utility>

#include "gridcull/core/exact.h"
#include "gridcull/service/judge.h"

namespace gridcull {
namespace {

constexpr int rays = 256;

Judgement judged(std::span<const Object> objects, int dimension, const View& view, const Answer& answer) {
  if (dimension == 2) return judge_answer(exact_visible_2d(objects, view), answer, view, nullptr, 0);
  const ExactRays reference(objects, rays);
  return judge_answer(reference.visible(view), answer, view, &reference, 0);
}

}  // namespace

Audit::Audit(double rate, Metrics& metrics) : rate_(rate), metrics_(metrics) {
  if (rate_ > 0.0) thread_ = std::thread([this] { run(); });
}

Audit::~Audit() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Audit::offer(std::span<const Object> objects, int dimension, std::span<const View> views, const Answers& answers,
                  Guarantee guarantee, const Told& told) {
  if (!(rate_ > 0.0) || (dimension == 3 && !ExactRays::available())) return;
  const std::vector<std::size_t> taken = take(views.size());
  if (taken.empty()) return;
  World copy;
  try {
    copy = std::make_shared<const std::vector<Object>>(objects.begin(), objects.end());
  } catch (const std::bad_alloc&) {
    metrics_.audit_skipped.Increment(static_cast<double>(taken.size()));
    const std::lock_guard lock(mutex_);
    --worlds_;
    return;
  }
  // The last job that holds it gives its place back.
  const World counted(copy.get(), [this, copy](const std::vector<Object>*) { --worlds_; });
  const std::lock_guard lock(mutex_);
  for (const std::size_t i : taken) jobs_.push_back({counted, dimension, views[i], answers.views[i], guarantee, told});
  changed_.notify_one();
}

/// Which of a frame's answers are to be judged; when there are any, a place for a world is taken.
std::vector<std::size_t> Audit::take(std::size_t answers) {
  std::vector<std::size_t> out;
  const std::lock_guard lock(mutex_);
  for (std::size_t i = 0; i < answers; ++i) {
    owed_ += rate_;
    if (owed_ < 1.0) continue;
    owed_ -= 1.0;
    if (jobs_.size() + out.size() < most_jobs && worlds_ < most_worlds) {
      out.push_back(i);
    } else {
      metrics_.audit_skipped.Increment();
    }
  }
  if (!out.empty()) ++worlds_;
  return out;
}

void Audit::run() {
  for (;;) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ending_ || !jobs_.empty(); });
    if (ending_) return;
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    try {
      judge(job);
    } catch (const std::exception&) {
      metrics_.audit_skipped.Increment();
    }
  }
}

void Audit::judge(const Job& job) {
  const Judgement judgement = judged(*job.objects, job.dimension, job.view, job.answer);
  metrics_.audited.Increment();
  job.told(job.view.viewer, judgement.exact);
  // A sampled method may miss and says so.
  if (job.guarantee == Guarantee::sampled) return;
  metrics_.audit_missed.Increment(static_cast<double>(judgement.misses.size()));
}

}  // namespace gridcull
