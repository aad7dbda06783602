#include "gridcull/service/advice.h"

#include <algorithm>

namespace gridcull {
namespace {

bool clearly_faster(const SpeedAccuracy& a, const SpeedAccuracy& b) { return a.time < (1.0 - same_time) * b.time; }

std::optional<std::size_t> find_winner(std::span<const SpeedAccuracy> settings, const std::vector<Standing>& standings,
                                       const SpeedAccuracy& loser) {
  std::optional<std::size_t> best;
  const auto better = [&](std::size_t a, std::size_t b) {
    if (standings[a].on_frontier != standings[b].on_frontier) return standings[a].on_frontier;
    if (settings[a].reported != settings[b].reported) return settings[a].reported < settings[b].reported;
    return settings[a].time < settings[b].time;
  };
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (beats(settings[i], loser) && (!best || better(i, *best))) best = i;
  }
  return best;
}

bool alike(const SpeedAccuracy& a, const SpeedAccuracy& b) {
  return a.reported == b.reported && !clearly_faster(a, b) && !clearly_faster(b, a);
}

/// The first that is like `place`: which of two alike ones was a hair quicker says nothing.
std::size_t first_alike(std::span<const SpeedAccuracy> settings, const std::vector<std::size_t>& frontier,
                        std::size_t place) {
  return *std::find_if(frontier.begin(), frontier.end(),
                       [&](std::size_t i) { return alike(settings[i], settings[place]); });
}

}  // namespace

bool beats(const SpeedAccuracy& a, const SpeedAccuracy& b) {
  if (!a.usable || !b.usable) return false;
  if (a.reported < b.reported) return !clearly_faster(b, a);
  return a.reported == b.reported && clearly_faster(a, b);
}

std::vector<Standing> find_frontier(std::span<const SpeedAccuracy> settings) {
  std::vector<Standing> standings(settings.size());
  for (std::size_t i = 0; i < settings.size(); ++i) {
    standings[i].on_frontier = settings[i].usable && std::none_of(settings.begin(), settings.end(),
                                                                  [&](const auto& s) { return beats(s, settings[i]); });
  }
  for (std::size_t i = 0; i < settings.size(); ++i) {
    standings[i].beaten_by = find_winner(settings, standings, settings[i]);
  }
  return standings;
}

std::optional<Picks> pick(std::span<const SpeedAccuracy> settings) {
  const std::vector<Standing> standings = find_frontier(settings);
  std::vector<std::size_t> frontier;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (standings[i].on_frontier) frontier.push_back(i);
  }
  if (frontier.empty()) return std::nullopt;
  const auto faster = [&](std::size_t a, std::size_t b) { return settings[a].time < settings[b].time; };
  const auto tighter = [&](std::size_t a, std::size_t b) {
    return settings[a].reported != settings[b].reported ? settings[a].reported < settings[b].reported : faster(a, b);
  };
  const std::size_t tightest = *std::min_element(frontier.begin(), frontier.end(), tighter);
  std::vector<std::size_t> tight;
  for (const std::size_t i : frontier) {
    if (settings[i].reported <= (1.0 + looser) * settings[tightest].reported) tight.push_back(i);
  }
  const std::size_t fastest = *std::min_element(frontier.begin(), frontier.end(), faster);
  const std::size_t standard = *std::min_element(tight.begin(), tight.end(), faster);
  return Picks{first_alike(settings, frontier, fastest), first_alike(settings, frontier, tightest),
               first_alike(settings, frontier, standard)};
}

}  // namespace gridcull
