// `gridcull explain`: why a viewer sees an object in a frame, or does not.
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/explain.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/option_values.h"
#include "gridcull/service/text.h"
#include "gridcull/service/world_options.h"
#include "gridcull/sim/world.h"

namespace gridcull {
namespace {

struct ExplainOptions {
  WorldOptions world{};
  std::uint64_t frame = 0;
  ViewerId viewer = no_id;
  ObjectId object = no_id;
  int rays = 512;
};

/// The world at the frame that is asked for.
World play_to(const ExplainOptions& options, const PreparedWorld& prepared) {
  World world(prepared.scene);
  const auto frames = open_frames(options.world, prepared);
  if (!frames) {
    if (options.frame > 0) throw option_error("--frame", "0, there is no frames file", std::to_string(options.frame));
    return world;
  }
  Frame frame;
  for (std::uint64_t i = 0; i <= options.frame; ++i) {
    if (!frames->next(frame)) {
      throw option_error("--frame", "one of the " + std::to_string(i) + " frames there are, from 0",
                         std::to_string(options.frame));
    }
    world.apply(frame);
    stop_if_interrupted();
  }
  return world;
}

View find_view(const World& world, const ExplainOptions& options) {
  for (const View& view : world.views()) {
    if (view.viewer == options.viewer) return view;
  }
  throw option_error("--viewer", "one that is there in frame " + std::to_string(options.frame),
                     std::to_string(options.viewer));
}

int explain_command(const ExplainOptions& options) {
  const PreparedWorld prepared = prepare_world(options.world);
  const int dimension = prepared.scene.dimension;
  if (dimension == 3 && !ExactRays::available()) {
    throw Error(ErrorCode::usage, "explain: the 3D reference needs Embree, which this program was built without");
  }
  const World world = play_to(options, prepared);
  const View view = find_view(world, options);
  if (!world.has(options.object)) {
    throw option_error("--object", "one that is there in frame " + std::to_string(options.frame),
                       std::to_string(options.object));
  }
  const Explanation explanation = explain(world.objects(), prepared.lattice, view, options.object, options.rays);
  std::fputs((explained_json(explanation, dimension).dump() + "\n").c_str(), stdout);
  return 0;
}

}  // namespace

void add_explain_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App& command = *app.add_subcommand("explain", "Why a viewer sees an object in a frame, or does not, as JSON");
  add_scene_options(command, options->world);
  add_whole(command, "--frame", options->frame, {.expected = "a whole number, 0 or more"}, "from 0 (default 0)");
  const WholeRange ids{0, no_id - 1, "an id, 0 .. 4294967294"};
  add_whole(command, "--viewer", options->viewer, ids, "who looks").type_name("ID")->required();
  add_whole(command, "--object", options->object, ids, "at what").type_name("ID")->required();
  add_whole(command, "--rays", options->rays, {1, 16384, "1 .. 16384"},
            "3D: along a frustum's height or a cube face's edge (default 512)")
      .type_name("R");
  command.footer(
      "verdict: visible (sees: a point of it that is seen), hidden (by: ids of occluders that together cover it),\n"
      "outside (of the view, or ridden by the viewer) or contains_viewer; cells: of the grid, that it touches.\n"
      "It is the exact reference that answers, whatever a method says.\n\n"
      "Example: the first building and the first driver of a town\n"
      "  gridcull make town --out town --viewers 10 --range 100\n"
      "  gridcull explain town/scene.json --frames town/frames.jsonl --frame 5 --viewer 400 --object 0");
  command.callback([options, &action] { action = [options] { return explain_command(*options); }; });
}

}  // namespace gridcull
