#include "gridcull/service/advice_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "gridcull/core/exact.h"
#include "gridcull/service/table.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

constexpr std::size_t listed = 5;  // ids of a longer list

std::string setting_text(const Contender& contender) {
  if (contender.setting_name == "cell") return "cell " + contender.setting;
  return contender.options.resolution == 0 ? "default" : contender.setting + " pixels";
}

std::string label(const Contender& contender) {
  return std::string(contender.method->info.name) + ", " + setting_text(contender);
}

/// What to type for it.
std::string command(const Contender& contender, bool baked) {
  std::string text = "--method " + std::string(contender.method->info.name);
  if (contender.options.resolution > 0) text += " --resolution " + contender.setting;
  if (contender.setting_name == "cell" && !contender.is_default)
    text += " --cell " + number_text(contender.options.cell) +
            (baked ? ", once gridcull bake static has made the static volume for that cell" : "");
  return text;
}

std::string sample_text(const AdvicePlan& plan) {
  const std::string frames = std::to_string(plan.frames), every = std::to_string(plan.settings.every);
  if (plan.file_frames == 0) return "the scene as it stands, asked " + frames + " times";
  if (plan.frames == plan.file_frames) return "all " + counted(plan.frames, "frame");
  const std::uint64_t last = (plan.frames - 1) * plan.settings.every;
  std::string text = counted(plan.frames, "frame") + " of " + std::to_string(plan.file_frames) + ": 0";
  if (plan.frames > 2) text += ", " + every + " ..";
  if (plan.frames > 1) text += (plan.frames > 2 ? " " : ", ") + std::to_string(last);
  return text + (plan.settings.every > 1 ? " (what happens between is told with the next)" : "");
}

std::string judged_text(const AdvicePlan& plan) {
  const bool flat = plan.scene.scene.dimension == 2;
  if (!flat && !ExactRays::available()) {
    return "nothing: built without Embree, so settings are compared by their PVS alone";
  }
  const std::string frames = counted(std::min(plan.frames, plan.settings.judged), "frame");
  return frames + " of them, at most 10 viewers in each, against " +
         (flat ? "the exact sets"
               : std::to_string(plan.settings.rays) + " rays along an edge: over-estimation is at most what is told");
}

std::uint64_t judged_queries(const Advice& advice) {
  std::uint64_t most = 0;
  for (const BenchRow& row : advice.measured.rows) most = std::max(most, row.verdict.queries);
  return most;
}

/// Not of a row that was stopped before all was judged: its frames are others.
std::string over_text(const Advice& advice, const BenchRow& row) {
  if (std::isnan(row.over_estimation()) || row.verdict.queries < judged_queries(advice)) return "-";
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.3f", row.over_estimation());
  return buffer;
}

std::string pvs_text(const BenchRow& row) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.2f", row.pvs_mean);
  return buffer;
}

/// Three digits, trailing zeros too.
std::string ms_text(double microseconds) {
  const double ms = microseconds / 1000.0;
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, ms < 99.5 ? "%#.3g" : "%.0f", ms);
  return buffer;
}

std::string standing_text(const std::vector<BenchRow>& rows, std::size_t place, const Standing& standing,
                          std::uint64_t frames) {
  const BenchRow& row = rows[place];
  std::string text = row.verdict.misses > 0 ? "misses somebody" : "on the frontier";
  if (const auto twin = twin_of(rows, place)) text = "the same as " + label(rows[*twin].contender);
  if (standing.beaten_by) text = "beaten by " + label(rows[*standing.beaten_by].contender);
  if (row.frames < frames) text += "; stopped after " + counted(row.frames, "frame");
  return text;
}

std::string line(const std::string& method, const std::string& setting, const std::string& rest) {
  char buffer[80];
  std::snprintf(buffer, sizeof buffer, "%-12s%-14s", method.c_str(), setting.c_str());
  return buffer + rest + "\n";
}

std::string figures(const Advice& advice, const BenchRow& row) {
  const TimeSamples::Summary times = row.total.steady();
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, "%9s %9s %9s %9s %7s %9s  ", ms_text(times.median).c_str(),
                ms_text(times.median_all).c_str(), pvs_text(row).c_str(), over_text(advice, row).c_str(),
                row.verdict.queries == 0 ? "-" : std::to_string(row.verdict.misses).c_str(),
                bytes_text(static_cast<double>(row.held_bytes)).c_str());
  return buffer;
}

std::string table(const AdvicePlan& plan, const Advice& advice) {
  char head[160];
  std::snprintf(head, sizeof head, "%9s %9s %9s %9s %7s %9s", "ms, least", "median", "PVS", "over-est", "misses",
                "memory");
  std::string text = line("method", "setting", head);
  const std::vector<Standing> standings = find_frontier(advice.settings);
  for (std::size_t i = 0; i < standings.size(); ++i) {
    const BenchRow& row = advice.measured.rows[i];
    const std::string rest =
        row.refused.empty() ? figures(advice, row) + standing_text(advice.measured.rows, i, standings[i], plan.frames)
                            : "  refused: " + row.refused;
    text += line(std::string(row.contender.method->info.name), setting_text(row.contender), rest);
  }
  for (const RefusedSetting& setting : plan.refused) {
    text += line(std::string(setting.contender.method->info.name), setting_text(setting.contender),
                 "  refused: " + setting.why);
  }
  return text;
}

std::string legend(const AdvicePlan& plan) {
  return std::string("ms: moves and query of a frame over all viewers; ") +
         (plan.frames > 1 ? "median over the frames but the first, which builds everything,\n"
                          : "the one frame there is builds everything,\n") +
         "of each frame's least and of all times. memory: held after the first frame. beaten by: another that is\n"
         "tighter and not slower, or as tight and faster; " +
         number_text(100.0 * same_time) + " % of time is noise.\n";
}

std::string caught_text(const AdvicePlan& plan, const PreparedWorld& world, const CellLess& found) {
  std::string text = row("occluders", std::to_string(found.occluders) +
                                          " with an interior; voxel hides nothing behind those that fill no cell:");
  for (std::size_t k = 0; k < plan.lattices.size(); ++k) {
    const auto& without = found.without[k];
    text +=
        row("  cell " + number_text(plan.lattices[k].cell()) + " m",
            without.empty() ? "none" : std::to_string(without.size()) + ": " + ids_text(without, world.scene, listed));
  }
  if (found.thin.empty()) return text;
  return text + row("  thin", std::to_string(found.thin.size()) +
                                  ", which fill none whatever the cell: " + ids_text(found.thin, world.scene, listed));
}

/// "silhouette, default (0.12 ms, over-estimation 1.01)"
std::string with_figures(const Advice& advice, std::size_t place) {
  const BenchRow& row = advice.measured.rows[place];
  const std::string over = over_text(advice, row);
  return label(row.contender) + " (" + ms_text(advice.settings[place].time) + " ms, " +
         (over == "-" ? "PVS " + pvs_text(row) : "over-estimation " + over) + ")";
}

std::string conclusion(const AdvicePlan& plan, const Advice& advice) {
  const std::optional<Picks> picks = pick(advice.settings);
  if (!picks) return "No setting ran without missing anybody: there is nothing to advise.\n";
  const std::string fastest = with_figures(advice, picks->fastest);
  const std::string take = command(advice.measured.rows[picks->standard].contender, plan.baked) + "\n";
  if (picks->fastest == picks->tightest) return "Fastest and tightest: " + fastest + ". Take it: " + take;
  return "Fastest: " + fastest + "; tightest: " + with_figures(advice, picks->tightest) + ".\nBy default take " +
         with_figures(advice, picks->standard) + ", the fastest within " + number_text(100.0 * looser) +
         " % of the tightest: " + take;
}

}  // namespace

std::string advice_text(const AdvicePlan& plan, const PreparedWorld& world, const Advice& advice) {
  std::string text =
      "\n" + row("measured", sample_text(plan) + "; settings in turn, " +
                                 counted(static_cast<unsigned>(plan.settings.repeats), "time") + " over");
  text += row("asked by", counted(plan.viewers, "viewer") + ", " +
                              counted(static_cast<unsigned>(plan.contenders[0].options.threads), "thread"));
  text += row("judged", judged_text(plan));
  text += "\n" + table(plan, advice) + legend(plan) + "\n" + caught_text(plan, world, advice.cell_less) + "\n";
  return text + conclusion(plan, advice);
}

}  // namespace gridcull
