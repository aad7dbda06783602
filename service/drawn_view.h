// What the engine met while it answered one viewer, kept for those who watch.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gridcull/core/drawing.h"

namespace gridcull {

class DrawnView final : public DrawSink {
 public:
  /// More boxes than a page can draw are left out.
  static constexpr std::size_t most_boxes = 100'000;

  /// Begins anew, for this viewer.
  void begin(ViewerId viewer);
  void cells(CellLayer layer, const Vec3& low, const Vec3& high) override;
  void tbv(ObjectId object, const Vec3& centre, double radius, bool revealed) override;
  void region(std::span<const Vec2> outline) override { region_.assign(outline.begin(), outline.end()); }

  /// `{"viewer", "cells": {"visited": [[low..., high...], ...], ...}, "volumes": [{"id", "centre", "radius",
  /// "revealed"}], "region": [[x, y], ...]}`; empty parts are left out.
  nlohmann::ordered_json json(int dimension) const;

 private:
  struct Box {
    Vec3 low, high;
  };
  struct Volume {
    ObjectId object;
    Vec3 centre;
    double radius;
    bool revealed;
  };
  static constexpr std::size_t layers = 6;

  ViewerId viewer_ = no_id;
  std::array<std::vector<Box>, layers> boxes_{};
  std::size_t count_ = 0;
  std::vector<Volume> volumes_{};
  std::vector<Vec2> region_{};
};

}  // namespace gridcull
