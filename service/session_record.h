// A session on disk, in the public formats: DIR/scene.json and DIR/frames.jsonl, which `gridcull run`
// replays, and DIR/session.json: the session's name and the options that `run` then needs.
#pragma once

#include <string>

#include "gridcull/sim/frames.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

/// Each frame is handed to the system whole before add() returns, so that the death of the program loses none. (If it
/// dies within add(), the last line may be cut; it was not acknowledged then.)
class SessionRecord {
 public:
  /// Makes the folder and writes the scene, and `about` as session.json. Throws Error(io).
  SessionRecord(const std::string& folder, const Scene& scene, const std::string& about);
  ~SessionRecord();
  SessionRecord(const SessionRecord&) = delete;
  SessionRecord& operator=(const SessionRecord&) = delete;

  /// Throws Error(io).
  void add(const Frame& frame);

 private:
  void begin(const std::string& folder, const Scene& scene, const std::string& about);
  void close();
  void write_line(std::string line);

  std::string path_;
  int dimension_;
  int file_ = -1;
};

}  // namespace gridcull
