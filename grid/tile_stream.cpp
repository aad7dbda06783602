#include "gridcull/grid/tile_stream.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

/// In the greatest coordinate: a viewer's window is a box.
double distance_to(const Vec3& low, const Vec3& high, const Vec3& point) {
  double distance = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    distance = std::max({distance, low[axis] - point[axis], point[axis] - high[axis]});
  }
  return distance;
}

}  // namespace

std::uint64_t tile_bytes(const StaticTile& tile) {
  constexpr std::uint64_t bricks = 512, beside = 256;  // a leaf's, and what it takes besides
  constexpr std::uint64_t block = bricks * (sizeof(std::uint64_t) + sizeof(std::uint32_t)) + beside;
  return tile.covers * sizeof(IdentifierMatrix::Entry) + tile.blocks * block;
}

TileStream::TileStream(std::shared_ptr<TiledCells> cells, const Lattice& lattice, std::uint64_t max_bytes)
    : cells_(std::move(cells)), lattice_(lattice), max_bytes_(max_bytes) {
  if (!cells_->head().fit(lattice)) {
    throw Error(ErrorCode::bad_scene, "static tiles: expected those of this lattice, found another's");
  }
  const TileLayout& layout = cells_->layout();
  const std::span<const StaticTile> tiles = cells_->tiles();
  stretch_of_.assign(tiles.size(), none);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (tiles[i].members.empty()) continue;
    stretch_of_[i] = static_cast<std::uint32_t>(stretches_.size());
    const Cell from = layout.low(i), to = layout.high(i);
    Stretch& tile = stretches_.emplace_back();
    tile.tile = i;
    // What a cell may touch is within the cell grown by the margin.
    const Vec3 margin(lattice.margin());
    tile.low = Vec3(lattice.boundary(0, from.x), lattice.boundary(1, from.y), lattice.boundary(2, from.z)) - margin;
    tile.high = Vec3(lattice.boundary(0, to.x), lattice.boundary(1, to.y), lattice.boundary(2, to.z)) + margin;
    if (lattice.dimension() == 2) tile.low.z = tile.high.z = 0.0;
    tile.centre = 0.5 * (tile.low + tile.high);
    tile.radius = 0.5 * glm::length(tile.high - tile.low) * (1.0 + 1e-12) + lattice.margin();
    tile.bytes = tile_bytes(tiles[i]);
  }
  slots_.assign(cells_->head().members.size(), none);
  chosen_.assign(stretches_.size(), 0);
}

bool TileStream::adopt(const Object& object, Slot slot) {
  if (use_.held > 0 || !object.is_static) return false;
  const StaticCells::Member* member = cells_->head().find(object);
  if (member == nullptr) return false;
  slots_[static_cast<std::size_t>(member - cells_->head().members.data())] = slot;
  return true;
}

void TileStream::release(ObjectId object) {
  const StaticCells::Member* member = cells_->head().find_id(object);
  slots_[static_cast<std::size_t>(member - cells_->head().members.data())] = none;
}

void TileStream::follow(std::span<const View> views, ObjectTable& objects, IdentifierMatrix& matrix) {
  measure(views);
  choose();
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    if (stretches_[i].held && !chosen_[i]) let_go(stretches_[i], objects, matrix);
  }
  for (std::size_t i = 0; i < stretches_.size(); ++i) {
    if (!stretches_[i].held && chosen_[i]) read(stretches_[i], objects, matrix);
  }
}

// Tiles are much wider than high: by its ball alone a tile beyond the range would be looked at.
bool TileStream::reaches(const ViewVolume& volume, const Stretch& tile) {
  return distance_to(tile.low, tile.high, volume.apex()) <= volume.range() &&
         volume.may_touch_ball(tile.centre, tile.radius);
}

void TileStream::measure(std::span<const View> views) {
  const double slack = 2.0 * lattice_.cell() * lattice_.brick_edge();  // windows are made of bricks
  for (Stretch& tile : stretches_) {
    tile.wanted = false;
    tile.distance = std::numeric_limits<double>::infinity();
    for (const View& view : views) {
      const double distance = distance_to(tile.low, tile.high, view.pose.position);
      tile.distance = std::min(tile.distance, distance);
      tile.wanted = tile.wanted || distance <= view.range + slack;
    }
  }
}

void TileStream::choose() {
  order_.clear();
  for (std::uint32_t i = 0; i < stretches_.size(); ++i) {
    chosen_[i] = 0;
    if (stretches_[i].wanted || stretches_[i].held) order_.push_back(i);
  }
  std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Stretch &x = stretches_[a], &y = stretches_[b];
    if (x.wanted != y.wanted) return x.wanted;
    return x.distance != y.distance ? x.distance < y.distance : a < b;
  });
  std::uint64_t bytes = 0;
  for (const std::uint32_t i : order_) {
    if (stretches_[i].bytes > max_bytes_ - bytes) continue;
    bytes += stretches_[i].bytes;
    chosen_[i] = 1;
  }
}

void TileStream::let_go(Stretch& tile, ObjectTable& objects, IdentifierMatrix& matrix) {
  each_member(tile, [&](Slot slot) { set_cells(tile, slot, 0, 0, objects, matrix); });
  tile.held = false;
  --use_.held;
  ++use_.let_go;
  use_.bytes -= tile.bytes;
}

void TileStream::read(Stretch& tile, ObjectTable& objects, IdentifierMatrix& matrix) {
  const StaticTile& expected = cells_->tiles()[tile.tile];
  cells_->read(tile.tile, covers_);
  if (covers_.size() != expected.covers || tile_hash(covers_) != expected.hash) {
    throw Error(ErrorCode::bad_scene,
                "static tiles: the cells of tile " + std::to_string(tile.tile) + " are not those that were written");
  }
  for (std::size_t first = 0, last = 0; first < covers_.size(); first = last) {
    const std::uint32_t member = covers_[first].member;
    while (last < covers_.size() && covers_[last].member == member) ++last;
    if (slots_[member] != none) set_cells(tile, slots_[member], first, last, objects, matrix);
  }
  tile.held = true;
  ++use_.held;
  ++use_.read;
  use_.bytes += tile.bytes;
}

void TileStream::set_cells(const Stretch& tile, Slot slot, std::size_t first, std::size_t last, ObjectTable& objects,
                           IdentifierMatrix& matrix) {
  ObjectState& state = objects[slot];
  cover_.clear();
  for (std::size_t i = first; i < last; ++i) cover_.bricks.push_back(covers_[i].cover);
  for (std::uint32_t i = state.entries; i != none; i = matrix.entry(i).next_of_object) {
    const IdentifierMatrix::Entry& entry = matrix.entry(i);
    if (cells_->layout().tile_of(lattice_.brick_corner(entry.brick)) == tile.tile) continue;
    cover_.bricks.push_back({entry.brick, entry.touched, entry.opaque});
  }
  std::sort(cover_.bricks.begin(), cover_.bricks.end(),
            [](const BrickCover& a, const BrickCover& b) { return a.brick < b.brick; });
  matrix.update(slot, cover_, state.occluder, true, state.entries);
}

TileUse TileStream::use() const {
  TileUse use = use_;
  use.directory = cells_->bytes() + stretches_.capacity() * sizeof(Stretch) + stretch_of_.capacity() * 4 +
                  slots_.capacity() * sizeof(Slot) + covers_.capacity() * sizeof(MemberBrick);
  for (const StaticTile& tile : cells_->tiles()) use.directory += sizeof(tile) + 4 * tile.members.capacity();
  return use;
}

}  // namespace gridcull
