#include "gridcull/sim/sumo_fcd.h"

#include <algorithm>

#include <pugixml.hpp>

#include "gridcull/core/error.h"
#include "gridcull/sim/import_parts.h"

namespace gridcull {
namespace {

constexpr std::size_t piece = std::size_t{1} << 18;
constexpr std::size_t greatest_step = std::size_t{1} << 30;

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

std::uint64_t newlines(std::string_view text) {
  return static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

FcdReader::FcdReader(const std::string& path) : reader_(path) {
  if (begins(byte_order_mark)) consume(byte_order_mark.size());
  while (true) {
    skip_space_and_comments();
    if (begins("<?"))
      consume(find("?>", at_, "the XML declaration") + 2);
    else if (begins("<!"))
      consume(find(">", at_, "a declaration") + 1);
    else
      break;
  }
  if (cut_inside("<fcd-export")) refuse("expected <fcd-export>, found the end of the file (cut short?)");
  if (!begins("<fcd-export")) refuse("expected XML with the element <fcd-export>, found something else");
  const std::size_t end = find(">", at_, "<fcd-export>");
  ended_ = buffer_[end - 1] == '/';
  consume(end + 1);
}

bool FcdReader::more() {
  if (at_ > 0) {
    buffer_.erase(0, at_);
    at_ = 0;
  }
  const std::size_t size = buffer_.size();
  if (size > greatest_step) throw Error(ErrorCode::limit, where() + ": a step of more than 1 GiB");
  buffer_.resize(size + piece);
  const std::size_t got = reader_.read(buffer_.data() + size, piece);
  buffer_.resize(size + got);
  return got > 0;
}

std::size_t FcdReader::find(std::string_view token, std::size_t from, const char* inside) {
  while (true) {
    const std::size_t found = buffer_.find(token, from);
    if (found != std::string::npos) return found;
    // Look again from where the token could begin; more() moves what is unread to the front.
    const std::size_t scanned = buffer_.size() >= token.size() ? buffer_.size() - token.size() + 1 : 0;
    from = std::max(from, scanned) - at_;
    if (!more()) refuse(std::string("expected the end of ") + inside + ", found the end of the file (cut short?)");
  }
}

bool FcdReader::begins(std::string_view token) {
  while (buffer_.size() - at_ < token.size() && more()) {
  }
  return std::string_view(buffer_).substr(at_).starts_with(token);
}

bool FcdReader::cut_inside(std::string_view token) {
  return !begins(token) && token.starts_with(std::string_view(buffer_).substr(at_));
}

void FcdReader::consume(std::size_t to) {
  line_ += newlines(std::string_view(buffer_).substr(at_, to - at_));
  at_ = to;
}

void FcdReader::skip_space_and_comments() {
  while (true) {
    std::size_t end = at_;
    while (end < buffer_.size() && is_space(buffer_[end])) ++end;
    consume(end);
    if (at_ == buffer_.size()) {
      if (!more()) return;
    } else if (begins("<!--")) {
      consume(find("-->", at_, "a comment") + 3);
    } else {
      return;
    }
  }
}

bool FcdReader::next(FcdStep& out, bool skip) {
  if (ended_) return false;
  skip_space_and_comments();
  if (begins("</fcd-export")) {
    consume(find(">", at_, "</fcd-export>") + 1);
    ended_ = true;
    return false;
  }
  if (cut_inside("</fcd-export") || cut_inside("<timestep") || cut_inside("<!--"))
    refuse("expected </fcd-export>, found the end of the file (cut short?)");
  if (!begins("<timestep")) refuse("expected <timestep> or </fcd-export>, found something else");
  // find() may move the buffer: positions are kept relative to at_.
  const std::size_t tag = find(">", at_, "<timestep>") - at_;
  std::size_t size = tag + 1;
  if (buffer_[at_ + tag - 1] != '/') {
    constexpr std::string_view close = "</timestep>";
    size = find(close, at_ + size, "<timestep>") - at_ + close.size();
  }
  if (!skip) read_step(size, out);
  consume(at_ + size);
  return true;
}

void FcdReader::read_step(std::size_t size, FcdStep& out) const {
  const std::string_view text = std::string_view(buffer_).substr(at_, size);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  const auto line_of = [&](std::ptrdiff_t offset) {
    const auto before = text.substr(0, offset < 0 ? 0 : static_cast<std::size_t>(offset));
    return reader_.name() + ":" + std::to_string(line_ + newlines(before)) + ": ";
  };
  if (!parsed) throw Error(ErrorCode::bad_message, line_of(parsed.offset) + "expected XML: " + parsed.description());
  const pugi::xml_node step = document.child("timestep");
  const auto refuse_node = [&](const pugi::xml_node& node, const std::string& why) {
    throw Error(ErrorCode::bad_message, line_of(node.offset_debug()) + "<" + node.name() + ">: " + why);
  };
  const auto number = [&](const pugi::xml_node& node, const char* name) {
    const pugi::xml_attribute attribute = node.attribute(name);
    if (!attribute) refuse_node(node, "missing attribute " + quoted(name));
    const auto value = parse_number(attribute.value());
    if (!value) {
      refuse_node(node, "attribute " + quoted(name) + ": expected a number of magnitude at most 1e9, found " +
                            quoted(attribute.value()));
    }
    return *value;
  };
  out.where = where();
  out.time = number(step, "time");
  out.movers.clear();
  for (const pugi::xml_node& node : step.children()) {
    const std::string_view kind = node.name();
    if (kind != "vehicle" && kind != "person") continue;
    const pugi::xml_attribute id = node.attribute("id");
    if (!id) refuse_node(node, "missing attribute \"id\"");
    out.movers.push_back({id.value(), kind == "person", number(node, "x"), number(node, "y"), number(node, "angle")});
  }
}

std::string FcdReader::where() const { return reader_.name() + ":" + std::to_string(line_); }

void FcdReader::refuse(const std::string& why) const { throw Error(ErrorCode::bad_message, where() + ": " + why); }

}  // namespace gridcull
