// Volume files of static worlds: static_volume.h.
#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <openvdb/openvdb.h>
#include <unistd.h>

#include "gridcull/core/error.h"
#include "gridcull/grid/file_seal.h"
#include "gridcull/grid/openvdb_store.h"
#include "gridcull/grid/shared_cells.h"
#include "gridcull/grid/static_tiles.h"
#include "gridcull/grid/static_volume.h"
#include "gridcull/grid/vdb_layout.h"

namespace gridcull {
namespace {

constexpr const char* format = "gridcull.static/1";

/// Names of the metadata.
namespace key {
constexpr const char *format = "gridcull_format", *units = "gridcull_units", *dimension = "gridcull_dimension",
                     *cell = "gridcull_cell", *origin = "gridcull_origin", *cells = "gridcull_cells",
                     *world = "gridcull_world", *objects = "gridcull_objects", *lists = "gridcull_lists",
                     *tile_shift = "gridcull_tile_shift", *tiles = "gridcull_tiles";
}  // namespace key

std::string hexadecimal(std::uint64_t value) {
  char digits[16];
  return {digits, std::to_chars(digits, digits + 16, value, 16).ptr};
}

std::uint64_t from_hexadecimal(const std::string& text) {
  std::uint64_t value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (end.ec != std::errc{} || end.ptr != text.data() + text.size()) {
    throw Error(ErrorCode::bad_scene, "expected a hash in hexadecimal digits, found \"" + text.substr(0, 40) + "\"");
  }
  return value;
}

/// Where a brick's cell `bit` is.
openvdb::Coord voxel_of(const Lattice& lattice, std::size_t brick, int bit) {
  const Cell c = lattice.cell_at(brick, bit);
  return {static_cast<int>(c.x), static_cast<int>(c.y), static_cast<int>(c.z)};
}

Lattice lattice_of(const StaticCells& cells) { return gridcull::lattice_of(cells, 0, Room::where_needed); }

template <class Grid>
typename Grid::Ptr make_grid(const char* name, const typename Grid::ValueType& background, const StaticCells& cells) {
  auto grid = Grid::create(background);
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_UNKNOWN);
  auto transform = openvdb::math::Transform::createLinearTransform(cells.cell);
  const double half = 0.5 * cells.cell;  // a voxel's place is its middle
  transform->postTranslate(
      {cells.origin.x + half, cells.origin.y + half, cells.origin.z + (cells.dimension == 3 ? half : 0.0)});
  grid->setTransform(transform);
  return grid;
}

openvdb::MetaMap metadata_of(const StaticCells& cells, const SharedCells& shared, int tile_shift) {
  openvdb::MetaMap map;
  const auto text = [&](const char* name, const std::string& value) {
    map.insertMeta(name, openvdb::StringMetadata(value));
  };
  text(key::format, format);
  text(key::units, "metres");
  map.insertMeta(key::dimension, openvdb::Int32Metadata(cells.dimension));
  map.insertMeta(key::cell, openvdb::DoubleMetadata(cells.cell));
  map.insertMeta(key::origin, openvdb::Vec3DMetadata({cells.origin.x, cells.origin.y, cells.origin.z}));
  map.insertMeta(key::cells, openvdb::Vec3IMetadata({static_cast<int>(cells.cells.x), static_cast<int>(cells.cells.y),
                                                     static_cast<int>(cells.cells.z)}));
  text(key::world, hexadecimal(cells.world));
  text(key::objects, members_text(cells));
  text(key::lists, lists_text(shared, cells));
  map.insertMeta(key::tile_shift, openvdb::Int32Metadata(tile_shift));
  text(key::tiles, tiles_text(make_tiles(cells, TileLayout(cells.cells, tile_shift)), cells));
  return map;
}

openvdb::GridPtrVec grids_of(const StaticCells& cells, const SharedCells& shared) {
  const Lattice lattice = lattice_of(cells);
  const auto opaque = make_grid<openvdb::BoolGrid>("opaque", false, cells);
  const auto touched = make_grid<openvdb::BoolGrid>("touched", false, cells);
  const auto object = make_grid<openvdb::Int32Grid>("object", -1, cells);
  auto opaque_cells = opaque->getAccessor(), touched_cells = touched->getAccessor();
  auto object_cells = object->getAccessor();
  for (const SharedCells::Part& part : shared.parts) {
    const bool filled = shared.opaque(part.list);
    for (std::uint64_t bits = part.cells; bits != 0; bits &= bits - 1) {
      const openvdb::Coord at = voxel_of(lattice, part.brick, std::countr_zero(bits));
      touched_cells.setValueOn(at, true);
      object_cells.setValueOn(at, static_cast<std::int32_t>(part.list));
      if (filled) opaque_cells.setValueOn(at, true);
    }
  }
  opaque->pruneGrid();
  touched->pruneGrid();
  object->pruneGrid();
  return {opaque, touched, object};
}

template <class T>
T value_of(const openvdb::MetaMap& map, const char* name) {
  const auto found = map.getMetadata<openvdb::TypedMetadata<T>>(name);
  if (!found) throw Error(ErrorCode::bad_scene, std::string("expected metadata ") + name + ", found none of that type");
  return found->value();
}

StaticCells head_of(const openvdb::MetaMap& map) {
  if (!map.getMetadata<openvdb::StringMetadata>(key::format)) {
    throw Error(ErrorCode::bad_scene, "expected a static volume, as gridcull bake static writes, found another .vdb");
  }
  const std::string found = value_of<std::string>(map, key::format);
  if (found != format) {
    throw Error(ErrorCode::bad_scene, std::string("expected format ") + format + ", found " + found.substr(0, 60));
  }
  StaticCells cells;
  cells.dimension = value_of<std::int32_t>(map, key::dimension);
  cells.cell = value_of<double>(map, key::cell);
  const openvdb::Vec3d origin = value_of<openvdb::Vec3d>(map, key::origin);
  cells.origin = {origin.x(), origin.y(), origin.z()};
  const openvdb::Vec3i count = value_of<openvdb::Vec3i>(map, key::cells);
  cells.cells = {count.x(), count.y(), count.z()};
  cells.world = from_hexadecimal(value_of<std::string>(map, key::world));
  const bool flat = cells.dimension == 2 && count.z() == 1 && origin.z() == 0.0;
  if (!(flat || cells.dimension == 3) || count.x() < 1 || count.y() < 1 || count.z() < 1 ||
      lattice_of(cells).cells() != cells.cells) {
    throw Error(ErrorCode::bad_scene, "expected cells of a lattice, found other metadata");
  }
  return cells;
}

using Leaf = openvdb::Int32Tree::LeafNodeType;

/// Collects the parts of a file's grid `object`, leaf by leaf.
class PartReader {
 public:
  PartReader(const Lattice& lattice, std::uint64_t max_memory, std::vector<SharedCells::Part>& out)
      : lattice_(lattice), max_memory_(max_memory), out_(out) {}

  void add(const Leaf& leaf) {
    for (auto value = leaf.cbeginValueOn(); value; ++value) add(value.getCoord(), *value);
    finish();
  }
  /// Cells of one list, as corners of the box tell.
  void add(const openvdb::CoordBBox& box, std::int32_t list) {
    if (box.volume() / 64 > max_memory_ / sizeof(BrickCover)) check_brick_memory(box.volume() / 64, max_memory_);
    const int edge = lattice_.brick_edge(), up = lattice_.dimension() == 3 ? edge : 1;
    for (int z = box.min().z(); z <= box.max().z(); z += up) {
      for (int y = box.min().y(); y <= box.max().y(); y += edge) {
        for (int x = box.min().x(); x <= box.max().x(); x += edge) {
          const openvdb::CoordBBox brick({x, y, z}, {x + edge - 1, y + edge - 1, z + up - 1});
          for (auto at = brick.begin(); at; ++at) add(*at, list);
          finish();
        }
      }
    }
  }

 private:
  void add(const openvdb::Coord& at, std::int32_t list) {
    const Cell cell{at.x(), at.y(), at.z()};
    if (!lattice_.holds(cell) || list < 0) {
      throw Error(ErrorCode::bad_scene, "object: expected numbers of lists in cells of the lattice, found others");
    }
    const auto brick = static_cast<std::uint32_t>(lattice_.brick_of(cell));
    const std::uint64_t bit = std::uint64_t{1} << lattice_.bit_of(cell);
    for (SharedCells::Part& part : leaf_parts_) {
      if (part.brick != brick || part.list != static_cast<std::uint32_t>(list)) continue;
      part.cells |= bit;
      return;
    }
    leaf_parts_.push_back({brick, static_cast<std::uint32_t>(list), bit});
  }
  void finish() {
    check_brick_memory(out_.size() + leaf_parts_.size(), max_memory_);
    out_.insert(out_.end(), leaf_parts_.begin(), leaf_parts_.end());
    leaf_parts_.clear();
  }

  const Lattice& lattice_;
  std::uint64_t max_memory_;
  std::vector<SharedCells::Part>& out_;
  std::vector<SharedCells::Part> leaf_parts_;
};

/// Leaves are read as they are come to, and given back.
void read_parts(openvdb::Int32Grid& grid, const Lattice& lattice, std::uint64_t max_memory, SharedCells& out) {
  PartReader reader(lattice, max_memory, out.parts);
  std::vector<Leaf*> stolen;
  grid.tree().stealNodes(stolen);
  std::vector<std::unique_ptr<Leaf>> leaves(stolen.begin(), stolen.end());
  for (auto& leaf : leaves) {
    reader.add(*leaf);
    leaf.reset();
  }
  for (auto tile = grid.tree().cbeginValueOn(); tile; ++tile) reader.add(tile.getBoundingBox(), *tile);
}

/// Runs `use(file)` on an open file; what OpenVDB or the metadata say against it becomes one line about `path`.
template <class Use>
auto with_file(const std::string& path, Use&& use) {
  check_vdb_layout(path);
  check_seal(path);
  openvdb::initialize();
  try {
    openvdb::io::File file(path);
    file.setCopyMaxBytes(0);  // read in place, not from a copy
    file.open(true);
    return use(file);
  } catch (const Error& error) {
    throw Error(error.code(), path + ": " + error.what());
  } catch (const std::exception& error) {
    std::string line = std::string(error.what()).substr(0, 200);
    for (char& c : line) c = c >= ' ' && c <= '~' ? c : ' ';
    throw Error(ErrorCode::bad_scene, path + ": cannot be read as a .vdb file: " + line);
  }
}

struct ObjectGrid {
  StaticCells head;  ///< with members
  std::vector<std::vector<SharedCells::Owner>> lists;
  openvdb::Int32Grid::Ptr grid;  ///< leaves come from the file when they are looked at
  openvdb::MetaMap::Ptr metadata;
};

ObjectGrid read_objects(openvdb::io::File& file) {
  ObjectGrid out;
  out.metadata = file.getMetadata();
  out.head = head_of(*out.metadata);
  out.head.members = parse_members(value_of<std::string>(*out.metadata, key::objects));
  out.lists = parse_lists(value_of<std::string>(*out.metadata, key::lists), out.head);
  if (!file.hasGrid("object")) throw Error(ErrorCode::bad_scene, "expected a grid named object, found none");
  out.grid = openvdb::gridPtrCast<openvdb::Int32Grid>(file.readGrid("object"));
  if (!out.grid) throw Error(ErrorCode::bad_scene, "object: expected a grid of int32, found another type");
  return out;
}

/// A volume file of which leaves are read when their tile is.
class TiledFile final : public TiledCells {
 public:
  TiledFile(std::string path, ObjectGrid objects)
      : path_(std::move(path)), objects_(std::move(objects)), lattice_(lattice_of(objects_.head)) {
    const openvdb::MetaMap& metadata = *objects_.metadata;
    const auto shift = value_of<std::int32_t>(metadata, key::tile_shift);
    if (shift < 3 || shift > 20) throw Error(ErrorCode::bad_scene, "expected tiles of 2^3 .. 2^20 cells, found others");
    layout_ = TileLayout(objects_.head.cells, shift);
    tiles_ = parse_tiles(value_of<std::string>(metadata, key::tiles), objects_.head, layout_);
    objects_.metadata.reset();
    list_leaves();
  }

  const StaticCells& head() const override { return objects_.head; }
  const TileLayout& layout() const override { return layout_; }
  std::span<const StaticTile> tiles() const override { return tiles_; }
  void read(std::size_t tile, std::vector<MemberBrick>& out) override try {
    constexpr auto any = std::numeric_limits<std::uint64_t>::max();
    parts_.clear();
    PartReader reader(lattice_, any, parts_);
    const auto by_tile = [](const Place& place, std::size_t wanted) { return place.tile < wanted; };
    for (auto at = std::lower_bound(leaves_.begin(), leaves_.end(), tile, by_tile);
         at != leaves_.end() && at->tile == tile; ++at) {
      reader.add(Leaf(*at->leaf));  // a copy takes the values: what the tree holds stays in the file
    }
    const Cell low = layout_.low(tile), high = layout_.high(tile);
    const auto coord = [](const Cell& c) {
      return openvdb::Coord(static_cast<int>(c.x), static_cast<int>(c.y), static_cast<int>(c.z));
    };
    openvdb::CoordBBox box(coord(low), coord(high).offsetBy(-1));
    for (const Block& block : blocks_) {
      openvdb::CoordBBox common = block.box;
      common.intersect(box);
      if (!common.empty()) reader.add(common, block.list);
    }
    covers_of(parts_, objects_.lists, any, out);
  } catch (const std::exception& fault) {
    throw Error(ErrorCode::bad_scene, path_ + ": " + fault.what());
  }
  std::uint64_t bytes() const override {
    std::uint64_t bytes = objects_.head.bytes() + objects_.grid->memUsage() + leaves_.capacity() * sizeof(Place);
    for (const auto& list : objects_.lists) bytes += sizeof(list) + list.capacity() * sizeof(SharedCells::Owner);
    return bytes;
  }

 private:
  struct Place {
    std::size_t tile;
    const Leaf* leaf;
  };
  struct Block {  // of one list
    openvdb::CoordBBox box;
    std::int32_t list;
  };

  void list_leaves() {
    const openvdb::Int32Tree& tree = objects_.grid->tree();
    leaves_.reserve(tree.leafCount());
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
      const openvdb::Coord at = leaf->origin();
      const Cell corner{at.x(), at.y(), at.z()};
      if (!lattice_.holds(corner)) throw Error(ErrorCode::bad_scene, "object: expected cells of the lattice");
      leaves_.push_back({layout_.tile_of(corner), &*leaf});
    }
    std::stable_sort(leaves_.begin(), leaves_.end(), [](const Place& a, const Place& b) { return a.tile < b.tile; });
    auto block = tree.cbeginValueOn();
    block.setMaxDepth(openvdb::Int32Tree::ValueOnCIter::LEAF_DEPTH - 1);
    for (; block; ++block) blocks_.push_back({block.getBoundingBox(), *block});
  }

  std::string path_;
  ObjectGrid objects_;
  Lattice lattice_;
  TileLayout layout_;
  std::vector<StaticTile> tiles_;
  std::vector<Place> leaves_;  // tiles ascend
  std::vector<Block> blocks_;
  std::vector<SharedCells::Part> parts_;
};

}  // namespace

void write_static_volume(const std::string& path, const StaticCells& cells, std::uint64_t max_memory, int tile_shift) {
  openvdb::initialize();
  check_openvdb_lattice(lattice_of(cells));
  const SharedCells shared = share_cells(cells, max_memory);
  const std::string beside = path + "." + std::to_string(::getpid()) + ".part";
  try {
    openvdb::io::File(beside).write(grids_of(cells, shared), metadata_of(cells, shared, tile_shift));
    check_vdb_layout(beside);  // what a full disk cut short is noticed now and not when it is needed
    seal_file(beside);
    std::filesystem::rename(beside, path);
  } catch (const std::exception&) {
    std::error_code none;
    std::filesystem::remove(beside, none);
    throw Error(ErrorCode::io, path + ": cannot be written");
  }
}

StaticCells read_static_volume_head(const std::string& path) {
  return with_file(path, [](openvdb::io::File& file) { return head_of(*file.getMetadata()); });
}

StaticCells read_static_volume(const std::string& path, std::uint64_t max_memory) {
  return with_file(path, [&](openvdb::io::File& file) {
    ObjectGrid objects = read_objects(file);
    StaticCells cells = std::move(objects.head);
    SharedCells shared{std::move(objects.lists), {}};
    read_parts(*objects.grid, lattice_of(cells), max_memory, shared);
    unshare_cells(shared, max_memory, cells);
    return cells;
  });
}

std::unique_ptr<TiledCells> open_static_volume_tiles(const std::string& path) {
  return with_file(path, [&](openvdb::io::File& file) -> std::unique_ptr<TiledCells> {
    return std::make_unique<TiledFile>(path, read_objects(file));
  });
}

}  // namespace gridcull
