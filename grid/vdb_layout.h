// Whether a .vdb file is whole, before OpenVDB reads it: OpenVDB 10 believes every length that it finds, and a file cut
// short can make it ask for twenty gigabytes or read beyond its mapping. The layout is OpenVDB's own (io/Archive,
// io/GridDescriptor, MetaMap of version 10): a head, metadata, then each grid behind a descriptor that says where it
// ends.
#pragma once

#include <string>

namespace gridcull {

/// Throws Error(io) for a file that cannot be read, and Error(bad_scene) with one line that begins with `path` for one
/// that is no .vdb, is of a version before 6.0 or after this OpenVDB's, was written as a stream (it then has no places
/// to check), is cut short, or says that a part of it lies beyond its end.
void check_vdb_layout(const std::string& path);

}  // namespace gridcull
