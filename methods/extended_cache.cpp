#include "gridcull/methods/extended_cache.h"

#include <algorithm>
#include <cmath>

#include <tbb/info.h>

#include "gridcull/core/memory_limit.h"
#include "gridcull/methods/parallel.h"

namespace gridcull::extended {

CellCache::CellCache(const Bounds& bounds, double edge, const CellSettings& settings, std::uint64_t max_bytes,
                     int threads)
    : edge_(edge),
      settings_(settings),
      kept_bytes_(max_bytes / 4),
      arena_(std::min(threads, tbb::info::default_concurrency())),
      lookers_(static_cast<std::size_t>(arena_.max_concurrency())) {
  if (!bounds.empty()) origin_ = bounds.min;
  const auto scratch = [&](const CellSettings& s) { return lookers_.size() * looker_bytes(s); };
  const auto bytes_of = [&](int resolution) {
    CellSettings other = settings_;
    other.resolution = resolution;
    return scratch(other) + 3 * view_bytes(other);
  };
  refuse_resolution(
      max_bytes, settings_.resolution,
      "the maps of three cells, " + std::to_string(settings_.planes) + " planes in six directions each, need",
      bytes_of);
  const std::uint64_t room = (max_bytes - scratch(settings_)) / view_bytes(settings_);
  views_at_once_ =
      static_cast<std::size_t>(std::max<std::uint64_t>(1, (room - std::max<std::uint64_t>(1, room / 4)) / 2));
}

void CellCache::reset(const StaticScene& scene) {
  cells_.clear();
  floor_ = scene.floor.height;
  for (auto& looker : lookers_) looker = std::make_unique<CellLooker>(scene, settings_);
}

// The box is grown by the roundings of its own corners and of the viewpoint's index.
ViewCell CellCache::cell_of(const CellKey& key) const {
  ViewCell cell;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<double>(key.at[static_cast<std::size_t>(k)]);
    double low = origin_[k] + i * edge_, high = origin_[k] + (i + 1.0) * edge_;
    if (k == 2) key.below ? high = std::min(high, floor_) : low = std::max(low, floor_);
    cell.centre[k] = 0.5 * (low + high);
    cell.half[k] =
        0.5 * (high - low) * (1.0 + 1e-12) + 2e-15 * (std::fabs(low) + std::fabs(high) + std::fabs(origin_[k]));
  }
  return cell;
}

std::optional<CellKey> CellCache::key_of(const Vec3& point) const {
  CellKey key;
  for (int k = 0; k < 3; ++k) {
    const double i = std::floor((point[k] - origin_[k]) / edge_);
    if (!(std::fabs(i) < 1e12)) return std::nullopt;
    key.at[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(i);
  }
  key.below = point.z < floor_;
  if (!holds(cell_of(key), point)) return std::nullopt;
  return key;
}

void CellCache::need(std::vector<CellKey>& keys) {
  ++needs_;
  missing_.clear();
  for (const CellKey& key : keys) {
    const auto [at, fresh] = cells_.try_emplace(key);
    at->second.used = needs_;
    if (!fresh) continue;
    at->second.view = std::make_unique<CellView>();
    missing_.emplace_back(&at->first, at->second.view.get());
  }
  const auto look = [this](std::size_t i, CellLooker& looker) {
    const auto [key, view] = missing_[i];
    looker.look(cell_of(*key), !key->below, key->without, nullptr, *view);
  };
  try {
    if (missing_.size() < 2 || lookers_.size() == 1) {
      for (std::size_t i = 0; i < missing_.size(); ++i) look(i, *lookers_[0]);
    } else {
      for_each_on(arena_, 0, missing_.size(), [&](std::size_t i, std::size_t worker) { look(i, *lookers_[worker]); });
    }
  } catch (...) {  // a cell that was not looked out of to the end must not be found
    for (const auto& [key, view] : missing_) cells_.erase(CellKey(*key));
    throw;
  }
}

void CellCache::trim() {
  const auto bytes_of = [this](const Entry& entry) {
    const auto pixels =
        static_cast<std::uint64_t>(settings_.resolution) * static_cast<std::uint64_t>(settings_.resolution);
    return entry.view->outlooks.planes.size() * pixels * 11 + 4 * entry.view->visible.size();  // maps: 8 * 4/3 bytes
  };
  std::uint64_t bytes = 0;
  for (const auto& [key, entry] : cells_) bytes += bytes_of(entry);
  while (bytes > kept_bytes_ && cells_.size() > 1) {
    const auto oldest = std::min_element(cells_.begin(), cells_.end(),
                                         [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
    bytes -= bytes_of(oldest->second);
    cells_.erase(oldest);
  }
}

}  // namespace gridcull::extended
