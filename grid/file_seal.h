// A checksum (CRC-32) behind a file's last byte. Libraries that read a file's format do not see it; what was damaged on
// the way is found before they read anything, for some believe every length that they find.
#pragma once

#include <string>

namespace gridcull {

/// Appends the seal. Throws Error(io) where that fails.
void seal_file(const std::string& path);

/// Throws Error(io) for a file that cannot be read, and Error(bad_scene), one line that begins with `path`, for one
/// without a seal or with a wrong one. A seal finds damage, not malice: anyone can make one.
void check_seal(const std::string& path);

}  // namespace gridcull
