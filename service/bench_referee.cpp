#include "gridcull/service/bench_referee.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "gridcull/service/interrupt.h"

namespace gridcull {
namespace {

constexpr std::size_t most_views = 10;

}  // namespace

BenchReferee::BenchReferee(int dimension, std::uint64_t frames, std::uint64_t all, int rays)
    : dimension_(dimension), rays_(rays) {
  if (dimension == 3 && !ExactRays::available()) return;
  frames = std::min(frames, all);
  if (frames == 1) frames_.push_back(all / 2);
  for (std::uint64_t i = 0; frames > 1 && i < frames; ++i) frames_.push_back(i * (all - 1) / (frames - 1));
}

bool BenchReferee::judges(std::uint64_t frame) const {
  return std::find(frames_.begin(), frames_.end(), frame) != frames_.end();
}

void BenchReferee::prepare(std::uint64_t frame, const World& world, std::span<const View> views) {
  if (!judges(frame) || prepared_.contains(frame)) return;
  Prepared p;
  const std::size_t count = std::min(views.size(), most_views);
  p.all = count == views.size();
  for (std::size_t i = 0; i < count; ++i) {
    p.chosen.push_back(i * views.size() / count);
    p.views.push_back(views[p.chosen.back()]);
  }
  if (dimension_ == 3) p.rays = std::make_unique<ExactRays>(world.objects(), rays_);
  p.exact.resize(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    if (interrupted()) return;
    p.exact[i] =
        p.rays ? p.rays->visible(p.views[i], &stop_if_interrupted) : exact_visible_2d(world.objects(), p.views[i]);
  });
  stop_if_interrupted();
  prepared_.emplace(frame, std::move(p));
}

std::vector<std::pair<std::uint64_t, double>> BenchReferee::exact() const {
  std::vector<std::pair<std::uint64_t, double>> out;
  for (const auto& [frame, p] : prepared_) {
    std::size_t visible = 0;
    for (const ExactAnswer& answer : p.exact) visible += answer.visible.size();
    if (p.all) out.emplace_back(frame, static_cast<double>(visible));
  }
  return out;
}

void BenchReferee::judge(std::uint64_t frame, const Answers& answers, BenchVerdict& verdict) const {
  const auto found = prepared_.find(frame);
  if (found == prepared_.end()) return;
  const Prepared& p = found->second;
  std::vector<Judgement> judgements(p.chosen.size());
  tbb::parallel_for(std::size_t{0}, p.chosen.size(), [&](std::size_t i) {
    if (interrupted()) return;
    judgements[i] = judge_answer(p.exact[i], answers.views[p.chosen[i]], p.views[i], p.rays.get(), frame);
  });
  stop_if_interrupted();
  for (std::size_t i = 0; i < p.chosen.size(); ++i) {
    ++verdict.queries;
    verdict.exact += judgements[i].exact;
    verdict.reported += answers.views[p.chosen[i]].visible.size();
    verdict.misses += judgements[i].misses.size();
    verdict.unconfirmed += judgements[i].unconfirmed;
  }
}

}  // namespace gridcull
