#include "gridcull/service/file_roles.h"

#include <filesystem>
#include <system_error>
#include <vector>

#include <sys/stat.h>
#include <unistd.h>

#include "gridcull/core/error.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

/// What a name stands for.
struct Place {
  const NamedFile* named = nullptr;
  std::string path{};  // links followed, where there is nothing yet too; "-" as it is
  bool exists = false;
  struct stat status {};
};

Place place_of(const NamedFile& file, int stream) {
  Place out;
  out.named = &file;
  if (file.path == "-") {
    out.path = file.path;
    out.exists = ::fstat(stream, &out.status) == 0;
    return out;
  }
  std::error_code none;
  const std::string target = write_target(file.path);
  const std::filesystem::path whole = std::filesystem::weakly_canonical(std::filesystem::absolute(target, none), none);
  out.path = whole.empty() ? target : whole.string();
  out.exists = ::stat(file.path.c_str(), &out.status) == 0;
  return out;
}

std::vector<Place> places_of(std::span<const NamedFile> files, int stream) {
  std::vector<Place> out;
  for (const NamedFile& file : files) out.push_back(place_of(file, stream));
  return out;
}

bool same_inode(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

/// By its inode where it exists: two spellings and two links of one file, and a stream under its /dev name too.
bool same(const Place& a, const Place& b) {
  return a.path == b.path || (a.exists && b.exists && same_inode(a.status, b.status));
}

bool swallows_all(const Place& place) {
  struct stat null {};
  return place.named->path != "-" && place.exists && ::stat("/dev/null", &null) == 0 && same_inode(place.status, null);
}

bool is_plain(const Place& place) { return place.exists && S_ISREG(place.status.st_mode); }

std::string text(const Place& place) { return place.named->option + " " + place.named->path; }

[[noreturn]] void refuse(const Place& place, const std::string& why) {
  throw Error(ErrorCode::usage, text(place) + ": " + why);
}

}  // namespace

void keep_apart(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
  const std::vector<Place> in = places_of(inputs, STDIN_FILENO), out = places_of(outputs, STDOUT_FILENO);
  for (std::size_t i = 0; i < in.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool once = in[i].named->path == "-" || (in[i].exists && !is_plain(in[i]));
      if (once && same(in[i], in[j])) refuse(in[i], "it can be read once only, and " + text(in[j]) + " reads it");
    }
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (const Place& read : in) {
      // A terminal may be read and written; what is written to a plain file takes the place of what it held.
      if (is_plain(out[i]) && same(out[i], read)) {
        refuse(out[i], "expected an output of its own, found the input " + text(read));
      }
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!swallows_all(out[i]) && same(out[i], out[j])) {
        refuse(out[i], "expected an output of its own, found that of " + text(out[j]));
      }
    }
  }
}

}  // namespace gridcull
