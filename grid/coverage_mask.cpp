// Why the answers are conservative.
//
// Cones of up to seven rays are covered without corners (mask_cone_body.h, with a claim of its own); what stands here
// of margins and covers is for other cones, for all tests, and for windows so narrow that a plane through two rays may
// be off by much of a pixel.
//
// Margins. Let P be the true image of a cone on a face's plane and p_k the computed corners, each within (d_x, d_y)
// of the true one. B is the rectangle of half sides d_x, d_y, C the convex hull of the p_k: C lies in P + B, and P in
// C + B. A pixel S whose enlargement S + B lies in C has S + B in P + B, hence S in P (P is closed and convex, B
// compact). A pixel that P touches has S + B touching C. So growing the pixel by B, never the polygon, is right for
// polygons of any shape, slivers too.
//
// d_x: a direction's coordinates err by 2^-40 of the largest, so u = x/w errs by at most
// sqrt(3) (1 + |u|) 2^-40 |d| / w. Within the guards |u|, |v| <= 4 and |d| / w < 6, thus 2^-34; 2^-32 of the scale
// is taken (scale: pixels to a unit of u), which leaves room for size / w = 16 (clip_cone() stretches the margins
// beyond that). To this come rounding to multiples of 2^-32 and the evaluation of an edge's line, together below
// 2^-30 pixels: coordinates are below 2^18, so each of the at most eight roundings in x0 + (y - y0) m equals
// a shift of the line in y by 2^-53 2^18 at most or one of x by as much.
//
// Within (cover). On a row's lower and upper edge, grown by the margin, low = max over the lines of left edges,
// high = min over those of right edges. Where low <= high there is a left edge crossing that height to the left
// and a right one to the right, so the points between lie in C, whatever the order of the corners; the corners of
// the pixel being in C, so is the pixel.
//
// Around (test). Each edge's line is pushed outward until it has every p_k on its inner side, so C lies inside it,
// again whatever the order. A row's span is bounded by the lines where they bound it least, and by C's extent.
//
// Rectangles. A box in the face's axes that holds the shape, with all errors, has its image within [low, high] / depth
// along each axis; margin_x and margin_y pay for the rounding of quotients of at most the tangent. A ball lies in the
// box of its radius about its centre; turning the centre into the face's axes moves it by less than 2^-48 of its
// length, and ball_margin() is 2^-34 of it. Where all columns asked for are covered over a strip's eight rows, so is
// each row.
//
// Pixels outside the view: a ray strictly beyond one side plane of the face by more than its error (`slack`)
// for all rays of a cone puts the whole cone beyond it.
#include "gridcull/grid/coverage_mask.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "gridcull/grid/mask_ball.h"
#include "gridcull/grid/mask_clip.h"
#include "gridcull/grid/mask_cube.h"
#include "gridcull/grid/mask_rectangle.h"

namespace gridcull {
namespace {

using masking::BallPlace;
using masking::Clipped;
using masking::Projection;

/// By how much a ball is shrunk or grown, times its size (mask_ball.cpp); holds the error of its numbers too.
double ball_margin(const Vec3& c, double radius) {
  return 0x1p-34 * (std::fabs(c.x) + std::fabs(c.y) + std::fabs(c.z) + radius);
}

double square(const Vec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

}  // namespace

CoverageMask::CoverageMask(InstructionSet isa) : kernels_(&masking::kernels_of(isa)) {}

std::uint64_t CoverageMask::bytes_for(int resolution) {
  MaskFace face;
  set_cube_face(face, 0, resolution);
  return 6 * (block_count(face) * sizeof(MaskBlock) + coarse_count(face) * sizeof(std::uint64_t));
}

void CoverageMask::begin(const ViewVolume& volume, int resolution) {
  face_count_ = 1;
  const bool single = set_window(faces_[0], volume, resolution);
  if (!single) {
    face_count_ = 6;
    const bool ready = cube_of_ == resolution;
    for (int k = 0; k < 6 && !ready; ++k) set_cube_face(faces_[static_cast<std::size_t>(k)], k, resolution);
  }
  cube_of_ = single ? 0 : resolution;
  std::size_t blocks = 0, coarse = 0;
  for (int k = 0; k < face_count_; ++k) blocks += block_count(face(k)), coarse += coarse_count(face(k));
  if (blocks_.size() < blocks) blocks_.resize(blocks);
  if (full_.size() < coarse) full_.resize(coarse);
  MaskBlock* block = blocks_.data();
  std::uint64_t* full = full_.data();
  open_blocks_ = static_cast<int>(blocks);
  for (int k = 0; k < face_count_; ++k) {
    clear(faces_[static_cast<std::size_t>(k)], block, full);
    block += block_count(face(k));
    full += coarse_count(face(k));
  }
  if (!single && !volume.all_round()) cover_beyond(volume);
}

void CoverageMask::cover_beyond(const ViewVolume& volume) {
  std::uint64_t uncounted = 0;
  for (int k = 0; k < face_count_; ++k) {
    MaskFace& f = faces_[static_cast<std::size_t>(k)];
    for (const HalfSpace& side : volume) {
      masking::Polygon polygon;
      if (f.window.open_blocks == 0 || !beyond_side(f, side.normal, polygon)) continue;
      open_blocks_ -= kernels_->cover_polygon(f.window, polygon, uncounted);
    }
  }
}

void CoverageMask::cover_cone(MaskFace& face, const Vec3* rays, int count) {
  masking::Polygon polygon;
  const Projection where = kernels_->project(face.window, &rays[0].x, count, polygon);
  if (where == Projection::outside) return;
  if (where == Projection::crossing && clip_cone(face.window, rays, count, polygon) != Clipped::polygon) return;
  open_blocks_ -= kernels_->cover_polygon(face.window, polygon, strips_);
}

bool CoverageMask::open_cone(const MaskFace& face, const Vec3* rays, int count) const {
  masking::Polygon polygon;
  const Projection where = kernels_->project(face.window, &rays[0].x, count, polygon);
  if (where == Projection::outside) return false;
  if (where == Projection::crossing) {
    const Clipped clipped = clip_cone(face.window, rays, count, polygon);
    if (clipped != Clipped::polygon) return clipped == Clipped::unsure;
  }
  return kernels_->open_polygon(face.window, polygon, strips_);
}

void CoverageMask::cover_convex(const Vec3* rays, int count) {
  // On a narrower window what a plane through two rays may be off is no longer small beside a pixel.
  constexpr double least_tangent = 0x1p-4;
  const bool wide = std::min(face(0).tangent_x, face(0).tangent_y) >= least_tangent;
  masking::Cone cone;
  if (wide && count <= masking::Cone::max_rays && kernels_->span_cone(&rays[0].x, count, cone)) return cover_cone(cone);
  unsigned near = face_count_ == 6 ? masking::cube_faces_near(rays, count) : 1;
  for (; near != 0; near &= near - 1) {
    MaskFace& f = faces_[static_cast<std::size_t>(std::countr_zero(near))];
    if (f.window.open_blocks != 0) cover_cone(f, rays, count);
  }
}

void CoverageMask::cover_cone(const masking::Cone& cone) {
  unsigned near = face_count_ == 6 ? masking::cube_faces_near_rays(cone.low, cone.high) : 1;
  for (; near != 0; near &= near - 1) {
    masking::Window& window = faces_[static_cast<std::size_t>(std::countr_zero(near))].window;
    if (window.open_blocks != 0) open_blocks_ -= kernels_->cover_cone(window, cone, strips_);
  }
}

bool CoverageMask::open_convex(const Vec3* rays, int count) const {
  unsigned near = face_count_ == 6 ? masking::cube_faces_near(rays, count) : 1;
  for (; near != 0; near &= near - 1) {
    const MaskFace& f = face(std::countr_zero(near));
    if (f.window.open_blocks != 0 && open_cone(f, rays, count)) return true;
  }
  return false;
}

void CoverageMask::cover_ball(const Vec3& centre, double radius) {
  const double inner = radius - ball_margin(centre, radius);
  if (!(inner > 0.0 && square(centre) * (1.0 - 0x1p-40) > radius * radius)) return;
  Vec3 rays[masking::cone_rays];
  bool have_rays = false;
  for (unsigned near = faces_near(centre, inner); near != 0; near &= near - 1) {
    MaskFace& f = faces_[static_cast<std::size_t>(std::countr_zero(near))];
    if (f.window.open_blocks == 0) continue;
    masking::Ellipse ellipse;
    const BallPlace place = masking::place_ball(f, f.to_face(centre), inner, ellipse);
    if (place == BallPlace::ellipse) {
      open_blocks_ -= kernels_->cover_ellipse(f.window, ellipse, strips_);
    } else if (place == BallPlace::crossing) {
      if (!have_rays) masking::rays_within(centre, inner, rays);
      have_rays = true;
      cover_cone(f, rays, masking::cone_rays);
    }
  }
}

bool CoverageMask::open_ball(const Vec3& centre, double radius) const {
  const double outer = radius + ball_margin(centre, radius);
  if (!(square(centre) * (1.0 - 0x1p-40) > outer * outer)) return !full();
  Vec3 rays[masking::cone_rays];
  bool have_rays = false;
  for (unsigned near = faces_near(centre, outer); near != 0; near &= near - 1) {
    const MaskFace& f = face(std::countr_zero(near));
    if (f.window.open_blocks == 0) continue;
    masking::Ellipse ellipse;
    const BallPlace place = masking::place_ball(f, f.to_face(centre), outer, ellipse);
    if (place == BallPlace::ellipse) {
      if (kernels_->open_ellipse(f.window, ellipse, strips_)) return true;
    } else if (place == BallPlace::crossing) {
      if (!have_rays) masking::rays_around(centre, outer, rays);
      have_rays = true;
      if (open_cone(f, rays, masking::cone_rays)) return true;
    }
  }
  return false;
}

bool CoverageMask::open_about_ball(const Vec3& centre, double radius) const {
  const double outer = radius + ball_margin(centre, radius);
  if (!(square(centre) * (1.0 - 0x1p-40) > outer * outer)) return !full();
  for (unsigned near = faces_near(centre, outer); near != 0; near &= near - 1) {
    const MaskFace& f = face(std::countr_zero(near));
    const Vec3 c = f.to_face(centre);
    masking::Rectangle rectangle;
    if (f.window.open_blocks != 0 && !masking::beyond_face(f, c, outer) &&
        masking::rectangle_about(f, c - outer, c + outer, rectangle) &&
        kernels_->open_rectangle(f.window, rectangle, strips_)) {
      return true;
    }
  }
  return false;
}

bool CoverageMask::beyond_window(const Vec3& centre, double radius) const {
  const MaskFace& f = face(0);
  return face_count_ == 1 && masking::beyond_face(f, f.to_face(centre), radius + ball_margin(centre, radius));
}

bool CoverageMask::open_box(const Vec3& low, const Vec3& high) const {
  double size = 0.0;
  for (int k = 0; k < 3; ++k) size = std::max({size, std::fabs(low[k]), std::fabs(high[k])});
  const double margin = 0x1p-39 * size;
  const Vec3 a = low - margin, b = high + margin;
  if (a.x <= 0.0 && a.y <= 0.0 && a.z <= 0.0 && b.x >= 0.0 && b.y >= 0.0 && b.z >= 0.0) return !full();
  masking::Rectangle rectangle;
  if (face_count_ == 1) {
    const masking::Window& w = face(0).window;
    const Projection where = w.open_blocks == 0 ? Projection::outside : kernels_->project_box(w, &a.x, &b.x, rectangle);
    return where == Projection::crossing ||
           (where == Projection::inside && kernels_->open_rectangle(w, rectangle, strips_));
  }
  for (unsigned near = masking::cube_faces_near_box(a, b); near != 0; near &= near - 1) {
    const int k = std::countr_zero(near);
    const MaskFace& f = face(k);
    if (f.window.open_blocks != 0 && masking::box_on_cube_face(f, k, a, b, rectangle) &&
        kernels_->open_rectangle(f.window, rectangle, strips_)) {
      return true;
    }
  }
  return false;
}

void CoverageMask::set_outlook(masking::Outlook& out) const {
  const MaskFace& f = face(0);
  out.cube = face_count_ == 6;
  for (int k = 0; k < 3; ++k) out.right[k] = f.right[k], out.up[k] = f.up[k], out.forward[k] = f.forward[k];
  out.tangent_x = f.tangent_x, out.tangent_y = f.tangent_y;
  out.scale_x = f.scale_x, out.scale_y = f.scale_y;
  out.norm_x = f.norm_x, out.norm_y = f.norm_y;
}

bool CoverageMask::open_towards(const Vec3& d) const {
  const MaskFace& f = face(face_count_ == 6 ? masking::cube_face_of(d) : 0);
  const masking::Window& w = f.window;
  const auto form = [&](const double* g) { return (g[0] * d.x + g[1] * d.y) + g[2] * d.z; };
  const double depth = form(w.form_w);
  if (w.open_blocks == 0 || !(depth > 0.0)) return false;
  const double x = form(w.form_x) / depth, y = form(w.form_y) / depth;
  if (!(x >= 0.0 && y >= 0.0 && x < w.width && y < w.height)) return false;
  return !f.covered(static_cast<int>(x), static_cast<int>(y));
}

unsigned CoverageMask::faces_near(const Vec3& centre, double radius) const {
  return face_count_ == 6 ? masking::cube_faces_near_ball(centre, radius * face(0).norm_x) : 1;
}

std::uint64_t CoverageMask::bytes() const {
  return sizeof(*this) + blocks_.capacity() * sizeof(MaskBlock) + full_.capacity() * sizeof(std::uint64_t);
}

}  // namespace gridcull
