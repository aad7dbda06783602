#include "gridcull/sim/frames.h"

#include <optional>
#include <utility>

#include "gridcull/sim/json_text.h"
#include "gridcull/sim/scene_json.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

constexpr std::string_view format = "gridcull.frames/1";
constexpr double greatest_time = 1e12;

void read_ids(const JsonRef& frame, std::string_view key, std::vector<std::uint32_t>& out) {
  const auto list = frame.find(key);
  if (!list) return;
  const std::vector<JsonRef> items = list->items();
  for (const JsonRef& item : items) out.push_back(item.id());
  refuse_repeated(items, out);
}

template <class T, class Read, class Id>
void read_list(const JsonRef& frame, std::string_view key, std::vector<T>& out, const Read& read, const Id& id) {
  const auto list = frame.find(key);
  if (!list) return;
  const std::vector<JsonRef> items = list->items();
  std::vector<std::uint32_t> ids;
  ids.reserve(items.size());
  out.reserve(items.size());
  for (const JsonRef& item : items) {
    out.push_back(read(item));
    ids.push_back(id(out.back()));
  }
  refuse_repeated(items, ids);
}

template <class Append>
void append_places(std::string& out, std::string_view key, std::size_t count, const Append& append) {
  if (count == 0) return;
  append_key(out, key);
  out += '[';
  for (std::size_t i = 0; i < count; ++i) {
    append_comma(out);
    append(i);
  }
  out += ']';
}

template <class T, class Append>
void append_list(std::string& out, std::string_view key, const std::vector<T>& list, const Append& append) {
  append_places(out, key, list.size(), [&](std::size_t i) { append(list[i]); });
}

}  // namespace

ObjectMove BulkMoves::at(std::size_t i) const {
  ObjectMove move{.id = ids[i]};
  if (positions) move.position = poses[i].position;
  if (orientations) move.orientation = poses[i].orientation;
  if (!headings.empty()) move.heading = headings[i];
  return move;
}

Frame parse_frame(std::string_view line, int dimension, const std::string& where) {
  const JsonTree tree(line, where, ErrorCode::bad_frame);
  const JsonRef root = tree.root();
  root.only_keys({"time", "set", "add", "remove", "viewers", "drop_viewers"});
  Frame out = read_frame(root, dimension);
  out.where = where;
  return out;
}

Frame read_frame(const JsonRef& root, int dimension) {
  Frame out;
  out.time = root.at("time").within(-greatest_time, greatest_time, "seconds of magnitude at most 1e12");
  read_ids(root, "remove", out.remove);
  read_list(
      root, "add", out.add, [&](const JsonRef& item) { return read_object(item, dimension); },
      [](const SceneObject& object) { return object.object.id; });
  read_list(
      root, "set", out.set, [&](const JsonRef& item) { return read_move(item, dimension); },
      [](const ObjectMove& move) { return move.id; });
  read_ids(root, "drop_viewers", out.drop_viewers);
  read_list(
      root, "viewers", out.viewers, [&](const JsonRef& item) { return read_viewer(item, dimension); },
      [](const ViewerUpdate& viewer) { return viewer.id; });
  return out;
}

std::string frame_text(const Frame& frame, int dimension) {
  std::string out = "{";
  append_key(out, "time");
  append_number(out, frame.time);
  const auto append_id = [&](std::uint32_t id) { append_integer(out, id); };
  append_list(out, "remove", frame.remove, append_id);
  append_list(out, "add", frame.add, [&](const SceneObject& object) { append_object(out, object, dimension); });
  append_places(out, "set", frame.moves(), [&](std::size_t i) {
    append_move(out, frame.set.empty() ? frame.bulk.at(i) : frame.set[i], dimension);
  });
  append_list(out, "drop_viewers", frame.drop_viewers, append_id);
  append_list(out, "viewers", frame.viewers, [&](const ViewerUpdate& v) { append_viewer(out, v, dimension); });
  return out + "}";
}

struct FrameReader::Detail {
  TextReader reader;
  int dimension;
  std::optional<double> last{};
  std::string line{};

  Detail(const std::string& path, int dimension_, std::function<void()> on_signal)
      : reader(path, std::move(on_signal)), dimension(dimension_) {}
  std::string where() const { return reader.name() + ":" + std::to_string(reader.line_number()); }
  /// The next line that is not blank.
  bool advance() {
    while (reader.line(line)) {
      if (line.find_first_not_of(" \t") != std::string::npos) return true;
    }
    return false;
  }
};

FrameReader::FrameReader(const std::string& path, int dimension, std::function<void()> on_signal)
    : detail_(std::make_unique<Detail>(path, dimension, std::move(on_signal))) {
  Detail& d = *detail_;
  if (!d.advance()) {
    throw Error(ErrorCode::bad_message, d.reader.name() + ": expected the first line {\"format\": \"" +
                                            std::string(format) + "\"}, found nothing");
  }
  const JsonTree tree(d.line, d.where(), ErrorCode::bad_message);
  tree.root().at("format").expect_format(format);
  tree.root().only_keys({"format"});
}

FrameReader::~FrameReader() = default;

bool FrameReader::next(Frame& out) {
  Detail& d = *detail_;
  if (!d.advance()) return false;
  Frame frame = parse_frame(d.line, d.dimension, d.where());
  if (d.last && !(frame.time > *d.last)) {
    std::string text = d.where() + ": /time: expected a time after ";
    append_number(text, *d.last);
    append_number(text += ", found ", frame.time);
    throw Error(ErrorCode::bad_frame, text);
  }
  d.last = frame.time;
  out = std::move(frame);
  return true;
}

struct FrameWriter::Detail {
  Detail(const std::string& path, int dimension_) : writer(path), dimension(dimension_) {}

  TextWriter writer;
  int dimension;
};

FrameWriter::FrameWriter(const std::string& path, int dimension) : detail_(std::make_unique<Detail>(path, dimension)) {
  detail_->writer.write("{\"format\": \"" + std::string(format) + "\"}\n");
}
FrameWriter::~FrameWriter() = default;
FrameWriter::FrameWriter(FrameWriter&&) noexcept = default;
FrameWriter& FrameWriter::operator=(FrameWriter&&) noexcept = default;

void FrameWriter::write(const Frame& frame) { detail_->writer.write(frame_text(frame, detail_->dimension) + "\n"); }

void FrameWriter::commit() { detail_->writer.commit(); }

}  // namespace gridcull
