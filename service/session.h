// One client's world in the service: an engine, its frames, and what the client has been told. Knows nothing of
// sockets.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/core/hash.h"
#include "gridcull/service/drawn_view.h"
#include "gridcull/service/explain.h"
#include "gridcull/service/session_record.h"
#include "gridcull/service/wire_request.h"
#include "gridcull/service/world_options.h"
#include "gridcull/sim/replay.h"

namespace gridcull {

/// What one viewer is told.
struct ViewerReply {
  ViewerId viewer = no_id;
  bool full = true;
  std::vector<ObjectId> visible{};           ///< full
  std::vector<ObjectId> added{}, removed{};  ///< not full: against what the viewer's last answer said
};

struct FrameReply {
  std::uint64_t seq = 0;
  double time = 0.0;
  bool wanted = true;  ///< false: only acknowledged
  bool bulk = false;
  std::vector<ViewerReply> answers{};
};

/// Not thread-safe.
class Session {
 public:
  struct Limits {
    std::uint64_t objects = 0;
  };

  /// `record`: folder for the session's record; "" for none. Throws what prepare_scene() and methods throw,
  /// Error(limit) for too many objects, Error(io).
  Session(OpenRequest open, const Limits& limits, const std::string& record);

  int dimension() const { return world_.scene.dimension; }
  const std::string& name() const { return name_; }
  const std::string& method() const { return options_.method; }
  double cell() const { return world_.choice.cell; }
  const Lattice& lattice() const { return world_.lattice; }
  std::size_t objects() const { return replay_->world().objects().size(); }
  const World& world() const { return replay_->world(); }

  /// The last applied frame's number; 0 before the first.
  std::uint64_t seq() const { return seq_; }
  /// The last frame's views and answers.
  std::span<const View> views() const { return replay_->views(); }
  const Answers& answers() const { return replay_->answers(); }
  Guarantee guarantee() const { return culler_->info().guarantee; }
  /// Over all answers so far, as in gridcull.stats/1.
  std::uint64_t pvs_hash() const { return hash_.value(); }

  /// Applies the next frame, or answers the last one again. A refusal changes nothing and does not use up the number:
  /// Error(sequence), Error(bad_frame), Error(unknown_object), Error(limit). After any other exception the session
  /// is broken(). The request's frame is swapped for an older one, whose memory the next request may use.
  const FrameReply& apply(FrameRequest& request);
  /// The last applied frame; after a refusal, the refused one.
  const Frame& last_frame() const { return replay_->last_frame(); }
  bool broken() const { return broken_; }

  /// A client that may have missed answers is there again: every viewer's next answer is full.
  void resume();

  /// From the next frame on this viewer's cells and volumes are kept for drawing; no_id: nobody's. Only the grid engine
  /// draws.
  void draw(ViewerId viewer) { drawing_ = viewer; }
  ViewerId drawing() const { return drawing_; }
  /// Of the last frame; nullptr where nothing was drawn.
  const DrawnView* drawn() const { return has_drawn_ ? &drawn_ : nullptr; }

  /// Of the last frame. Throws Error(sequence) before the first and Error(unknown_object).
  Explanation explain(const ExplainRequest& request) const;

 private:
  /// Hands the frame in hand to the replay, and the replay's last one back, for its memory; not that of one which was
  /// far larger than its world, as refused ones may be.
  class OneFrame final : public FrameSource {
   public:
    Frame* frame = nullptr;
    std::size_t worth_keeping = 0;  ///< entries
    bool next(Frame& out) override;
  };

  bool begin_drawing();
  std::string about() const;
  void check_count(const Frame& frame) const;
  void make_reply(const FrameRequest& request);
  void drop(const std::vector<ViewerId>& viewers);

  std::string name_;
  WorldOptions options_;
  Limits limits_;
  PreparedWorld world_;
  std::unique_ptr<Culler> culler_;
  OneFrame source_;
  std::unique_ptr<Replay> replay_;
  std::unique_ptr<SessionRecord> record_;
  std::uint64_t seq_ = 0;
  bool fresh_ = true;  // the next answer is full
  bool broken_ = false;
  std::map<ViewerId, std::vector<ObjectId>> told_;  // what each viewer's last answer amounts to
  // What they were told before their viewer was dropped, or the connection lost, is not known on both sides: their next
  // answer is full.
  std::set<ViewerId> unsure_;
  FrameReply reply_;
  StableHash hash_;
  ViewerId drawing_ = no_id;
  DrawnView drawn_, drawing_now_;  // of the last frame; of the one in hand
  bool has_drawn_ = false;
};

}  // namespace gridcull
