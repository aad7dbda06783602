// The methods by name: the one place outside grid/ and service/ that knows the grid engine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gridcull/core/bound_kind.h"
#include "gridcull/core/bounds.h"
#include "gridcull/core/culler.h"
#include "gridcull/grid/static_cells.h"
#include "gridcull/grid/static_store.h"
#include "gridcull/grid/static_tiles.h"
#include "gridcull/methods/baking.h"

namespace gridcull {

/// Options as the command line gives them; each method takes what it knows.
struct MethodOptions {
  int dimension = 2;
  Bounds bounds{};
  double cell = 1.0;         ///< metres
  std::string tbv = "auto";  ///< off, solid, hollow, auto (TbvMode)
  int threads = 1;           ///< 1 .. 256
  std::uint64_t max_memory = std::uint64_t{4} << 30;
  int resolution = 0;                   ///< pixels along a cube face's edge, 1 .. 8192; 0: the method's default
  int rays_width = 0, rays_height = 0;  ///< rays of a picture, 1 .. 8192 each; 0: the method's default
  int occluders = 8;                    ///< `shadow-frusta`: used at most, each frame and viewer, 1 .. 64
  std::string criteria = "area-angle,sampled,recent";  ///< `shadow-frusta`: what occluders are ranked by, some of these
  std::string unions = "on";                           ///< `shadow-frusta`: on, off
  std::string overlap = "planes";                      ///< `shadow-frusta`: planes, exact
  std::optional<BoundKind> bound{};                    ///< what objects are tested with; none: the method's own choice
  std::string baked{};                                 ///< file that the method reads instead of baking; "": none
  BakeSettings bake{};                                 ///< for baking
  StoreKind store = StoreKind::dense;                  ///< `voxel`: where static objects' cells are kept
  std::shared_ptr<const StaticCells> static_cells{};   ///< `voxel`: cells that were discretised before
  std::shared_ptr<TiledCells> static_tiles{};          ///< `voxel`: the same, read as viewers come near
  std::uint64_t static_memory = 0;                     ///< bytes for cells of static_tiles
  double view_box = 0.0;  ///< five-d-tree: edge of the box about the viewpoint, metres, >= 0
};

/// How a method works in advance; `bake` is nullptr for those that do not.
struct Baking {
  std::uint32_t version = 0;  ///< of the payload
  std::span<const BakeSetting> settings{};
  /// The payload for the static objects among `objects`; nothing when the listener stopped it. `resume` is a state from
  /// BakeListener::checkpoint(), of the same world and options, or empty. Threads change the time, not the result.
  std::optional<std::vector<std::byte>> (*bake)(std::span<const Object> objects, const MethodOptions& options,
                                                std::span<const std::byte> resume, BakeListener& listener) = nullptr;
  /// What a payload holds, for people: lines of "name  value". Throws Error(bad_scene) for one that cannot be read.
  std::string (*describe)(std::span<const std::byte> payload) = nullptr;
};

struct MethodEntry {
  MethodInfo info;
  std::string_view options;  ///< the command-line options it takes, for `gridcull methods`
  std::unique_ptr<Culler> (*make)(const MethodOptions&);
  Baking baking{};
};

/// All methods, in the order they are listed.
std::span<const MethodEntry> method_catalog();

/// Throws Error(usage) for an unknown name (the message lists the known ones) or a method that does not
/// take the dimension, and whatever the method's constructor throws.
std::unique_ptr<Culler> make_method(std::string_view name, const MethodOptions& options);

/// The method's place in the catalog. Throws Error(usage) for an unknown name; `option` stands at the front.
const MethodEntry& find_method(std::string_view name, std::string_view option = "--method");

/// The method used when none is named.
std::string_view default_method();

}  // namespace gridcull
