#include "gridcull/core/volume.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include <glm/common.hpp>

#include "gridcull/core/error.h"
#include "gridcull/core/volume_parts.h"

namespace gridcull {
namespace {

constexpr int block_shift = 3;

[[noreturn]] void refuse(const std::string& why) { throw Error(ErrorCode::bad_scene, "volume: " + why); }

bool is_inside(double value, double iso, bool inside_below) { return inside_below ? value < iso : value > iso; }

/// The cube of side 1 << shift that holds a point of a field: 21 bits an axis (ScalarField::greatest_index).
std::uint64_t key_of(const LatticePoint& p, int shift) {
  constexpr std::uint64_t bits = (1u << 21) - 1;
  const auto part = [&](int x) { return static_cast<std::uint64_t>(x >> shift) & bits; };
  return part(p.x) << 42 | part(p.y) << 21 | part(p.z);
}

bool within(const LatticePoint& p, const LatticeBox& box) {
  return p.x >= box.first.x && p.y >= box.first.y && p.z >= box.first.z && p.x <= box.last.x && p.y <= box.last.y &&
         p.z <= box.last.z;
}

LatticeBox common(const LatticeBox& a, const LatticeBox& b) {
  return {glm::max(a.first, b.first), glm::min(a.last, b.last)};
}

/// The box's part of a row of a block: bits 8 y + z.
std::uint64_t yz_mask(const LatticeBox& part) {
  const int z0 = part.first.z & 7, z1 = part.last.z & 7;
  const std::uint64_t line = (0xFFull >> (7 - (z1 - z0))) << z0;
  std::uint64_t mask = 0;
  for (int y = part.first.y & 7; y <= (part.last.y & 7); ++y) mask |= line << 8 * y;
  return mask;
}

LatticeBox tile_at(const LatticePoint& origin, int shift) { return {origin, origin + LatticePoint((1 << shift) - 1)}; }
LatticeBox block_at(const LatticePoint& origin) { return tile_at(origin, block_shift); }

/// Calls f(origin) for the cubes of side 1 << shift that the box meets until it says false; whether it never did.
template <class F>
bool for_cubes(const LatticeBox& box, int shift, F&& f) {
  const int side = 1 << shift;
  const LatticePoint first = box.first & ~(side - 1);
  LatticePoint p;
  for (p.x = first.x; p.x <= box.last.x; p.x += side) {
    for (p.y = first.y; p.y <= box.last.y; p.y += side) {
      for (p.z = first.z; p.z <= box.last.z; p.z += side) {
        if (!f(p)) return false;
      }
    }
  }
  return true;
}

double cubes_in(const LatticeBox& box, int shift) {
  double count = 1.0;
  for (int k = 0; k < 3; ++k) count *= static_cast<double>((box.last[k] >> shift) - (box.first[k] >> shift) + 1);
  return count;
}

}  // namespace

InsidePoints::InsidePoints(const ScalarField& field, double iso, bool inside_below) {
  const auto add = [&](const LatticePoint& origin, const Bits& bits) {
    slots_.emplace(key_of(origin, block_shift), static_cast<std::uint32_t>(bits_.size()));
    origins_.push_back(origin);
    bits_.push_back(bits);
  };
  for (const FieldBlock& block : field.blocks()) {
    Bits bits{};
    for (std::size_t i = 0; i < block.values.size(); ++i) {
      if (!is_inside(block.values[i], iso, inside_below)) continue;
      bits[i >> 6] |= std::uint64_t{1} << (i & 63);
      const int x = static_cast<int>(i >> 6), y = static_cast<int>(i >> 3 & 7), z = static_cast<int>(i & 7);
      const LatticePoint p = block.origin + LatticePoint(x, y, z);
      take_in({p, p});
    }
    if (bits != Bits{}) add(block.origin, bits);
  }
  Bits full;
  full.fill(~std::uint64_t{0});
  for (const FieldTile& tile : field.tiles()) {
    if (!is_inside(tile.value, iso, inside_below)) continue;
    take_in({tile.origin, tile.origin + LatticePoint(tile.side - 1)});
    const int shift = std::countr_zero(static_cast<unsigned>(tile.side));
    if (shift == block_shift) {
      add(tile.origin, full);
      continue;
    }
    if (levels_.empty() || levels_.back().shift != shift) levels_.push_back({shift, {}});
    levels_.back().tiles.emplace(key_of(tile.origin, shift), tile.origin);
  }
}

void InsidePoints::take_in(const LatticeBox& box) {
  const bool first = bounds_.empty();
  bounds_ = {first ? box.first : glm::min(bounds_.first, box.first),
             first ? box.last : glm::max(bounds_.last, box.last)};
}

bool InsidePoints::holds(const LatticePoint& p) const { return within(p, bounds_) && all({p, p}); }

bool InsidePoints::any(const LatticeBox& box) const {
  const LatticeBox part = common(box, bounds_);
  if (part.empty()) return false;
  const auto meets = [&](std::uint32_t slot) {
    const LatticeBox here = common(part, block_at(origins_[slot]));
    if (here.empty()) return false;
    const std::uint64_t mask = yz_mask(here);
    for (int x = here.first.x & 7; x <= (here.last.x & 7); ++x) {
      if ((bits_[slot][static_cast<std::size_t>(x)] & mask) != 0) return true;
    }
    return false;
  };
  if (any_tile(part)) return true;
  if (cubes_in(part, block_shift) > static_cast<double>(bits_.size())) {
    for (std::uint32_t slot = 0; slot < bits_.size(); ++slot) {
      if (meets(slot)) return true;
    }
    return false;
  }
  return !for_cubes(part, block_shift, [&](const LatticePoint& origin) {
    const auto found = slots_.find(key_of(origin, block_shift));
    return found == slots_.end() || !meets(found->second);
  });
}

bool InsidePoints::any_tile(const LatticeBox& box) const {
  const auto any_of_level = [&](const Level& level) {
    if (cubes_in(box, level.shift) > static_cast<double>(level.tiles.size())) {
      return std::any_of(level.tiles.begin(), level.tiles.end(),
                         [&](const auto& tile) { return !common(box, tile_at(tile.second, level.shift)).empty(); });
    }
    return !for_cubes(box, level.shift,
                      [&](const LatticePoint& p) { return !level.tiles.contains(key_of(p, level.shift)); });
  };
  return std::any_of(levels_.begin(), levels_.end(), any_of_level);
}

bool InsidePoints::all(const LatticeBox& box) const {
  return within(box.first, bounds_) && within(box.last, bounds_) && all_below(box, levels_.size());
}

bool InsidePoints::all_below(const LatticeBox& box, std::size_t levels) const {
  if (levels == 0) return all_in_blocks(box);
  const Level& level = levels_[levels - 1];
  return for_cubes(box, level.shift, [&](const LatticePoint& p) {
    return level.tiles.contains(key_of(p, level.shift)) || all_below(common(box, tile_at(p, level.shift)), levels - 1);
  });
}

bool InsidePoints::all_in_blocks(const LatticeBox& box) const {
  return for_cubes(box, block_shift, [&](const LatticePoint& origin) {
    const auto found = slots_.find(key_of(origin, block_shift));
    if (found == slots_.end()) return false;
    const LatticeBox here = common(box, block_at(origin));
    const std::uint64_t mask = yz_mask(here);
    for (int x = here.first.x & 7; x <= (here.last.x & 7); ++x) {
      if ((bits_[found->second][static_cast<std::size_t>(x)] & mask) != mask) return false;
    }
    return true;
  });
}

std::uint64_t InsidePoints::bytes() const {
  std::uint64_t bytes = sizeof(InsidePoints) + bits_.size() * (sizeof(Bits) + sizeof(LatticePoint) + 48);
  for (const Level& level : levels_) bytes += level.tiles.size() * 64;
  return bytes;
}

LatticeMap::LatticeMap(const FieldFrame& frame, const Pose& pose) {
  const Rotation outer = rotation_of(pose.orientation), inner = rotation_of(frame.pose.orientation);
  origin_ = gridcull::to_world(pose, outer, frame.pose.position);
  columns_ = {outer * (frame.voxel * inner.x), outer * (frame.voxel * inner.y), outer * (frame.voxel * inner.z)};
  // The inverse of what the columns are, whatever an orientation's length: never their transpose.
  const double det = glm::dot(columns_[0], glm::cross(columns_[1], columns_[2]));
  rows_ = {glm::cross(columns_[1], columns_[2]) / det, glm::cross(columns_[2], columns_[0]) / det,
           glm::cross(columns_[0], columns_[1]) / det};
  const auto size = [](const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); };
  magnitude_ = size(pose.position) + 2.0 * size(frame.pose.position);
}

Vec3 LatticeMap::half_in_lattice(const Vec3& half) const {
  Vec3 out(0.0);
  for (int k = 0; k < 3; ++k) {
    const Vec3& row = rows_[static_cast<std::size_t>(k)];
    out[k] = std::fabs(row.x) * half.x + std::fabs(row.y) * half.y + std::fabs(row.z) * half.z;
  }
  return out;
}

// The sign: each corner's difference has the right one, rounded or not; shares of a cell are not negative and one of
// the eight products of them is at least 1/8, so a sum of differences of one sign has that sign.
double depth_at(const Volume& volume, const Vec3& lattice) {
  const auto depth_of = [&](double value) { return volume.inside_below ? value - volume.iso : volume.iso - value; };
  for (int k = 0; k < 3; ++k) {
    if (!(std::fabs(lattice[k]) < 2.0 * ScalarField::greatest_index)) return depth_of(volume.field->background());
  }
  const LatticePoint base(glm::floor(lattice));
  const Vec3 w = lattice - Vec3(base);
  double sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    const double share = ((i & 1) ? w.x : 1.0 - w.x) * ((i & 2) ? w.y : 1.0 - w.y) * ((i & 4) ? w.z : 1.0 - w.z);
    sum += share * depth_of(volume.field->at(base + LatticePoint(i & 1, i >> 1 & 1, i >> 2 & 1)));
  }
  return sum;
}

std::uint64_t bytes_of(const Volume& volume) {
  const VolumeBody& body = *volume.body;
  const ScalarField& field = *volume.field;
  return ScalarField::memory_of(field.blocks().size(), field.tiles().size()) + sizeof(VolumeBody) +
         body.points->bytes() + body.outer.capacity() * sizeof(Vec3) + body.inner.capacity() * sizeof(LatticeBox);
}

std::array<Vec3, 8> inner_corners(const Volume& volume, const LatticeBox& box) {
  const FieldFrame& frame = volume.field->frame();
  const Rotation r = rotation_of(frame.pose.orientation);
  // A corner is a sum of three products and one more sum: off by less than 2^-50 of what is added up.
  const Vec3 pull(rounding_in_lattice(*volume.field, box));
  const Vec3 low = Vec3(box.first) + pull, high = Vec3(box.last) - pull;
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec3 q((i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z);
    corners[i] = to_world(frame.pose, r, frame.voxel * q);
  }
  return corners;
}

Volume make_volume(std::shared_ptr<const ScalarField> field, double iso, bool inside_below) {
  if (!std::isfinite(iso)) refuse("expected a finite value to compare with");
  if (is_inside(field->background(), iso, inside_below)) {
    refuse("expected the background outside, found " + std::to_string(field->background()) + " where inside is " +
           (inside_below ? "below " : "above ") + std::to_string(iso));
  }
  auto body = std::make_shared<VolumeBody>();
  auto points = std::make_shared<const InsidePoints>(*field, iso, inside_below);
  if (points->bounds().empty()) {
    refuse(std::string("expected a value ") + (inside_below ? "below " : "above ") + std::to_string(iso) +
           ", found none");
  }
  body->points = points;
  const Volume bare{field, iso, inside_below, body};
  body->outer = corners_about(bare);
  for (const Vec3& p : body->outer) {
    if (!(std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) <= 1e9)) {
      refuse("expected coordinates of magnitude at most 1e9");
    }
  }
  body->inner = solid_boxes(*points);
  std::erase_if(body->inner, [&](const LatticeBox& box) { return rounding_in_lattice(*field, box) > 0.25; });
  return bare;
}

}  // namespace gridcull
