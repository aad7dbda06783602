// Two doubles side by side, and the comparison of 16 cells into 16 bits. Two bodies: SSE2, which every x86-64
// has, and portable. Each operation rounds as the scalar one does, so both give the same bits
// (tests/test_cover_ball.cpp holds them against each other).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace gridcull {

struct PortablePair {
  double a, b;

  static PortablePair of(double a, double b) { return {a, b}; }
  static PortablePair both(double v) { return {v, v}; }
  double first() const { return a; }
  double second() const { return b; }
  void store(double* to) const { to[0] = a, to[1] = b; }
  PortablePair operator+(const PortablePair& o) const { return {a + o.a, b + o.b}; }
  PortablePair operator-(const PortablePair& o) const { return {a - o.a, b - o.b}; }
  PortablePair operator*(const PortablePair& o) const { return {a * o.a, b * o.b}; }
  friend PortablePair least(const PortablePair& p, const PortablePair& q) {
    return {std::min(p.a, q.a), std::min(p.b, q.b)};
  }
  friend PortablePair greatest(const PortablePair& p, const PortablePair& q) {
    return {std::max(p.a, q.a), std::max(p.b, q.b)};
  }
  friend PortablePair absolute(const PortablePair& p) { return {std::abs(p.a), std::abs(p.b)}; }
  /// Lane by lane: p < q ? yes : no.
  friend PortablePair where_less(const PortablePair& p, const PortablePair& q, const PortablePair& yes,
                                 const PortablePair& no) {
    return {p.a < q.a ? yes.a : no.a, p.b < q.b ? yes.b : no.b};
  }
};

/// 16 / edge rows of `edge` cells: bit edge * j + i is x[i] <= limit[j] (< where strict).
template <int edge, bool strict>
std::uint32_t compare_rows(const PortablePair* x, const PortablePair* limit) {
  const auto lane = [](const PortablePair* p, int i) { return i % 2 == 0 ? p[i / 2].a : p[i / 2].b; };
  std::uint32_t bits = 0;
  for (int j = 0; j < 16 / edge; ++j) {
    for (int i = 0; i < edge; ++i) {
      const double v = lane(x, i), l = lane(limit, j);
      bits |= static_cast<std::uint32_t>(strict ? v < l : v <= l) << (edge * j + i);
    }
  }
  return bits;
}

/// One row of four cells: bit i is x[i] <= limit (< where strict).
template <bool strict>
std::uint32_t compare_row(const PortablePair* x, double limit) {
  const auto bit = [&](double v) { return static_cast<std::uint32_t>(strict ? v < limit : v <= limit); };
  return bit(x[0].a) | bit(x[0].b) << 1 | bit(x[1].a) << 2 | bit(x[1].b) << 3;
}

#if defined(__SSE2__)

struct SsePair {
  __m128d v;

  static SsePair of(double a, double b) { return {_mm_set_pd(b, a)}; }
  static SsePair both(double s) { return {_mm_set1_pd(s)}; }
  double first() const { return _mm_cvtsd_f64(v); }
  double second() const { return _mm_cvtsd_f64(_mm_unpackhi_pd(v, v)); }
  void store(double* to) const { _mm_storeu_pd(to, v); }
  SsePair operator+(const SsePair& o) const { return {_mm_add_pd(v, o.v)}; }
  SsePair operator-(const SsePair& o) const { return {_mm_sub_pd(v, o.v)}; }
  SsePair operator*(const SsePair& o) const { return {_mm_mul_pd(v, o.v)}; }
  friend SsePair least(const SsePair& p, const SsePair& q) { return {_mm_min_pd(p.v, q.v)}; }
  friend SsePair greatest(const SsePair& p, const SsePair& q) { return {_mm_max_pd(p.v, q.v)}; }
  friend SsePair absolute(const SsePair& p) { return {_mm_andnot_pd(_mm_set1_pd(-0.0), p.v)}; }
  friend SsePair where_less(const SsePair& p, const SsePair& q, const SsePair& yes, const SsePair& no) {
    const __m128d mask = _mm_cmplt_pd(p.v, q.v);
    return {_mm_or_pd(_mm_and_pd(mask, yes.v), _mm_andnot_pd(mask, no.v))};
  }
};

/// Four cells of a row as four 32-bit masks.
template <bool strict>
__m128i compare_four(const SsePair* x, __m128d limit) {
  const __m128d a = strict ? _mm_cmplt_pd(x[0].v, limit) : _mm_cmple_pd(x[0].v, limit);
  const __m128d b = strict ? _mm_cmplt_pd(x[1].v, limit) : _mm_cmple_pd(x[1].v, limit);
  return _mm_castps_si128(_mm_shuffle_ps(_mm_castpd_ps(a), _mm_castpd_ps(b), _MM_SHUFFLE(2, 0, 2, 0)));
}

template <bool strict>
std::uint32_t compare_row(const SsePair* x, double limit) {
  const __m128i four = compare_four<strict>(x, _mm_set1_pd(limit));
  return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(four)));
}

template <int edge, bool strict>
std::uint32_t compare_rows(const SsePair* x, const SsePair* limit) {
  __m128i fours[4];
  for (int row = 0; row < 16 / edge; ++row) {
    const __m128d pair = limit[row / 2].v;
    const __m128d l = row % 2 == 0 ? _mm_unpacklo_pd(pair, pair) : _mm_unpackhi_pd(pair, pair);
    for (int i = 0; i < edge / 4; ++i) fours[row * (edge / 4) + i] = compare_four<strict>(x + 2 * i, l);
  }
  const __m128i low = _mm_packs_epi32(fours[0], fours[1]), high = _mm_packs_epi32(fours[2], fours[3]);
  return static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(low, high)));
}

using DoublePair = SsePair;

#else

using DoublePair = PortablePair;

#endif

}  // namespace gridcull
