#include "gridcull/service/server/hub.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/server/secrets.h"
#include "gridcull/sim/stats.h"

namespace gridcull {
namespace {

/// Counts a session while it is made, whatever becomes of it.
class Opening {
 public:
  Opening(std::mutex& mutex, std::uint64_t& count) : mutex_(mutex), count_(count) {}
  ~Opening() {
    const std::lock_guard lock(mutex_);
    --count_;
  }

 private:
  std::mutex& mutex_;
  std::uint64_t& count_;
};

[[noreturn]] void refuse_unknown() {
  throw Error(ErrorCode::forbidden, "message: expected a session that is there and its token");
}

}  // namespace

void Hub::update_gauge() { metrics_.sessions.Set(static_cast<double>(sessions_.size())); }

std::shared_ptr<HeldSession> Hub::open(OpenRequest request, const std::shared_ptr<SessionListener>& client) {
  {
    const std::lock_guard lock(mutex_);
    if (sessions_.size() + opening_ >= options_.max_sessions) {
      throw Error(ErrorCode::limit, "message: expected at most " + std::to_string(options_.max_sessions) + " sessions");
    }
    ++opening_;
  }
  const Opening opening(mutex_, opening_);
  request.options.max_memory = options_.max_memory;
  SessionKey key{new_token().substr(0, 16), new_token()};
  const std::string record = options_.record.empty() ? "" : options_.record + "/" + key.session;
  auto held = std::make_shared<HeldSession>(key, std::move(request), Session::Limits{options_.max_objects}, record);
  held->client = client;
  held->summarise(true);
  const std::lock_guard lock(mutex_);
  sessions_.emplace(key.session, held);
  update_gauge();
  return held;
}

std::shared_ptr<HeldSession> Hub::find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(id);
  if (found == sessions_.end()) refuse_unknown();
  return found->second;
}

std::shared_ptr<HeldSession> Hub::resume(const SessionKey& key, const std::shared_ptr<SessionListener>& client) {
  std::shared_ptr<HeldSession> held = find(key.session);
  if (!same_secret(held->key.token, key.token)) {
    refuse_unknown();
  }
  const std::unique_lock lock = held->lock_if_idle();
  if (held->ended) refuse_unknown();
  const std::shared_ptr<SessionListener> before = held->client.lock();
  if (before && before != client) before->taken_over();
  held->client = client;
  held->left.reset();
  held->session.resume();
  held->summarise(true);
  return held;
}

void Hub::end(HeldSession& held) {
  held.ended = true;
  held.client.reset();
  for (const auto& watcher : held.watchers) {
    if (const std::shared_ptr<SessionListener> there = watcher.lock()) there->watched_ended();
  }
  held.watchers.clear();
}

void Hub::close(const std::shared_ptr<HeldSession>& held) {
  end(*held);
  const std::lock_guard lock(mutex_);
  sessions_.erase(held->key.session);
  update_gauge();
}

void Hub::leave(const std::shared_ptr<HeldSession>& held, const SessionListener* client) {
  const std::lock_guard lock(held->mutex);
  const std::shared_ptr<SessionListener> now = held->client.lock();
  if (now && now.get() != client) return;  // somebody else took it over
  held->client.reset();
  held->left = std::chrono::steady_clock::now();
  held->summarise(false);
}

void Hub::sweep() {
  const auto now = std::chrono::steady_clock::now();
  std::vector<std::shared_ptr<HeldSession>> ended;  // their ends may take a while: outside the lock
  const std::lock_guard lock(mutex_);
  for (auto at = sessions_.begin(); at != sessions_.end();) {
    bool over = false;
    // One that is at work has a client.
    if (const std::unique_lock held(at->second->mutex, std::try_to_lock); held.owns_lock()) {
      over = at->second->left && now - *at->second->left > options_.keep;
      if (over) end(*at->second);
    }
    if (over) {
      ended.push_back(std::move(at->second));
      at = sessions_.erase(at);
    } else {
      ++at;
    }
  }
  update_gauge();
}

nlohmann::ordered_json Hub::list() const {
  std::vector<std::shared_ptr<HeldSession>> all;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, held] : sessions_) all.push_back(held);
  }
  nlohmann::ordered_json sessions = nlohmann::ordered_json::array();
  for (const auto& held : all) {
    const Session& session = held->session;  // its name and kind never change
    const SessionSummary now = held->summary();
    sessions.push_back({{"session", held->key.session},
                        {"name", session.name()},
                        {"method", session.method()},
                        {"dimension", session.dimension()},
                        {"objects", now.objects},
                        {"viewers", now.viewers},
                        {"seq", now.seq},
                        {"connected", now.connected},
                        {"pvs_hash", hash_text(now.pvs_hash)}});
  }
  return {{"sessions", std::move(sessions)}};
}

}  // namespace gridcull
