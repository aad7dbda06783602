#include "gridcull/methods/five_d_options.h"

#include <array>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

constexpr std::array settings{
    BakeSetting{"s-thresh", "least visible share of a surface that counts", 0.01, 1e-4, 0.5},
    BakeSetting{"confidence-a", "a ratio above this means visible", 50.0, 1.0, 1e6},
    BakeSetting{"confidence-b", "a ratio below this means invisible", 0.2, 1e-6, 1.0},
    BakeSetting{"significant", "1: what rays hit is still invisible below s-thresh", 0.0, 0.0, 1.0, true},
    BakeSetting{"effectiveness", "less effective partitions are not made", 0.05, 0.0, 1.0},
    BakeSetting{"estimate-rays", "rays an object that an estimate is made from", 12.0, 2.0, 256.0, true},
    BakeSetting{"cells", "cells in position, at most", 2048.0, 1.0, 1048576.0, true},
    BakeSetting{"intervals", "angular intervals of the last split, 1 or 8", 8.0, 1.0, 8.0, true},
    BakeSetting{"direction-planes", "candidate planes in each angle", 0.0, 0.0, 64.0, true},
    BakeSetting{"bits", "bits of a split position", 12.0, 4.0, 20.0, true},
    BakeSetting{"boxes", "motion boxes for moving objects, at most", 512.0, 0.0, 1048576.0, true},
    BakeSetting{"low", "3D: least height of viewpoints, metres; without both: where something moves", -1e9, -1e9, 1e9},
    BakeSetting{"high", "3D: greatest height of viewpoints, metres", 1e9, -1e9, 1e9}};

}  // namespace

std::span<const BakeSetting> five_d_settings() { return settings; }

FiveDOptions five_d_options(const BakeSettings& values) {
  const auto get = [&values](std::string_view name) {
    for (const BakeSetting& setting : settings) {
      if (setting.name == name) return bake_setting(values, setting);
    }
    throw Error(ErrorCode::internal, "no setting " + std::string(name));
  };
  const auto whole = [&get](std::string_view name) { return static_cast<int>(get(name)); };
  FiveDOptions o;
  o.s_thresh = get("s-thresh");
  o.a = get("confidence-a");
  o.b = get("confidence-b");
  o.significant = whole("significant") == 1;
  o.effectiveness = get("effectiveness");
  o.estimate_rays = whole("estimate-rays");
  o.cells = whole("cells");
  o.intervals = whole("intervals");
  o.direction_planes = whole("direction-planes");
  o.bits = whole("bits");
  o.boxes = whole("boxes");
  o.low = get("low");
  o.high = get("high");
  if (o.intervals != 1 && o.intervals != 8) {
    throw Error(ErrorCode::usage, "--intervals: expected 1 or 8, found " + std::to_string(o.intervals));
  }
  if (!(o.low < o.high)) throw Error(ErrorCode::usage, "--high: expected more than --low");
  return o;
}

}  // namespace gridcull
