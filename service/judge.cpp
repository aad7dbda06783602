#include "gridcull/service/judge.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include <tbb/parallel_for.h>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/service/interrupt.h"

namespace gridcull {
namespace {

double mean(std::uint64_t sum, std::uint64_t count) {
  return count == 0 ? 0.0 : static_cast<double>(sum) / static_cast<double>(count);
}

}  // namespace

Judgement judge_answer(const ExactAnswer& exact, const Answer& answer, const View& view, const ExactRays* rays,
                       std::uint64_t frame) {
  Judgement judgement;
  judgement.exact = exact.visible.size();
  for (std::size_t i = 0; i < exact.visible.size(); ++i) {
    const ObjectId object = exact.visible[i];
    if (std::binary_search(answer.visible.begin(), answer.visible.end(), object)) continue;
    const bool holds_viewer = exact.witness[i] == Vec3(0.0);
    if (rays && !holds_viewer && !rays->confirm(view, object, exact.witness[i])) {
      ++judgement.unconfirmed;
    } else {
      judgement.misses.push_back({frame, view.viewer, object, exact.witness[i]});
    }
  }
  return judgement;
}

double Verdict::exact_mean() const { return mean(exact, queries); }
double Verdict::reported_mean() const { return mean(reported, queries); }
double Verdict::over_estimation() const {
  return exact == 0 ? std::numeric_limits<double>::quiet_NaN()
                    : static_cast<double>(reported) / static_cast<double>(exact);
}

Judge::Judge(int dimension, int rays) : dimension_(dimension), rays_(rays) {
  if (dimension == 3 && !ExactRays::available()) {
    throw Error(ErrorCode::usage, "check: the 3D reference needs Embree, which this program was built without");
  }
}

void Judge::judge(const Replay& replay) {
  const std::span<const Object> objects = replay.world().objects();
  const std::span<const View> views = replay.views();
  const std::vector<Answer>& answers = replay.answers().views;
  std::optional<ExactRays> rays;
  if (dimension_ == 3) rays.emplace(objects, rays_);
  std::vector<Judgement> judgements(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    if (interrupted()) return;
    const ExactAnswer exact =
        rays ? rays->visible(views[i], &stop_if_interrupted) : exact_visible_2d(objects, views[i]);
    judgements[i] = judge_answer(exact, answers[i], views[i], rays ? &*rays : nullptr, replay.frame());
  });
  stop_if_interrupted();
  ++verdict_.frames;
  for (std::size_t i = 0; i < views.size(); ++i) {
    ++verdict_.queries;
    verdict_.exact += judgements[i].exact;
    verdict_.reported += answers[i].visible.size();
    verdict_.unconfirmed += judgements[i].unconfirmed;
    verdict_.misses.insert(verdict_.misses.end(), judgements[i].misses.begin(), judgements[i].misses.end());
  }
}

}  // namespace gridcull
