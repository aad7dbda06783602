// Answers as files of the format `gridcull.pvs/1` (JSON lines).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gridcull/core/culler.h"

namespace gridcull {

/// Writes answers. "-" is standard output, .gz packs. The file appears under its name on commit() only.
class PvsWriter {
 public:
  /// `scene` is the scene file's name as it shall stand in the first line.
  PvsWriter(const std::string& path, const std::string& method, const std::string& scene);
  ~PvsWriter();
  PvsWriter(PvsWriter&&) noexcept;
  PvsWriter& operator=(PvsWriter&&) noexcept;

  /// One line a viewer. Throws Error(io).
  void write(std::uint64_t frame, double time, const Answers& answers);
  /// Finishes the file. Throws Error(io).
  void commit();

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

/// One line of a PVS file.
struct PvsLine {
  std::uint64_t frame = 0;
  double time = 0.0;
  ViewerId viewer = no_id;
  std::vector<ObjectId> visible{};
};

class PvsReader {
 public:
  /// Throws Error(io), Error(bad_message).
  explicit PvsReader(const std::string& path);
  ~PvsReader();
  PvsReader(PvsReader&&) noexcept;
  PvsReader& operator=(PvsReader&&) noexcept;

  const std::string& method() const;
  const std::string& scene() const;
  /// False at the end. Lines out of order and ids that do not ascend are refused.
  bool next(PvsLine& out);

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

}  // namespace gridcull
