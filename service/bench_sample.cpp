#include "gridcull/service/bench_sample.h"

#include <algorithm>
#include <limits>

namespace gridcull {

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

void TimeSamples::add(std::size_t frame, double microseconds) {
  if (frame >= least_.size()) {
    least_.resize(frame + 1, std::numeric_limits<double>::infinity());
    all_.resize(frame + 1);
  }
  least_[frame] = std::min(least_[frame], microseconds);
  all_[frame].push_back(microseconds);
}

TimeSamples::Summary TimeSamples::summary(std::size_t first) const {
  if (first >= least_.size()) return {};
  const std::vector<double> least(least_.begin() + static_cast<std::ptrdiff_t>(first), least_.end());
  std::vector<double> all;
  for (std::size_t i = first; i < all_.size(); ++i) all.insert(all.end(), all_[i].begin(), all_[i].end());
  return {*std::min_element(least.begin(), least.end()), median_of(least),
          *std::max_element(least.begin(), least.end()), median_of(std::move(all))};
}

}  // namespace gridcull
