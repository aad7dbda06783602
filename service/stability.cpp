#include "gridcull/service/stability.h"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/service/bench_contender.h"
#include "gridcull/service/build_facts.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/stability_report.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

std::vector<const MethodEntry*> chosen(const std::vector<std::string>& names) {
  std::vector<const MethodEntry*> out;
  for (const std::string& name : names) out.push_back(&find_method(name));
  if (out.empty()) {
    for (const MethodEntry& entry : method_catalog()) out.push_back(&entry);
  }
  return out;
}

std::string head(const StabilitySettings& settings) {
  const BuildFacts facts = build_facts();
  return "commit " + facts.commit + ", " + facts.compiler + ", " + facts.flags + ", " + processor_name() + ", " +
         date_text() + "; one thread, least of " + std::to_string(settings.repeats) +
         " repeats of each frame, median over frames; 3D: reference of " + std::to_string(settings.rays) +
         " rays along a cube face's edge, so over-estimations are upper bounds\n";
}

std::uint64_t worlds_of(int dimension, const std::vector<const MethodEntry*>& methods) {
  std::uint64_t values = 0, taking = 0;
  for (const Limit& limit : stability_limits()) values += limit.values.size();
  for (const MethodEntry* m : methods) taking += dimension == 2 ? m->info.takes_2d : m->info.takes_3d;
  return values * taking;
}

/// Both files, opened before the work: a folder that cannot be written is refused at once.
struct Files {
  TextWriter table, csv;

  explicit Files(const std::filesystem::path& folder)
      : table(made(folder) / "stability.md"), csv(folder / "stability.csv") {}

 private:
  static std::filesystem::path made(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw Error(ErrorCode::io, folder.string() + ": cannot be made: " + error.message());
    return folder;
  }
};

}  // namespace

int run_stability_bench(const std::vector<std::string>& names, const StabilitySettings& settings,
                        const std::string& out) {
  const std::vector<const MethodEntry*> methods = chosen(names);
  std::optional<Files> files;
  if (!out.empty()) files.emplace(out);
  const std::string facts = head(settings);
  std::fputs(facts.c_str(), stdout);
  std::string tables = facts;
  std::vector<StabilityResult> results;
  for (const int dimension : {2, 3}) {
    if (dimension == 3 && !ExactRays::available()) continue;
    std::vector<StabilityResult> more;
    {
      Progress progress("worlds, " + std::to_string(dimension) + "D", worlds_of(dimension, methods));
      std::uint64_t done = 0;
      more = run_stability(methods, dimension, settings, [&] { progress.update(++done); });
    }
    for (StabilityResult& result : more) {
      const std::string table = "\n" + stability_table(result);
      std::fputs(table.c_str(), stdout);
      tables += table;
      results.push_back(std::move(result));
    }
    std::fflush(stdout);
  }
  if (!files) return 0;
  files->table.write(tables);
  files->csv.write("# " + facts + stability_csv(results));
  files->table.commit();
  files->csv.commit();
  return 0;
}

}  // namespace gridcull
