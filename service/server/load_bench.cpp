#include "gridcull/service/server/load_bench.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "gridcull/service/client/gridcull_client.h"
#include "gridcull/service/server/background_server.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/stats.h"

namespace gridcull {
namespace {

using Clock = std::chrono::steady_clock;

/// A town's frames over and over, as times that go on.
struct Tape {
  nlohmann::json scene;
  std::vector<Client::Frame> frames;
};

Tape record_town(const LoadSettings& settings) {
  GenerateOptions options;
  options.count = settings.buildings;
  options.viewers = static_cast<std::uint32_t>(settings.viewers);
  options.range = 100.0;
  options.frames = 100;
  const auto town = make_generator("town", options);
  Tape tape{nlohmann::json::parse(scene_text(town->scene())), {}};
  Frame frame;
  while (town->next(frame)) {
    Client::Frame& told = tape.frames.emplace_back();
    for (const ObjectMove& move : frame.set) {
      if (move.position && move.heading) told.move(move.id, {move.position->x, move.position->y}, *move.heading);
    }
  }
  return tape;
}

/// One session, in a thread of its own: a frame each time one is due.
void drive(const LoadSettings& settings, const Tape& tape, std::uint16_t port, int number, Clock::time_point start,
           const std::atomic<bool>& stop, LoadResult& out, std::vector<double>& latencies) {
  Client client("127.0.0.1", port);
  client.open(tape.scene);
  const std::chrono::duration<double> period(1.0 / settings.rate);
  const auto frames = static_cast<std::uint64_t>(settings.seconds * settings.rate);
  for (std::uint64_t i = 0; i < frames && !stop; ++i) {
    // Spread over the period, as independent clients are.
    const auto due = start + std::chrono::duration_cast<Clock::duration>(
                                 period * (static_cast<double>(i) + static_cast<double>(number) / settings.sessions));
    std::this_thread::sleep_until(due);
    Client::Frame frame = tape.frames[i % tape.frames.size()];
    frame.time = static_cast<double>(i) / settings.rate;
    ++out.asked;
    client.frame(frame);
    ++out.answered;
    latencies.push_back(std::chrono::duration<double, std::milli>(Clock::now() - due).count());
  }
  client.close();
}

double at_share(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0.0;
  const auto place = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(place, sorted.size() - 1)];
}

}  // namespace

LoadResult bench_load(const LoadSettings& settings, const std::function<void()>& tick) {
  const Tape tape = record_town(settings);
  ServerOptions options;
  options.threads = settings.threads;
  options.max_sessions = static_cast<std::uint64_t>(settings.sessions);
  const BackgroundServer server(options);
  const auto sessions = static_cast<std::size_t>(settings.sessions);
  std::vector<LoadResult> results(sessions);
  std::vector<std::vector<double>> latencies(sessions);
  for (auto& list : latencies) list.reserve(static_cast<std::size_t>(settings.seconds * settings.rate));
  std::atomic<bool> stop = false;
  std::atomic<int> running = settings.sessions, failed = 0;
  const auto start = Clock::now() + std::chrono::seconds(2);  // until all are open
  std::vector<std::thread> clients;
  for (std::size_t i = 0; i < sessions; ++i) {
    clients.emplace_back([&, i] {
      try {
        drive(settings, tape, server.port(), static_cast<int>(i), start, stop, results[i], latencies[i]);
      } catch (const std::exception&) {
        ++failed;
      }
      --running;
    });
  }
  LoadResult all;
  std::exception_ptr interrupted;
  try {
    const auto early = start + std::chrono::duration<double>(settings.seconds / 6.0);
    while (running > 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      if (all.memory_early == 0.0 && Clock::now() > early) all.memory_early = static_cast<double>(resident_bytes());
      if (running > settings.sessions / 2) all.memory_late = static_cast<double>(resident_bytes());
      tick();
    }
  } catch (...) {
    interrupted = std::current_exception();
    stop = true;
  }
  for (std::thread& client : clients) client.join();
  if (interrupted) std::rethrow_exception(interrupted);
  std::vector<double> sorted;
  for (std::size_t i = 0; i < sessions; ++i) {
    all.asked += results[i].asked;
    all.answered += results[i].answered;
    sorted.insert(sorted.end(), latencies[i].begin(), latencies[i].end());
  }
  std::sort(sorted.begin(), sorted.end());
  all.median_ms = at_share(sorted, 0.5);
  all.p99_ms = at_share(sorted, 0.99);
  all.max_ms = sorted.empty() ? 0.0 : sorted.back();
  return all;
}

std::string load_text(const LoadSettings& s, const LoadResult& r) {
  char text[512];
  std::snprintf(text, sizeof text,
                "%d sessions of %u objects and %d viewers, %.3g frames a second each, %.3g s\n"
                "frames asked %llu, answered %llu; from due to answered: median %.2f ms, p99 %.2f ms, most %.2f ms\n"
                "memory of server and clients: %.1f MB after a sixth, %.1f MB at the end\n",
                s.sessions, s.buildings + s.buildings / 4, s.viewers, s.rate, s.seconds,
                static_cast<unsigned long long>(r.asked), static_cast<unsigned long long>(r.answered), r.median_ms,
                r.p99_ms, r.max_ms, r.memory_early / 1e6, r.memory_late / 1e6);
  return text;
}

}  // namespace gridcull
