// The tables of Bartz, Klosowski, Staneker 2005 on models of ours (bounds_models.h): 1 the models, 2 culled share and
// time per bound with a depth buffer, 2b the same for the method `silhouette`, 3 a model turned by 45 degrees about
// (1, 1, 1), 4 hierarchical queries, 5 volume and surface; and figure 5, build time against vertices. What they show is
// discussed in docs/bounds.md. Times are processor time,
// the least of the repeats.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <time.h>

#include "depth_culling.h"
#include "gridcull/grid/engine.h"
#include "gridcull/sim/random.h"

using namespace gridcull;
using namespace gridcull::bench;

namespace {

constexpr double untested = 0.05;  // of the leaves in view, front-most: as for the paper's MCAD models

/// Processor time of this thread: others on the machine do not count.
double seconds_now() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Least seconds of `repeats` calls.
template <class F>
double least_seconds(int repeats, const F& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    const double start = seconds_now();
    work();
    least = std::min(least, seconds_now() - start);
  }
  return least;
}

/// What one contender did in all frames: work of a round, least time of each frame over the rounds.
struct Meter {
  explicit Meter(const Model& m) : model(&m), least(m.views.size(), std::numeric_limits<double>::infinity()) {}

  /// `cull(view)` gives a CullResult.
  template <class Cull>
  void round(const Cull& cull) {
    sum = {};
    for (std::size_t v = 0; v < least.size(); ++v) {
      CullResult one;
      least[v] = std::min(least[v], least_seconds(1, [&] { one = cull(model->views[v]); }));
      sum.drawn_triangles += one.drawn_triangles;
      sum.drawn_parts += one.drawn_parts;
      sum.queries += one.queries;
    }
  }

  double frames() const { return static_cast<double>(least.size()); }
  /// Per cent of the model's triangles or parts that were not drawn.
  double culled() const {
    return 100.0 *
           (1.0 - static_cast<double>(sum.drawn_triangles) / (frames() * static_cast<double>(triangles_of(*model))));
  }
  double culled_parts() const {
    return 100.0 * (1.0 - static_cast<double>(sum.drawn_parts) / (frames() * static_cast<double>(model->parts.size())));
  }
  double ms() const {
    double seconds = 0.0;
    for (const double s : least) seconds += s;
    return 1e3 * seconds / frames();
  }
  double queries() const { return static_cast<double>(sum.queries) / frames(); }

  const Model* model;
  std::vector<double> least;
  CullResult sum{};
};

/// Of the leaves' bounds.
struct Complexity {
  double mean = 0.0;
  std::size_t most = 0;
};

Complexity complexity_of(const BoundTree& tree) {
  Complexity out;
  for (const BoundTree::Node& node : tree.nodes()) {
    if (node.left != 0) continue;
    out.mean += static_cast<double>(node.triangles.size()) / static_cast<double>(tree.model().parts.size());
    out.most = std::max(out.most, node.triangles.size());
  }
  return out;
}

/// All contenders in turn, round by round, so that they share the machine's moods.
template <class Cull>
std::vector<Meter> race(const Model& model, std::size_t contenders, int repeats, const Cull& cull) {
  std::vector<Meter> meters(contenders, Meter(model));
  for (int i = 0; i < repeats; ++i) {
    for (std::size_t k = 0; k < contenders; ++k) {
      meters[k].round([&](const View& view) { return cull(k, view); });
    }
  }
  return meters;
}

void table_2(const Model& model, int repeats) {
  std::vector<BoundTree> trees;
  for (const BoundKind kind : all_bound_kinds) trees.emplace_back(model, kind);
  DepthBuffer buffer;
  const auto meters = race(model, trees.size(), repeats, [&](std::size_t k, const View& view) {
    return cull_sequential(trees[k], view, untested, buffer);
  });
  std::printf("\n%s, depth buffer, sequential\n%-8s %9s %9s %9s %9s %18s\n", model.name.c_str(), "bound", "culled %",
              "parts %", "ms/frame", "queries", "triangles (most)");
  for (std::size_t k = 0; k < trees.size(); ++k) {
    const Complexity t = complexity_of(trees[k]);
    std::printf("%-8s %9.2f %9.2f %9.3f %9.1f %11.0f (%zu)\n", std::string(name_of(all_bound_kinds[k])).c_str(),
                meters[k].culled(), meters[k].culled_parts(), meters[k].ms(), meters[k].queries(), t.mean, t.most);
  }
}

void table_4(const Model& model, int repeats) {
  const std::vector<BoundKind> kinds{BoundKind::box, BoundKind::dop14, BoundKind::dop18, BoundKind::dop26};
  std::vector<BoundTree> trees;
  for (const BoundKind kind : kinds) trees.emplace_back(model, kind);
  DepthBuffer buffer;
  const auto meters = race(model, trees.size(), repeats,
                           [&](std::size_t k, const View& view) { return cull_hierarchical(trees[k], view, buffer); });
  std::printf("\n%s, depth buffer, hierarchical\n%-8s %9s %9s %9s %9s\n", model.name.c_str(), "bound", "culled %",
              "parts %", "ms/frame", "queries");
  for (std::size_t k = 0; k < trees.size(); ++k) {
    std::printf("%-8s %9.2f %9.2f %9.3f %9.1f\n", std::string(name_of(kinds[k])).c_str(), meters[k].culled(),
                meters[k].culled_parts(), meters[k].ms(), meters[k].queries());
  }
}

std::unique_ptr<GridEngine> engine_for(const Model& model, std::optional<BoundKind> kind) {
  GridOptions options;
  options.dimension = 3;
  options.bound = kind;
  for (const Part& part : model.parts) {
    for (const Vec3& v : part.vertices) options.bounds.add(v);
  }
  const Vec3 size = options.bounds.size();
  options.cell = std::max({size.x, size.y, size.z}) / 50.0;
  auto engine = std::make_unique<GridEngine>(options);
  for (const Object& object : objects_of(model)) engine->add(object);
  return engine;
}

void table_2b(const Model& model, int repeats) {
  std::vector<std::unique_ptr<GridEngine>> engines;
  for (const BoundKind kind : all_bound_kinds) engines.push_back(engine_for(model, kind));
  engines.push_back(engine_for(model, std::nullopt));
  Answers answers;
  double time = 0.0;
  const auto query = [&](std::size_t k, const View& view) {
    engines[k]->query(++time, {&view, 1}, answers);
    return CullResult{0, answers.views[0].visible.size(), answers.views[0].work.rasters};
  };
  for (std::size_t k = 0; k < engines.size(); ++k) (void)query(k, model.views[0]);  // the first frame discretises
  const auto meters = race(model, engines.size(), repeats, query);
  std::printf("\n%s, method silhouette\n%-8s %9s %9s %9s\n", model.name.c_str(), "bound", "parts %", "ms/frame",
              "strips");
  for (std::size_t k = 0; k < engines.size(); ++k) {
    const std::string name(k < all_bound_kinds.size() ? name_of(all_bound_kinds[k]) : "default");
    std::printf("%-8s %9.2f %9.3f %9.0f\n", name.c_str(), meters[k].culled_parts(), meters[k].ms(),
                meters[k].queries());
  }
}

void table_5(const Model& model) {
  std::printf("\n%s, sums over the parts\n%-8s %12s %12s\n", model.name.c_str(), "bound", "volume", "surface");
  for (const BoundKind kind : {BoundKind::hull, BoundKind::dop26, BoundKind::dop18, BoundKind::dop14, BoundKind::box,
                               BoundKind::obb, BoundKind::sphere}) {
    double volume = 0.0, surface = 0.0;
    for (const Part& part : model.parts) {
      const BoundingVolume bound = bound_of(part.vertices, kind);
      volume += volume_of(bound);
      surface += surface_of(bound);
    }
    std::printf("%-8s %12.3f %12.3f\n", std::string(name_of(kind)).c_str(), volume, surface);
  }
}

std::vector<Vec3> points_in_ball(std::size_t count) {
  Random random(7);
  std::vector<Vec3> points;
  while (points.size() < count) {
    const Vec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (glm::dot(p, p) <= 1.0) points.push_back(p);
  }
  return points;
}

void figure_5(int repeats) {
  std::printf("\nbuild time in microseconds against vertices; last row: re-fitting by the old boundary\n%9s",
              "vertices");
  for (const BoundKind kind : all_bound_kinds) std::printf(" %10s", std::string(name_of(kind)).c_str());
  for (std::size_t count = 10; count <= 1'000'000; count *= 10) {
    const std::vector<Vec3> points = points_in_ball(count);
    std::printf("\n%9zu", count);
    for (const BoundKind kind : all_bound_kinds) {
      // As many builds a repeat as take about a millisecond, so that the clock does not matter.
      const int builds = static_cast<int>(std::max<std::size_t>(1, 1000 / count));
      double sink = 0.0;
      const double seconds = least_seconds(repeats, [&] {
        for (int i = 0; i < builds; ++i) sink += bound_of(points, kind).size;
      });
      std::printf(" %10.2f", 1e6 * seconds / builds + (sink < 0.0 ? 1.0 : 0.0));
    }
    std::fflush(stdout);
  }
  const std::vector<Vec3> points = points_in_ball(1000);
  std::printf("\n%9s", "re-fit");
  for (const BoundKind kind : all_bound_kinds) {
    const BoundingVolume bound = bound_of(points, kind);
    const Pose pose{{1, 2, 3}, normalised({0.9, 0.1, 0.2, 0.3})};
    double sink = 0.0;
    const double seconds = least_seconds(repeats, [&] {
      for (int i = 0; i < 100; ++i) sink += refit(bound, pose).size;
    });
    std::printf(" %10.2f", 1e6 * seconds / 100 + (sink < 0.0 ? 1.0 : 0.0));
  }
  std::printf("\n");
}

}  // namespace

/// One argument: how many repeats (default 3).
int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 3;
  std::vector<Model> models{make_tool(), make_radio(), make_houses()};
  models.push_back(turned(models[1]));
  std::printf("%-16s %7s %10s %6s\n", "model", "frames", "triangles", "parts");
  for (const Model& m : models) {
    std::printf("%-16s %7zu %10zu %6zu\n", m.name.c_str(), m.views.size(), triangles_of(m), m.parts.size());
  }
  for (const Model& model : models) table_5(model);
  for (const Model& model : models) table_2(model, repeats);
  for (const Model& model : models) table_4(model, repeats);
  for (const Model& model : models) table_2b(model, repeats);
  figure_5(repeats);
  return 0;
}
