#include "gridcull/core/scalar_field.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <string>
#include <tuple>
#include <utility>

#include <glm/common.hpp>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

constexpr int block_shift = 3;

[[noreturn]] void refuse(const std::string& why) { throw Error(ErrorCode::bad_scene, "volume: " + why); }

/// One number for the cube of side 1 << shift that holds the point: 21 bits an axis, different for any two cubes
/// within greatest_index, since the side is at least 2^3.
std::uint64_t key_of(const LatticePoint& p, int shift) {
  constexpr std::uint64_t bits = (1u << 21) - 1;
  const auto part = [&](int x) { return static_cast<std::uint64_t>(x >> shift) & bits; };
  return part(p.x) << 42 | part(p.y) << 21 | part(p.z);
}

auto order(const LatticePoint& p) { return std::tuple(p.x, p.y, p.z); }

void check_origin(const LatticePoint& p, int side) {
  for (int k = 0; k < 3; ++k) {
    if (p[k] % side != 0 || p[k] < -ScalarField::greatest_index || p[k] > ScalarField::greatest_index - side) {
      refuse("expected blocks and tiles at multiples of their side, within 2^22 points of the lattice's origin");
    }
  }
}

void check_value(float value) {
  if (!std::isfinite(value)) refuse("expected finite values, found " + std::to_string(value));
}

void check_frame(const FieldFrame& frame) {
  if (!(frame.voxel > 0.0 && frame.voxel <= 1e9)) {
    refuse("expected a voxel size above 0 and at most 1e9, found " + std::to_string(frame.voxel));
  }
  for (int k = 0; k < 3; ++k) {
    if (!(std::fabs(frame.pose.position[k]) <= 1e9)) refuse("expected finite coordinates of magnitude at most 1e9");
  }
}

}  // namespace

ScalarField::ScalarField(const FieldFrame& frame, float background, std::vector<FieldBlock> blocks,
                         std::vector<FieldTile> tiles)
    : frame_(frame), background_(background), blocks_(std::move(blocks)), tiles_(std::move(tiles)) {
  check_frame(frame_);
  frame_.pose.orientation = normalised(frame_.pose.orientation);
  check_value(background_);
  index_blocks();
  index_tiles();
}

ScalarField ScalarField::scaled(double scale) && {
  FieldFrame frame = frame_;
  frame.voxel *= scale;
  frame.pose.position *= scale;
  check_frame(frame);
  frame_ = frame;
  return std::move(*this);
}

void ScalarField::take_in(const LatticePoint& origin, int side) {
  const LatticePoint end = origin + LatticePoint(side - 1);
  const bool any = first_.x <= last_.x;
  first_ = any ? glm::min(first_, origin) : origin;
  last_ = any ? glm::max(last_, end) : end;
}

void ScalarField::index_blocks() {
  std::sort(blocks_.begin(), blocks_.end(),
            [](const FieldBlock& a, const FieldBlock& b) { return order(a.origin) < order(b.origin); });
  block_slots_.reserve(blocks_.size());
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    check_origin(blocks_[i].origin, FieldBlock::side);
    for (const float value : blocks_[i].values) check_value(value);
    const bool fresh =
        block_slots_.emplace(key_of(blocks_[i].origin, block_shift), static_cast<std::uint32_t>(i)).second;
    if (!fresh) refuse("expected each block once");
    take_in(blocks_[i].origin, FieldBlock::side);
  }
}

void ScalarField::index_tiles() {
  std::sort(tiles_.begin(), tiles_.end(), [](const FieldTile& a, const FieldTile& b) {
    return std::pair(a.side, order(a.origin)) < std::pair(b.side, order(b.origin));
  });
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    const FieldTile& tile = tiles_[i];
    if (tile.side < FieldBlock::side || tile.side > greatest_index ||
        !std::has_single_bit(static_cast<unsigned>(tile.side))) {
      refuse("expected tiles of 8 points along an edge, or that times a power of two");
    }
    check_origin(tile.origin, tile.side);
    check_value(tile.value);
    const int shift = std::countr_zero(static_cast<unsigned>(tile.side));
    if (levels_.empty() || levels_.back().shift != shift) levels_.push_back({shift, {}});
    if (!levels_.back().slots.emplace(key_of(tile.origin, shift), static_cast<std::uint32_t>(i)).second) {
      refuse("expected each tile once");
    }
    take_in(tile.origin, tile.side);
  }
  for (const Level& level : levels_) {
    const auto taken = [&](const LatticePoint& p) { return level.slots.contains(key_of(p, level.shift)); };
    const bool overlap =
        std::any_of(blocks_.begin(), blocks_.end(), [&](const FieldBlock& b) { return taken(b.origin); }) ||
        std::any_of(tiles_.begin(), tiles_.end(),
                    [&](const FieldTile& t) { return t.side < 1 << level.shift && taken(t.origin); });
    if (overlap) refuse("expected no block or tile within a tile");
  }
}

float ScalarField::at(const LatticePoint& p) const {
  for (int k = 0; k < 3; ++k) {
    if (p[k] < first_[k] || p[k] > last_[k]) return background_;
  }
  if (const auto found = block_slots_.find(key_of(p, block_shift)); found != block_slots_.end()) {
    return blocks_[found->second].values[FieldBlock::at(p)];
  }
  for (const Level& level : levels_) {
    const auto found = level.slots.find(key_of(p, level.shift));
    if (found != level.slots.end()) return tiles_[found->second].value;
  }
  return background_;
}

std::uint64_t ScalarField::memory_of(std::uint64_t blocks, std::uint64_t tiles) {
  constexpr std::uint64_t slot = 48;  // a node of the hash table and its share of the buckets
  return blocks * (sizeof(FieldBlock) + slot) + tiles * (sizeof(FieldTile) + slot);
}

}  // namespace gridcull
