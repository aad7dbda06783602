// The image-space coverage mask of the method `silhouette` in 3D: which directions from one viewpoint are covered by
// occluders so far (Greene, Kass and Miller 1993; Zhang and others 1997; the layout of 64 x 8 bits after
// Hasselgren, Andersson and Akenine-Moeller 2016). One bit a pixel and no depth: whoever fills it goes front to back.
//
// Conservative on both sides: a pixel is covered only when the occluder covers all of it, and a test looks at
// every pixel that the shape may touch. So `false` from a test is proof that what was covered hides the shape.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/core/view_volume.h"
#include "gridcull/grid/instruction_set.h"
#include "gridcull/grid/mask_face.h"

namespace gridcull {

/// Not thread-safe: one mask a thread.
///
/// Geometry is relative to the viewpoint, in world axes, metres; magnitudes 1e-9 .. 1e12. Each vector stands for any
/// true one whose coordinates differ from it by up to 2^-40 of its largest coordinate, likewise each radius, and a
/// box's bounds by up to 2^-40 of its largest: the answers hold for all of those.
class CoverageMask {
 public:
  /// A mask with nothing to see; `isa` must be supported (is_supported()).
  explicit CoverageMask(InstructionSet isa);

  /// Prepares for a view from `volume.apex()`. A pyramid whose tangents are at most 2.5 gets one face, its window;
  /// any other view the six faces of a cube with world axes, on which pixels wholly outside the view are
  /// covered from the start. `resolution`: pixels along a face's longer side, 8 .. 8192, a multiple of 8.
  /// Allocates only when it needs more than ever before.
  void begin(const ViewVolume& volume, int resolution);

  /// The most that begin() allocates for a resolution: the six faces of a cube.
  static std::uint64_t bytes_for(int resolution);

  /// Every pixel is covered: nothing more can be seen.
  bool full() const { return open_blocks_ == 0; }

  // Under-estimates: cover the pixels wholly inside.
  /// The directions that meet a ball; |centre| > radius > 0, else nothing happens.
  void cover_ball(const Vec3& centre, double radius);
  /// The convex cone spanned by `rays` in cyclic order, either turn; 3 .. 64 of them, all within an open half-space.
  void cover_convex(const Vec3* rays, int count);

  // Over-estimates: true when a pixel that the shape may touch is uncovered; false: every part of the shape that
  // lies in the view is hidden.
  bool open_ball(const Vec3& centre, double radius) const;
  /// The rectangle about its image: cheaper, and open whenever open_ball() is.
  bool open_about_ball(const Vec3& centre, double radius) const;
  /// The ball lies wholly outside the one window, if there is one: neither test nor cover would find a pixel.
  bool beyond_window(const Vec3& centre, double radius) const;
  /// As cover_convex(); in any other order of the rays the answer is still safe.
  bool open_convex(const Vec3* rays, int count) const;
  /// Axis-aligned box, low <= high; the rectangle about its image is tested.
  bool open_box(const Vec3& low, const Vec3& high) const;

  /// Keys of up to eight balls and the pixels they may touch, for open_pixels(): open where open_about_ball() is, or,
  /// for those that stand upright, open_box(). `outlook` came from set_outlook() since begin().
  void place_balls(const masking::Outlook& outlook, const masking::Balls& balls, masking::Batch& out) const {
    kernels_->place_balls(outlook, face(0).window, balls, out);
  }
  void set_outlook(masking::Outlook& outlook) const;
  bool open_pixels(int index, const masking::Rectangle& pixels) const {
    const masking::Window& window = face(index).window;
    return window.open_blocks != 0 && kernels_->open_rectangle(window, pixels, strips_);
  }

  /// Whether the pixel that the direction falls on (rounded: or one beside it) is uncovered; false outside the view.
  /// No proof of anything: what lies there may be seen.
  bool open_towards(const Vec3& direction) const;

  /// Work: strips of eight pixel rows that covers and tests went through since clear_counts().
  std::uint64_t rows() const { return strips_; }
  void clear_counts() { strips_ = 0; }
  /// Memory held.
  std::uint64_t bytes() const;

  /// For drawing and tests.
  int faces() const { return face_count_; }
  const MaskFace& face(int index) const { return faces_[static_cast<std::size_t>(index)]; }

 private:
  /// Faces that a ball may reach, a bit each.
  unsigned faces_near(const Vec3& centre, double radius) const;
  void cover_beyond(const ViewVolume& volume);
  void cover_cone(const masking::Cone& cone);
  void cover_cone(MaskFace& face, const Vec3* rays, int count);
  bool open_cone(const MaskFace& face, const Vec3* rays, int count) const;

  const masking::Kernels* kernels_;
  std::array<MaskFace, 6> faces_;
  int face_count_ = 0;
  int cube_of_ = 0;  // the resolution for which faces_ are those of the cube
  int open_blocks_ = 0;
  std::vector<MaskBlock> blocks_;
  std::vector<std::uint64_t> full_;
  mutable std::uint64_t strips_ = 0;
};

}  // namespace gridcull
