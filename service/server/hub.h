// All sessions of a server, by id. Functions may be called from any thread.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gridcull/service/server/metrics.h"
#include "gridcull/service/server/server_options.h"
#include "gridcull/service/session.h"

namespace gridcull {

/// Who is told what happens to a session. Called with the session's lock held: post, do not wait.
class SessionListener {
 public:
  virtual ~SessionListener() = default;
  /// The session has another client from now on.
  virtual void taken_over() = 0;
  /// A message for those who watch.
  virtual void watched(std::shared_ptr<const std::string> message) = 0;
  /// The session that it watches has ended.
  virtual void watched_ended() = 0;
};

/// A session is at work: try again. Threads that serve sockets never wait for a session.
struct SessionBusy {};

/// What the list of sessions says; kept apart so that listing waits for no session.
struct SessionSummary {
  std::size_t objects = 0, viewers = 0;
  std::uint64_t seq = 0, pvs_hash = 0;
  bool connected = true;
};

/// A session and who uses it. All but `key` under the lock.
struct HeldSession {
  HeldSession(SessionKey k, OpenRequest open, const Session::Limits& limits, const std::string& record)
      : key(std::move(k)), session(std::move(open), limits, record) {}

  const SessionKey key;
  std::mutex mutex;
  Session session;
  std::weak_ptr<SessionListener> client{};                      ///< nobody: it waits for its client
  std::optional<std::chrono::steady_clock::time_point> left{};  ///< when its client went; none while it is there
  std::vector<std::weak_ptr<SessionListener>> watchers{};
  bool ended = false;  ///< closed, broken or swept away: nobody may use it any more

  /// The lock, when the session is not at work. Throws SessionBusy.
  std::unique_lock<std::mutex> lock_if_idle() {
    std::unique_lock lock(mutex, std::try_to_lock);
    if (!lock.owns_lock()) throw SessionBusy{};
    return lock;
  }
  /// Under the lock: writes down what the list says.
  void summarise(bool connected) {
    const std::lock_guard guard(summary_mutex_);
    summary_ = {session.objects(), session.world().viewer_count(), session.seq(), session.pvs_hash(), connected};
  }
  SessionSummary summary() const {
    const std::lock_guard guard(summary_mutex_);
    return summary_;
  }

  /// Sizes of exact sets as last audited, by viewer; under a lock of their own.
  void note_exact(ViewerId viewer, std::size_t size) {
    const std::lock_guard lock(exact_mutex_);
    exact_[viewer] = size;
  }
  std::optional<std::size_t> exact(ViewerId viewer) const {
    const std::lock_guard lock(exact_mutex_);
    const auto found = exact_.find(viewer);
    return found == exact_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  mutable std::mutex summary_mutex_;
  SessionSummary summary_{};
  mutable std::mutex exact_mutex_;
  std::map<ViewerId, std::size_t> exact_;
};

class Hub {
 public:
  Hub(const ServerOptions& options, Metrics& metrics) : options_(options), metrics_(metrics) {}

  /// Throws Error(limit), and what Session's constructor throws.
  std::shared_ptr<HeldSession> open(OpenRequest request, const std::shared_ptr<SessionListener>& client);
  /// Throws Error(forbidden) for a session that is not there or another token, SessionBusy.
  std::shared_ptr<HeldSession> resume(const SessionKey& key, const std::shared_ptr<SessionListener>& client);
  /// For watching. Throws Error(forbidden).
  std::shared_ptr<HeldSession> find(const std::string& id) const;
  /// The session ends, and those who watch it are told. Its lock is held.
  void close(const std::shared_ptr<HeldSession>& held);
  /// The client's connection ended; the session waits for it to come back.
  void leave(const std::shared_ptr<HeldSession>& held, const SessionListener* client);
  /// Ends sessions whose client has been away for too long.
  void sweep();

  /// GET /v1/sessions.
  nlohmann::ordered_json list() const;

 private:
  void update_gauge();
  static void end(HeldSession& held);

  const ServerOptions& options_;
  Metrics& metrics_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<HeldSession>> sessions_;
  std::uint64_t opening_ = 0;  // sessions that are being made
};

}  // namespace gridcull
