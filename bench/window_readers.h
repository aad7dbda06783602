// Ways to copy rows of O_s, to compare.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gridcull/grid/lattice.h"
#include "gridcull/grid/static_store.h"

namespace gridcull {

class WindowReader {
 public:
  virtual ~WindowReader() = default;
  /// out[i] |= O_s of the brick `first` + i along x; `first` in bricks.
  virtual void add_row(const Cell& first, std::span<std::uint64_t> out) const = 0;
};

/// The store's own way.
std::unique_ptr<WindowReader> make_store_reader(const Lattice& lattice, const StaticStore& store);

struct NamedReader {
  const char* name;
  std::unique_ptr<WindowReader> (*make)(const Lattice&, const StaticStore&);
};

/// Trees made of what a store holds: OpenVDB with accessors and without, NanoVDB with an accessor, as far as they are
/// there.
std::vector<NamedReader> tree_readers();

}  // namespace gridcull
