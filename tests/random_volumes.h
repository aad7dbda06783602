// Volumes of many kinds, by seed.
#pragma once

#include <random>

#include "gridcull/core/scalar_field.h"
#include "gridcull/core/shape.h"

namespace gridcull::test {

/// A field of `value(point)` at the points from `first` to `last`, in whole blocks, `background` elsewhere.
template <class F>
ScalarField field_of(const FieldFrame& frame, float background, const LatticePoint& first, const LatticePoint& last,
                     F&& value) {
  std::vector<FieldBlock> blocks;
  LatticePoint o;
  for (o.x = first.x & ~7; o.x <= last.x; o.x += 8) {
    for (o.y = first.y & ~7; o.y <= last.y; o.y += 8) {
      for (o.z = first.z & ~7; o.z <= last.z; o.z += 8) {
        FieldBlock& block = blocks.emplace_back();
        block.origin = o;
        block.values.fill(background);
        for (int i = 0; i < 512; ++i) {
          const LatticePoint p = o + LatticePoint(i >> 6, i >> 3 & 7, i & 7);
          const bool within =
              p.x >= first.x && p.y >= first.y && p.z >= first.z && p.x <= last.x && p.y <= last.y && p.z <= last.z;
          if (within) block.values[static_cast<std::size_t>(i)] = value(p);
        }
      }
    }
  }
  return ScalarField(frame, background, std::move(blocks));
}

/// A lumpy ball, a ring, a thick wall, noise, steps that hit the value itself, a tile, or single points; as a level set
/// or a fog volume, its lattice moved and turned or not; about within `reach` of the origin.
Volume random_volume(std::mt19937_64& random, double reach);

}  // namespace gridcull::test
