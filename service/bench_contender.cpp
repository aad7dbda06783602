#include "gridcull/service/bench_contender.h"

#include <algorithm>
#include <cmath>

#include "gridcull/core/error.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

constexpr std::size_t many_viewers = 10;
/// Finer cells than the scene's own are tried by themselves only where they are few.
constexpr double most_cells = 2e6;

bool takes(const MethodEntry& method, const char* option) {
  return method.options.find(option) != std::string_view::npos;
}

double cell_count(const BenchScene& scene, double cell) {
  const Vec3 size = scene.choice.bounds.size();
  double count = 1.0;
  for (int k = 0; k < scene.scene.dimension; ++k) count *= std::max(1.0, size[k] / cell);
  return count;
}

std::vector<double> cells_of(const BenchScene& scene, const BenchChoice& choice) {
  if (!choice.cells.empty()) return choice.cells;
  std::vector<double> cells{2.0 * scene.default_cell, scene.default_cell};
  const double fine = 0.5 * scene.default_cell;
  if (cell_count(scene, fine) <= most_cells) cells.push_back(fine);
  return cells;
}

/// The file that was baked for this method and world; "" where there is none.
std::string baked_for(const MethodEntry& method, const BenchScene& scene, const BenchChoice& choice) {
  if (method.baking.bake == nullptr || choice.baked.empty()) return {};
  std::vector<Object> objects;
  for (const SceneObject& object : scene.scene.objects) objects.push_back(object.object);
  const std::uint64_t world = static_world_hash(objects);
  for (const std::string& file : choice.baked) {
    const BakedHead head = read_baked_head(file);
    if (head.method == method.info.name && head.world == world) return file;
  }
  return {};
}

bool takes_edge_here(const MethodEntry& method, const BenchScene& scene) {
  return takes_edge(method) && scene.scene.dimension == 3;
}

/// From a file, or from one that is to be made; nothing else is asked of a method that has one.
void add_baked(const Contender& plain, const BenchScene& scene, const BenchChoice& choice,
               std::vector<Contender>& out) {
  if (plain.method->baking.bake == nullptr) return;
  Contender one = plain;
  one.setting_name = "sets";
  one.setting = "baked";
  one.options.baked = baked_for(*plain.method, scene, choice);
  one.to_bake = one.options.baked.empty() && choice.bake;
  if (one.to_bake || !one.options.baked.empty()) out.push_back(one);
}

void add_resolutions(const Contender& plain, const BenchScene& scene, const BenchChoice& choice,
                     std::vector<Contender>& out) {
  const bool edge = takes_edge_here(*plain.method, scene), picture = takes_picture(*plain.method);
  Contender one = plain;
  one.setting_name = "resolution";
  std::vector<Resolution> all = choice.resolutions;
  if (all.empty() && edge) all = {{}, {.edge = 64}, {.edge = 128}, {.edge = 256}, {.edge = 512}};
  if (all.empty() && picture) all = {{.width = 42, .height = 24}, {}, {.width = 320, .height = 180}};
  const std::size_t before = out.size();
  for (const Resolution& resolution : all) {
    if ((resolution.edge > 0 && !edge) || (resolution.width > 0 && !picture)) continue;
    apply_resolution(resolution, *plain.method, one.options);
    one.setting = resolution_text(resolution);
    if (picture && resolution.width == 0) one.setting = "128x72";
    one.is_default = picture ? one.setting == "128x72" : resolution.edge == 0;
    out.push_back(one);
  }
  // Nothing asked for that this method takes: its default.
  if (out.size() == before) one.setting = picture ? "128x72" : "auto", out.push_back(one);
}

void add_occluders(const Contender& plain, const BenchChoice& choice, std::vector<Contender>& out) {
  Contender one = plain;
  one.setting_name = "occluders";
  for (const int count : choice.occluders.empty() ? std::vector{1, 2, 4, 8, 16, 32} : choice.occluders) {
    one.options.occluders = count;
    one.setting = std::to_string(count);
    one.is_default = count == MethodOptions{}.occluders;
    out.push_back(one);
  }
}

void add_cells(const Contender& plain, const BenchScene& scene, const BenchChoice& choice,
               std::vector<Contender>& out) {
  Contender one = plain;
  one.setting_name = "cell";
  for (const double cell : cells_of(scene, choice)) {
    one.options.cell = cell;
    one.setting = number_text(cell) + " m";
    one.is_default = cell == scene.default_cell;
    out.push_back(one);
  }
}

/// Every setting with each kind of bound.
void multiply_by_bounds(const BenchChoice& choice, std::vector<Contender>& contenders) {
  if (choice.bounds.empty() || !takes(*contenders[0].method, "--bounds")) return;
  std::vector<Contender> out;
  for (const BoundKind kind : choice.bounds) {
    for (Contender one : contenders) {
      one.options.bound = kind;
      one.setting_name += one.setting_name.empty() ? "bounds" : " and bounds";
      one.setting += (one.setting.empty() ? "" : " ") + std::string(name_of(kind));
      one.is_default = one.is_default && kind == choice.bounds[0];
      out.push_back(std::move(one));
    }
  }
  contenders = std::move(out);
}

/// The settings of one method on one scene, threads apart.
std::vector<Contender> settings_of(const MethodEntry& method, const BenchScene& scene, const BenchChoice& choice) {
  Contender plain;
  plain.method = &method;
  plain.options.dimension = scene.scene.dimension;
  plain.options.bounds = scene.choice.bounds;
  plain.options.cell = scene.default_cell;
  plain.options.max_memory = choice.max_memory;
  std::vector<Contender> out;
  if (takes_edge_here(method, scene) || takes_picture(method)) {
    add_baked(plain, scene, choice, out);
    const bool baked = !out.empty();  // then that is the default
    add_resolutions(plain, scene, choice, out);
    if (baked) std::for_each(out.begin() + 1, out.end(), [](Contender& c) { c.is_default = false; });
  } else if (takes(method, "--occluders")) {
    add_occluders(plain, choice, out);
  } else if (takes(method, "--cell") && !takes_edge(method)) {
    add_cells(plain, scene, choice, out);
  } else {
    add_baked(plain, scene, choice, out);
    if (out.empty()) out.push_back(plain);
  }
  multiply_by_bounds(choice, out);
  // A curve without its default: the first stands for it.
  if (std::none_of(out.begin(), out.end(), [](const Contender& c) { return c.is_default; })) out[0].is_default = true;
  return out;
}

}  // namespace

std::string Contender::label() const {
  std::string text(method->info.name);
  if (!setting.empty()) text += ", " + setting_name + " " + setting;
  return text + ", " + counted(static_cast<unsigned long long>(options.threads), "thread");
}

std::vector<Contender> choose_contenders(const BenchScene& scene, const BenchChoice& choice) {
  std::vector<const MethodEntry*> methods;
  for (const std::string& name : choice.methods) methods.push_back(&find_method(name, "--methods"));
  if (methods.empty()) {
    for (const MethodEntry& method : method_catalog()) methods.push_back(&method);
  }
  std::vector<int> threads = choice.threads;
  if (threads.empty()) threads = scene.scene.viewers.size() >= many_viewers ? std::vector{1, 2} : std::vector{1};
  const std::vector<int> alone{1};
  std::vector<Contender> out;
  for (const MethodEntry* method : methods) {
    if (scene.scene.dimension == 2 ? !method->info.takes_2d : !method->info.takes_3d) continue;
    const bool parallel = takes(*method, "--threads");
    for (const Contender& setting : settings_of(*method, scene, choice)) {
      for (const int count : parallel ? threads : alone) {
        out.push_back(setting);
        out.back().options.threads = count;
      }
    }
  }
  return out;
}

}  // namespace gridcull
