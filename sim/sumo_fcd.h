// SUMO's floating-car data, step by step.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gridcull/sim/text_file.h"

namespace gridcull {

struct FcdMover {
  std::string id;
  bool person;
  double x, y;   ///< metres
  double angle;  ///< degrees clockwise from north
};

struct FcdStep {
  double time;        ///< seconds
  std::string where;  ///< file:line
  std::vector<FcdMover> movers;
};

/// Reads `<fcd-export>`. One `<timestep>` at a time is in memory. Everything that is not such a file, a file
/// that ends before `</fcd-export>` included, is Error(bad_message).
class FcdReader {
 public:
  explicit FcdReader(const std::string& path);

  /// Next step; with `skip` its content is passed over unread. False at the end.
  bool next(FcdStep& out, bool skip);

 private:
  bool more();
  std::size_t find(std::string_view token, std::size_t from, const char* inside);
  bool begins(std::string_view token);
  /// Whether the file ends before this token is whole, right at its begin included.
  bool cut_inside(std::string_view token);
  void skip_space_and_comments();
  void consume(std::size_t to);
  void read_step(std::size_t size, FcdStep& out) const;
  std::string where() const;
  [[noreturn]] void refuse(const std::string& why) const;

  TextReader reader_;
  std::string buffer_{};
  std::size_t at_ = 0;      ///< begin of what is unread in buffer_
  std::uint64_t line_ = 1;  ///< of buffer_[at_]
  bool ended_ = false;
};

}  // namespace gridcull
