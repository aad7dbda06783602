// Pictures after the paper's Figure 1 (Batagelo and Wu 2002): what one viewer's traversal did to the grid or the index,
// which objects it left visible, and what the viewer sees where that is known. In 3D a horizontal slice through the
// viewer's height.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gridcull/core/drawing.h"
#include "gridcull/core/object.h"
#include "gridcull/core/view.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/service/svg_cells.h"

namespace gridcull {

/// Collects what the engine draws.
class PictureSink final : public DrawSink {
 public:
  struct Tbv {
    ObjectId object;
    Vec3 centre;
    double radius;
    bool revealed;
  };

  /// `lattice` is copied.
  explicit PictureSink(const Lattice& lattice) : lattice_(lattice) {}

  void cells(CellLayer layer, const Vec3& low, const Vec3& high) override;
  void tbv(ObjectId object, const Vec3& centre, double radius, bool revealed) override;
  void region(std::span<const Vec2> outline) override { region_.assign(outline.begin(), outline.end()); }

  /// Cells of a layer with the given z index (2D: 0).
  const CellPlane& plane(CellLayer layer, std::int64_t z) const;
  const std::vector<Tbv>& tbvs() const { return tbvs_; }
  const std::vector<Vec2>& region() const { return region_; }

 private:
  Lattice lattice_;
  std::map<std::pair<CellLayer, std::int64_t>, CellPlane> planes_{};
  std::vector<Tbv> tbvs_{};
  std::vector<Vec2> region_{};
};

/// What a picture shows.
struct Picture {
  const Lattice& lattice;
  std::span<const Object> objects{};
  const View& view;
  std::span<const ObjectId> visible{};  ///< ascending
  std::string title{};
  std::string subtitle{};
};

/// The SVG text. `sink` may be nullptr: a method that has no grid shows its objects only.
std::string svg_picture(const Picture& picture, const PictureSink* sink);

}  // namespace gridcull
