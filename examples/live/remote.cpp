#include <gridcull/service/client/gridcull_client.h>
#include <gridcull/sim/scene.h>

#include "sight.h"

using namespace gridcull;

namespace {

class RemoteSight final : public Sight {
 public:
  RemoteSight(const Scene& scene, const std::string& host, std::uint16_t port, const std::string& name)
      : dimension_(scene.dimension), client_(host, port) {
    client_.open(nlohmann::json::parse(scene_text(scene)), "silhouette", {{"name", name}});
  }
  ~RemoteSight() override {
    try {
      client_.close();
    } catch (const std::exception&) {  // the server ends a session that nobody resumes by itself
    }
  }

  const Answers& see(const Frame& frame) override {
    Client::Frame told{.time = frame.time};
    for (const ObjectMove& move : frame.set) told.move(move.id, {move.position->x, move.position->y}, *move.heading);
    Frame rest = frame;
    rest.set.clear();
    told.rest = nlohmann::json::parse(frame_text(rest, dimension_));
    answers_.views.clear();
    for (const auto& [viewer, visible] : client_.frame(told)) answers_.views.push_back({viewer, visible});
    return answers_;
  }

 private:
  int dimension_;
  Client client_;
  Answers answers_{};
};

}  // namespace

std::unique_ptr<Sight> make_remote_sight(const Scene& scene, const std::string& address, const std::string& name) {
  const std::size_t colon = address.rfind(':');
  const int port = colon == std::string::npos ? 0 : std::atoi(address.c_str() + colon + 1);
  if (port < 1 || port > 65535) throw std::runtime_error("--server: expected HOST:PORT, found '" + address + "'");
  return std::make_unique<RemoteSight>(scene, address.substr(0, colon), static_cast<std::uint16_t>(port), name);
}
