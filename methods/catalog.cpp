#include "gridcull/methods/catalog.h"

#include <array>
#include <sstream>

#include "gridcull/core/error.h"
#include "gridcull/grid/engine.h"
#include "gridcull/methods/depth_rays.h"
#include "gridcull/methods/extended_bake.h"
#include "gridcull/methods/extended_projections.h"
#include "gridcull/methods/five_d_bake.h"
#include "gridcull/methods/five_d_tree.h"
#include "gridcull/methods/frustum.h"
#include "gridcull/methods/pairwise_rays.h"
#include "gridcull/methods/shadow_frusta.h"

namespace gridcull {
namespace {

TbvMode tbv_mode(const std::string& name) {
  if (name == "off") return TbvMode::off;
  if (name == "solid") return TbvMode::solid;
  if (name == "hollow") return TbvMode::hollow;
  if (name == "auto") return TbvMode::automatic;
  throw Error(ErrorCode::usage, "--tbv: expected off, solid, hollow or auto, found " + name);
}

std::unique_ptr<Culler> make_engine(const MethodOptions& o, Hiding hiding) {
  return std::make_unique<GridEngine>(GridOptions{o.dimension, o.bounds, o.cell, tbv_mode(o.tbv), o.threads,
                                                  o.max_memory, hiding, o.resolution, o.bound, o.store, o.static_cells,
                                                  o.static_tiles, o.static_memory});
}

std::unique_ptr<Culler> make_voxel(const MethodOptions& o) { return make_engine(o, Hiding::voxel); }

std::unique_ptr<Culler> make_silhouette(const MethodOptions& o) {
  if (o.bound && o.dimension == 2) {
    throw Error(ErrorCode::usage, "--bounds: silhouette tests the outlines themselves in 2D scenes");
  }
  return make_engine(o, Hiding::silhouette);
}

std::unique_ptr<Culler> make_frustum(const MethodOptions& o) { return make_frustum_culler(o.dimension, o.bound); }

std::unique_ptr<Culler> make_pairwise(const MethodOptions& o) {
  return make_pairwise_rays({o.dimension, o.bounds, o.threads});
}

OccluderWeights weights_of(const std::string& criteria) {
  OccluderWeights weights{0.0, 0.0, 0.0};
  std::istringstream names(criteria + ",");
  for (std::string name; std::getline(names, name, ',');) {
    double* weight = name == "area-angle" ? &weights.angle
                     : name == "sampled"  ? &weights.sampled
                     : name == "recent"   ? &weights.recent
                                          : nullptr;
    if (weight == nullptr || *weight > 0.0) {
      throw Error(ErrorCode::usage, "--criteria: expected some of area-angle, sampled and recent, found " + criteria);
    }
    *weight = 1.0;
  }
  return weights;
}

/// Whether it is the second of two words.
bool is_second(const char* option, const std::string& value, const char* first, const char* second) {
  if (value == first || value == second) return value == second;
  throw Error(ErrorCode::usage, std::string(option) + ": expected " + first + " or " + second + ", found " + value);
}

std::unique_ptr<Culler> make_shadows(const MethodOptions& o) {
  return make_shadow_frusta({.dimension = o.dimension,
                             .occluders = o.occluders,
                             .unions = !is_second("--unions", o.unions, "on", "off"),
                             .exact = is_second("--overlap", o.overlap, "planes", "exact"),
                             .bound = o.bound,
                             .weights = weights_of(o.criteria)});
}

std::unique_ptr<Culler> make_depth(const MethodOptions& o) {
  DepthRaysOptions options{.bounds = o.bounds, .bound = o.bound, .max_memory = o.max_memory};
  if (o.rays_width > 0) options.width = o.rays_width, options.height = o.rays_height;
  return make_depth_rays(options);
}

std::unique_ptr<Culler> make_five_d(const MethodOptions& o) {
  return make_five_d_tree({o.dimension, o.bounds, o.baked, o.view_box, o.threads, o.max_memory});
}

std::optional<std::vector<std::byte>> bake_five_d_tree(std::span<const Object> objects, const MethodOptions& o,
                                                       std::span<const std::byte> resume, BakeListener& listener) {
  FiveDOptions options = five_d_options(o.bake);
  options.threads = o.threads;
  options.max_memory = o.max_memory;
  const auto baked = bake_five_d(objects, o.dimension, o.bounds, options, resume, &listener);
  if (!baked) return std::nullopt;
  return five_d_payload(*baked);
}

Baking five_d_baking() { return {five_d_version, five_d_settings(), &bake_five_d_tree, &describe_five_d}; }

std::unique_ptr<Culler> make_extended(const MethodOptions& o) {
  return make_extended_projections({.bounds = o.bounds,
                                    .cell = o.cell,
                                    .resolution = o.resolution,
                                    .threads = o.threads,
                                    .baked = o.baked,
                                    .max_memory = o.max_memory});
}

std::optional<std::vector<std::byte>> bake_extended(std::span<const Object> objects, const MethodOptions& o,
                                                    std::span<const std::byte> resume, BakeListener& listener) {
  return bake_extended_projections(objects, {o.bounds, o.cell, o.threads, o.bake, o.max_memory}, resume, listener);
}

Baking extended_baking() {
  return {extended_baked_version, extended_bake_settings(), &bake_extended, &describe_extended_projections};
}

}  // namespace

std::span<const MethodEntry> method_catalog() {
  static const std::array entries{
      MethodEntry{grid_engine_info(Hiding::voxel),
                  "--cell C, --tbv off|solid|hollow|auto, --threads N, --max-memory BYTES", &make_voxel},
      MethodEntry{
          grid_engine_info(Hiding::silhouette),
          "--resolution R (3D), --bounds KIND (3D), --cell C, --tbv off|solid|auto, --threads N, --max-memory BYTES",
          &make_silhouette},
      MethodEntry{frustum_culler_info(), "--bounds KIND", &make_frustum},
      MethodEntry{
          shadow_frusta_info(),
          "--occluders N (default 8), --criteria area-angle,sampled,recent (or some of these), --unions on|off, "
          "--overlap planes|exact, --bounds KIND",
          &make_shadows},
      MethodEntry{pairwise_rays_info(), "--threads N", &make_pairwise},
      MethodEntry{depth_rays_info(), "--resolution WxH (default 128x72), --bounds KIND, --max-memory BYTES",
                  &make_depth},
      MethodEntry{five_d_tree_info(), "--baked FILE, --view-box METRES, --max-memory BYTES", &make_five_d,
                  five_d_baking()},
      MethodEntry{extended_projections_info(),
                  "--resolution R, --cell C, --threads N, --baked FILE, --max-memory BYTES", &make_extended,
                  extended_baking()}};
  return entries;
}

const MethodEntry& find_method(std::string_view name, std::string_view option) {
  std::string known;
  for (const MethodEntry& entry : method_catalog()) {
    if (entry.info.name == name) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.info.name);
  }
  throw Error(ErrorCode::usage, std::string(option) + ": expected one of " + known + ", found " + std::string(name));
}

std::unique_ptr<Culler> make_method(std::string_view name, const MethodOptions& options) {
  const MethodEntry& entry = find_method(name);
  if (options.dimension == 2 ? !entry.info.takes_2d : !entry.info.takes_3d) {
    throw Error(ErrorCode::usage,
                "--method: " + std::string(name) + " does not take " + std::to_string(options.dimension) + "D scenes");
  }
  if (!options.baked.empty() && entry.baking.bake == nullptr) {
    throw Error(ErrorCode::usage, "--baked: " + std::string(name) + " reads no baked file");
  }
  if (options.bound && entry.options.find("--bounds") == std::string_view::npos) {
    throw Error(ErrorCode::usage, "--bounds: " + std::string(name) + " tests no bounds");
  }
  const MethodOptions standard;
  const auto refuse_others = [&entry](const char* option, bool given) {
    if (given && entry.options.find(option) == std::string_view::npos) {
      throw Error(ErrorCode::usage, std::string(option) + ": no option of " + std::string(entry.info.name));
    }
  };
  refuse_others("--resolution", options.resolution > 0 || options.rays_width > 0);
  refuse_others("--view-box", options.view_box != standard.view_box);
  refuse_others("--occluders", options.occluders != standard.occluders);
  refuse_others("--criteria", options.criteria != standard.criteria);
  refuse_others("--unions", options.unions != standard.unions);
  refuse_others("--overlap", options.overlap != standard.overlap);
  return entry.make(options);
}

std::string_view default_method() { return "silhouette"; }

}  // namespace gridcull
