#include "gridcull/service/stability_report.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gridcull/service/bench_report.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

/// Results that ran.
std::vector<const LimitResult*> ran(const LimitRow& row) {
  std::vector<const LimitResult*> out;
  for (const LimitResult& result : row.results) {
    if (result.refused.empty()) out.push_back(&result);
  }
  return out;
}

std::string at(const LimitResult& result) { return number_text(result.value, 4); }

double missed_share(const LimitResult& result) {
  return result.exact == 0 ? 0.0 : static_cast<double>(result.misses) / static_cast<double>(result.exact);
}

/// "12 of 340 at 0.01; 3 of 300 at 0", "3 .. 58 % (at 100)" where it misses at many values, or "none".
std::string misses_text(const LimitRow& row) {
  std::vector<const LimitResult*> missing;
  for (const LimitResult* result : ran(row)) {
    if (result->misses > 0) missing.push_back(result);
  }
  if (missing.size() > 3) {
    const auto [least, most] = std::minmax_element(missing.begin(), missing.end(), [](const auto* a, const auto* b) {
      return missed_share(*a) < missed_share(*b);
    });
    const std::string low = number_text(100.0 * missed_share(**least), 2),
                      high = number_text(100.0 * missed_share(**most), 2);
    if (low == high) return low + " % of the visible";
    return low + " .. " + high + " % of the visible (worst at " + at(**most) + ")";
  }
  std::string text;
  for (const LimitResult* result : missing) {
    text += (text.empty() ? "" : "; ") + std::to_string(result->misses) + " of " + std::to_string(result->exact) +
            " at " + at(*result);
  }
  return text.empty() ? "none" : text;
}

/// "1.02 .. 1.4 (at 0.5)": the least, the most, and where that is.
template <class Of>
std::string span_text(const LimitRow& row, int digits, const Of& of) {
  const LimitResult* least = nullptr;
  const LimitResult* most = nullptr;
  for (const LimitResult* result : ran(row)) {
    if (std::isnan(of(*result))) continue;
    if (least == nullptr || of(*result) < of(*least)) least = result;
    if (most == nullptr || of(*result) > of(*most)) most = result;
  }
  if (least == nullptr) return "";
  const std::string low = number_text(of(*least), digits), high = number_text(of(*most), digits);
  return low == high ? low : low + " .. " + high + " (at " + at(*most) + ")";
}

std::string refused_text(const LimitRow& row) {
  std::string text;
  for (const LimitResult& result : row.results) {
    if (!result.refused.empty()) text += (text.empty() ? "" : "; ") + at(result) + ": " + result.refused;
  }
  return text;
}

std::string values_text(const Limit& limit) {
  return number_text(limit.values.front(), 4) + " to " + number_text(limit.values.back(), 4) + " " + limit.quantity;
}

std::string flicker_text(const LimitRow& row) {
  std::string text;
  for (const LimitResult* result : ran(row)) {
    text += (text.empty() ? "" : "; ") + number_text(result->changes, 3) + " (" +
            number_text(result->exact_changes, 3) + ") at " + at(*result);
  }
  return text;
}

}  // namespace

std::string stability_table(const StabilityResult& result) {
  const MethodInfo& info = result.method->info;
  std::string out = "### " + std::string(info.name) + ", " + std::to_string(result.dimension) + "D (" +
                    (info.guarantee == Guarantee::conservative ? "conservative" : "sampled") + ")\n\n";
  out +=
      "| what goes to its limit | from, to | misses | over-estimation | microseconds a frame |\n"
      "|---|---|---|---|---|\n";
  std::string notes;
  for (const LimitRow& row : result.rows) {
    out += "| " + row.limit->name + " | " + values_text(*row.limit) + " | " + misses_text(row) + " | " +
           span_text(row, 3, [](const LimitResult& r) { return r.over_estimation(); }) + " | " +
           span_text(row, 3, [](const LimitResult& r) { return r.frame_us; }) + " |\n";
    if (row.limit->flicker) {
      notes += "Objects that come or go a frame (really): " + flicker_text(row) + ".\n";
    }
    const std::string refused = refused_text(row);
    if (!refused.empty()) notes += "Refused, " + row.limit->name + ": " + refused + ".\n";
  }
  return out + "\n" + notes;
}

std::string stability_csv(std::span<const StabilityResult> results) {
  std::string out =
      "method,dimension,limit,quantity,value,queries,exact,reported,misses,over_estimation,frame_us,changes,"
      "exact_changes,refused\n";
  for (const StabilityResult& result : results) {
    for (const LimitRow& row : result.rows) {
      for (const LimitResult& r : row.results) {
        const double over = r.over_estimation();
        out += std::string(result.method->info.name) + "," + std::to_string(result.dimension) + "," +
               csv_field(row.limit->name) + "," + csv_field(row.limit->quantity) + "," + number_text(r.value, 12) +
               "," + std::to_string(r.queries) + "," + std::to_string(r.exact) + "," + std::to_string(r.reported) +
               "," + std::to_string(r.misses) + "," + (std::isnan(over) ? "" : number_text(over, 6)) + "," +
               number_text(r.frame_us, 6) + "," + number_text(r.changes, 6) + "," + number_text(r.exact_changes, 6) +
               "," + csv_field(r.refused) + "\n";
      }
    }
  }
  return out;
}

}  // namespace gridcull
