// One traversal of a box hierarchy against the view volume and all active shadow frusta: Hudson et al. 1997, section 5.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/methods/exact_overlap.h"
#include "gridcull/methods/image_polygon.h"
#include "gridcull/methods/shadow_frustum.h"
#include "gridcull/methods/shadow_world.h"
#include "gridcull/methods/view_test.h"

namespace gridcull {

/// At most 64: which frusta a box may still lie in is one word.
inline constexpr std::size_t most_occluders = 64;

class ShadowWalk {
 public:
  /// What one view asks for. All must outlive the walk.
  struct Task {
    const ShadowWorld* world = nullptr;
    std::span<const std::uint32_t> holders{};  ///< places of what holds the viewpoint
    std::span<const ShadowFrustum* const> frusta{};
    const ViewTest* test = nullptr;
    ObjectId rides = no_id;
    bool unions = true, exact = false;
  };

  /// Forgets the last view.
  void begin(const Task& task, Answer& answer);
  /// Adds what may be seen of the tree's objects to the answer, in no order.
  void run(const BoxTree& tree);

  /// How many objects each frustum hid, alone.
  std::span<const std::uint64_t> hidden_by() const { return hidden_by_; }
  std::uint64_t hidden_by_unions() const { return hidden_by_unions_; }

 private:
  void visit(const BoxTree& tree, std::uint32_t node, std::uint64_t active);
  void visit_object(std::uint32_t place, std::uint64_t active);
  bool may_be_in_view(const SightBox& box) const;
  template <class Occludee>
  bool hides(const Occludee& occludee, std::uint64_t& active, std::uint64_t objects);
  bool lies_beside(const ShadowFrustum& frustum, const SightBox& box);
  bool lies_beside(const ShadowFrustum&, const SightBall&) { return false; }
  /// What an object is tested with.
  struct Outline {
    const FlatObject* object = nullptr;
    const PlacedBound* bound = nullptr;  ///< null: the object's own corners
    std::optional<SightBall> ball{};     ///< of what is round
    double blur = 0.0;                   ///< metres by which corners may be off, as seen from the eye
  };
  Outline outline_of(std::uint32_t place) const;
  bool is_hidden(const Outline& outline, const SightBox& box, std::uint64_t active);
  void list_points(const Outline& outline);
  bool hides_outline(const Outline& outline, const SightBox& box, std::uint64_t active);
  bool hides_together(std::span<const std::uint32_t> numbers);

  Task task_{};
  Answer* answer_ = nullptr;
  Vec3 eye_{0.0};
  bool flat_ = false;
  std::vector<std::uint64_t> hidden_by_{};
  std::uint64_t hidden_by_unions_ = 0;
  ImagePolygon polygon_{};
  UnionScratch scratch_{};
  std::vector<VolumeEdge> edges_{};
  std::vector<Vec3> points_{};
  std::vector<std::uint32_t> beyond_{};
  std::vector<std::uint64_t> within_{};
};

}  // namespace gridcull
