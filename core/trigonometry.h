// Sine and cosine with the same bits on every machine.
#pragma once

#include <span>

namespace gridcull {

struct SinCos {
  double sin;
  double cos;
};

/// Sine and cosine of `angle` (radians, finite), error below 2 ulp for |angle| <= 1e5.
/// The C library picks its kernel by processor (with or without fused multiply-add), so its last bit
/// differs between machines; answers must not. Exact at 0: {0, 1}.
SinCos stable_sincos(double angle);

/// The same bits for many angles, in about half the time; `out` has as many places.
void stable_sincos(std::span<const double> angles, std::span<SinCos> out);

}  // namespace gridcull
