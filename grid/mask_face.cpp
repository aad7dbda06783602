#include "gridcull/grid/mask_face.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "gridcull/grid/mask_clip.h"

namespace gridcull {
namespace {

constexpr double widest = 2.5;
/// Polygons are clipped at this tangent, well outside the widest window, or at 2^17 pixels.
constexpr double guard_tangent = 4.0;
constexpr double guard_pixels = 0x1p17;

void set_form(double* out, const Vec3& v) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

}  // namespace

bool MaskFace::covered(int x, int y) const {
  if (window.open_blocks == 0) return true;
  const int block = y / masking::block_height * window.blocks + x / masking::block_width;
  return (window.words[8 * block + y % 8] >> (x % 64) & 1u) != 0;
}

void set_geometry(MaskFace& face, const Vec3& right, const Vec3& up, const Vec3& forward, double tangent_x,
                  double tangent_y, int resolution) {
  masking::Window& w = face.window;
  face.right = right, face.up = up, face.forward = forward;
  face.tangent_x = tangent_x, face.tangent_y = tangent_y;
  const double longer = std::max(tangent_x, tangent_y);
  w.width = std::max(8, static_cast<int>(std::lround(resolution * (tangent_x / longer))));
  w.height = std::max(8, static_cast<int>(std::lround(resolution * (tangent_y / longer))));
  const double middle_x = 0.5 * w.width, middle_y = 0.5 * w.height;
  face.scale_x = middle_x / tangent_x, face.scale_y = middle_y / tangent_y;
  face.step_y = 1.0 / face.scale_y;
  face.norm_x = std::sqrt(1.0 + tangent_x * tangent_x), face.norm_y = std::sqrt(1.0 + tangent_y * tangent_y);
  set_form(w.form_x, face.scale_x * right + middle_x * forward);
  set_form(w.form_y, face.scale_y * up + middle_y * forward);
  set_form(w.form_w, forward);
  set_form(w.corner, forward - tangent_x * right - tangent_y * up);
  set_form(w.per_x, (1.0 / face.scale_x) * right);
  set_form(w.per_y, (1.0 / face.scale_y) * up);
  w.step = 1.0 / face.scale_x;
  w.guard_x = std::min(guard_tangent * face.scale_x, guard_pixels);
  w.guard_y = std::min(guard_tangent * face.scale_y, guard_pixels);
  // See coverage_mask.cpp, "Margins".
  w.slack_x = 0x1p-38 * (face.scale_x + middle_x), w.slack_y = 0x1p-38 * (face.scale_y + middle_y);
  w.margin_x = 0x1p-32 * face.scale_x + 0x1p-30, w.margin_y = 0x1p-32 * face.scale_y + 0x1p-30;
  w.blocks = (w.width + masking::block_width - 1) / masking::block_width;
  w.strips = (w.height + masking::block_height - 1) / masking::block_height;
  w.coarse = (w.blocks + 63) / 64;
}

void set_cube_face(MaskFace& face, int index, int resolution) {
  static constexpr int right_of[3] = {1, 0, 0}, up_of[3] = {2, 2, 1};
  Vec3 right(0.0), up(0.0), forward(0.0);
  const int axis = index / 2;
  right[right_of[axis]] = 1.0;
  up[up_of[axis]] = 1.0;
  forward[axis] = index % 2 == 0 ? 1.0 : -1.0;
  set_geometry(face, right, up, forward, 1.0, 1.0, resolution);
}

bool set_window(MaskFace& face, const ViewVolume& volume, int resolution) {
  if (volume.end() - volume.begin() != 4) return false;
  // Sides come as left, right, low, high: normals t X + Y, t X - Y, s X + Z, s X - Z (core/view_volume.cpp).
  const Vec3 &left = volume.begin()[0].normal, &right = volume.begin()[1].normal;
  const Vec3 &low = volume.begin()[2].normal, &high = volume.begin()[3].normal;
  const Vec3 forward = glm::normalize(volume.axis());
  const Vec3 across = left - right;
  const Vec3 x = glm::normalize(across - glm::dot(across, forward) * forward), y = glm::cross(forward, x);
  // The pyramid's edges; their projections bound the window whatever the rounding of the axes.
  double tangent_x = 0.0, tangent_y = 0.0;
  for (const Vec3& side : {left, right}) {
    for (const Vec3& level : {low, high}) {
      Vec3 edge = glm::cross(side, level);
      if (glm::dot(edge, forward) < 0.0) edge = -edge;
      const double depth = glm::dot(edge, forward);
      if (!(std::fabs(glm::dot(edge, x)) <= widest * depth && std::fabs(glm::dot(edge, y)) <= widest * depth)) {
        return false;
      }
      tangent_x = std::max(tangent_x, std::fabs(glm::dot(edge, x)) / depth);
      tangent_y = std::max(tangent_y, std::fabs(glm::dot(edge, y)) / depth);
    }
  }
  // Rounding outward: every number here is right to 2^-49.
  set_geometry(face, x, y, forward, tangent_x + 0x1p-40, tangent_y + 0x1p-40, resolution);
  return true;
}

std::size_t block_count(const MaskFace& face) {
  return static_cast<std::size_t>(face.window.blocks) * static_cast<std::size_t>(face.window.strips);
}

std::size_t coarse_count(const MaskFace& face) {
  return static_cast<std::size_t>(face.window.coarse) * static_cast<std::size_t>(face.window.strips) +
         block_count(face) + 8;
}

void clear(MaskFace& face, MaskBlock* blocks, std::uint64_t* coarse) {
  masking::Window& w = face.window;
  w.words = blocks->rows;
  w.full = coarse;
  w.columns = coarse + w.coarse * w.strips;
  w.open_blocks = w.blocks * w.strips;
  std::memset(blocks, 0, block_count(face) * sizeof(MaskBlock));
  std::memset(coarse, 0, coarse_count(face) * sizeof(std::uint64_t));
  if (const int columns = w.width % 64; columns != 0) {
    for (int strip = 0; strip < w.strips; ++strip) {
      MaskBlock& last = blocks[strip * w.blocks + w.blocks - 1];
      for (std::uint64_t& row : last.rows) row = ~std::uint64_t{0} << columns;
      w.columns[strip * w.blocks + w.blocks - 1] = ~std::uint64_t{0} << columns;
    }
  }
  for (int row = w.height % 8; row != 0 && row < 8; ++row) {
    for (int k = 0; k < w.blocks; ++k) blocks[(w.strips - 1) * w.blocks + k].rows[row] = ~std::uint64_t{0};
  }
}

bool beyond_side(const MaskFace& face, const Vec3& normal, masking::Polygon& out) {
  // A square a little larger than the face, cut by the plane; rounding moves a corner by less than the margins.
  constexpr double half = 1.25;
  const std::array<Vec2, 4> square{Vec2{-half, -half}, Vec2{half, -half}, Vec2{half, half}, Vec2{-half, half}};
  const Vec3 n = face.to_face(normal);
  const auto depth = [&](const Vec2& p) { return -(n.x * p.x + n.y * p.y + n.z) - 0x1p-40; };
  out.count = 0;
  const auto add = [&](const Vec2& p) {
    out.x[out.count] = masking::snapped((p.x + face.tangent_x) * face.scale_x);
    out.y[out.count++] = masking::snapped((p.y + face.tangent_y) * face.scale_y);
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec2 &a = square[k], &b = square[(k + 1) % 4];
    const double da = depth(a), db = depth(b);
    if (da >= 0.0) add(a);
    if ((da >= 0.0) != (db >= 0.0)) add(a + da / (da - db) * (b - a));
  }
  if (out.count < 3) return false;
  masking::pad(out);
  out.margin_x = face.window.margin_x, out.margin_y = face.window.margin_y;
  return true;
}

}  // namespace gridcull
