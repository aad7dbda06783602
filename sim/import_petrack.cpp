#include "gridcull/sim/import_petrack.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "gridcull/core/error.h"
#include "gridcull/sim/import_parts.h"
#include "gridcull/sim/scene_json.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

struct Sample {
  std::int64_t frame;
  ObjectId id;
  Vec2 position;  // metres
  std::uint64_t line;
  double heading = 0.0;
};

struct Tracks {
  double frame_rate = 0.0;  // a second
  double unit = 0.0;        // metres
  std::vector<Sample> samples{};
};

class Reader {
 public:
  explicit Reader(const std::string& path) : reader_(path) {}

  Tracks read() {
    std::string line;
    while (reader_.line(line)) {
      const std::size_t begin = line.find_first_not_of(" \t");
      if (begin == std::string::npos) continue;
      if (line[begin] == '#')
        read_header(line);
      else
        read_row(line);
    }
    if (reader_.line_number() == 0) refuse("expected header lines and rows, found an empty file");
    if (out_.samples.empty()) check_header();
    return std::move(out_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    const std::uint64_t line = reader_.line_number();  // 0: the file is empty
    const std::string where = line > 0 ? ":" + std::to_string(line) : "";
    throw Error(ErrorCode::bad_message, reader_.name() + where + ": " + why);
  }
  void check_header() const {
    if (!(out_.frame_rate > 0.0)) refuse("expected a header line \"# framerate: 25 fps\" before the first row");
    if (!(out_.unit > 0.0)) refuse("expected a header line that names the unit (x/m or x/cm) before the first row");
  }
  void read_header(const std::string& line) {
    if (const std::size_t at = line.find("framerate"); at != std::string::npos) {
      const std::size_t digit = line.find_first_of("-0123456789", at);
      const std::size_t end = line.find_first_not_of("-+.eE0123456789", digit);
      const auto rate = digit == std::string::npos ? std::nullopt : parse_number(line.substr(digit, end - digit));
      if (!rate || !(*rate > 0.0)) refuse("expected a frame rate above 0, found " + quoted(line));
      out_.frame_rate = *rate;
    }
    if (line.find("x/cm") != std::string::npos)
      out_.unit = 0.01;
    else if (line.find("x/m") != std::string::npos)
      out_.unit = 1.0;
  }
  void read_row(const std::string& line) {
    check_header();
    std::vector<std::string_view> fields;
    constexpr std::string_view spaces = " \t";
    for (std::size_t at = line.find_first_not_of(spaces); at != std::string::npos;) {
      const std::size_t end = std::min(line.find_first_of(spaces, at), line.size());
      fields.push_back(std::string_view(line).substr(at, end - at));
      at = line.find_first_not_of(spaces, end);
    }
    if (fields.size() < 4 || fields.size() > 5) refuse("expected a row \"id frame x y z\", found " + quoted(line));
    Sample sample{};
    sample.id = static_cast<ObjectId>(integer(fields[0], no_id - 1, "an id from 0 to 4294967294"));
    sample.frame = integer(fields[1], 1'000'000'000, "a frame from 0 to 1e9");
    sample.position = out_.unit * Vec2(coordinate(fields[2]), coordinate(fields[3]));
    if (fields.size() == 5) coordinate(fields[4]);
    sample.line = reader_.line_number();
    out_.samples.push_back(sample);
  }
  std::int64_t integer(std::string_view text, std::int64_t greatest, const char* expected) const {
    std::int64_t value = -1;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = fault == std::errc{} && end == text.data() + text.size();
    if (!whole || value < 0 || value > greatest)
      refuse(std::string("expected ") + expected + ", found " + quoted(text));
    return value;
  }
  double coordinate(std::string_view text) const {
    const auto value = parse_number(text);
    if (!value) refuse("expected a coordinate of magnitude at most 1e9, found " + quoted(text));
    return *value;
  }

  TextReader reader_;
  Tracks out_{};
};

/// Headings along the motion over 0.2 s to either side; `track` is one person's, sorted by frame.
void turn(std::vector<Sample*>& track, double frame_rate) {
  constexpr double least_way = 0.05;  // metres
  const auto window = static_cast<std::int64_t>(std::floor(0.2 * frame_rate + 0.5));
  std::size_t first = 0, last = 0;
  std::optional<double> known;
  for (std::size_t i = 0; i < track.size(); ++i) {
    while (track[first]->frame < track[i]->frame - window) ++first;
    while (last + 1 < track.size() && track[last + 1]->frame <= track[i]->frame + window) ++last;
    const Vec2 way = track[last]->position - track[first]->position;
    if (glm::length(way) >= least_way) {
      // Rounded, since the C library's atan2 may differ in its last bits from machine to machine.
      const double heading = std::round(std::atan2(way.y, way.x) * 1e6) / 1e6;
      // Who first stands and then walks stands looking where it will go.
      for (std::size_t j = 0; !known && j < i; ++j) track[j]->heading = heading;
      known = heading;
    }
    track[i]->heading = known.value_or(0.0);
  }
}

void sort_and_turn(Tracks& tracks, const std::string& path) {
  std::vector<Sample>& samples = tracks.samples;
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.frame != b.frame ? a.frame < b.frame : a.id < b.id; });
  std::map<ObjectId, std::vector<Sample*>> persons;
  for (Sample& sample : samples) {
    std::vector<Sample*>& track = persons[sample.id];
    if (!track.empty() && track.back()->frame == sample.frame) {
      throw Error(ErrorCode::bad_message, path + ":" + std::to_string(std::max(sample.line, track.back()->line)) +
                                              ": expected a person once in a frame, found id " +
                                              std::to_string(sample.id) + " twice in frame " +
                                              std::to_string(sample.frame));
    }
    track.push_back(&sample);
  }
  for (auto& [id, track] : persons) turn(track, tracks.frame_rate);
}

void check(const PetrackOptions& options) {
  const auto positive = [](double value, const char* what) {
    if (!(value > 0.0 && value <= 1e9)) {
      throw Error(ErrorCode::usage,
                  std::string(what) + ": expected a number above 0 and at most 1e9, found " + short_number(value));
    }
  };
  positive(options.radius, "radius");
  positive(options.max_speed, "max-speed");
  positive(options.range, "range");
  if (!(options.fov_degrees > 0.0 && options.fov_degrees <= 360.0)) {
    throw Error(ErrorCode::usage,
                "fov-degrees: expected degrees above 0 and at most 360, found " + short_number(options.fov_degrees));
  }
}

}  // namespace

Imported import_petrack(const PetrackOptions& options, const FrameSink& sink) {
  check(options);
  Tracks tracks = Reader(options.trajectories).read();
  sort_and_turn(tracks, options.trajectories);
  ViewerUpdate viewer;
  viewer.range = options.range;
  if (options.fov_degrees != 360.0) viewer.fov = radians_of(options.fov_degrees);
  ImportFrames frames(options.viewers, viewer);
  Imported out;
  for (auto at = tracks.samples.begin(); at != tracks.samples.end();) {
    const std::int64_t number = at->frame;
    std::vector<MoverState> movers;
    for (; at != tracks.samples.end() && at->frame == number; ++at) {
      const std::string name = std::to_string(at->id);
      frames.declare(at->id, {name, Disc{options.radius}, options.max_speed, true});
      movers.push_back({at->id, {at->position.x, at->position.y, 0.0}, at->heading});
    }
    const std::string where = options.trajectories + ": frame " + std::to_string(number);
    sink(frames.step(static_cast<double>(number) / tracks.frame_rate, std::move(movers), where));
    ++out.frames;
  }
  frames.finish();
  out.movers = frames.movers();
  out.scene.bounds = whole_metres(frames.bounds());
  return out;
}

}  // namespace gridcull
