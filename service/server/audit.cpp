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
  std::shared_ptr<const std::vector<Object>> copy;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::lock_guard lock(mutex_);
    owed_ += rate_;
    if (owed_ < 1.0) continue;
    owed_ -= 1.0;
    if (jobs_.size() >= most_jobs) {
      metrics_.audit_skipped.Increment();
      continue;
    }
    if (!copy) copy = std::make_shared<const std::vector<Object>>(objects.begin(), objects.end());
    jobs_.push_back({copy, dimension, views[i], answers.views[i], guarantee, told});
    changed_.notify_one();
  }
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
