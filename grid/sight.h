// Rounding of keys and of points on their way to the viewer: what convex_piece.h's slack pays for.
#pragma once

#include "gridcull/grid/piece_silhouette.h"

namespace gridcull {

/// Bound, in metres, on how far a computed point `origin + rotation * local`, or a plane's height over `apex`, lies
/// from the true one, for locals no farther out than the piece reaches. With u = 2^-53, P and V the sums of magnitudes
/// of position and viewpoint, L the reach, |.|_1 <= sqrt(3) |.|:
///   origin = position - viewpoint: u (P + V);   apex = rotation^T origin: 5 u sqrt(3) (P + V);
///   rotation * local: 5 u sqrt(3) L;   final sums: u (P + V + L);
///   to_world's own roundings: 5 u sqrt(3) L + u (P + L);
///   the rotation's columns: entries within 8 u of an orthonormal matrix's (unit quaternions to 4e-16): 24 u (P + V +
///   L)
/// together below 36 u (P + V) + 44 u L, taken as 64 u = 2^-47 each.
double sight_blur(const ConvexPiece& piece, const SightFrame& frame);

/// A distance from a few correctly rounded operations (relative error below 2^-49), as a key for occluders or tests.
inline double rounded_up(double distance) { return distance * (1.0 + 0x1p-48); }
inline double rounded_down(double distance) { return distance * (1.0 - 0x1p-48); }

}  // namespace gridcull
