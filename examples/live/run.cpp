#include "run.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <utility>

#include <gridcull/sim/pvs.h>
#include <gridcull/sim/stats.h>

#include "sight.h"

using namespace gridcull;

namespace {

std::atomic<bool> stopped{false};

/// A run in the public formats; the files appear on commit().
class Record {
 public:
  Record(const std::string& folder, const Scene& scene)
      : frames_(made(folder) + "/frames.jsonl", scene.dimension),
        pvs_(folder + "/pvs.jsonl", "silhouette", folder + "/scene.json") {
    write_scene(folder + "/scene.json", scene);
  }
  void add(std::uint64_t number, const Frame& frame, const Answers& answers) {
    frames_.write(frame);
    pvs_.write(number, frame.time, answers);
  }
  void commit() {
    frames_.commit();
    pvs_.commit();
  }

 private:
  static const std::string& made(const std::string& folder) {
    std::filesystem::create_directories(folder);
    return folder;
  }

  FrameWriter frames_;
  PvsWriter pvs_;
};

class Lap {
 public:
  /// Seconds since the last call.
  double operator()() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// What a run comes to.
struct Totals {
  std::uint64_t steps = 0, movers_seen = 0;
  double simulating = 0.0, asking = 0.0;  ///< seconds
  StatsCollector collector{};
};

void report(const LiveOptions& options, const Scene& scene, const Totals& totals) {
  const Stats stats = totals.collector.stats();
  const auto steps = static_cast<double>(std::max<std::uint64_t>(totals.steps, 1));
  const auto queries = static_cast<double>(std::max<std::uint64_t>(stats.queries, 1));
  const std::string asking = "gridcull, " + std::string(options.server.empty() ? "embedded" : "served");
  std::printf("\n%-20s %zu\n", "static objects", scene.objects.size());
  std::printf("%-20s %.0f\n", "steps", static_cast<double>(totals.steps));
  std::printf("%-20s %.0f, %.1f movers in line of sight each\n", "questions", static_cast<double>(stats.queries),
              static_cast<double>(totals.movers_seen) / queries);
  std::printf("%-20s %.3f ms a step\n", options.title.c_str(), 1e3 * totals.simulating / steps);
  std::printf("%-20s %.3f ms a step\n", asking.c_str(), 1e3 * totals.asking / steps);
  std::printf("%-20s %s\n", "pvs_hash", hash_text(stats.pvs_hash).c_str());
  std::printf("%-20s %s/pvs.jsonl (scene.json, frames.jsonl beside it)\n", "answers", options.out.c_str());
}

}  // namespace

void run_live(const LiveOptions& options, const Scene& scene, FrameSource& frames,
              const std::function<void(const Frame&, const Answers&)>& tell) {
  std::signal(SIGINT, [](int) { stopped = true; });
  std::signal(SIGTERM, [](int) { stopped = true; });
  const std::unique_ptr<Sight> sight =
      options.server.empty() ? make_embedded_sight(scene) : make_remote_sight(scene, options.server, options.title);
  Record record(options.out, scene);
  Totals totals;
  Frame frame;
  Lap lap;
  double told = -1e12;
  const auto finish = [&] {
    record.commit();
    report(options, scene, totals);
  };
  try {
    while (!stopped && frames.next(frame)) {
      totals.simulating += lap();
      const Answers& answers = sight->see(frame);
      totals.asking += lap();
      totals.collector.add(answers);
      record.add(totals.steps++, frame, answers);
      for (const Answer& answer : answers.views) {
        for (const ObjectId id : answer.visible) totals.movers_seen += id >= scene.objects.size() ? 1 : 0;
      }
      if (frame.time > told + 1.0 - 1e-6) {
        tell(frame, answers);
        std::fflush(stdout);
        told = frame.time;
      }
      lap();
    }
  } catch (...) {  // the server or the simulator has gone: what there is so far is kept
    finish();
    throw;
  }
  finish();
}

std::string named(const Answer& answer, const Scene& scene, const std::function<std::string(ObjectId)>& name) {
  constexpr int most = 8;
  std::string out;
  int count = 0;
  for (const ObjectId id : answer.visible) {
    if (id < scene.objects.size()) continue;
    if (++count <= most) out += " " + name(id);
  }
  if (count > most) out += " and " + std::to_string(count - most) + " more";
  return count == 0 ? " nobody" : out;
}

int told_fault(const char* program, const std::exception& fault) {
  std::fprintf(stderr, "%s: %s\n", program, fault.what());
  return 2;
}
