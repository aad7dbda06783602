#include "gridcull/service/run_report.h"

#include "gridcull/service/table.h"
#include "gridcull/service/text.h"
#include "gridcull/sim/stats.h"

namespace gridcull {
namespace {

std::string milliseconds(double microseconds) { return number_text(microseconds / 1000.0, 3) + " ms"; }

}  // namespace

std::string guarantee_text(Guarantee guarantee) {
  return guarantee == Guarantee::conservative ? "conservative" : "sampled";
}

std::string run_table(const WorldOptions& options, const PreparedWorld& world, const MethodInfo& method,
                      const Stats& stats, double seconds) {
  std::string table;
  table += row("scene", options.scene + ", " + std::to_string(world.scene.dimension) + "D");
  table += row("method", std::string(method.name) + " (" + guarantee_text(method.guarantee) + "), TBVs " + options.tbv +
                             (options.pull ? ", pull, " : ", push, ") +
                             counted(static_cast<unsigned long long>(options.threads), "thread"));
  table += row("grid", lattice_text(world.lattice));
  table += row("frames", std::to_string(stats.frames) + " in " + number_text(seconds, 3) +
                             " s: " + number_text(seconds > 0 ? static_cast<double>(stats.frames) / seconds : 0, 4) +
                             " a second");
  table += row("queries", std::to_string(stats.queries));
  table +=
      row("mean PVS", number_text(stats.pvs_mean, 4) + " objects" +
                          (stats.in_view_mean > 0.0 ? ", of " + number_text(stats.in_view_mean, 4) + " in view" : ""));
  table += row("time a frame", milliseconds(stats.total_us.median) + " median, " + milliseconds(stats.total_us.p99) +
                                   " p99, " + milliseconds(stats.total_us.max) + " max");
  table += row("positions", number_text(stats.positions_read_mean, 4) + " read a frame");
  table +=
      row("TBVs", number_text(stats.tbv_active_mean, 4) + " alive a frame; " + std::to_string(stats.tbv_revealed) +
                      " revealed, " + std::to_string(stats.tbv_expired) + " expired, " + counted(stats.jumps, "jump"));
  table += row("pvs_hash", hash_text(stats.pvs_hash));
  return table;
}

}  // namespace gridcull
