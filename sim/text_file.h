// Text files in and out: plain, packed (.gz by name) or standard input and output ("-").
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace gridcull {

/// What some editors put in front of UTF-8.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Reads a file piece by piece or line by line. Throws Error(io) when it cannot be opened or read, is named
/// .gz but is not packed, or is a .gz that ends too early or is damaged.
class TextReader {
 public:
  /// `on_signal` is called when a signal breaks off a read that waits (a pipe, a terminal): it may throw to end the
  /// wait; otherwise, and without it, the read is taken up again.
  explicit TextReader(const std::string& path, std::function<void()> on_signal = {});
  ~TextReader();
  TextReader(TextReader&&) noexcept;
  TextReader& operator=(TextReader&&) noexcept;

  /// Next piece of at most `size` bytes; 0 at the end.
  std::size_t read(char* into, std::size_t size);
  /// Next line without its end (\n or \r\n), the first one without a byte order mark; false at the end. Throws
  /// Error(limit) above 1 GiB.
  bool line(std::string& out);
  /// Number of the line that line() gave last, from 1.
  std::uint64_t line_number() const;
  /// The name for messages: the path, "standard input" for "-".
  const std::string& name() const;

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

/// Whether a file can be read but once: "-", and what is there but is no plain file (a pipe, a terminal).
bool reads_once(const std::string& path);

/// The whole file.
std::string read_text(const std::string& path);

/// Where a file written under this name goes: symbolic links are followed, to what is not there yet too.
std::string write_target(const std::string& path);

/// Writes a file beside its name (a link's: beside its target) and puts it there on commit(); without commit() nothing
/// is left. Standard output and things that are not plain files (/dev/null, pipes) are written directly. Throws
/// Error(io).
class TextWriter {
 public:
  explicit TextWriter(const std::string& path);
  ~TextWriter();
  TextWriter(TextWriter&&) noexcept;
  TextWriter& operator=(TextWriter&&) noexcept;

  void write(std::string_view text);
  void commit();

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

/// Writes and commits.
void write_text(const std::string& path, std::string_view text);

}  // namespace gridcull
