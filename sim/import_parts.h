// What the importers share: movers that come and go, and who of them carries a viewer.
#pragma once

#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/sim/imported.h"

namespace gridcull {

/// A mover as one step of the imported file gives it.
struct MoverState {
  ObjectId id = no_id;
  Vec3 position{0.0};
  double heading = 0.0;  ///< radians
};

/// What a mover is, for all steps.
struct MoverKind {
  std::string name{};
  Shape shape = Disc{1.0};
  double max_speed = 0.0;
  bool counted = true;  ///< whether "all" and a number of viewers mean it; by its name any can be chosen
};

/// Turns steps into frames: add, set and remove movers, give and drop viewers.
class ImportFrames {
 public:
  /// `viewer` is the update that a new viewer gets, but for its id and whom it follows.
  ImportFrames(ViewerChoice choice, ViewerUpdate viewer);

  /// Names the movers in the order of first appearance from `first` on.
  void begin_ids_at(ObjectId first) { next_id_ = first; }
  /// The id of a mover by a key of the caller's; `make` says what it is when it is new.
  template <class Make>
  ObjectId id_of(const std::string& key, const Make& make) {
    const auto [place, is_new] = ids_.try_emplace(key, next_id_);
    if (is_new) declare(next_id_++, make());
    return place->second;
  }
  void declare(ObjectId id, const MoverKind& kind) { kinds_.emplace(id, kind); }

  /// The frame that leads to these movers, sorted by id here. Throws Error(bad_message) for one id twice.
  Frame step(double time, std::vector<MoverState> movers, const std::string& where);

  std::uint64_t movers() const { return kinds_.size(); }
  /// All places so far, each grown by its shape's reach.
  const Bounds& bounds() const { return bounds_; }
  /// Throws Error(usage) when a viewer was chosen by a name that never came.
  void finish() const;

 private:
  void choose_viewers(const std::vector<ObjectId>& added, Frame& out);
  void give_viewer(ObjectId id, Frame& out);

  ViewerChoice choice_;
  ViewerUpdate viewer_;
  std::set<std::string> chosen_names_{}, met_names_{};
  ObjectId next_id_ = 0;
  std::unordered_map<std::string, ObjectId> ids_{};
  std::unordered_map<ObjectId, MoverKind> kinds_{};
  std::set<ObjectId> alive_{}, viewers_{};
  Bounds bounds_{};
};

/// Bounds rounded outward to whole metres, none when empty.
std::optional<Bounds> whole_metres(const Bounds& bounds);

/// A finite number of magnitude at most 1e9 that is all of the text.
std::optional<double> parse_number(std::string_view text);

/// At most six significant digits, for a message.
std::string short_number(double value);

/// Quoted for a message, on one line.
std::string quoted(std::string_view text);

}  // namespace gridcull
