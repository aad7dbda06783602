// What a benchmark says: CSV for machines, a table for people.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gridcull/service/bench_run.h"

namespace gridcull {

/// Lines that begin with "# ": commit, compiler, flags, processor, date, settings.
std::string bench_head(const BenchSettings& settings);

/// One line of names, one line a row; fields with commas or quotes are quoted (RFC 4180). What does not apply is empty.
std::string bench_csv(std::span<const BenchSceneResult> results);

/// For people: one block a scene.
std::string bench_table(const BenchSceneResult& result);

/// The field as it stands in CSV.
std::string csv_field(const std::string& text);

}  // namespace gridcull
