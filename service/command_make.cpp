// `gridcull make`: writes a generated world.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/option_values.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/text.h"
#include "gridcull/service/world_options.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/world_files.h"

namespace gridcull {
namespace {

constexpr std::uint64_t most_32 = std::numeric_limits<std::uint32_t>::max();

struct MakeOptions {
  std::string name{};
  std::string out{};
  GenerateOptions generate{};
  std::uint64_t max_memory = MethodOptions{}.max_memory;
};

std::string names() {
  std::string text;
  for (const std::string_view name : generated_scenes()) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

std::unique_ptr<Generator> open_generator(const MakeOptions& options) {
  const auto known = generated_scenes();
  if (std::find(known.begin(), known.end(), options.name) == known.end()) {
    throw option_error("SCENE", "one of " + names(), options.name);
  }
  if (options.generate.blocks && options.name != "city") {
    throw Error(ErrorCode::usage, "--blocks: no option of " + options.name);
  }
  auto generator = named_as_typed([&] { return make_generator(options.name, options.generate); });
  // A grid that `run` would refuse is refused here.
  const Scene& scene = generator->scene();
  if (scene.bounds && scene.cell) {
    (void)make_lattice(scene.dimension, *scene.bounds, *scene.cell, options.max_memory, "--cell");
  }
  return generator;
}

int make(const MakeOptions& options) {
  const auto generator = open_generator(options);
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

}  // namespace

void add_make_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<MakeOptions>();
  CLI::App& command = *app.add_subcommand("make", "Write a generated world: " + names());
  GenerateOptions& g = options->generate;
  add_text(command, "SCENE", options->name, "one of " + names(), names()).required();
  add_text(command, "--out", options->out, "a folder", "folder for scene.json and frames.jsonl")
      .required()
      ->type_name("DIR");
  add_whole(command, "--count", g.count, {0, 10'000'000, "a whole number, at most 10000000"},
            "spheres, discs, cars (city), buildings (town), corridors a side (maze)");
  add_whole(command, "--blocks", g.blocks, {1, 2000, "1 .. 2000"}, "city: blocks along each side (default 50)");
  add_whole(command, "--viewers", g.viewers, {0, most_32, "a whole number, at most 4294967295"},
            "viewers on the first V movers, looking all round")
      .type_name("V");
  add_positive(command, "--range", g.range, positive_metres(), "how far viewers see (default: no limit)")
      .type_name("METRES");
  add_positive(command, "--cell", g.cell, positive_metres(), "cell size that the scene names").type_name("METRES");
  add_whole(command, "--max-memory", options->max_memory, memory_bytes(),
            "refuse a cell size whose grid is larger than this (default 4 GiB, as run does)")
      .type_name("BYTES");
  add_whole(command, "--seed", g.seed, {.expected = "a whole number from 0 to 18446744073709551615"},
            "another seed, another world (default 1)");
  add_whole(command, "--frames", g.frames, {1, most_32, "a whole number, 1 .. 4294967295"}, "frames, 30 a second");
  command.footer(
      "Example: 400 buildings, cars between them, ten of which look around 100 m far\n"
      "  gridcull make town --out town --viewers 10 --range 100");
  command.callback([options, &action] { action = [options] { return make(*options); }; });
}

}  // namespace gridcull
