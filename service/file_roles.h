// Which files a command reads and writes: no output may be another output or an input.
#pragma once

#include <span>
#include <string>

namespace gridcull {

/// A file as it was named: "--out", "pvs.jsonl". A path of "-" is standard input or output.
struct NamedFile {
  std::string option{};
  std::string path{};
};

/// Refuses what would silently lose a file: two outputs that are one file or stream, under whatever names, an output
/// that is a file to be read, and two inputs from one stream, which can be read once only. /dev/null may be named as
/// often as one likes. Throws Error(usage).
void keep_apart(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);

}  // namespace gridcull
