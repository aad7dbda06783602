// Drawing is a sink: the engine hands cells and volumes to this interface while it answers a view;
// an SVG file, the viewer page and a recorder are implementations.
#pragma once

#include <span>

#include "gridcull/core/ids.h"
#include "gridcull/core/vec.h"

namespace gridcull {

enum class CellLayer {
  visited,       ///< in the view volume and not hidden; `silhouette`: a node of the index that was looked into
  opaque,        ///< O: wholly inside one occluder
  hidden,        ///< H: wholly hidden from the viewer; `silhouette`: so is what hangs in this node of the index
  touched,       ///< I: an object may touch it
  tbv,           ///< T: a temporal bounding volume touches it
  line_of_sight  ///< seed cells of the traversal
};

/// Boxes are [low, high] in metres and stand for one cell, a run of cells or a node of an index, whose sides are whole
/// cells and which may stick out of the lattice; or, `silhouette` in 2D, for some static objects, as tight as they are.
/// In 2D z is 0.
class DrawSink {
 public:
  virtual ~DrawSink() = default;
  virtual void cells(CellLayer layer, const Vec3& low, const Vec3& high) = 0;
  /// A temporal bounding volume: ball (2D: disc) about `centre`; `revealed` in this frame by this view.
  virtual void tbv(ObjectId object, const Vec3& centre, double radius, bool revealed) = 0;
  /// 2D, `silhouette`: exactly what the viewer sees, a closed polygon about the viewpoint, counter-clockwise, metres;
  /// the range's circle is drawn as chords.
  virtual void region(std::span<const Vec2> /*outline*/) {}
};

/// Whose view is drawn where.
struct Drawing {
  ViewerId viewer;
  DrawSink* sink;
};

}  // namespace gridcull
