#include "gridcull/service/bench_scene.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <vector>

#include "gridcull/core/error.h"
#include "gridcull/grid/openvdb_field.h"
#include "gridcull/service/bench_hidden.h"
#include "gridcull/service/bench_still.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/survey.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw Error(ErrorCode::usage, "--scenes: " + text + ": " + why);
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

template <class Number>
Number number(const std::string& text, const std::string& part, const std::string& what) {
  Number value{};
  const auto [end, fault] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (fault != std::errc() || end != part.data() + part.size()) {
    refuse(text, "expected " + what + ", found \"" + part + "\"");
  }
  return value;
}

bool is_made(const std::string& kind) {
  const auto names = generated_scenes();
  return std::find(names.begin(), names.end(), kind) != names.end();
}

void set_parameter(const std::string& text, const std::string& key, const std::string& value, BenchSceneName& name) {
  if (key == "viewers") {
    name.options.viewers = number<std::uint32_t>(text, value, "a number of viewers");
  } else if (key == "range") {
    name.options.range = number<double>(text, value, "metres");
  } else if (key == "cell") {
    name.options.cell = number<double>(text, value, "metres");
  } else if (key == "seed") {
    name.options.seed = number<std::uint64_t>(text, value, "a seed");
  } else if (key == "hidden" && name.kind == "spheres") {
    name.hidden = number<std::uint32_t>(text, value, "a number of hidden movers");
    name.boxed = true;
    if (name.hidden > 5'000'000) refuse(text, "expected at most 5000000 hidden movers");
  } else if (key == "moving" && name.kind == "spheres") {
    name.moving = number<std::uint32_t>(text, value, "a number of moving spheres");
  } else {
    refuse(text, "expected viewers=, range=, cell=, seed= or (spheres) hidden= and moving=, found \"" + key + "=\"");
  }
}

BenchSceneName made_name(const std::string& text, const std::vector<std::string>& parts) {
  BenchSceneName name;
  name.kind = parts[0];
  std::vector<std::uint32_t> counts;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::size_t equals = parts[i].find('=');
    if (equals == std::string::npos) {
      counts.push_back(number<std::uint32_t>(text, parts[i], "a number"));
    } else {
      set_parameter(text, parts[i].substr(0, equals), parts[i].substr(equals + 1), name);
    }
  }
  const std::size_t most = name.kind == "city" ? 2 : 1;
  if (counts.size() > most) refuse(text, "too many numbers");
  if (name.kind == "city") {
    if (!counts.empty()) name.options.blocks = counts[0];
    if (counts.size() == 2) name.options.count = counts[1];
  } else if (!counts.empty()) {
    name.options.count = counts[0];
  }
  return name;
}

std::string frames_beside(const fs::path& folder) {
  for (const char* file : {"frames.jsonl", "frames.jsonl.gz"}) {
    if (fs::is_regular_file(folder / file)) return (folder / file).string();
  }
  return {};
}

BenchSceneName file_name(const std::string& text) {
  BenchSceneName name;
  const std::size_t at = text.find('@');
  if (at != std::string::npos) {
    name.scene_path = text.substr(0, at);
    name.frames_path = text.substr(at + 1);
    return name;
  }
  if (fs::is_directory(text)) {
    const fs::path folder(text);
    name.scene_path =
        (folder / (fs::is_regular_file(folder / "scene.json.gz") ? "scene.json.gz" : "scene.json")).string();
    name.frames_path = frames_beside(folder);
    return name;
  }
  name.scene_path = text;
  name.frames_path = frames_beside(fs::path(text).parent_path());
  return name;
}

std::string made_label(const BenchSceneName& name, bool counts, bool viewers) {
  const GenerateOptions& o = name.options;
  std::string label = name.kind;
  if (counts && o.blocks) label += ":" + std::to_string(*o.blocks);
  if (counts && o.count) label += ":" + std::to_string(*o.count);
  if (viewers && o.viewers) label += ":viewers=" + std::to_string(*o.viewers);
  if (o.range) label += ":range=" + number_text(*o.range);
  if (o.cell) label += ":cell=" + number_text(*o.cell);
  if (o.seed != 1) label += ":seed=" + std::to_string(o.seed);
  if (name.moving) label += ":moving=" + std::to_string(*name.moving);
  if (name.boxed) label += counts ? ":hidden=" + std::to_string(name.hidden) : " about a box";
  return label;
}

}  // namespace

BenchSceneName parse_bench_scene(const std::string& text) {
  const std::vector<std::string> parts = split(text, ':');
  if (is_made(parts[0])) return made_name(text, parts);
  const bool path = text.find_first_of("/.@") != std::string::npos || fs::exists(text);
  if (path) return file_name(text);
  std::string known;
  for (const std::string_view name : generated_scenes()) known += std::string(name) + ", ";
  refuse(text, "expected " + known + "a folder or a file");
}

std::unique_ptr<FrameSource> BenchScene::frames() const {
  if (name.kind.empty()) {
    if (name.frames_path.empty()) return still == 0 ? nullptr : std::make_unique<StillFrames>(still);
    return std::make_unique<FrameReader>(name.frames_path, scene.dimension, &stop_if_interrupted);
  }
  auto made = make_generator(name.kind, name.options);
  const auto first = static_cast<ObjectId>(made->scene().objects.size() + 1);
  std::unique_ptr<FrameSource> source = std::move(made);
  if (name.moving) source = std::make_unique<FewMovers>(std::move(source), *name.moving);
  if (name.boxed) source = std::make_unique<HiddenMovers>(std::move(source), name.hidden, first);
  return source;
}

std::string BenchScene::family_of_objects() const { return name.kind.empty() ? label : made_label(name, false, true); }
std::string BenchScene::family_of_viewers() const { return name.kind.empty() ? label : made_label(name, true, false); }

BenchScene open_bench_scene(const std::string& text) {
  BenchScene out;
  out.label = text;
  out.name = parse_bench_scene(text);
  std::optional<Survey> survey;
  if (out.name.kind.empty()) {
    out.scene = read_scene(out.name.scene_path, std::uint64_t{4} << 30, read_scalar_field);
    if (!out.scene.bounds || !out.scene.cell) survey = survey_world(out.scene, out.name.frames_path);
  } else {
    out.scene = make_generator(out.name.kind, out.name.options)->scene();
    if (out.name.moving) keep_still(out.scene, *out.name.moving);
    if (out.name.boxed) add_hidden_movers(out.scene, out.name.hidden);
  }
  if (survey) {
    out.choice = choose_lattice(out.scene.dimension, survey->objects, out.scene.bounds, out.scene.cell, survey->extent);
  } else {
    out.choice = choose_lattice(out.scene.dimension, {}, out.scene.bounds, out.scene.cell);
  }
  out.default_cell = out.choice.cell;
  return out;
}

}  // namespace gridcull
