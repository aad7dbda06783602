// The five-dimensional tree of Gotsman, Sudarsky and Fayman 1999.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "gridcull/core/bounds.h"
#include "gridcull/core/culler.h"
#include "gridcull/methods/five_d_options.h"

namespace gridcull {

struct FiveDTreeOptions {
  int dimension = 3;
  Bounds bounds{};        ///< of the world
  std::string baked{};    ///< file from `gridcull bake`; "": the tree is baked small at the first query
  double view_box = 0.0;  ///< edge of the box about a viewpoint that a query takes, metres, >= 0
  int threads = 1;        ///< for baking
  std::uint64_t max_memory = std::uint64_t{4} << 30;  ///< bytes, of the file
};

/// Version of what is baked.
constexpr std::uint32_t five_d_version = 1;

std::unique_ptr<Culler> make_five_d_tree(const FiveDTreeOptions& options);

const MethodInfo& five_d_tree_info();

}  // namespace gridcull
