// `gridcull check`: holds a method against the exact reference.
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "gridcull/service/commands.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/judge.h"
#include "gridcull/service/option_values.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/run_report.h"
#include "gridcull/service/table.h"
#include "gridcull/service/text.h"
#include "gridcull/service/world_options.h"

namespace gridcull {
namespace {

struct CheckOptions {
  WorldOptions world{};
  std::uint64_t every = 1;
  int rays = 512;
  bool json = false;
};

std::string miss_text(const Miss& miss) {
  std::string text = "miss: frame " + std::to_string(miss.frame) + ", viewer " + std::to_string(miss.viewer) +
                     ", object " + std::to_string(miss.object);
  if (miss.direction == Vec3(0.0)) return text + " holds the viewer\n";
  const Vec3& d = miss.direction;
  return text + " is seen along (" + number_text(d.x, 9) + ", " + number_text(d.y, 9) + ", " + number_text(d.z, 9) +
         ")\n";
}

std::string check_text(const CheckOptions& options, const PreparedWorld& world, const MethodInfo& method,
                       const Verdict& verdict, std::uint64_t frames) {
  const bool flat = world.scene.dimension == 2;
  const double over = verdict.over_estimation();
  std::string text = row("scene", options.world.scene + ", " + std::to_string(world.scene.dimension) + "D");
  text += row("method", std::string(method.name) + " (" + guarantee_text(method.guarantee) + "), TBVs " +
                            options.world.tbv + (options.world.pull ? ", pull" : ", push"));
  text += row("grid", lattice_text(world.lattice));
  text += row("frames", std::to_string(frames) + ", " + std::to_string(verdict.frames) + " of them judged");
  text += row("queries", std::to_string(verdict.queries) + " judged");
  text += row("exact mean", number_text(verdict.exact_mean(), 5) + " visible objects" +
                                (flat ? "" : " (a lower bound: " + std::to_string(options.rays) + " rays)"));
  text += row("PVS mean", number_text(verdict.reported_mean(), 5) + " objects");
  text += row("over-estimation", (std::isnan(over) ? "none: nothing is visible" : number_text(over, 4)) +
                                     std::string(flat || std::isnan(over) ? "" : " (an upper bound)"));
  text += row("misses", std::to_string(verdict.misses.size()));
  if (verdict.unconfirmed > 0) {
    text +=
        row("unconfirmed", std::to_string(verdict.unconfirmed) + " seen by a ray in floats, not in doubles: no misses");
  }
  for (const Miss& miss : verdict.misses) text += miss_text(miss);
  return text;
}

std::string check_json(const CheckOptions& options, const PreparedWorld& world, const MethodInfo& method,
                       const Verdict& verdict, std::uint64_t frames) {
  nlohmann::ordered_json json{{"format", "gridcull.check/1"},
                              {"method", method.name},
                              {"guarantee", guarantee_text(method.guarantee)},
                              {"dimension", world.scene.dimension},
                              {"frames", frames},
                              {"judged_frames", verdict.frames},
                              {"queries", verdict.queries},
                              {"exact_mean", verdict.exact_mean()},
                              {"exact_is_lower_bound", world.scene.dimension == 3},
                              {"pvs_mean", verdict.reported_mean()}};
  const double over = verdict.over_estimation();
  json["over_estimation"] = std::isnan(over) ? nlohmann::ordered_json() : nlohmann::ordered_json(over);
  if (world.scene.dimension == 3) json["rays"] = options.rays;
  json["unconfirmed"] = verdict.unconfirmed;
  json["misses"] = verdict.misses.size();
  json["missed"] = nlohmann::ordered_json::array();
  for (const Miss& miss : verdict.misses) {
    json["missed"].push_back({{"frame", miss.frame}, {"viewer", miss.viewer}, {"object", miss.object}});
  }
  return json.dump() + "\n";
}

int check(const CheckOptions& options) {
  const PreparedWorld world = prepare_world(options.world);
  const auto culler = make_culler(options.world, world);
  Judge judge(world.scene.dimension, options.rays);
  const auto frames = open_frames(options.world, world);
  Replay replay(*culler, world.scene, frames.get(), feed_of(options.world));
  {
    Progress progress("frames", expected_frames(options.world, world));
    while (replay.step()) {
      if (replay.frame() % options.every == 0) judge.judge(replay);
      progress.update(replay.next_frame());
      stop_if_interrupted();
    }
  }
  const MethodInfo& method = culler->info();
  const auto report = options.json ? check_json : check_text;
  std::fputs(report(options, world, method, judge.verdict(), replay.next_frame()).c_str(), stdout);
  return method.guarantee == Guarantee::conservative && !judge.verdict().misses.empty() ? 1 : 0;
}

}  // namespace

void add_check_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App& command = *app.add_subcommand("check", "Hold a method against the exact reference; 1 if it missed anybody");
  add_scene_options(command, options->world);
  add_method_options(command, options->world);
  add_whole(command, "--every", options->every, {.low = 1, .expected = "a whole number, 1 or more"},
            "judge frames 0, N, 2N ... (all are replayed; default 1)");
  add_whole(command, "--rays", options->rays, {1, 16384, "1 .. 16384"},
            "3D: along a frustum's height or a cube face's edge (default 512)")
      .type_name("R");
  command.add_flag("--json", options->json, "one JSON object instead of text");
  command.footer(
      "Example: every twentieth frame of a town\n"
      "  gridcull make town --out town --viewers 10 --range 100\n"
      "  gridcull check town/scene.json --frames town/frames.jsonl --every 20");
  command.callback([options, &action] { action = [options] { return check(*options); }; });
}

}  // namespace gridcull
