// A running SUMO as a source of frames: every step moves all vehicles and pedestrians, read by TraCI subscriptions.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include <gridcull/sim/frames.h>
#include <gridcull/sim/import_parts.h>

struct TrafficOptions {
  std::string config{};            ///< a .sumocfg
  double step = 0.1;               ///< seconds
  double begin = 0.0, end = 60.0;  ///< seconds; frames come from the step after `begin` to `end`
  std::uint64_t equipped = 40;     ///< vehicles that look, at any time
  double range = 150.0;            ///< metres
};

class Traffic final : public gridcull::FrameSource {
 public:
  /// Starts SUMO and lets it run to `begin`.
  explicit Traffic(const TrafficOptions& options);
  ~Traffic() override;
  Traffic(const Traffic&) = delete;
  Traffic& operator=(const Traffic&) = delete;

  /// Buildings (polygons of SUMO's whose type begins with "building") and bounds; nothing that moves.
  const gridcull::Scene& scene() const { return scene_; }

  /// Lets SUMO take a step. Vehicles that teleport and people who ride are not in the world meanwhile.
  bool next(gridcull::Frame& out) override;

  /// SUMO's name of an object.
  const std::string& name(gridcull::ObjectId id) const { return names_.at(id); }
  std::size_t vehicles() const { return vehicles_; }  ///< in the last frame
  std::size_t people() const { return people_; }

 private:
  void read_buildings();
  void subscribe(const std::vector<std::string>& vehicles, const std::vector<std::string>& people);
  std::vector<gridcull::MoverState> states();

  TrafficOptions options_;
  gridcull::Scene scene_{};
  gridcull::ImportFrames frames_;
  std::unordered_map<gridcull::ObjectId, std::string> names_{};
  struct Size {
    double length, width;  ///< metres
  };
  std::unordered_map<std::string, Size> sizes_{};  ///< of vehicles
  std::size_t vehicles_ = 0, people_ = 0;
};
