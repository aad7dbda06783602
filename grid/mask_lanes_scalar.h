// Eight lanes in plain C++: what mask_kernels_body.h asks of an instruction set. Every operation rounds exactly,
// and min, max and select have one meaning (a < b ? a : b), so that all sets give the same bits.
#pragma once

#include <cmath>
#include <cstdint>

namespace gridcull::masking::scalar {

struct Lanes {
  double v[8];
};
/// One bit a lane.
struct Mask {
  unsigned bits;
};
/// Eight 32-bit integers.
struct Ints {
  int v[8];
};
/// The eight rows of a block.
struct Words {
  std::uint64_t v[8];
};

template <class F>
Lanes each_lane(F&& f) {
  Lanes r;
  for (int k = 0; k < 8; ++k) r.v[k] = f(k);
  return r;
}
template <class F>
Mask each_bit(F&& f) {
  Mask m{0};
  for (int k = 0; k < 8; ++k) m.bits |= static_cast<unsigned>(f(k)) << k;
  return m;
}

inline Lanes splat(double a) {
  return each_lane([&](int) { return a; });
}
inline Lanes iota() {
  return each_lane([&](int k) { return static_cast<double>(k); });
}
inline Lanes load(const double* p) {
  return each_lane([&](int k) { return p[k]; });
}
inline void store(double* p, const Lanes& a) {
  for (int k = 0; k < 8; ++k) p[k] = a.v[k];
}
/// Rays 0 .. count - 1 (at most 8), the last one again beyond them.
inline void load_rays(const double* rays, int count, Lanes& x, Lanes& y, Lanes& z) {
  for (int k = 0; k < 8; ++k) {
    const double* ray = rays + 3 * (k < count ? k : count - 1);
    x.v[k] = ray[0], y.v[k] = ray[1], z.v[k] = ray[2];
  }
}
inline Lanes operator+(const Lanes& a, const Lanes& b) {
  return each_lane([&](int k) { return a.v[k] + b.v[k]; });
}
inline Lanes operator-(const Lanes& a, const Lanes& b) {
  return each_lane([&](int k) { return a.v[k] - b.v[k]; });
}
inline Lanes operator*(const Lanes& a, const Lanes& b) {
  return each_lane([&](int k) { return a.v[k] * b.v[k]; });
}
inline Lanes operator/(const Lanes& a, const Lanes& b) {
  return each_lane([&](int k) { return a.v[k] / b.v[k]; });
}
inline Lanes smaller(const Lanes& a, const Lanes& b) {
  return each_lane([&](int k) { return a.v[k] < b.v[k] ? a.v[k] : b.v[k]; });
}
inline Lanes larger(const Lanes& a, const Lanes& b) {
  return each_lane([&](int k) { return a.v[k] > b.v[k] ? a.v[k] : b.v[k]; });
}
inline Lanes magnitude(const Lanes& a) {
  return each_lane([&](int k) { return std::fabs(a.v[k]); });
}
inline Lanes root(const Lanes& a) {
  return each_lane([&](int k) { return std::sqrt(a.v[k]); });
}
inline Mask operator<(const Lanes& a, const Lanes& b) {
  return each_bit([&](int k) { return a.v[k] < b.v[k]; });
}
inline Mask operator<=(const Lanes& a, const Lanes& b) {
  return each_bit([&](int k) { return a.v[k] <= b.v[k]; });
}
inline Mask operator&(Mask a, Mask b) { return {a.bits & b.bits}; }
inline Mask operator^(Mask a, Mask b) { return {a.bits ^ b.bits}; }
inline unsigned bits(Mask a) { return a.bits; }
inline Lanes select(Mask m, const Lanes& yes, const Lanes& no) {
  return each_lane([&](int k) { return (m.bits >> k & 1u) != 0 ? yes.v[k] : no.v[k]; });
}
/// Lanes 1 .. 7 of a, then lane 0 of b.
inline Lanes shift_in(const Lanes& a, const Lanes& b) {
  return each_lane([&](int k) { return k < 7 ? a.v[k + 1] : b.v[0]; });
}
/// Sums and extremes over the lanes, halves together: k and k + 4, then k and k + 2, then k and k + 1.
inline double sum(const Lanes& a) {
  const double* v = a.v;
  return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7]));
}
inline double lowest(const Lanes& a) {
  double r = a.v[0];
  for (int k = 1; k < 8; ++k) r = r < a.v[k] ? r : a.v[k];
  return r;
}
inline double highest(const Lanes& a) {
  double r = a.v[0];
  for (int k = 1; k < 8; ++k) r = r > a.v[k] ? r : a.v[k];
  return r;
}

/// Values of -1 .. 8193.
inline int round_up(double x) {
  const int t = static_cast<int>(x);
  return t + (x > t);
}
inline int round_down(double x) {
  const int t = static_cast<int>(x);
  return t - (x < t);
}
inline Ints round_up(const Lanes& a) {
  Ints r;
  for (int k = 0; k < 8; ++k) r.v[k] = round_up(a.v[k]);
  return r;
}
inline Ints round_down(const Lanes& a) {
  Ints r;
  for (int k = 0; k < 8; ++k) r.v[k] = round_down(a.v[k]);
  return r;
}
inline Ints add(const Ints& a, int b) {
  Ints r;
  for (int k = 0; k < 8; ++k) r.v[k] = a.v[k] + b;
  return r;
}
inline void store(int* p, const Ints& a) {
  for (int k = 0; k < 8; ++k) p[k] = a.v[k];
}
/// 0 in lanes outside [from, to).
inline Ints keep(const Ints& a, int from, int to) {
  Ints r;
  for (int k = 0; k < 8; ++k) r.v[k] = k >= from && k < to ? a.v[k] : 0;
  return r;
}

inline Words load(const std::uint64_t* p) {
  Words r;
  for (int k = 0; k < 8; ++k) r.v[k] = p[k];
  return r;
}
inline void store(std::uint64_t* p, const Words& a) {
  for (int k = 0; k < 8; ++k) p[k] = a.v[k];
}
/// Bits [first - offset, end - offset) of each row, as far as they lie in the word.
inline Words span(const Ints& first, const Ints& end, int offset) {
  const auto ones_from = [](int n) { return n >= 64 ? 0 : ~std::uint64_t{0} << (n > 0 ? n : 0); };
  Words r;
  for (int k = 0; k < 8; ++k) r.v[k] = ones_from(first.v[k] - offset) & ~ones_from(end.v[k] - offset);
  return r;
}
inline Words operator|(const Words& a, const Words& b) {
  Words r;
  for (int k = 0; k < 8; ++k) r.v[k] = a.v[k] | b.v[k];
  return r;
}
/// The bits that all eight have.
inline std::uint64_t common(const Words& a) {
  std::uint64_t r = ~std::uint64_t{0};
  for (int k = 0; k < 8; ++k) r &= a.v[k];
  return r;
}
/// The same bits in words [from, to), none in the others.
inline Words in_rows(std::uint64_t bits, int from, int to) {
  Words r;
  for (int k = 0; k < 8; ++k) r.v[k] = from <= k && k < to ? bits : 0;
  return r;
}
/// Whether a bit of `bits` is unset in `words`.
inline bool any_beyond(const Words& bits, const Words& words) {
  std::uint64_t r = 0;
  for (int k = 0; k < 8; ++k) r |= bits.v[k] & ~words.v[k];
  return r != 0;
}

}  // namespace gridcull::masking::scalar
