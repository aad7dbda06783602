#include "gridcull/service/session_record.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "gridcull/core/error.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {

SessionRecord::SessionRecord(const std::string& folder, const Scene& scene, const std::string& about)
    : path_(folder + "/frames.jsonl"), dimension_(scene.dimension) {
  std::error_code fault;
  const bool made = std::filesystem::create_directories(folder, fault);
  if (fault) throw Error(ErrorCode::io, folder + ": the folder cannot be made: " + fault.message());
  try {
    begin(folder, scene, about);
  } catch (...) {
    close();
    if (made) std::filesystem::remove_all(folder, fault);  // the session is not opened: nothing of it is left
    throw;
  }
}

SessionRecord::~SessionRecord() { close(); }

void SessionRecord::begin(const std::string& folder, const Scene& scene, const std::string& about) {
  write_scene(folder + "/scene.json", scene);
  write_text(folder + "/session.json", about);
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0644);
  if (file_ < 0) throw Error(ErrorCode::io, path_ + ": cannot be written: " + std::strerror(errno));
  write_line("{\"format\": \"gridcull.frames/1\"}");
}

void SessionRecord::close() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

void SessionRecord::add(const Frame& frame) { write_line(frame_text(frame, dimension_)); }

void SessionRecord::write_line(std::string line) {
  line += '\n';
  const off_t start = ::lseek(file_, 0, SEEK_END);
  std::size_t done = 0;
  while (done < line.size()) {
    const ssize_t wrote = ::write(file_, line.data() + done, line.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) {
      const std::string why = std::strerror(errno);
      // Half a line would spoil what comes after it.
      const bool cut = ::ftruncate(file_, start) == 0;
      throw Error(ErrorCode::io, path_ + ": cannot be written: " + why + (cut ? "" : "; its last line is cut"));
    }
    done += static_cast<std::size_t>(wrote);
  }
}

}  // namespace gridcull
