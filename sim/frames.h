// Frames: how a world moves on, as files of the format `gridcull.frames/1` (JSON lines).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gridcull/sim/scene.h"

namespace gridcull {

/// Moves an object; what is not named stays.
struct ObjectMove {
  ObjectId id = no_id;
  std::optional<Vec3> position{};
  std::optional<Quat> orientation{};
  std::optional<double> heading{};  ///< radians, as given; orientation is turn_about_z() of it
};

/// Moves of many objects side by side, as the wire has them and as a culler takes them. Each names the same parts.
struct BulkMoves {
  std::vector<ObjectId> ids{};
  std::vector<Pose> poses{};       ///< as many; of the parts that are not told nothing is read
  std::vector<double> headings{};  ///< radians, as given; as many or, where none are told, empty
  bool positions = false;
  bool orientations = false;  ///< with headings: turn_about_z() of them

  /// One of them, as it would stand in a list.
  ObjectMove at(std::size_t i) const;
};

/// Makes a viewer or changes one; what is not named stays. `position` ends `follows`, `follows` ends
/// `position`; at most one of the two is named.
struct ViewerUpdate {
  ViewerId id = no_id;
  std::optional<Vec3> position{};
  std::optional<ObjectId> follows{};
  std::optional<Vec3> offset{};       ///< in the followed object's frame
  std::optional<Quat> orientation{};  ///< absolute
  std::optional<double> heading{};    ///< radians, as given
  std::optional<double> range{};      ///< metres
  std::optional<double> fov{};        ///< 2D: radians
  std::optional<Frustum> frustum{};   ///< 3D
};

/// One frame. Its parts apply in this order.
struct Frame {
  double time = 0.0;  ///< seconds, at most 1e12 in magnitude, greater than the last frame's
  std::vector<ObjectId> remove{};
  std::vector<SceneObject> add{};
  std::vector<ObjectMove> set{};  ///< or in bulk
  BulkMoves bulk{};               ///< from the wire only; then `set` is empty
  std::vector<ViewerId> drop_viewers{};
  std::vector<ViewerUpdate> viewers{};
  std::string where{};  ///< `file:line` for refusals; may be empty

  /// How many objects it moves, in a list or in bulk, and which.
  std::size_t moves() const { return set.empty() ? bulk.ids.size() : set.size(); }
  ObjectId moved(std::size_t i) const { return set.empty() ? bulk.ids[i] : set[i].id; }
};

/// Where frames come from: a file, a generator.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Fills `out` with the next frame; false at the end.
  virtual bool next(Frame& out) = 0;
};

/// Reads one frames line (without its end). Throws Error(bad_message) or Error(bad_frame).
Frame parse_frame(std::string_view line, int dimension, const std::string& where);

/// The line that FrameWriter writes for a frame, without its end.
std::string frame_text(const Frame& frame, int dimension);

/// Reads a frames file line by line, holding one line in memory. "-" is standard input, .gz is unpacked.
class FrameReader final : public FrameSource {
 public:
  /// `dimension` is the scene's. Reads the format line. Throws Error(io), Error(bad_message).
  /// `on_signal` as for TextReader.
  FrameReader(const std::string& path, int dimension, std::function<void()> on_signal = {});
  ~FrameReader() override;

  /// Throws Error(bad_message) for text that is not a frame and Error(bad_frame) for one that cannot be
  /// (a time that goes back, an id twice in one list); the message begins with `file:line: /pointer`.
  bool next(Frame& out) override;

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

/// Writes a frames file. The file appears under its name on commit() only.
class FrameWriter {
 public:
  FrameWriter(const std::string& path, int dimension);
  ~FrameWriter();
  FrameWriter(FrameWriter&&) noexcept;
  FrameWriter& operator=(FrameWriter&&) noexcept;

  /// Throws Error(io).
  void write(const Frame& frame);
  /// Finishes the file. Throws Error(io).
  void commit();

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

}  // namespace gridcull
