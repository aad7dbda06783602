// The arrows of DESIGN section 3: who may include whom. Reads the sources themselves.
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;

struct Include {
  std::string file;    // "grid/engine.cpp"
  std::string part;    // "grid"
  std::string target;  // "core/ids.h"
  std::string target_part;
};

/// What each part may include, itself besides.
const std::map<std::string, std::set<std::string>> allowed{
    {"core", {}},
    {"grid", {"core"}},
    {"methods", {"core"}},
    {"sim", {"core"}},
    {"service", {"sim", "grid", "methods", "core"}},
};

bool is_catalog(const std::string& file) { return file.starts_with("methods/catalog."); }

bool is_exact_reference(const std::string& file) { return file.starts_with("core/exact"); }

/// Text between the first pair of delimiters of an #include line, empty for other lines.
std::string included(const std::string& line) {
  const auto hash = line.find_first_not_of(" \t");
  if (hash == std::string::npos || line[hash] != '#') return {};
  const auto word = line.find_first_not_of(" \t", hash + 1);
  if (word == std::string::npos || !line.substr(word).starts_with("include")) return {};
  const auto open = line.find_first_of("<\"", word);
  if (open == std::string::npos || line.find_first_not_of(" \t", word + 7) != open) return {};
  const auto close = line.find_first_of(">\"", open + 1);
  return close == std::string::npos ? std::string() : line.substr(open + 1, close - open - 1);
}

/// Own includes of one file. Plain quoted names would dodge the rule, so they are findings of their own.
void read_includes(const fs::path& path, const std::string& part, std::vector<Include>& out,
                   std::vector<std::string>& odd) {
  const std::string file = part + "/" + path.filename().string();
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::string name = included(line);
    if (name.empty()) continue;
    constexpr std::string_view root = "gridcull/";
    if (name.starts_with(root)) {
      const std::string target = name.substr(root.size());
      out.push_back({file, part, target, target.substr(0, target.find('/'))});
    } else if (line.find('"') != std::string::npos) {
      odd.push_back(file + ": \"" + name + "\"");
    }
  }
}

struct Sources {
  std::vector<Include> includes;
  std::vector<std::string> odd;
  std::map<std::string, int> files;  // by part
};

Sources read_sources() {
  Sources sources;
  for (const auto& [part, targets] : allowed) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(GRIDCULL_SOURCE_DIR) / part)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      ++sources.files[part];
      read_includes(entry.path(), part, sources.includes, sources.odd);
    }
  }
  return sources;
}

}  // namespace

TEST_CASE("the parts include only what the arrows allow") {
  const Sources sources = read_sources();
  for (const auto& [part, targets] : allowed) {
    CAPTURE(part);
    CHECK(sources.files.at(part) > 0);
  }
  CHECK(sources.includes.size() > 50);
  for (const Include& include : sources.includes) {
    if (include.part == include.target_part) continue;
    if (is_catalog(include.file) && include.target_part == "grid") continue;
    INFO(include.file << " includes " << include.target);
    CHECK(allowed.at(include.part).contains(include.target_part));
  }
  for (const std::string& line : sources.odd) {
    INFO("own headers are included as \"gridcull/PART/NAME.h\": " << line);
    CHECK(line.empty());
  }
}

TEST_CASE("methods see of each other only the catalog's list and shared tools") {
  for (const Include& include : read_sources().includes) {
    if (include.part != "methods" || is_catalog(include.file)) continue;
    INFO(include.file << " includes " << include.target);
    CHECK(include.target != "methods/catalog.h");
  }
}

TEST_CASE("the exact reference shares no code with any method") {
  // Vocabulary: what things are and where they stand, and the handle of a library; not who is visible.
  const std::set<std::string> vocabulary{
      "core/bounds.h", "core/culler.h",       "core/embree_device.h", "core/error.h", "core/half_space.h",
      "core/hull.h",   "core/ids.h",          "core/object.h",        "core/pose.h",  "core/scalar_field.h",
      "core/shape.h",  "core/trigonometry.h", "core/vec.h",           "core/view.h"};
  const std::vector<Include> includes = read_sources().includes;
  std::set<std::string> used;  // what else the reference is made of
  for (const Include& include : includes) {
    if (is_exact_reference(include.file) && !vocabulary.contains(include.target)) used.insert(include.target);
  }
  CHECK(used.contains("core/exact.h"));
  for (const Include& include : includes) {
    if (include.part != "grid" && include.part != "methods") continue;
    INFO(include.file << " includes " << include.target << ", which the exact reference is made of");
    CHECK_FALSE(used.contains(include.target));
  }
}

TEST_CASE("an include line is read in all its spellings") {
  CHECK(included("#include \"gridcull/core/ids.h\"") == "gridcull/core/ids.h");
  CHECK(included("  #  include <vector>  // why") == "vector");
  CHECK(included("// #include \"gridcull/grid/engine.h\"").empty());
  CHECK(included("#define include_me \"x\"").empty());
  CHECK(included("#if 1").empty());
}
