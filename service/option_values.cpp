#include "gridcull/service/option_values.h"

#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>

#include "gridcull/service/text.h"

namespace gridcull {
namespace {

std::string or_nothing(const std::string& text) { return text.empty() ? "nothing" : text; }

template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number value{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// One value, handed over as it was typed.
CLI::Option& add_value(CLI::App& command, const std::string& name, const std::string& help,
                       std::function<void(const std::string&)> take) {
  CLI::Option& option = *command.add_option(
      name,
      [take = std::move(take)](const CLI::results_t& typed) {
        take(typed.front());
        return true;
      },
      help);
  return option;
}

std::uint64_t whole_of(const std::string& name, const WholeRange& range, const std::string& text) {
  const auto value = parse<std::uint64_t>(text);
  if (!value || *value < range.low || *value > range.high) throw option_error(name, range.expected, or_nothing(text));
  return *value;
}

double number_of(const std::string& name, const PositiveRange& range, const std::string& text) {
  const auto value = parse<double>(text);
  const bool good = value && (*value > 0.0 || (range.or_zero && *value == 0.0)) && *value <= range.high;
  if (!good) throw option_error(name, range.expected, or_nothing(text));
  return *value;
}

/// Values with commas between, each made by `read`.
template <class Number, class Read>
CLI::Option& add_list(CLI::App& command, const std::string& name, std::vector<Number>& into, const std::string& help,
                      const Read& read) {
  const auto take = [&into, read](const CLI::results_t& typed) {
    into.clear();
    for (const std::string& text : typed) into.push_back(static_cast<Number>(read(text)));
    return true;
  };
  CLI::Option& option = *command.add_option(name, take, help);
  return *option.expected(1, CLI::detail::expected_max_vector_size)->delimiter(',');
}

}  // namespace

CLI::Option& add_wholes(CLI::App& command, const std::string& name, std::vector<int>& into, const WholeRange& range,
                        const std::string& help) {
  CLI::Option& option =
      add_list(command, name, into, help, [=](const std::string& text) { return whole_of(name, range, text); });
  return *option.type_name("N,N...");
}

CLI::Option& add_positives(CLI::App& command, const std::string& name, std::vector<double>& into,
                           const PositiveRange& range, const std::string& help) {
  CLI::Option& option =
      add_list(command, name, into, help, [=](const std::string& text) { return number_of(name, range, text); });
  return *option.type_name("NUMBER,NUMBER...");
}

CLI::Option& add_whole(CLI::App& command, const std::string& name, const WholeRange& range, const std::string& help,
                       std::function<void(std::uint64_t)> take) {
  CLI::Option& option =
      add_value(command, name, help, [=](const std::string& text) { take(whole_of(name, range, text)); });
  return *option.type_name("N");
}

CLI::Option& add_positive(CLI::App& command, const std::string& name, const PositiveRange& range,
                          const std::string& help, std::function<void(double)> take) {
  CLI::Option& option =
      add_value(command, name, help, [=](const std::string& text) { take(number_of(name, range, text)); });
  return *option.type_name("NUMBER");
}

CLI::Option& add_numbers(CLI::App& command, const std::string& name, std::vector<double>& into, std::size_t count,
                         const std::string& expected, const std::string& help) {
  const auto take = [&into, name, count, expected](const CLI::results_t& typed) {
    into.clear();
    std::string all;
    bool good = typed.size() == count;
    for (const std::string& text : typed) {
      all += (all.empty() ? "" : ",") + text;
      const auto value = parse<double>(text);
      good = good && value && std::fabs(*value) <= 1e9;
      into.push_back(value.value_or(0.0));
    }
    if (!good) throw option_error(name, expected, or_nothing(all));
    return true;
  };
  CLI::Option& option = *command.add_option(name, take, help);
  return *option.expected(1, CLI::detail::expected_max_vector_size)->delimiter(',');
}

CLI::Option& add_text(CLI::App& command, const std::string& name, std::string& into, const std::string& expected,
                      const std::string& help) {
  CLI::Option& option = add_value(command, name, help, [&into, name, expected](const std::string& text) {
    if (text.empty()) throw option_error(name, expected, "nothing");
    into = text;
  });
  return *option.type_name("TEXT");
}

}  // namespace gridcull
