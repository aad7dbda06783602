// A volume told point by point in long doubles, by the definition; shares nothing with core but the field's values.
#pragma once

#include <array>
#include <cmath>

#include "gridcull/core/scalar_field.h"
#include "gridcull/core/shape.h"
#include "gridcull/core/volume_body.h"

namespace gridcull::test {

class VolumeTruth {
 public:
  VolumeTruth(const Volume& volume, const Pose& pose) : volume_(volume) {
    const FieldFrame& frame = volume.field->frame();
    const Rotation outer = rotation_of(pose.orientation), inner = rotation_of(frame.pose.orientation);
    const auto add = [&](const Vec3& lattice) {
      const Vec3 local = inner * lattice;
      std::array<Real, 3> out{};
      for (int k = 0; k < 3; ++k) {
        out[static_cast<std::size_t>(k)] =
            Real(frame.voxel) * (Real(outer.x[k]) * local.x + Real(outer.y[k]) * local.y + Real(outer.z[k]) * local.z);
      }
      return out;
    };
    columns_ = {add({1, 0, 0}), add({0, 1, 0}), add({0, 0, 1})};
    for (int k = 0; k < 3; ++k) {
      const Vec3& at = frame.pose.position;
      origin_[static_cast<std::size_t>(k)] =
          Real(pose.position[k]) + Real(outer.x[k]) * at.x + Real(outer.y[k]) * at.y + Real(outer.z[k]) * at.z;
    }
  }

  Vec3 world(const Vec3& lattice) const {
    Vec3 out(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      out[static_cast<int>(k)] = static_cast<double>(origin_[k] + columns_[0][k] * lattice.x +
                                                     columns_[1][k] * lattice.y + columns_[2][k] * lattice.z);
    }
    return out;
  }

  /// Below 0 inside.
  double depth(const Vec3& world) const {
    const std::array<Real, 3> q = lattice(world);
    LatticePoint base;
    for (int k = 0; k < 3; ++k) base[k] = static_cast<int>(std::floor(q[static_cast<std::size_t>(k)]));
    Real sum = 0;
    for (int i = 0; i < 8; ++i) {
      Real share = 1;
      for (int k = 0; k < 3; ++k) {
        const Real part = q[static_cast<std::size_t>(k)] - base[k];
        share *= (i >> k & 1) != 0 ? part : 1 - part;
      }
      sum += share * at(base + LatticePoint(i & 1, i >> 1 & 1, i >> 2 & 1));
    }
    return static_cast<double>(sum);
  }

  /// Calls f(depth) for the points of a box.
  template <class F>
  void for_points(const LatticeBox& box, F&& f) const {
    LatticePoint p;
    for (p.x = box.first.x; p.x <= box.last.x; ++p.x) {
      for (p.y = box.first.y; p.y <= box.last.y; ++p.y) {
        for (p.z = box.first.z; p.z <= box.last.z; ++p.z) f(static_cast<double>(at(p)));
      }
    }
  }

 private:
  using Real = long double;

  Real at(const LatticePoint& p) const {
    const Real d = Real(volume_.field->at(p)) - Real(volume_.iso);
    return volume_.inside_below ? d : -d;
  }
  /// Cramer's rule.
  std::array<Real, 3> lattice(const Vec3& world) const {
    std::array<Real, 3> d{};
    for (std::size_t k = 0; k < 3; ++k) d[k] = Real(world[static_cast<int>(k)]) - origin_[k];
    const auto det = [](const auto& a, const auto& b, const auto& c) {
      return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    };
    const Real whole = det(columns_[0], columns_[1], columns_[2]);
    return {det(d, columns_[1], columns_[2]) / whole, det(columns_[0], d, columns_[2]) / whole,
            det(columns_[0], columns_[1], d) / whole};
  }

  const Volume& volume_;
  std::array<Real, 3> origin_{};
  std::array<std::array<Real, 3>, 3> columns_{};
};

}  // namespace gridcull::test
