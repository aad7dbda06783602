// The innermost loop of balls: 64 comparisons of a brick into one word. Two bodies, SSE2 (part of plain
// x86-64) and portable; both only compare, so they give the same bits (tests/test_cover_ball.cpp).
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace gridcull::covering {

/// Bit edge * j + i: squares[i] <= limits[j] (or < where `strict`). `edge` squares, 64 / edge limits.
template <int edge, bool strict>
std::uint64_t compare_portable(const double* squares, const double* limits) {
  std::uint64_t bits = 0;
  for (int j = 0; j < 64 / edge; ++j) {
    for (int i = 0; i < edge; ++i) {
      const bool in = strict ? squares[i] < limits[j] : squares[i] <= limits[j];
      bits |= static_cast<std::uint64_t>(in) << (edge * j + i);
    }
  }
  return bits;
}

#if defined(__SSE2__)

/// Four comparisons as four 32-bit masks. squares is 16-byte aligned.
template <bool strict>
inline __m128i compare_four(const double* squares, __m128d limit) {
  const __m128d a = _mm_load_pd(squares), b = _mm_load_pd(squares + 2);
  const __m128d below_a = strict ? _mm_cmplt_pd(a, limit) : _mm_cmple_pd(a, limit);
  const __m128d below_b = strict ? _mm_cmplt_pd(b, limit) : _mm_cmple_pd(b, limit);
  return _mm_castps_si128(_mm_shuffle_ps(_mm_castpd_ps(below_a), _mm_castpd_ps(below_b), _MM_SHUFFLE(2, 0, 2, 0)));
}

template <int edge, bool strict>
std::uint64_t compare_sse2(const double* squares, const double* limits) {
  constexpr int groups = edge / 4;  // of four cells in a row
  std::uint64_t bits = 0;
  for (int block = 0; block < 4; ++block) {  // of 16 cells
    __m128i masks[4];
    for (int g = 0; g < 4; ++g) {
      const int group = 4 * block + g;
      masks[g] = compare_four<strict>(squares + 4 * (group % groups), _mm_set1_pd(limits[group / groups]));
    }
    const __m128i low = _mm_packs_epi32(masks[0], masks[1]), high = _mm_packs_epi32(masks[2], masks[3]);
    const int sixteen = _mm_movemask_epi8(_mm_packs_epi16(low, high));
    bits |= static_cast<std::uint64_t>(static_cast<unsigned>(sixteen)) << (16 * block);
  }
  return bits;
}

template <int edge>
std::uint64_t bits_at_most(const double* squares, const double* limits) {
  return compare_sse2<edge, false>(squares, limits);
}
template <int edge>
std::uint64_t bits_below(const double* squares, const double* limits) {
  return compare_sse2<edge, true>(squares, limits);
}

#else

template <int edge>
std::uint64_t bits_at_most(const double* squares, const double* limits) {
  return compare_portable<edge, false>(squares, limits);
}
template <int edge>
std::uint64_t bits_below(const double* squares, const double* limits) {
  return compare_portable<edge, true>(squares, limits);
}

#endif

}  // namespace gridcull::covering
