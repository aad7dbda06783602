#include "gridcull/service/bench_hidden.h"

#include <cmath>
#include <utility>

namespace gridcull {

std::vector<HiddenMovers::Track> HiddenMovers::tracks(std::uint32_t movers) {
  std::uint64_t state = 42;
  const auto uniform = [&](double low, double high) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;  // Knuth's linear congruence
    return low + (high - low) * static_cast<double>(state >> 11) * 0x1p-53;
  };
  std::vector<Track> out;
  out.reserve(movers);
  for (std::uint32_t i = 0; i < movers; ++i) {
    Track track{};
    for (int k = 0; k < 3; ++k) track.centre[k] = k < 2 ? uniform(42, 58) : uniform(18, 42);
    for (int k = 0; k < 3; ++k) track.along[k] = uniform(-1, 1);
    track.along /= std::fmax(0.1, glm::length(track.along));
    track.speed = uniform(0.5, 2.0);
    track.phase = uniform(0.0, 8.0);
    out.push_back(track);
  }
  return out;
}

/// Back and forth over 4 m, a triangle wave.
Vec3 HiddenMovers::Track::at(double time) const {
  const double way = phase + speed * time;
  const double rest = way - 8.0 * std::floor(way / 8.0);
  return centre + along * (std::fabs(rest - 4.0) - 2.0);
}

HiddenMovers::HiddenMovers(std::unique_ptr<FrameSource> spheres, std::uint32_t movers, ObjectId first)
    : spheres_(std::move(spheres)), tracks_(tracks(movers)), first_(first) {}

bool HiddenMovers::next(Frame& out) {
  if (!spheres_->next(out)) return false;
  for (std::uint32_t i = 0; i < tracks_.size(); ++i) {
    ObjectMove& move = out.set.emplace_back();
    move.id = first_ + i;
    move.position = tracks_[i].at(out.time);
  }
  return true;
}

void add_hidden_movers(Scene& scene, std::uint32_t movers) {
  const auto first = static_cast<ObjectId>(scene.objects.size());
  Object& box = scene.objects.emplace_back().object;
  box.id = first;
  box.shape = Cuboid{{52, 52, 54}};
  box.pose.position = {50, 50, 30};
  box.is_static = true;
  const auto tracks = HiddenMovers::tracks(movers);
  for (std::uint32_t i = 0; i < movers; ++i) {
    Object& mover = scene.objects.emplace_back().object;
    mover.id = first + 1 + i;
    mover.shape = Sphere{0.25};
    mover.pose.position = tracks[i].at(0.0);
    mover.max_speed = tracks[i].speed * (1.0 + 1e-9);
  }
}

}  // namespace gridcull
