// A page from elsewhere may have its own name point to this machine (DNS rebinding): then Origin and Host agree. A
// server on the loopback address knows all its names, so there a Host that agrees is not enough.
#include "gridcull/service/server/origins.h"

#include <algorithm>
#include <utility>

#include <boost/asio/ip/address.hpp>

namespace gridcull {
namespace {

std::string_view without_port(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  const bool in_address = colon != std::string_view::npos && host.find(']', colon) != std::string_view::npos;
  return in_address ? host : host.substr(0, colon);
}

}  // namespace

bool is_origin(std::string_view text) {
  if (text == "null") return true;
  const std::size_t end = text.find("://");
  if (end == std::string_view::npos || end == 0 || end + 3 == text.size()) return false;
  const std::string_view scheme = text.substr(0, end), host = text.substr(end + 3);
  const auto all = [](std::string_view part, std::string_view others) {
    return std::all_of(part.begin(), part.end(), [&](char c) {
      return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || others.find(c) != std::string_view::npos;
    });
  };
  return all(scheme, "+-.") && all(host, "-._:[]");
}

Origins::Origins(const std::string& address, std::uint16_t port, std::vector<std::string> allowed)
    : allowed_(std::move(allowed)) {
  boost::system::error_code fault;
  const auto ip = boost::asio::ip::make_address(address, fault);
  loopback_ = !fault && ip.is_loopback();
  const std::string at = ":" + std::to_string(port);
  const std::string own = !fault && ip.is_v6() ? "[" + address + "]" : address;
  for (const std::string& name : {own, std::string("localhost"), std::string("127.0.0.1"), std::string("[::1]")}) {
    allowed_.push_back("http://" + name + at);
  }
}

/// The name of one of the allowed origins, on any port: the name is what a page from elsewhere cannot borrow.
bool Origins::knows(std::string_view host) const {
  return std::any_of(allowed_.begin(), allowed_.end(), [&](std::string_view origin) {
    const std::size_t start = origin.find("://");
    return start != std::string_view::npos && without_port(origin.substr(start + 3)) == without_port(host);
  });
}

bool Origins::may_use(std::string_view origin, std::string_view host) const {
  if (loopback_ && !host.empty() && !knows(host)) return false;
  if (origin.empty()) return true;
  if (std::find(allowed_.begin(), allowed_.end(), origin) != allowed_.end()) return true;
  return !loopback_ && (origin == "http://" + std::string(host) || origin == "https://" + std::string(host));
}

}  // namespace gridcull
