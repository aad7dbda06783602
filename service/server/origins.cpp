// A page from elsewhere may have its own name point to this machine (DNS rebinding): then Origin and Host agree. A
// server on the loopback address knows all its names, so there a Host that agrees is not enough.
#include "gridcull/service/server/origins.h"

#include <algorithm>
#include <utility>

#include <boost/asio/ip/address.hpp>

namespace gridcull {

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

bool Origins::may_use(std::string_view origin, std::string_view host) const {
  if (origin.empty()) return true;
  if (std::find(allowed_.begin(), allowed_.end(), origin) != allowed_.end()) return true;
  return !loopback_ && (origin == "http://" + std::string(host) || origin == "https://" + std::string(host));
}

}  // namespace gridcull
