// Balls seen from a viewpoint: nested discs for the coverage mask and slices for tests. Each is a tangent cone of a
// concentric ball, so that the mask needs nothing but cover_ball() and open_ball().
#pragma once

#include <array>
#include <span>

namespace gridcull {

/// `radius`: of the concentric ball whose tangent cone it is; `key`: the distance by which every ray of that cone has
/// entered the ball, the key at which it may enter the mask. Metres.
struct BallSection {
  double radius;
  double key;
};

/// Fractions of the radius for the sections; the last is the whole silhouette.
inline constexpr std::array<double, 3> ball_fractions{0.55, 0.85, 1.0};

/// `distance` of the viewpoint from the centre and `radius` within relative error 2^-50 of the truth's. Ascending
/// keys; returns how many: fractions.size(), or 0 when the viewpoint is in the ball or so near that the silhouette
/// opens to almost a half-space.
int ball_sections(double distance, double radius, std::span<const double> fractions, std::span<BallSection> out);

/// Radius of the concentric ball whose tangent cone holds all directions in which the ball is entered at distance `far`
/// or nearer; rounded up, at most a little more than `radius`. 0 when there are none: `far` is below distance - radius.
double ball_slice_radius(double distance, double radius, double far);

/// Nearest and farthest distance at which a ray enters the ball (rounded down and up); {0, 0} from inside.
std::array<double, 2> ball_entrance(double distance, double radius);

}  // namespace gridcull
