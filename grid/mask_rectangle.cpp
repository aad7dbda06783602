#include "gridcull/grid/mask_rectangle.h"

#include <algorithm>

namespace gridcull::masking {
namespace {

/// Reciprocals of the depths that the box reaches, above 0; where one is not, every direction to its side is meant.
struct Depths {
  double per_near, per_far;
};

/// Pixels [from, to) for u in [low, high] / depth; false: none. Quotients are right to 2^-51 of themselves, and those
/// that matter are below the tangent: far within the margin.
bool pixel_range(double low, double high, const Depths& d, double tangent, double scale, double margin, int pixels,
                 int& from, int& to) {
  const double a = low * (low < 0.0 ? d.per_near : d.per_far), b = high * (high < 0.0 ? d.per_far : d.per_near);
  const double left = std::max((a + tangent) * scale - margin, 0.0), right = (b + tangent) * scale + margin;
  if (!(left < pixels && right >= 0.0)) return false;
  from = static_cast<int>(left);
  to = static_cast<int>(std::min(right, pixels - 0.5)) + 1;
  return true;
}

}  // namespace

bool rectangle_about(const MaskFace& face, const Vec3& low, const Vec3& high, Rectangle& out) {
  // The shape's own depth is less by what it was grown by, so below 0 here; and the quotients stay numbers.
  if (!(high.z > 0x1p-1000)) return false;
  const Window& w = face.window;
  const Depths d{low.z > 0x1p-1000 ? 1.0 / low.z : 0x1p1000, 1.0 / high.z};
  return pixel_range(low.x, high.x, d, face.tangent_x, face.scale_x, w.margin_x, w.width, out.x0, out.x1) &&
         pixel_range(low.y, high.y, d, face.tangent_y, face.scale_y, w.margin_y, w.height, out.y0, out.y1);
}

bool box_on_cube_face(const MaskFace& face, int index, const Vec3& low, const Vec3& high, Rectangle& out) {
  const int axis = index / 2, right = axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
  const double far = index % 2 == 0 ? high[axis] : -low[axis], near = index % 2 == 0 ? low[axis] : -high[axis];
  return rectangle_about(face, {low[right], low[up], near}, {high[right], high[up], far}, out);
}

}  // namespace gridcull::masking
