// What a method works out in advance (`gridcull bake`): who bakes, from what, and how far it has come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gridcull/core/object.h"

namespace gridcull {

/// What a baked file is good for: one method, one version of its payload, one static world.
struct BakedHead {
  std::string method;
  std::uint32_t version = 1;  ///< of the payload
  std::uint64_t world = 0;    ///< static_world_hash() of the world it was baked from
};

/// Hash of the static objects, occluders and occludees: ids, shapes, poses, occluder or not. Neither their order nor
/// moving objects count.
std::uint64_t static_world_hash(std::span<const Object> objects);

/// Writes magic, container version, head, length, payload and checksum beside `path`, then renames. Throws Error(io).
void write_baked(const std::string& path, const BakedHead& head, std::span<const std::byte> payload);

/// The payload of a file baked for `expected`. Throws Error(io) when it cannot be read and Error(bad_scene) with one line
/// when it is no baked file, cut short, altered, of a later version, of another method or of another world.
std::vector<std::byte> read_baked(const std::string& path, const BakedHead& expected);

/// Hears how a bake gets on.
class BakeListener {
 public:
  virtual ~BakeListener() = default;
  /// Share done, 0 .. 1. False: stop now; what was worked out so far goes to checkpoint() first.
  virtual bool progress(double share) = 0;
  /// The state of the work, good for going on later: same world, same options, same result as without the break.
  virtual void checkpoint(std::span<const std::byte> state) = 0;
};

}  // namespace gridcull
