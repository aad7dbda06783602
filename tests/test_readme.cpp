// The README's program is the one that the tests build and run, and what it says about files is true.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;
const fs::path root = GRIDCULL_SOURCE_DIR;

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The code between ```language and ```, of every such block.
std::vector<std::string> blocks(const std::string& text, const std::string& language) {
  std::vector<std::string> found;
  const std::string open = "```" + language + "\n";
  for (auto at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    at += open.size();
    found.push_back(text.substr(at, text.find("```", at) - at));
  }
  return found;
}

}  // namespace

TEST_CASE("the README's program is examples/embed/main.cpp") {
  const auto programs = blocks(text_of(root / "README.md"), "cpp");
  REQUIRE(programs.size() == 1);
  CHECK(programs[0] == text_of(root / "examples/embed/main.cpp"));
}

TEST_CASE("what the README quotes of its output is among what it prints") {
  const std::string readme = text_of(root / "README.md");
  std::smatch quoted;
  REQUIRE(std::regex_search(readme, quoted, std::regex("It prints, among others, `([^`]*)`")));
  CHECK(text_of(root / "examples/embed/expected.txt").find(quoted[1].str() + "\n") != std::string::npos);
}

TEST_CASE("links of the documents lead somewhere") {
  for (const char* document : {"README.md", "CONVENTIONS.md", "CHANGELOG.md"}) {
    const std::string text = text_of(root / document);
    CHECK(text.size() > 100);
    const std::regex link(R"(\]\(([^)#:]+)\))");
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      INFO(document << ": " << (*it)[1].str());
      CHECK(fs::exists(root / (*it)[1].str()));
    }
  }
}
