#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include "gridcull/core/error.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 18;
constexpr std::size_t longest_line = std::size_t{1} << 30;

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw Error(ErrorCode::io, name + ": " + why);
}

std::string system_message() { return std::strerror(errno); }

}  // namespace

struct TextReader::Detail {
  std::string name;
  int file = -1;             // plain files; 0 is standard input
  gzFile packed = nullptr;   // .gz
  std::vector<char> buffer;  // bytes begin .. end are unread
  std::size_t begin = 0, end = 0;
  std::uint64_t lines = 0;
  std::function<void()> on_signal{};

  explicit Detail(const std::string& path) : name(path == "-" ? "standard input" : path) {
    if (path == "-") {
      file = STDIN_FILENO;
    } else if (path.ends_with(".gz")) {
      open_packed(path);
    } else {
      file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
      if (file < 0) refuse(name, "cannot be opened: " + system_message());
    }
  }
  ~Detail() {
    if (packed) gzclose(packed);
    if (file > STDIN_FILENO) ::close(file);
  }
  Detail(const Detail&) = delete;
  Detail& operator=(const Detail&) = delete;

  void open_packed(const std::string& path) {
    errno = 0;
    packed = gzopen(path.c_str(), "rbe");
    if (!packed) refuse(name, "cannot be opened: " + system_message());
    gzbuffer(packed, static_cast<unsigned>(buffer_size));
    // zlib would hand an unpacked file through as it is.
    if (gzdirect(packed)) {
      gzclose(packed);
      packed = nullptr;
      refuse(name, "expected a gzip file, as its name says, found something else");
    }
  }

  std::size_t read(char* into, std::size_t size) {
    if (packed) return read_packed(into, std::min(size, longest_line));
    while (true) {
      const ssize_t got = ::read(file, into, size);
      if (got >= 0) return static_cast<std::size_t>(got);
      if (errno != EINTR) refuse(name, "cannot be read: " + system_message());
      if (on_signal) on_signal();
    }
  }

  std::size_t read_packed(char* into, std::size_t size) {
    const int got = gzread(packed, into, static_cast<unsigned>(size));
    if (got == static_cast<int>(size)) return size;
    int code = Z_OK;
    const char* message = gzerror(packed, &code);
    // A short read without an error is the end; zlib marks an early end by Z_BUF_ERROR.
    if (code == Z_BUF_ERROR) refuse(name, "the gzip data end too early (a truncated file)");
    if (got < 0 || code != Z_OK) {
      std::string why = message;
      if (why.starts_with(name + ": ")) why.erase(0, name.size() + 2);  // zlib names the file too
      refuse(name, "the gzip data are damaged: " + why);
    }
    return static_cast<std::size_t>(got);
  }

  bool fill() {
    buffer.resize(buffer_size);
    begin = 0;
    end = read(buffer.data(), buffer.size());
    return end > 0;
  }
};

TextReader::TextReader(const std::string& path, std::function<void()> on_signal)
    : detail_(std::make_unique<Detail>(path)) {
  detail_->on_signal = std::move(on_signal);
}
TextReader::~TextReader() = default;
TextReader::TextReader(TextReader&&) noexcept = default;
TextReader& TextReader::operator=(TextReader&&) noexcept = default;

std::size_t TextReader::read(char* into, std::size_t size) {
  Detail& d = *detail_;
  if (d.begin == d.end) return d.read(into, size);
  const std::size_t n = std::min(size, d.end - d.begin);
  std::memcpy(into, d.buffer.data() + d.begin, n);
  d.begin += n;
  return n;
}

bool TextReader::line(std::string& out) {
  Detail& d = *detail_;
  out.clear();
  bool any = false;
  while (d.begin < d.end || d.fill()) {
    any = true;
    const char* from = d.buffer.data() + d.begin;
    const void* newline = std::memchr(from, '\n', d.end - d.begin);
    const std::size_t n =
        newline ? static_cast<std::size_t>(static_cast<const char*>(newline) - from) : d.end - d.begin;
    if (out.size() + n > longest_line) {
      throw Error(ErrorCode::limit, d.name + ":" + std::to_string(d.lines + 1) + ": a line longer than 1 GiB");
    }
    out.append(from, n);
    d.begin += n;
    if (newline) {
      ++d.begin;
      break;
    }
  }
  if (!any) return false;
  ++d.lines;
  if (out.ends_with('\r')) out.pop_back();
  if (d.lines == 1 && out.starts_with(byte_order_mark)) out.erase(0, byte_order_mark.size());
  return true;
}

std::uint64_t TextReader::line_number() const { return detail_->lines; }
const std::string& TextReader::name() const { return detail_->name; }

bool reads_once(const std::string& path) {
  if (path == "-") return true;
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(path, none);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
}

std::string read_text(const std::string& path) {
  TextReader reader(path);
  std::string text;
  std::vector<char> piece(buffer_size);
  try {
    while (const std::size_t n = reader.read(piece.data(), piece.size())) text.append(piece.data(), n);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::limit,
                reader.name() + ": more than fits into memory, after " + std::to_string(text.size()) + " bytes");
  }
  return text;
}

}  // namespace gridcull
