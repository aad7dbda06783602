// Options whose values are checked as they are read: every refusal names the option as typed, what was expected and
// what was found.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gridcull/core/error.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gridcull {

/// Whole numbers low .. high, and the words for them.
struct WholeRange {
  std::uint64_t low = 0, high = std::numeric_limits<std::uint64_t>::max();
  std::string expected{};
};

/// Numbers above 0, or from 0 on, and at most `high`, and the words for them.
struct PositiveRange {
  double high = 1e9;
  std::string expected = "a number above 0 and at most 1e9";
  bool or_zero = false;
};

inline PositiveRange positive_metres() { return {1e9, "metres above 0 and at most 1e9"}; }
inline WholeRange memory_bytes() {
  return {1, std::numeric_limits<std::uint64_t>::max(), "a whole number of bytes, 1 or more"};
}

/// A whole number in decimal digits: no sign, no fraction, nothing around it.
CLI::Option& add_whole(CLI::App& command, const std::string& name, const WholeRange& range, const std::string& help,
                       std::function<void(std::uint64_t)> take);
/// Into any integer that holds the range, or an optional of one.
template <std::integral Whole>
CLI::Option& add_whole(CLI::App& command, const std::string& name, Whole& into, const WholeRange& range,
                       const std::string& help) {
  return add_whole(command, name, range, help, [&into](std::uint64_t value) { into = static_cast<Whole>(value); });
}
template <std::integral Whole>
CLI::Option& add_whole(CLI::App& command, const std::string& name, std::optional<Whole>& into, const WholeRange& range,
                       const std::string& help) {
  return add_whole(command, name, range, help, [&into](std::uint64_t value) { into = static_cast<Whole>(value); });
}

/// A number in decimal.
CLI::Option& add_positive(CLI::App& command, const std::string& name, const PositiveRange& range,
                          const std::string& help, std::function<void(double)> take);
/// Into a double or an optional of one.
template <class Number>
CLI::Option& add_positive(CLI::App& command, const std::string& name, Number& into, const PositiveRange& range,
                          const std::string& help) {
  return add_positive(command, name, range, help, [&into](double value) { into = value; });
}

/// One or more, with commas between; each is checked as by add_whole() and add_positive().
CLI::Option& add_wholes(CLI::App& command, const std::string& name, std::vector<int>& into, const WholeRange& range,
                        const std::string& help);
CLI::Option& add_positives(CLI::App& command, const std::string& name, std::vector<double>& into,
                           const PositiveRange& range, const std::string& help);

/// As many finite numbers of magnitude at most 1e9 as `count`, with commas between.
CLI::Option& add_numbers(CLI::App& command, const std::string& name, std::vector<double>& into, std::size_t count,
                         const std::string& expected, const std::string& help);

/// Text that is not empty: a file, a folder, a name.
CLI::Option& add_text(CLI::App& command, const std::string& name, std::string& into, const std::string& expected,
                      const std::string& help);

/// What `action` gives. The library begins its refusals of options with the field's name ("count: ..."); here they
/// begin with the option.
template <class Action>
auto named_as_typed(const Action& action) {
  try {
    return action();
  } catch (const Error& fault) {
    if (fault.code() != ErrorCode::usage) throw;
    throw Error(ErrorCode::usage, "--" + std::string(fault.what()));
  }
}

}  // namespace gridcull
