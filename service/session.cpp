#include "gridcull/service/session.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <nlohmann/json.hpp>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/grid/engine.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

constexpr int explain_rays = 512;

void refuse_many(std::uint64_t count, std::uint64_t most) {
  if (count <= most) return;
  throw Error(ErrorCode::limit,
              "message: expected at most " + std::to_string(most) + " objects, found " + std::to_string(count));
}

/// The scene as it has to be recorded: with the grid that was chosen for it.
Scene with_grid(Scene scene, const LatticeChoice& choice) {
  scene.bounds = choice.bounds;
  scene.cell = choice.cell;
  return scene;
}

PreparedWorld prepare(OpenRequest& open, const Session::Limits& limits) {
  refuse_many(open.scene.objects.size(), limits.objects);
  return prepare_scene(open.options, std::move(open.scene));
}

}  // namespace

Session::Session(OpenRequest open, const Limits& limits, const std::string& record)
    : name_(std::move(open.name)),
      options_(open.options),
      limits_(limits),
      world_(prepare(open, limits)),
      culler_(make_culler(options_, world_)),
      replay_(std::make_unique<Replay>(*culler_, world_.scene, &source_)) {
  if (!record.empty()) {
    record_ = std::make_unique<SessionRecord>(record, with_grid(world_.scene, world_.choice), about());
  }
  // The world has them now.
  world_.scene.objects = {};
  world_.scene.viewers = {};
}

/// What `gridcull run` has to be told besides the record's files to give the same answers.
std::string Session::about() const {
  std::vector<std::string> options{"--method", options_.method, "--tbv", options_.tbv};
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) options.insert(options.end(), {name, value});
  };
  add("--resolution", options_.resolution);
  add("--bounds", options_.bounds);
  add("--occluders", options_.occluders != WorldOptions{}.occluders ? std::to_string(options_.occluders) : "");
  add("--view-box", options_.view_box != WorldOptions{}.view_box ? number_text(options_.view_box, 17) : "");
  const nlohmann::ordered_json json{{"name", name_}, {"run", options}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

bool Session::OneFrame::next(Frame& out) {
  std::swap(out, *frame);
  const Frame& old = *frame;
  const std::size_t room = old.bulk.ids.capacity() + old.bulk.poses.capacity() + old.set.capacity() +
                           old.add.capacity() + old.remove.capacity() + old.viewers.capacity() +
                           old.drop_viewers.capacity();
  if (room > worth_keeping) *frame = {};
  return true;
}

void Session::check_count(const Frame& frame) const {
  const std::size_t now = objects() + frame.add.size();
  if (now > frame.remove.size()) refuse_many(now - frame.remove.size(), limits_.objects);
}

/// Whether the frame in hand is drawn.
bool Session::begin_drawing() {
  auto* engine = drawing_ == no_id ? nullptr : dynamic_cast<GridEngine*>(culler_.get());
  if (engine == nullptr) return false;
  drawing_now_.begin(drawing_);
  engine->draw_next(drawing_, &drawing_now_);
  return true;
}

const FrameReply& Session::apply(FrameRequest& request) {
  if (seq_ > 0 && request.seq == seq_) {
    // Again, and after a resume in full, since nobody knows what has arrived.
    if (fresh_) make_reply(request);
    reply_.bulk = request.bulk;
    return reply_;
  }
  if (broken_) throw Error(ErrorCode::internal, "message: the session failed");
  if (request.seq != seq_ + 1) {
    throw Error(ErrorCode::sequence,
                "message: /seq: expected " + std::to_string(seq_ + 1) + ", found " + std::to_string(request.seq));
  }
  check_count(request.frame);
  source_.frame = &request.frame;
  // Each object moved in bulk once, and as much again that vectors grow by; small frames always.
  source_.worth_keeping = 4 * objects() + 4096;
  const bool draws = begin_drawing();
  const std::optional<double> before = world().time();
  try {
    replay_->step();
    if (record_) record_->add(last_frame());
  } catch (...) {
    // The world refuses a frame before it changes anything; whatever else fails leaves half a frame.
    broken_ = world().time() != before;
    throw;
  }
  seq_ = request.seq;
  has_drawn_ = draws;
  if (draws) std::swap(drawn_, drawing_now_);
  for (const Answer& answer : answers().views) hash_.add(answer);
  drop(last_frame().drop_viewers);
  make_reply(request);
  return reply_;
}

void Session::drop(const std::vector<ViewerId>& viewers) {
  for (const ViewerId viewer : viewers) {
    if (told_.erase(viewer) > 0) unsure_.insert(viewer);
  }
}

void Session::resume() {
  fresh_ = true;
  for (const auto& [viewer, told] : told_) unsure_.insert(viewer);
  told_.clear();
}

void Session::make_reply(const FrameRequest& request) {
  reply_.seq = seq_;
  reply_.time = world().time().value_or(0.0);
  reply_.bulk = request.bulk;
  reply_.wanted = request.reply != ReplyKind::none;
  if (!reply_.wanted) return reply_.answers.clear();
  const bool full = fresh_ || request.reply == ReplyKind::full;
  reply_.answers.resize(answers().views.size());
  for (std::size_t i = 0; i < reply_.answers.size(); ++i) {
    const Answer& answer = answers().views[i];
    ViewerReply& reply = reply_.answers[i];  // kept for its memory
    reply.viewer = answer.viewer;
    reply.full = full || unsure_.contains(answer.viewer);
    unsure_.erase(answer.viewer);
    reply.visible.clear();
    reply.added.clear();
    reply.removed.clear();
    std::vector<ObjectId>& told = told_[answer.viewer];
    if (reply.full) {
      reply.visible = answer.visible;
    } else {
      std::set_difference(answer.visible.begin(), answer.visible.end(), told.begin(), told.end(),
                          std::back_inserter(reply.added));
      std::set_difference(told.begin(), told.end(), answer.visible.begin(), answer.visible.end(),
                          std::back_inserter(reply.removed));
    }
    told = answer.visible;
  }
  fresh_ = false;
}

Explanation Session::explain(const ExplainRequest& request) const {
  if (seq_ == 0) throw Error(ErrorCode::sequence, "message: expected a frame before the first explain");
  if (dimension() == 3 && !ExactRays::available()) {
    throw Error(ErrorCode::limit, "message: the 3D reference needs Embree, which this server was built without");
  }
  const auto view =
      std::find_if(views().begin(), views().end(), [&](const View& v) { return v.viewer == request.viewer; });
  if (view == views().end()) {
    throw Error(ErrorCode::unknown_object, "message: /viewer: expected the id of a viewer of the last frame, found " +
                                               std::to_string(request.viewer));
  }
  if (!world().has(request.object)) {
    throw Error(ErrorCode::unknown_object, "message: /object: expected the id of an object that is there, found " +
                                               std::to_string(request.object));
  }
  return gridcull::explain(world().objects(), lattice(), *view, request.object, explain_rays);
}

}  // namespace gridcull
