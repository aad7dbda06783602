#include "gridcull/service/server/service_bench.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <utility>

#include <nlohmann/json.hpp>

#include "gridcull/methods/catalog.h"
#include "gridcull/service/bench_scene.h"
#include "gridcull/service/client/gridcull_client.h"
#include "gridcull/service/server/background_server.h"
#include "gridcull/sim/replay.h"
#include "gridcull/sim/world.h"

namespace gridcull {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

ServerOptions one_thread() {
  ServerOptions options;
  options.threads = 1;
  options.max_memory = std::uint64_t{4} << 30;
  return options;
}

/// A frame as it is told to the engine and to the client; both are made before the clock runs.
struct Told {
  double time = 0.0;
  std::vector<std::pair<ObjectId, Pose>> moves{};
  std::vector<View> views{};
  Client::Frame frame{};
};

/// Moves are whole poses; what comes and goes is left out: a bench's scenes have neither.
std::vector<Told> play(const BenchScene& scene, std::uint64_t frames) {
  World world(scene.scene);
  const auto source = scene.frames();
  std::vector<Told> all;
  Frame frame;
  while (all.size() < frames && source->next(frame)) {
    world.apply(frame);
    Told told{.time = frame.time};
    for (const ObjectMove& move : frame.set) told.moves.emplace_back(move.id, world.object(move.id).pose);
    told.frame.time = frame.time;
    for (std::size_t i = 0; i < told.moves.size(); ++i) {
      const auto& [id, pose] = told.moves[i];
      const Quat& q = pose.orientation;
      const Vec3& p = pose.position;
      if (scene.scene.dimension == 2) {
        told.frame.move(id, {p.x, p.y}, frame.set[i].heading.value_or(heading_of(q)));
      } else {
        told.frame.move(id, {p.x, p.y, p.z}, {q.w, q.x, q.y, q.z});
      }
    }
    nlohmann::json line = nlohmann::json::parse(frame_text(frame, scene.scene.dimension));
    for (const char* key : {"viewers", "drop_viewers"}) {
      if (line.contains(key)) told.frame.rest[key] = line[key];
    }
    world.views(told.views);
    all.push_back(std::move(told));
  }
  return all;
}

std::unique_ptr<Culler> engine_of(const BenchScene& scene) {
  MethodOptions options;
  options.dimension = scene.scene.dimension;
  options.bounds = scene.choice.bounds;
  options.cell = scene.choice.cell;
  auto engine = make_method(default_method(), options);
  for (const SceneObject& object : scene.scene.objects) engine->add(object.object);
  return engine;
}

nlohmann::json scene_json(const BenchScene& bench) {
  Scene scene = bench.scene;
  scene.bounds = bench.choice.bounds;
  scene.cell = bench.choice.cell;
  return nlohmann::json::parse(scene_text(scene));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

/// The least time of each frame.
struct Times {
  std::vector<double> alone{}, wire{};
};

void keep_least(std::vector<double>& times, std::size_t frame, double ms) {
  if (times.size() <= frame) times.resize(frame + 1, ms);
  times[frame] = std::min(times[frame], ms);
}

bool same(const Answers& answers, const Client::Answers& told) {
  if (answers.views.size() != told.size()) return false;
  return std::all_of(answers.views.begin(), answers.views.end(), [&](const Answer& answer) {
    const auto found = told.find(answer.viewer);
    return found != told.end() && found->second == answer.visible;
  });
}

bool race(const BenchScene& scene, const std::vector<Told>& frames, std::uint16_t port, Times& times,
          const std::function<void()>& tick) {
  const auto engine = engine_of(scene);
  Client client("127.0.0.1", port);
  client.open(scene_json(scene));
  Answers answers;
  bool all_same = true;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Told& told = frames[i];
    const auto start = Clock::now();
    for (const auto& [id, pose] : told.moves) engine->move(id, pose);
    engine->query(told.time, told.views, answers);
    const double alone = since(start);
    const auto start_wire = Clock::now();
    const Client::Answers wire = client.frame(told.frame, Client::Reply::full);
    const double over_wire = since(start_wire);
    all_same = all_same && same(answers, wire);
    if (i > 0) {
      keep_least(times.alone, i - 1, alone);
      keep_least(times.wire, i - 1, over_wire);
    }
    tick();
  }
  client.close();
  return all_same;
}

}  // namespace

ServiceBenchResult bench_service(const std::string& name, std::uint64_t frames, int repeats,
                                 const std::function<void()>& tick) {
  const BenchScene scene = open_bench_scene(name);
  const std::vector<Told> told = play(scene, frames);
  const BackgroundServer server(one_thread());
  ServiceBenchResult result{.scene = name, .objects = scene.scene.objects.size(), .same_answers = true};
  for (const Told& frame : told) result.moves += frame.moves.size(), result.views += frame.views.size();
  result.moves /= std::max<std::size_t>(told.size(), 1);
  result.views /= std::max<std::size_t>(told.size(), 1);
  Times times;
  for (int i = 0; i < repeats; ++i) {
    result.same_answers = race(scene, told, server.port(), times, tick) && result.same_answers;
  }
  result.alone_ms = median(times.alone);
  result.wire_ms = median(times.wire);
  if (!times.alone.empty()) {
    result.alone_min_ms = *std::min_element(times.alone.begin(), times.alone.end());
    result.wire_min_ms = *std::min_element(times.wire.begin(), times.wire.end());
  }
  return result;
}

std::string service_bench_table(const std::vector<ServiceBenchResult>& results) {
  std::string text =
      "scene                                     moves   views   in process, ms   over loopback, ms   ratio   "
      "answers\n";
  for (const ServiceBenchResult& r : results) {
    char line[256];
    std::snprintf(line, sizeof line, "%-40s %6llu %7llu %16.3f %19.3f %7.2f   %s\n", r.scene.c_str(),
                  static_cast<unsigned long long>(r.moves), static_cast<unsigned long long>(r.views), r.alone_ms,
                  r.wire_ms, r.alone_ms > 0.0 ? r.wire_ms / r.alone_ms : 0.0,
                  r.same_answers ? "the same" : "DIFFERENT");
    text += line;
  }
  return text;
}

}  // namespace gridcull
