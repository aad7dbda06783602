// `gridcull bake`: what a method works out in advance, into a file. Ctrl-C leaves FILE.part, from which the same
// command goes on.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "gridcull/core/error.h"
#include "gridcull/methods/bytes.h"
#include "gridcull/service/bake_static.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/file_roles.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/option_values.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/table.h"
#include "gridcull/service/text.h"
#include "gridcull/service/world_options.h"

namespace gridcull {
namespace {

namespace fs = std::filesystem;

struct BakeOptions {
  WorldOptions world{};
  std::string more{};  ///< what `bake static SCENE` has and `bake SCENE` has not
  std::string out{};
  std::map<std::string, std::optional<double>, std::less<>> settings{};  ///< of all methods
};

std::string bakers() {
  std::string text;
  for (const MethodEntry& entry : method_catalog()) {
    if (entry.baking.bake != nullptr) text += (text.empty() ? "" : ", ") + std::string(entry.info.name);
  }
  return text.empty() ? "none" : text;
}

const MethodEntry& find_baker(const WorldOptions& options) {
  if (options.method.empty()) throw Error(ErrorCode::usage, "--method: expected one that bakes: " + bakers());
  const MethodEntry& method = find_method(options.method);
  if (method.baking.bake != nullptr) return method;
  throw Error(ErrorCode::usage, "--method: " + options.method + " does not bake; those that do: " + bakers());
}

/// Only those of the method may be given.
BakeSettings choose_settings(const BakeOptions& options, const MethodEntry& method) {
  BakeSettings chosen;
  for (const auto& [name, value] : options.settings) {
    if (!value) continue;
    bool known = false;
    for (const BakeSetting& setting : method.baking.settings) known = known || setting.name == name;
    if (!known) throw Error(ErrorCode::usage, "--" + name + ": no option of " + std::string(method.info.name));
    chosen[name] = *value;
  }
  for (const BakeSetting& setting : method.baking.settings) (void)bake_setting(chosen, setting);
  return chosen;
}

/// Everything besides the world that the result depends on.
std::string settings_text(const MethodEntry& method, const MethodOptions& options) {
  std::string text = "cell " + number_text(options.cell, 17) + ", bounds";
  for (const Vec3& corner : {options.bounds.min, options.bounds.max}) {
    for (int k = 0; k < 3; ++k) text += " " + number_text(corner[k], 17);
  }
  for (const BakeSetting& setting : method.baking.settings) {
    text += ", " + std::string(setting.name) + " " + number_text(bake_setting(options.bake, setting), 17);
  }
  return text;
}

void check_folder(const std::string& out) {
  const fs::path folder = fs::path(out).parent_path();
  const std::string name = folder.empty() ? "." : folder.string();
  const bool is_other = fs::exists(out) && !fs::is_regular_file(out);  // a folder, a device, a pipe
  if (out == "-" || is_other) throw option_error("--out", "a file", out);
  if (::access(name.c_str(), W_OK) != 0 || !fs::is_directory(name)) {
    throw Error(ErrorCode::io, out + ": cannot be written: no folder, or one that is protected");
  }
}

/// FILE.part: the state of an unfinished bake and what it is for.
class Unfinished {
 public:
  Unfinished(std::string path, BakedHead head, std::string settings)
      : path_(std::move(path)), head_(std::move(head)), settings_(std::move(settings)) {
    head_.method += " (unfinished)";
  }

  const std::string& path() const { return path_; }
  /// The state to go on from; empty where there is none. Throws where it is one of something else.
  std::vector<std::byte> read() const {
    if (!fs::exists(path_)) return {};
    const std::vector<std::byte> payload = read_baked(path_, head_);
    ByteReader reader(payload, path_);
    if (reader.text() != settings_) {
      reader.refuse("begun with other options; give the same ones, or remove it to begin anew");
    }
    const auto state = reader.block();
    reader.finish();
    return {state.begin(), state.end()};
  }
  void write(std::span<const std::byte> state) const {
    ByteWriter out;
    out.text(settings_);
    out.block(state);
    write_baked(path_, head_, out.span());
  }
  void remove() const {
    std::error_code none;
    fs::remove(path_, none);
  }

 private:
  std::string path_;
  BakedHead head_;
  std::string settings_;
};

class Listener final : public BakeListener {
 public:
  explicit Listener(const Unfinished& unfinished) : unfinished_(unfinished) {}

  bool progress(double share) override {
    bar_.update(static_cast<std::uint64_t>(share * whole));
    return !interrupted();
  }
  void checkpoint(std::span<const std::byte> state) override {
    try {
      unfinished_.write(state);
    } catch (const Error& error) {
      throw Stopped{std::string("the work so far is lost: ") + error.what()};
    }
  }

 private:
  static constexpr std::uint64_t whole = 1000;
  const Unfinished& unfinished_;
  Progress bar_{"thousandths", whole};
};

/// The payload. Throws Stopped on Ctrl-C, once FILE.part is written.
std::vector<std::byte> work(const MethodEntry& method, std::span<const Object> objects, const MethodOptions& options,
                            const Unfinished& unfinished, std::span<const std::byte> state) {
  Listener listener(unfinished);
  auto payload = method.baking.bake(objects, options, state, listener);
  if (!payload) throw Stopped{unfinished.path() + " holds the work so far, and the same command goes on from it"};
  return std::move(*payload);
}

void check_command_line(const BakeOptions& options) {
  if (!options.more.empty()) throw Error(ErrorCode::usage, "bake: expected one scene, found also " + options.more);
  if (options.out.empty()) throw Error(ErrorCode::usage, "--out is required");
  check_folder(options.out);
  keep_apart(input_files(options.world),
             std::vector<NamedFile>{{"--out", options.out}, {"--out", options.out + ".part"}});
}

/// The scene's, and those moving ones that only the frames add.
std::vector<Object> objects_of(const PreparedWorld& world) {
  std::vector<Object> objects;
  std::set<ObjectId> known;
  for (const SceneObject& object : world.scene.objects) {
    objects.push_back(object.object);
    known.insert(object.object.id);
  }
  if (!world.survey) return objects;
  for (const Object& object : world.survey->objects) {
    if (!object.is_static && known.insert(object.id).second) objects.push_back(object);
  }
  return objects;
}

int bake_cells(BakeOptions options) {
  if (options.more.empty()) throw Error(ErrorCode::usage, "bake static: expected a scene or a model");
  if (!options.world.method.empty()) throw Error(ErrorCode::usage, "bake static: no --method is needed");
  for (const auto& [name, value] : options.settings) {
    if (value) throw Error(ErrorCode::usage, "--" + name + ": no option of bake static");
  }
  options.world.scene = std::exchange(options.more, "");
  check_command_line(options);
  return bake_static(options.world, options.out);
}

int bake(const BakeOptions& options) {
  if (options.world.scene == "static") return bake_cells(options);
  check_command_line(options);
  const MethodEntry& method = find_baker(options.world);
  const BakeSettings settings = choose_settings(options, method);
  // Frames are read for who moves in them.
  const PreparedWorld world = prepare_world(options.world, !options.world.frames.empty());
  MethodOptions chosen = method_options(options.world, world);
  chosen.bake = settings;
  (void)make_method(options.world.method, chosen);  // refuses the wrong dimension
  const std::vector<Object> objects = objects_of(world);
  const BakedHead head{std::string(method.info.name), method.baking.version, static_world_hash(objects)};
  const Unfinished unfinished(options.out + ".part", head, settings_text(method, chosen));
  const std::vector<std::byte> state = unfinished.read();

  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::byte> payload = work(method, objects, chosen, unfinished, state);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_baked(options.out, head, payload);
  unfinished.remove();
  std::string text = row("scene", options.world.scene) + row("method", options.world.method) +
                     row("file", options.out + ", " + bytes_text(static_cast<double>(fs::file_size(options.out)))) +
                     row("time", number_text(seconds, 3) + " s, " +
                                     counted(static_cast<unsigned long long>(options.world.threads), "thread") +
                                     (state.empty() ? "" : ", gone on from " + unfinished.path()));
  std::fputs((text + method.baking.describe(payload)).c_str(), stdout);
  return 0;
}

/// One option a name, whichever methods have it.
void add_settings(CLI::App& command, BakeOptions& options) {
  std::map<std::string, std::string> help;
  for (const MethodEntry& entry : method_catalog()) {
    for (const BakeSetting& setting : entry.baking.settings) {
      std::string& text = help[std::string(setting.name)];
      text += (text.empty() ? "" : "; ") + std::string(entry.info.name) + ": " + std::string(setting.help) +
              " (default " + number_text(setting.standard) + ")";
    }
  }
  for (const auto& [name, text] : help) {
    command.add_option("--" + name, options.settings[name], text)->type_name("X");
  }
}

}  // namespace

void add_bake_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<BakeOptions>();
  options->world.method.clear();
  options->world.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 256u));
  CLI::App& command = *app.add_subcommand("bake",
                                          "Work in advance: for a method, into a file that --baked reads, or with "
                                          "`static` in front of the scene the cells of "
                                          "what does not move, into a .vdb");
  add_scene_options(command, options->world);
  command.add_option("MORE", options->more)->group("");
  add_text(command, "--method", options->world.method, "one that bakes", "one that bakes: " + bakers())
      .type_name("NAME");
  add_text(command, "--out", options->out, "a file name",
           "file to write; Ctrl-C leaves FILE.part, from which the same command goes on (a second one ends at once, "
           "without); bake static begins anew")
      .type_name("FILE");
  add_whole(command, "--threads", options->world.threads, {1, 256, "1 .. 256"},
            "1 .. 256 (default: all cores); the file does not depend on it");
  add_settings(command, *options);
  command.footer(
      "Example: a town, baked and used\n"
      "  gridcull make town --out town --viewers 10 --range 100\n"
      "  gridcull bake --method five-d-tree town/scene.json --out town.baked\n"
      "  gridcull run town/scene.json --frames town/frames.jsonl --method five-d-tree --baked town.baked\n"
      "Example: the cells of a scene's static objects, or of a model, for its \"static_volume\"\n"
      "  gridcull bake static town/scene.json --out town/town.vdb");
  command.callback([options, &action] { action = [options] { return bake(*options); }; });
}

}  // namespace gridcull
