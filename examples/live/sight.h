// Who sees whom, asked frame by frame: by gridcull in this process or by a gridcull server.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <gridcull/core/culler.h>
#include <gridcull/sim/frames.h>

class Sight {
 public:
  virtual ~Sight() = default;
  /// Applies the frame and answers for every viewer in it, in the order of their ids; valid until the next call.
  virtual const gridcull::Answers& see(const gridcull::Frame& frame) = 0;
};

std::unique_ptr<Sight> make_embedded_sight(const gridcull::Scene& scene);

/// `address` is HOST:PORT of a `gridcull serve`; `name` is the session's.
std::unique_ptr<Sight> make_remote_sight(const gridcull::Scene& scene, const std::string& address,
                                         const std::string& name);
