#include "gridcull/service/tbv_bench.h"

#include <cstdio>
#include <utility>

#include "gridcull/service/bench_plot.h"
#include "gridcull/service/bench_report.h"
#include "gridcull/service/build_facts.h"
#include "gridcull/service/tbv_tape.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

void take_means(const TbvTape& tape, TbvResult& result) {
  for (std::size_t f = result.costs.first; f < tape.frames.size(); ++f) {
    const TbvTape::Frame& frame = tape.frames[f];
    ++result.frames;
    result.hidden += static_cast<double>(frame.hidden);
    result.looks += static_cast<double>(frame.looks.size());
    result.born += static_cast<double>(frame.born.size());
    result.renewed += static_cast<double>(frame.renewed.size());
    result.removed += static_cast<double>(frame.removed.size());
    result.revealed += static_cast<double>(frame.revealed.size());
  }
  const double frames = result.frames == 0 ? 1.0 : static_cast<double>(result.frames);
  for (double* sum :
       {&result.hidden, &result.looks, &result.born, &result.renewed, &result.removed, &result.revealed}) {
    *sum /= frames;
  }
}

double a_frame(const TbvResult& result, std::uint64_t sum) {
  return result.frames == 0 ? 0.0 : static_cast<double>(sum) / static_cast<double>(result.frames);
}

std::string times(const TimeSamples& samples, std::size_t first) {
  const TimeSamples::Summary s = samples.summary(first);
  return number_text(s.min) + "," + number_text(s.median) + "," + number_text(s.max) + "," + number_text(s.median_all);
}

constexpr const char* columns =
    "scene,index,objects,frames,hidden,looks,born,renewed,removed,revealed,upkeep_us_min,upkeep_us_median,"
    "upkeep_us_max,upkeep_us_median_all,look_up_us_min,look_up_us_median,look_up_us_max,look_up_us_median_all,"
    "places_written,places_visited,volumes_looked_at,bytes,tree_cost,fresh_tree_cost\n";

std::string csv_line(const TbvResult& r, std::size_t index) {
  const TbvCost& cost = r.costs.of[index];
  const bool tree = index + 1 == tbv_indexes.size();
  std::string line = csv_field(r.scene) + "," + std::string(tbv_indexes[index]) + "," + std::to_string(r.objects) +
                     "," + std::to_string(r.frames);
  for (const double mean : {r.hidden, r.looks, r.born, r.renewed, r.removed, r.revealed}) {
    line += "," + number_text(mean);
  }
  line += "," + times(cost.upkeep, r.costs.first) + "," + times(cost.look_up, r.costs.first);
  for (const std::uint64_t sum : {cost.written, cost.visited, cost.looked_at}) {
    line += "," + number_text(a_frame(r, sum), 8);
  }
  line += "," + std::to_string(cost.bytes) + "," + (tree ? number_text(r.costs.tree_cost) : "") + "," +
          (tree ? number_text(r.costs.fresh_tree_cost) : "");
  return line + "\n";
}

}  // namespace

TbvResult run_tbv_scene(const std::string& name, const TbvSettings& settings, const std::function<void()>& tick) {
  const BenchScene scene = open_bench_scene(name);
  TbvResult result;
  result.scene = name;
  result.family = scene.family_of_objects();
  result.objects = scene.scene.objects.size();
  const TbvTape tape = record_tbv_tape(scene, settings.frames, tick);
  result.costs = replay_tbv_tape(tape, settings.first, settings.repeats, tick);
  take_means(tape, result);
  return result;
}

std::uint64_t tbv_ticks(const TbvSettings& settings) {
  const auto plays = 1 + tbv_indexes.size() * static_cast<std::uint64_t>(settings.repeats);
  return settings.scenes.size() * settings.frames * plays;
}

std::string tbv_head(const TbvSettings& settings) {
  const BuildFacts facts = build_facts();
  return "# gridcull bench --figure " + std::string(tbv_figure) + ", " + date_text() + "\n# commit: " + facts.commit +
         "\n# compiler: " + facts.compiler + "\n# flags: " + facts.flags + "\n# processor: " + processor_name() +
         "\n# frames: " + std::to_string(settings.frames) + ", counted from " + std::to_string(settings.first) +
         " on; repeats: " + std::to_string(settings.repeats) +
         "\n# times: microseconds a frame, one thread; least over repeats of each frame, then over frames\n";
}

std::string tbv_csv(std::span<const TbvResult> results) {
  std::string out = columns;
  for (const TbvResult& result : results) {
    for (std::size_t i = 0; i < tbv_indexes.size(); ++i) out += csv_line(result, i);
  }
  return out;
}

std::string tbv_table(const TbvResult& r) {
  std::string out = r.scene + ": " + number_text(r.hidden, 6) + " hidden; a frame " + number_text(r.born, 3) +
                    " born, " + number_text(r.renewed, 3) + " renewed, " + number_text(r.revealed, 3) + " revealed, " +
                    number_text(r.looks, 4) + " looks\n";
  char line[200];
  std::snprintf(line, sizeof line, "  %-12s %12s %12s %12s %12s %12s %10s\n", "", "upkeep, us", "look-up, us",
                "written", "visited", "looked at", "memory");
  out += line;
  for (std::size_t i = 0; i < tbv_indexes.size(); ++i) {
    const TbvCost& cost = r.costs.of[i];
    std::snprintf(
        line, sizeof line, "  %-12s %12s %12s %12.0f %12.0f %12.0f %10s\n", std::string(tbv_indexes[i]).c_str(),
        number_text(cost.upkeep.summary(r.costs.first).median, 4).c_str(),
        number_text(cost.look_up.summary(r.costs.first).median, 4).c_str(), a_frame(r, cost.written),
        a_frame(r, cost.visited), a_frame(r, cost.looked_at), bytes_text(static_cast<double>(cost.bytes)).c_str());
    out += line;
  }
  return out;
}

std::vector<Chart> tbv_charts(std::span<const TbvResult> results) {
  std::vector<std::pair<std::string, PlotCurves>> families;
  for (const TbvResult& result : results) {
    auto family = families.begin();
    while (family != families.end() && family->first != result.family) ++family;
    if (family == families.end()) family = families.insert(family, {result.family, {}});
    for (std::size_t i = 0; i < tbv_indexes.size(); ++i) {
      const TbvCost& cost = result.costs.of[i];
      const std::string name(tbv_indexes[i]);
      family->second[name + ", upkeep"].push_back({result.hidden, cost.upkeep.summary(result.costs.first).median, ""});
      family->second[name + ", look-up"].push_back(
          {result.hidden, cost.look_up.summary(result.costs.first).median, "", true});
    }
  }
  std::vector<Chart> charts;
  for (auto& [family, curves] : families) {
    sort_points(curves);
    const std::string name =
        charts.empty() ? tbv_figure : tbv_figure + ("-" + plot_file_name(family.substr(0, family.find(':'))));
    const PlotAxes axes{"Temporal bounding volumes in three indexes: " + family, "hidden volumes",
                        "microseconds a frame"};
    charts.push_back({name, plot_script(axes, curves)});
  }
  return charts;
}

}  // namespace gridcull
