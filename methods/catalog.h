// The methods by name: the one place outside grid/ and service/ that knows the grid engine.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "gridcull/core/bounds.h"
#include "gridcull/core/culler.h"

namespace gridcull {

/// Options as the command line gives them; each method takes what it knows.
struct MethodOptions {
  int dimension = 2;
  Bounds bounds{};
  double cell = 1.0;          ///< metres
  std::string tbv = "solid";  ///< off, solid, hollow
  int threads = 1;            ///< 1 .. 256
  std::uint64_t max_memory = std::uint64_t{4} << 30;
  int resolution = 0;                   ///< pixels along a cube face's edge, 1 .. 8192; 0: the method's default
  int rays_width = 0, rays_height = 0;  ///< rays of a picture, 1 .. 8192 each; 0: the method's default
};

struct MethodEntry {
  MethodInfo info;
  std::string_view options;  ///< the command-line options it takes, for `gridcull methods`
  std::unique_ptr<Culler> (*make)(const MethodOptions&);
};

/// All methods, in the order they are listed.
std::span<const MethodEntry> method_catalog();

/// Throws Error(usage) for an unknown name (the message lists the known ones) or a method that does not
/// take the dimension, and whatever the method's constructor throws.
std::unique_ptr<Culler> make_method(std::string_view name, const MethodOptions& options);

/// The method used when none is named.
std::string_view default_method();

}  // namespace gridcull
