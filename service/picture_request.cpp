#include "gridcull/service/picture_request.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "gridcull/core/error.h"
#include "gridcull/grid/engine.h"
#include "gridcull/service/svg_picture.h"
#include "gridcull/service/text.h"
#include "gridcull/sim/in_view.h"

namespace gridcull {
namespace {

template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number value{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || fault != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The viewers that there are, the first few by id.
std::string those_of(std::span<const View> views) {
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(views.size(), most); ++i) {
    text += (i > 0 ? ", " : "") + std::to_string(views[i].viewer);
  }
  if (views.size() > most) text += ", ...";
  return views.empty() ? "none" : text;
}

std::string title_of(const Culler& culler, const PictureRequest& request) {
  return "Whom viewer " + std::to_string(request.viewer) + " may see in frame " + std::to_string(request.frame) +
         " (method " + std::string(culler.info().name) + ")";
}

std::string subtitle_of(const std::string& label, const Replay& replay, const Answer& answer, const Lattice& lattice) {
  std::string text = label + ", t = " + number_text(replay.time(), 4) +
                     " s: " + counted(answer.visible.size(), "object") + " reported";
  for (const View& view : replay.views()) {
    if (view.viewer == answer.viewer) {
      text += " of " + std::to_string(count_in_view(replay.world(), {&view, 1})) + " in the view volume";
    }
  }
  text += "; cells of " + number_text(lattice.cell()) + " m";
  if (lattice.dimension() == 3) text += "; slice through the viewer's height";
  return text;
}

}  // namespace

PictureRequest parse_picture_request(const std::string& text) {
  const auto first = text.find(':');
  const auto second = first == std::string::npos ? first : text.find(':', first + 1);
  if (second != std::string::npos && second + 1 < text.size()) {
    const auto frame = parse_number<std::uint64_t>(std::string_view(text).substr(0, first));
    const auto viewer = parse_number<ViewerId>(std::string_view(text).substr(first + 1, second - first - 1));
    if (frame && viewer && *viewer != no_id) return {*frame, *viewer, text.substr(second + 1)};
  }
  throw option_error("--picture", "FRAME:VIEWER:FILE.svg, as in 100:7:view.svg", "\"" + text + "\"");
}

Pictures::Pictures(const std::vector<std::string>& requests, std::string label) : label_(std::move(label)) {
  for (const std::string& text : requests) {
    PictureRequest request = parse_picture_request(text);
    TextWriter writer(request.file);
    items_.push_back({std::move(request), std::move(writer)});
  }
}

bool Pictures::step(Replay& replay, Culler& culler, const Lattice& lattice) {
  const std::uint64_t frame = replay.next_frame();
  std::map<ViewerId, PictureSink> sinks;
  for (const Item& item : items_) {
    if (item.request.frame == frame) sinks.try_emplace(item.request.viewer, lattice);
  }
  auto* engine = sinks.empty() ? nullptr : dynamic_cast<GridEngine*>(&culler);
  if (engine) {
    std::vector<Drawing> drawings;
    for (auto& [viewer, sink] : sinks) drawings.push_back({viewer, &sink});
    engine->draw_next(drawings);
  }
  if (!replay.step()) return false;
  frames_ = frame + 1;
  for (Item& item : items_) {
    if (item.request.frame != frame) continue;
    draw(item, replay, culler, lattice, engine ? &sinks.at(item.request.viewer) : nullptr);
  }
  return true;
}

void Pictures::draw(Item& item, const Replay& replay, const Culler& culler, const Lattice& lattice,
                    const PictureSink* sink) {
  const auto& answers = replay.answers().views;
  const auto answer =
      std::find_if(answers.begin(), answers.end(), [&](const Answer& a) { return a.viewer == item.request.viewer; });
  const auto view = std::find_if(replay.views().begin(), replay.views().end(),
                                 [&](const View& v) { return v.viewer == item.request.viewer; });
  if (answer == answers.end() || view == replay.views().end()) {
    item.others = those_of(replay.views());
    return;
  }
  Picture picture{.lattice = lattice,
                  .objects = replay.world().objects(),
                  .view = *view,
                  .visible = answer->visible,
                  .title = title_of(culler, item.request),
                  .subtitle = subtitle_of(label_, replay, *answer, lattice)};
  item.writer.write(svg_picture(picture, sink));
  item.drawn = true;
}

void Pictures::check() const {
  for (const Item& item : items_) {
    if (item.drawn) continue;
    const PictureRequest& request = item.request;
    const std::string what = "--picture " + std::to_string(request.frame) + ":" + std::to_string(request.viewer);
    if (request.frame >= frames_) {
      throw Error(ErrorCode::usage, what + (frames_ == 1 ? ": there is only " : ": there are only ") +
                                        counted(frames_, "frame") + ", counted from 0");
    }
    throw Error(ErrorCode::usage, what + ": viewer " + std::to_string(request.viewer) +
                                      " is not there in that frame, but " + item.others);
  }
}

void Pictures::commit() {
  for (Item& item : items_) item.writer.commit();
}

}  // namespace gridcull
