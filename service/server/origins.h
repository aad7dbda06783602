// Which browsers' pages may use the server: those that it served itself, and those that were named.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gridcull {

/// Whether a browser may send this as `Origin`: "null", or a scheme, a host and where wanted a port, in lower case and
/// without anything behind.
bool is_origin(std::string_view text);

class Origins {
 public:
  /// `address`, `port`: where the server listens; `allowed`: --allow-origin.
  Origins(const std::string& address, std::uint16_t port, std::vector<std::string> allowed);

  /// The headers `Origin` ("": no browser) and `Host` of a request.
  bool may_use(std::string_view origin, std::string_view host) const;

 private:
  bool knows(std::string_view host) const;

  std::vector<std::string> allowed_;
  bool loopback_;
};

}  // namespace gridcull
