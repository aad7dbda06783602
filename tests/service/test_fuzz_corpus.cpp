// The fuzzers' corpus, replayed: whatever once was found stays found.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/tests/fuzz/fuzz_targets.h"

using namespace gridcull;

namespace {

std::vector<std::string> corpus(const std::string& target) {
  std::vector<std::string> inputs;
  for (const auto& file : std::filesystem::directory_iterator(GRIDCULL_SOURCE_DIR "/tests/fuzz/corpus/" + target)) {
    std::ifstream stream(file.path(), std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  std::sort(inputs.begin(), inputs.end());
  return inputs;
}

}  // namespace

TEST_CASE("the readers take the whole corpus, and every prefix of its short files") {
  const auto replay = [](const std::string& target, void (*take)(std::string_view)) {
    CAPTURE(target);
    const std::vector<std::string> inputs = corpus(target);
    CHECK(inputs.size() >= 5);
    for (const std::string& input : inputs) {
      take(input);
      for (std::size_t n = 0; input.size() < 300 && n < input.size(); ++n) take(std::string_view(input).substr(0, n));
    }
  };
  replay("wire", fuzz::wire);
  replay("scene", fuzz::scene);
  replay("frame", fuzz::frame);
}
