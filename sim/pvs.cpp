#include "gridcull/sim/pvs.h"

#include <utility>

#include "gridcull/sim/json_text.h"
#include "gridcull/sim/json_tree.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

constexpr std::string_view format = "gridcull.pvs/1";

}  // namespace

struct PvsWriter::Detail {
  explicit Detail(const std::string& path) : writer(path) {}

  TextWriter writer;
  std::string text{};
};

PvsWriter::PvsWriter(const std::string& path, const std::string& method, const std::string& scene)
    : detail_(std::make_unique<Detail>(path)) {
  std::string text = "{\"format\": \"" + std::string(format) + "\"";
  append_key(text, "method");
  append_string(text, method);
  append_key(text, "scene");
  append_string(text, scene);
  detail_->writer.write(text + "}\n");
}
PvsWriter::~PvsWriter() = default;
PvsWriter::PvsWriter(PvsWriter&&) noexcept = default;
PvsWriter& PvsWriter::operator=(PvsWriter&&) noexcept = default;

void PvsWriter::write(std::uint64_t frame, double time, const Answers& answers) {
  std::string& text = detail_->text;
  text.clear();
  for (const Answer& answer : answers.views) {
    text += "{\"frame\": ";
    append_integer(text, frame);
    append_key(text, "time");
    append_number(text, time);
    append_key(text, "viewer");
    append_integer(text, answer.viewer);
    append_key(text, "visible");
    text += '[';
    for (const ObjectId id : answer.visible) {
      append_comma(text);
      append_integer(text, id);
    }
    text += "]}\n";
  }
  detail_->writer.write(text);
}

void PvsWriter::commit() { detail_->writer.commit(); }

struct PvsReader::Detail {
  TextReader reader;
  std::string method{}, scene{};
  bool any = false;
  PvsLine last{};
  std::string line{};

  explicit Detail(const std::string& path) : reader(path) {}
  std::string where() const { return reader.name() + ":" + std::to_string(reader.line_number()); }
};

PvsReader::PvsReader(const std::string& path) : detail_(std::make_unique<Detail>(path)) {
  Detail& d = *detail_;
  if (!d.reader.line(d.line)) {
    throw Error(ErrorCode::bad_message, d.reader.name() + ": expected a first line of the format \"" +
                                            std::string(format) + "\", found nothing");
  }
  const JsonTree tree(d.line, d.where(), ErrorCode::bad_message);
  tree.root().at("format").expect_format(format);
  tree.root().only_keys({"format", "method", "scene"});
  d.method = tree.root().at("method").string();
  d.scene = tree.root().at("scene").string();
}
PvsReader::~PvsReader() = default;
PvsReader::PvsReader(PvsReader&&) noexcept = default;
PvsReader& PvsReader::operator=(PvsReader&&) noexcept = default;

const std::string& PvsReader::method() const { return detail_->method; }
const std::string& PvsReader::scene() const { return detail_->scene; }

bool PvsReader::next(PvsLine& out) {
  Detail& d = *detail_;
  if (!d.reader.line(d.line)) return false;
  const JsonTree tree(d.line, d.where(), ErrorCode::bad_message);
  const JsonRef root = tree.root();
  root.only_keys({"frame", "time", "viewer", "visible"});
  PvsLine read;
  read.frame = root.at("frame").count();
  read.time = root.at("time").within(-1e12, 1e12, "seconds of magnitude at most 1e12");
  read.viewer = root.at("viewer").id();
  for (const JsonRef& item : root.at("visible").items()) {
    const ObjectId id = item.id();
    if (!read.visible.empty() && id <= read.visible.back()) item.refuse_with("expected ids that ascend");
    read.visible.push_back(id);
  }
  const auto order = std::pair(read.frame, read.viewer);
  if (d.any && order <= std::pair(d.last.frame, d.last.viewer)) {
    root.refuse_with("expected lines in the order of frame, then viewer");
  }
  d.any = true;
  d.last.frame = read.frame;
  d.last.viewer = read.viewer;
  out = std::move(read);
  return true;
}

}  // namespace gridcull
