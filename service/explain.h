// Why a viewer sees an object, or does not: `gridcull explain` and the wire's `explain`.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gridcull/core/object.h"
#include "gridcull/core/view.h"
#include "gridcull/grid/lattice.h"

namespace gridcull {

struct Explanation {
  enum class Verdict {
    visible,
    hidden,          ///< 3D: no sampled ray sees it
    outside,         ///< of the view volume, or what the viewer rides on, which is never reported
    contains_viewer  ///< the viewpoint lies inside it
  };
  Verdict verdict = Verdict::outside;
  std::vector<ObjectId> by{};  ///< hidden: occluders that together cover it, ascending; none can be spared in 2D
  std::vector<Cell> cells{};   ///< of the grid, that the object may touch; at most `most_cells`
  static constexpr std::size_t most_cells = 100'000;
  std::optional<Vec3> sees{};  ///< visible: its first point on a line of sight, world axes, metres
};

/// "visible", "hidden", "outside", "contains_viewer".
std::string verdict_text(Explanation::Verdict verdict);

/// The wire's message of type "explained".
nlohmann::ordered_json explained_json(const Explanation& explanation, int dimension);

/// By the exact reference, whatever the method says. `rays`: of the 3D reference (core/exact.h). Throws
/// Error(unknown_object), and what the reference throws.
Explanation explain(std::span<const Object> world, const Lattice& lattice, const View& view, ObjectId object, int rays);

}  // namespace gridcull
