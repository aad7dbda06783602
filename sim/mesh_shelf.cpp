#include "gridcull/sim/mesh_shelf.h"

#include <filesystem>
#include <utility>

#include "gridcull/core/error.h"
#include "gridcull/core/volume.h"

namespace gridcull {
namespace {

std::uint64_t bytes_of(const std::vector<MeshGroup>& groups) {
  std::uint64_t bytes = 0;
  for (const MeshGroup& group : groups) {
    bytes += group.faces.vertices.size() * sizeof(Vec3) + group.faces.triangles.size() * sizeof(std::uint32_t[3]);
  }
  return bytes;
}

}  // namespace

MeshShelf::MeshShelf(const std::string& scene_path, std::uint64_t max_memory, FieldReader read_field)
    : folder_(scene_path == "-" ? "" : std::filesystem::path(scene_path).parent_path().string()),
      left_(max_memory),
      read_field_(std::move(read_field)) {}

Volume MeshShelf::take(const VolumeSource& source, double iso, bool inside_below) {
  if (!read_field_) throw Error(ErrorCode::bad_scene, source.file + ": volumes are not read here");
  std::shared_ptr<const ScalarField>& field = fields_[{source.file, source.grid, source.scale}];
  if (!field) {
    const std::string path = (std::filesystem::path(folder_) / source.file).string();
    field = std::make_shared<const ScalarField>(read_field_(path, source.grid, left_).scaled(source.scale));
    spend(ScalarField::memory_of(field->blocks().size(), field->tiles().size()));
  }
  Volume& volume = volumes_[{field.get(), iso, inside_below}];
  if (!volume.body) {
    try {
      volume = make_volume(field, iso, inside_below);
    } catch (const Error& fault) {
      throw Error(fault.code(), source.file + ": " + fault.what());
    }
  }
  return volume;
}

MeshGroup MeshShelf::take(const std::string& file, const std::string& group) {
  const auto [place, is_new] = files_.try_emplace(file);
  if (is_new) {
    try {
      place->second = read_mesh((std::filesystem::path(folder_) / file).string(), left_);
      spend(bytes_of(place->second));
    } catch (...) {
      files_.erase(place);
      throw;
    }
  }
  const std::vector<MeshGroup>& groups = place->second;
  if (group.empty()) return groups.size() == 1 ? groups.front() : joined(groups);
  for (const MeshGroup& one : groups) {
    if (one.name == group) return one;
  }
  std::string names;
  for (std::size_t i = 0; i < groups.size() && i < 8; ++i) names += (i > 0 ? ", '" : "'") + groups[i].name + "'";
  throw Error(ErrorCode::bad_scene, file + ": expected one of its groups (" + names +
                                        (groups.size() > 8 ? ", ..." : "") + "), found '" + group + "'");
}

}  // namespace gridcull
