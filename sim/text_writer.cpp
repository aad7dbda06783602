#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include "gridcull/core/error.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw Error(ErrorCode::io, (path == "-" ? "standard output" : path) + ": cannot be written: " + why);
}

/// Opens a new file beside `target` under a name that nobody has.
int open_beside(const std::string& target, std::string& temporary) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    temporary = target + ".part" + std::to_string(::getpid()) + "-" + std::to_string(attempt);
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0 || errno != EEXIST) return file;
  }
  return -1;
}

}  // namespace

struct TextWriter::Detail {
  std::string path;       // as the caller named it
  std::string target;     // with links resolved
  std::string temporary;  // "" when written directly
  std::FILE* plain = nullptr;
  gzFile packed = nullptr;

  explicit Detail(const std::string& name) : path(name), target(write_target(name)) {
    if (path == "-") {
      plain = stdout;
      return;
    }
    const int file = open_file();
    if (file < 0) refuse(path, std::strerror(errno));
    // Level 4 packs frames to within a tenth of the default's size in a third of the time.
    if (path.ends_with(".gz"))
      packed = gzdopen(file, "wb4");
    else
      plain = ::fdopen(file, "wb");
    if (!packed && !plain) {
      ::close(file);
      remove_temporary();
      refuse(path, "out of memory");
    }
    if (packed) gzbuffer(packed, 1u << 17);
  }
  ~Detail() {
    close();
    remove_temporary();
  }
  Detail(const Detail&) = delete;
  Detail& operator=(const Detail&) = delete;

  int open_file() {
    std::error_code none;
    const fs::file_status status = fs::status(path, none);
    if (fs::is_directory(status)) refuse(path, "it is a folder");
    if (fs::is_symlink(fs::symlink_status(target, none))) {
      errno = ELOOP;
      return -1;
    }
    if (!fs::exists(status)) return open_beside(target, temporary);
    if (!fs::is_regular_file(status)) return ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    // Renaming needs no right to write the file itself: respect its protection all the same.
    if (::access(path.c_str(), W_OK) != 0) return -1;
    return open_beside(target, temporary);
  }

  /// Whether everything reached the file.
  bool close() {
    bool good = true;
    if (packed) good = gzclose(packed) == Z_OK;
    if (plain) good = (plain == stdout ? std::fflush(plain) : std::fclose(plain)) == 0;
    packed = nullptr;
    plain = nullptr;
    return good;
  }
  void remove_temporary() {
    if (!temporary.empty()) ::unlink(temporary.c_str());
    temporary.clear();
  }
};

std::string write_target(const std::string& path) {
  constexpr int most_links = 40;  // as many as the system follows
  fs::path at = path;
  std::error_code none;
  for (int links = 0; links < most_links && fs::is_symlink(fs::symlink_status(at, none)); ++links) {
    const fs::path to = fs::read_symlink(at, none);
    if (none) break;
    at = to.is_absolute() ? to : at.parent_path() / to;
  }
  return at.string();
}

TextWriter::TextWriter(const std::string& path) : detail_(std::make_unique<Detail>(path)) {}
TextWriter::~TextWriter() = default;
TextWriter::TextWriter(TextWriter&&) noexcept = default;
TextWriter& TextWriter::operator=(TextWriter&&) noexcept = default;

void TextWriter::write(std::string_view text) {
  Detail& d = *detail_;
  if (!d.plain && !d.packed) throw Error(ErrorCode::sequence, d.path + ": written to after its end");
  while (!text.empty()) {
    const std::size_t n = std::min(text.size(), std::size_t{1} << 30);
    errno = 0;
    const bool good = d.packed ? gzwrite(d.packed, text.data(), static_cast<unsigned>(n)) == static_cast<int>(n)
                               : std::fwrite(text.data(), 1, n, d.plain) == n;
    if (!good) refuse(d.path, errno ? std::strerror(errno) : "the write failed");
    text.remove_prefix(n);
  }
}

void TextWriter::commit() {
  Detail& d = *detail_;
  if (!d.plain && !d.packed) throw Error(ErrorCode::sequence, d.path + ": finished twice");
  errno = 0;
  if (!d.close()) refuse(d.path, errno ? std::strerror(errno) : "the write failed");
  if (d.temporary.empty()) return;
  if (std::rename(d.temporary.c_str(), d.target.c_str()) != 0) refuse(d.path, std::strerror(errno));
  d.temporary.clear();
}

void write_text(const std::string& path, std::string_view text) {
  TextWriter writer(path);
  writer.write(text);
  writer.commit();
}

}  // namespace gridcull
