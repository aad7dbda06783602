#include "gridcull/service/server/server.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>  // before Asio: Boost 1.74 does not include it in C++20
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/server/http_front.h"

namespace gridcull {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;

namespace {

/// How long connections have to take leave.
constexpr std::chrono::seconds farewell{5};
/// After a failed accept, mostly for want of file descriptors.
constexpr std::chrono::milliseconds breath{100};

Tcp::endpoint endpoint_of(const ServerOptions& options) {
  boost::system::error_code fault;
  const auto address = asio::ip::make_address(options.address, fault);
  if (fault) throw Error(ErrorCode::usage, "--address: expected an IP address, found " + options.address);
  return {address, options.port};
}

std::string url_of(const Tcp::endpoint& endpoint) {
  const std::string address = endpoint.address().to_string();
  return "http://" + (endpoint.address().is_v6() ? "[" + address + "]" : address) + ":" +
         std::to_string(endpoint.port());
}

}  // namespace

struct Server::Detail {
  explicit Detail(const ServerOptions& options)
      : parts(options), acceptor(strand), signals(strand), sweeper(strand), last(strand), breather(strand) {
    const Tcp::endpoint wanted = endpoint_of(options);
    try {
      acceptor.open(wanted.protocol());
      acceptor.set_option(asio::socket_base::reuse_address(true));
      acceptor.bind(wanted);
      acceptor.listen();
    } catch (const boost::system::system_error& fault) {
      throw Error(ErrorCode::io, options.address + ":" + std::to_string(options.port) +
                                     ": cannot be listened at: " + fault.code().message());
    }
    endpoint = acceptor.local_endpoint();
    origins.emplace(options.address, endpoint.port(), options.allowed_origins);
  }

  /// One thread. A handler that fails, mostly for want of memory, ends its connection, which nobody holds then.
  void serve() {
    for (;;) {
      try {
        context.run();
        return;
      } catch (const std::exception&) {
        parts.metrics.count_rejected("internal");
      }
    }
  }

  void accept() {
    acceptor.async_accept(asio::make_strand(context), [this](boost::system::error_code fault, Tcp::socket socket) {
      if (stopping) return;
      if (fault) {
        breather.expires_after(breath);
        breather.async_wait([this](boost::system::error_code) {
          if (!stopping) accept();
        });
        return;
      }
      welcome(std::move(socket));
      accept();
    });
  }

  void welcome(Tcp::socket&& socket) {
    boost::system::error_code ignored;
    socket.set_option(Tcp::no_delay(true), ignored);
    auto open = std::make_shared<OpenSocket>(sockets);
    if (open->number > parts.options.max_connections) return;  // closes it
    const auto upgraded = [this, open](const std::shared_ptr<Connection>& connection) {
      connection->carry(open);
      note(connection);
    };
    std::make_shared<HttpFront>(boost::beast::tcp_stream(std::move(socket)), parts, *origins, upgraded)->start();
  }

  void note(const std::shared_ptr<Connection>& connection) {
    const std::lock_guard lock(mutex);
    std::erase_if(connections, [](const auto& gone) { return gone.expired(); });
    connections.push_back(connection);
    if (stopping) connection->end("the server stops");
  }

  void sweep() {
    sweeper.expires_after(std::chrono::seconds(1));
    sweeper.async_wait([this](boost::system::error_code fault) {
      if (fault || stopping) return;
      parts.hub.sweep();
      sweep();
    });
  }

  void stop() {
    if (stopping.exchange(true)) return;
    boost::system::error_code ignored;
    acceptor.close(ignored);
    signals.cancel(ignored);
    sweeper.cancel();
    breather.cancel();
    const std::lock_guard lock(mutex);
    for (const auto& weak : connections) {
      if (const auto connection = weak.lock()) connection->end("the server stops");
    }
    work.reset();
    last.expires_after(farewell);
    last.async_wait([this](boost::system::error_code fault) {
      if (!fault) context.stop();
    });
    await_farewells();
  }

  /// The context runs out of work when the last connection is gone, but for `last`.
  void await_farewells() {
    sweeper.expires_after(std::chrono::milliseconds(20));
    sweeper.async_wait([this](boost::system::error_code) {
      {
        const std::lock_guard lock(mutex);
        std::erase_if(connections, [](const auto& gone) { return gone.expired(); });
        if (connections.empty()) {
          context.stop();
          return;
        }
      }
      await_farewells();
    });
  }

  /// Counts sockets from their acceptance to the end of their HTTP front or WebSocket.
  struct OpenSocket {
    explicit OpenSocket(std::atomic<std::uint64_t>& c) : count(c), number(++c) {}
    ~OpenSocket() { --count; }
    std::atomic<std::uint64_t>& count;
    std::uint64_t number;
  };

  // What connections use outlives the context, which holds them.
  ServerParts parts;
  std::optional<Origins> origins;
  std::atomic<bool> stopping = false;
  std::atomic<std::uint64_t> sockets = 0;
  std::mutex mutex;
  std::vector<std::weak_ptr<Connection>> connections;
  asio::io_context context;
  std::optional<asio::executor_work_guard<asio::io_context::executor_type>> work{asio::make_work_guard(context)};
  // What is the server's own, one handler at a time.
  asio::strand<asio::io_context::executor_type> strand{context.get_executor()};
  Tcp::acceptor acceptor;
  asio::signal_set signals;
  asio::steady_timer sweeper, last, breather;
  Tcp::endpoint endpoint;
};

Server::Server(const ServerOptions& options) : detail_(std::make_unique<Detail>(options)) {}
Server::~Server() = default;

std::uint16_t Server::port() const { return detail_->endpoint.port(); }
std::string Server::url() const { return url_of(detail_->endpoint); }

void Server::run(bool signals) {
  Detail& d = *detail_;
  if (signals) {
    d.signals.add(SIGINT);
    d.signals.add(SIGTERM);
    // The terminal is gone; nohup says not to mind.
    struct sigaction before {};
    if (sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) d.signals.add(SIGHUP);
    d.signals.async_wait([&d](boost::system::error_code fault, int) {
      if (!fault) d.stop();
    });
  }
  asio::post(d.strand, [&d] {
    d.accept();
    d.sweep();
  });
  std::vector<std::thread> threads;
  for (int i = 1; i < d.parts.options.threads; ++i) threads.emplace_back([&d] { d.serve(); });
  d.serve();
  for (std::thread& thread : threads) thread.join();
}

void Server::stop() {
  asio::post(detail_->strand, [this] { detail_->stop(); });
}

}  // namespace gridcull
