// People who walk through a building, steered by DetourCrowd, as a source of frames.
#pragma once

#include <memory>
#include <random>
#include <vector>

#include <gridcull/sim/frames.h>
#include <recastnavigation/DetourCrowd.h>

#include "floor_plan.h"
#include "walkable.h"

struct CrowdOptions {
  int people = 1000;
  int viewers = 1000;   ///< the first so many people look
  double fov = 170.0;   ///< degrees
  double range = 60.0;  ///< metres
  double seconds = 30.0, step = 0.1;
};

class Crowd final : public gridcull::FrameSource {
 public:
  Crowd(const FloorPlan& plan, const CrowdOptions& options);

  /// The building; ids 0, 1, ...; the people follow.
  const gridcull::Scene& scene() const { return scene_; }
  /// Frame 0 adds the people, each later one is a step of the crowd.
  bool next(gridcull::Frame& out) override;
  std::string name(gridcull::ObjectId person) const;

 private:
  struct CrowdDeleter {
    void operator()(dtCrowd* crowd) const { dtFreeCrowd(crowd); }
  };
  void build(const FloorPlan& plan);
  void fill(const FloorPlan& plan);
  void send_on(int person);
  void step();
  gridcull::Vec3 place(int person) const;
  gridcull::ObjectId id(int person) const;
  gridcull::Frame first_frame() const;

  CrowdOptions options_;
  gridcull::Scene scene_{};
  std::vector<gridcull::Vec2> goals_{};
  NavMesh mesh_;
  std::unique_ptr<dtCrowd, CrowdDeleter> crowd_;
  std::minstd_rand dice_{1};
  std::vector<double> headings_{};  ///< radians
  std::uint64_t steps_ = 0;
};
