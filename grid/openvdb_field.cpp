// Fields of other programs, from .vdb files. A file cut short is found before OpenVDB reads it (vdb_layout.h). And
// grids are not read through openvdb::io::File, which looks at no read's success: here the stream itself throws where
// lengths inside a grid were altered.
#include "gridcull/grid/openvdb_field.h"

#include <cmath>
#include <fstream>
#include <memory>
#include <utility>
#include <vector>

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>
#include <openvdb/openvdb.h>

#include "gridcull/core/error.h"
#include "gridcull/grid/vdb_layout.h"

namespace gridcull {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& why, ErrorCode code = ErrorCode::bad_scene) {
  throw Error(code, path + ": cannot be read as a volume: " + why);
}

void check_memory(const std::string& path, std::uint64_t bytes, std::uint64_t max_memory) {
  if (bytes <= max_memory) return;
  refuse(
      path,
      "expected at most the " + std::to_string(max_memory) + " bytes of --max-memory, found " + std::to_string(bytes),
      ErrorCode::limit);
}

/// For a message: on one line, and not without end.
std::string one_line(std::string text) {
  text.resize(std::min<std::size_t>(text.size(), 200));
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 32) c = ' ';
  }
  return text;
}

/// The grids of a file, one read at a time.
class VdbFile : private openvdb::io::Archive {
 public:
  explicit VdbFile(const std::string& path) : stream_(path, std::ios::binary) {
    stream_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    settings_->setSeekable(true);
    openvdb::io::setStreamMetadataPtr(stream_, settings_, false);
    readHeader(stream_);
    setFormatVersion(stream_);
    setLibraryVersion(stream_);
    setDataCompression(stream_);
    if (!inputHasGridOffsets()) throw openvdb::IoError("expected a file with the places of its grids");
    openvdb::MetaMap about;
    about.readMeta(stream_);
    const std::int32_t count = readGridCount(stream_);
    for (std::int32_t i = 0; i < count; ++i) {
      Entry& entry = entries_.emplace_back();
      entry.grid = entry.place.read(stream_);
      entry.place.seekToEnd(stream_);
    }
  }

  struct Entry {
    openvdb::io::GridDescriptor place{};
    openvdb::GridBase::Ptr grid{};  ///< without its tree
  };
  const std::vector<Entry>& entries() const { return entries_; }

  /// What its writer noted of its size in memory; 0 where it did not.
  std::uint64_t noted_bytes(const Entry& entry) {
    entry.place.seekToGrid(stream_);
    readGridCompression(stream_);
    entry.grid->readMeta(stream_);
    const auto noted = entry.grid->getMetadata<openvdb::Int64Metadata>(openvdb::GridBase::META_FILE_MEM_BYTES);
    return noted && noted->value() > 0 ? static_cast<std::uint64_t>(noted->value()) : 0;
  }
  /// The whole grid; one that shares its tree with another is given that.
  openvdb::FloatGrid::Ptr take(const Entry& entry) {
    entry.place.seekToGrid(stream_);
    readGrid(entry.grid, entry.place, stream_);
    auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(entry.grid);
    if (!entry.place.isInstance()) return grid;
    for (const Entry& other : entries_) {
      if (other.place.uniqueName() != entry.place.instanceParentName() || other.place.isInstance()) continue;
      if (!other.grid->isType<openvdb::FloatGrid>()) break;
      grid->setTree(take(other)->treePtr());
      return grid;
    }
    throw openvdb::IoError("expected the grid whose tree '" + entry.place.gridName() + "' shares");
  }

 private:
  openvdb::io::StreamMetadata::Ptr settings_ = std::make_shared<openvdb::io::StreamMetadata>();  ///< the stream's
  std::ifstream stream_;
  std::vector<Entry> entries_{};
};

const VdbFile::Entry& chosen(const VdbFile& file, const std::string& path, const std::string& name) {
  std::string names;
  for (const VdbFile::Entry& entry : file.entries()) {
    const bool is_float = entry.grid->isType<openvdb::FloatGrid>();
    const std::string its_name = entry.place.gridName();
    if (name.empty() ? is_float : its_name == name) {
      if (is_float) return entry;
      refuse(path, "expected a float grid, found '" + one_line(name) + "' of type " + one_line(entry.grid->type()));
    }
    names += (names.empty() ? "" : ", ") + ("'" + one_line(its_name) + "' of type " + one_line(entry.grid->type()));
  }
  const std::string found = names.empty() ? "no grid" : one_line(names);
  refuse(path,
         (name.empty() ? "expected a float grid" : "expected a grid '" + one_line(name) + "'") + ", found " + found);
}

/// By the largest of the four sums that hold w, x, y and z (S. W. Shepperd, "Quaternion from rotation matrix", 1978).
Quat quat_of(const Rotation& r) {
  const double xx = r.x.x, yy = r.y.y, zz = r.z.z, sum = xx + yy + zz;
  Quat q;
  if (sum >= xx && sum >= yy && sum >= zz) {
    q = {1.0 + sum, r.y.z - r.z.y, r.z.x - r.x.z, r.x.y - r.y.x};
  } else if (xx >= yy && xx >= zz) {
    q = {r.y.z - r.z.y, 1.0 + 2.0 * xx - sum, r.x.y + r.y.x, r.z.x + r.x.z};
  } else if (yy >= zz) {
    q = {r.z.x - r.x.z, r.x.y + r.y.x, 1.0 + 2.0 * yy - sum, r.y.z + r.z.y};
  } else {
    q = {r.x.y - r.y.x, r.z.x + r.x.z, r.y.z + r.z.y, 1.0 + 2.0 * zz - sum};
  }
  return normalised(q);
}

/// Edges and angles may be off by a millionth: the frame is then the nearest that is not.
FieldFrame frame_of(const openvdb::math::Transform& transform, const std::string& path) {
  const std::string wanted = "expected voxels that are cubes, turned and moved only, found ";
  if (!transform.isLinear()) refuse(path, wanted + "a perspective transform");
  const openvdb::Mat4R m = transform.baseMap()->getAffineMap()->getMat4();
  // OpenVDB's points are rows: row i is the image of axis i.
  const auto row = [&](int i) { return Vec3(m(i, 0), m(i, 1), m(i, 2)); };
  const Vec3 x = row(0), y = row(1), z = row(2);
  const double edge = glm::length(x);
  if (!(std::isfinite(edge) && edge > 0.0)) refuse(path, wanted + "voxels without a size");
  constexpr double slack = 1e-6;
  for (const Vec3& axis : {y, z}) {
    if (!(std::fabs(glm::length(axis) - edge) <= slack * edge)) refuse(path, wanted + "edges of different lengths");
  }
  for (const auto& [a, b] : {std::pair(x, y), std::pair(y, z), std::pair(z, x)}) {
    if (!(std::fabs(glm::dot(a, b)) <= slack * edge * edge)) refuse(path, wanted + "edges that are not perpendicular");
  }
  if (!(glm::dot(glm::cross(x, y), z) > 0.0)) refuse(path, wanted + "mirrored ones");
  FieldFrame frame;
  const bool straight = x == Vec3(x.x, 0.0, 0.0) && y == Vec3(0.0, y.y, 0.0) && z == Vec3(0.0, 0.0, z.z) && x.x > 0.0;
  frame.voxel = straight ? x.x : edge;
  frame.pose.position = Vec3(m(3, 0), m(3, 1), m(3, 2));
  if (!straight || y.y < 0.0) frame.pose.orientation = quat_of({x / edge, y / edge, z / edge});
  return frame;
}

/// Calls f(box, value) for every tile that is not the background.
template <class F>
void for_each_tile(const openvdb::FloatTree& tree, F&& f) {
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(openvdb::FloatTree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    if (*tile == tree.background()) continue;
    f(tile.getBoundingBox(), *tile);
  }
}

LatticePoint point_of(const openvdb::Coord& c) { return {c.x(), c.y(), c.z()}; }

ScalarField field_of(const openvdb::FloatGrid& grid, const std::string& path, std::uint64_t max_memory) {
  const openvdb::FloatTree& tree = grid.tree();
  const FieldFrame frame = frame_of(grid.transform(), path);
  std::uint64_t count = 0;
  for_each_tile(tree, [&](const openvdb::CoordBBox&, float) { ++count; });
  check_memory(path, ScalarField::memory_of(tree.leafCount(), count), max_memory);
  std::vector<FieldBlock> blocks;
  blocks.reserve(tree.leafCount());
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    FieldBlock& block = blocks.emplace_back();
    block.origin = point_of(leaf->origin());
    static_assert(openvdb::FloatTree::LeafNodeType::SIZE == 512);  // x slowest, as here
    for (openvdb::Index i = 0; i < 512; ++i) block.values[i] = leaf->getValue(i);
  }
  std::vector<FieldTile> tiles;
  tiles.reserve(count);
  for_each_tile(tree, [&](const openvdb::CoordBBox& box, float value) {
    tiles.push_back({point_of(box.min()), box.dim().x(), value});
  });
  try {
    return ScalarField(frame, tree.background(), std::move(blocks), std::move(tiles));
  } catch (const Error& fault) {
    refuse(path, fault.what(), fault.code());
  }
}

}  // namespace

ScalarField read_scalar_field(const std::string& path, const std::string& grid_name, std::uint64_t max_memory) {
  check_vdb_layout(path);
  openvdb::initialize();
  try {
    VdbFile file(path);
    const VdbFile::Entry& entry = chosen(file, path, grid_name);
    check_memory(path, file.noted_bytes(entry), max_memory);
    return field_of(*file.take(entry), path, max_memory);
  } catch (const Error&) {
    throw;
  } catch (const std::ios_base::failure&) {
    refuse(path, "the file ends too early");
  } catch (const std::bad_alloc&) {
    refuse(path, "it asks for more memory than there is");
  } catch (const std::exception& fault) {
    refuse(path, one_line(fault.what()));
  }
}

}  // namespace gridcull
