// What a method works out in advance (`gridcull bake`): who bakes, from what, and how far it has come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/core/object_hash.h"

namespace gridcull {

/// What a baked file is good for: one method, one version of its payload, one static world.
struct BakedHead {
  std::string method;
  std::uint32_t version = 1;  ///< of the payload
  std::uint64_t world = 0;    ///< static_world_hash() of the world it was baked from
};

/// Writes magic, container version, head, length, payload and checksum beside `path`, then renames. Throws Error(io).
void write_baked(const std::string& path, const BakedHead& head, std::span<const std::byte> payload);

/// The payload of a file baked for `expected`. Throws Error(io) when it cannot be read and Error(bad_scene) with one
/// line when it is no baked file, cut short, altered, of a later version, of another method or of another world.
/// Error(limit), before anything is read, for a file of more than `max_bytes`.
std::vector<std::byte> read_baked(const std::string& path, const BakedHead& expected,
                                  std::uint64_t max_bytes = std::numeric_limits<std::uint64_t>::max());

/// What a file says it is, without a look at the payload. Throws as read_baked() where it is no whole baked file.
BakedHead read_baked_head(const std::string& path);

/// A number that a method's bake takes on the command line, as `--NAME VALUE`.
struct BakeSetting {
  std::string_view name;
  std::string_view help;
  double standard = 0.0;           ///< where nobody says otherwise
  double least = 0.0, most = 0.0;  ///< both allowed
  bool whole = false;              ///< whole numbers only
};

/// Values of settings by name; those that are not there have their standard value.
using BakeSettings = std::map<std::string, double, std::less<>>;

/// The value of a setting. Throws Error(usage) when it is out of range.
double bake_setting(const BakeSettings& values, const BakeSetting& setting);

/// Hears how a bake gets on. Calls come from the thread that bakes.
class BakeListener {
 public:
  virtual ~BakeListener() = default;
  /// Share done, 0 .. 1. False: stop now; what was worked out so far goes to checkpoint() first.
  virtual bool progress(double share) = 0;
  /// The state of the work, good for going on later: same world, same options, same result as without the break.
  virtual void checkpoint(std::span<const std::byte> state) = 0;
};

}  // namespace gridcull
