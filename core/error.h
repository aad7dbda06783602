// The one error type that the library throws.
#pragma once

#include <stdexcept>
#include <string>

namespace gridcull {

/// What kind of fault it is; the wire protocol's codes are these names.
enum class ErrorCode {
  bad_scene,       ///< a scene, shape, lattice or option that cannot be used
  bad_frame,       ///< a frame that contradicts the scene or the time before it
  bad_message,     ///< text or bytes that cannot be read as what they should be
  unknown_object,  ///< an object id that is not there
  sequence,        ///< calls or messages out of order
  limit,           ///< more memory, objects or sessions than allowed
  forbidden,       ///< a token that is missing or wrong
  io,              ///< a file that cannot be opened, read or written
  usage,           ///< a command line or option that makes no sense
  internal         ///< a broken promise of the library itself
};

/// Thrown for every refusal. `what()` is one line that says what is wrong, where, and what was
/// expected; the object that refused is unchanged (strong guarantee) unless its function says otherwise.
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace gridcull
