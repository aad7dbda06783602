// `gridcull make`: writes a generated world.
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/text.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/world_files.h"

namespace gridcull {
namespace {

struct MakeOptions {
  std::string name{};
  std::string out{};
  GenerateOptions generate{};
};

int make(const MakeOptions& options) {
  const auto generator = make_generator(options.name, options.generate);
  WorldFiles files(options.out, generator->scene().dimension);
  {
    Progress progress("frames", generator->frame_count());
    std::uint64_t frames = 0;
    for (Frame frame; generator->next(frame);) {
      files.write(frame);
      progress.update(++frames);
      stop_if_interrupted();
    }
  }
  files.commit(generator->scene());
  const Scene& scene = generator->scene();
  std::printf("%s: %s, %s, %s -> %s, %s\n", options.name.c_str(), counted(scene.objects.size(), "object").c_str(),
              counted(scene.viewers.size(), "viewer").c_str(), counted(generator->frame_count(), "frame").c_str(),
              files.scene_path().c_str(), files.frames_path().c_str());
  return 0;
}

std::string names() {
  std::string text;
  for (const std::string_view name : generated_scenes()) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

}  // namespace

void add_make_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<MakeOptions>();
  CLI::App& command = *app.add_subcommand("make", "Write a generated world: " + names());
  GenerateOptions& g = options->generate;
  command.add_option("SCENE", options->name, names())->required();
  command.add_option("--out", options->out, "folder for scene.json and frames.jsonl")->required()->type_name("DIR");
  command.add_option("--count", g.count, "spheres, discs, cars (city), buildings (town), corridors a side (maze)");
  command.add_option("--blocks", g.blocks, "city: blocks along each side (default 50)");
  command.add_option("--viewers", g.viewers, "viewers on the first V movers, looking all round")->type_name("V");
  command.add_option("--range", g.range, "how far viewers see (default: no limit)")->type_name("METRES");
  command.add_option("--cell", g.cell, "cell size that the scene names")->type_name("METRES");
  command.add_option("--seed", g.seed, "another seed, another world (default 1)");
  command.add_option("--frames", g.frames, "frames, 30 a second");
  command.footer(
      "Example: 400 buildings, cars between them, ten of which look around 100 m far\n"
      "  gridcull make town --out town --viewers 10 --range 100");
  command.callback([options, &action] { action = [options] { return make(*options); }; });
}

}  // namespace gridcull
