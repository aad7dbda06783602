// Eight lanes in two registers of AVX2. See mask_lanes_scalar.h for what each does.
#pragma once

#include <cstdint>

#include <immintrin.h>

namespace gridcull::masking::avx2 {

struct Lanes {
  __m256d a, b;  ///< lanes 0 .. 3 and 4 .. 7
};
/// All ones or all zeros a lane.
struct Mask {
  __m256d a, b;
};
struct Ints {
  __m256i v;
};
struct Words {
  __m256i a, b;
};

inline Lanes splat(double x) { return {_mm256_set1_pd(x), _mm256_set1_pd(x)}; }
inline Lanes iota() { return {_mm256_setr_pd(0, 1, 2, 3), _mm256_setr_pd(4, 5, 6, 7)}; }
inline Lanes load(const double* p) { return {_mm256_loadu_pd(p), _mm256_loadu_pd(p + 4)}; }
inline void store(double* p, const Lanes& x) { _mm256_storeu_pd(p, x.a), _mm256_storeu_pd(p + 4, x.b); }
inline void load_rays(const double* rays, int count, Lanes& x, Lanes& y, Lanes& z) {
  const double* p[8];
  for (int k = 0; k < 8; ++k) p[k] = rays + 3 * (k < count ? k : count - 1);
  const auto pick = [&](int axis) {
    return Lanes{_mm256_setr_pd(p[0][axis], p[1][axis], p[2][axis], p[3][axis]),
                 _mm256_setr_pd(p[4][axis], p[5][axis], p[6][axis], p[7][axis])};
  };
  x = pick(0), y = pick(1), z = pick(2);
}
inline Lanes operator+(const Lanes& x, const Lanes& y) { return {_mm256_add_pd(x.a, y.a), _mm256_add_pd(x.b, y.b)}; }
inline Lanes operator-(const Lanes& x, const Lanes& y) { return {_mm256_sub_pd(x.a, y.a), _mm256_sub_pd(x.b, y.b)}; }
inline Lanes operator*(const Lanes& x, const Lanes& y) { return {_mm256_mul_pd(x.a, y.a), _mm256_mul_pd(x.b, y.b)}; }
inline Lanes operator/(const Lanes& x, const Lanes& y) { return {_mm256_div_pd(x.a, y.a), _mm256_div_pd(x.b, y.b)}; }
inline Lanes smaller(const Lanes& x, const Lanes& y) { return {_mm256_min_pd(x.a, y.a), _mm256_min_pd(x.b, y.b)}; }
inline Lanes larger(const Lanes& x, const Lanes& y) { return {_mm256_max_pd(x.a, y.a), _mm256_max_pd(x.b, y.b)}; }
inline Lanes magnitude(const Lanes& x) {
  const __m256d sign = _mm256_set1_pd(-0.0);
  return {_mm256_andnot_pd(sign, x.a), _mm256_andnot_pd(sign, x.b)};
}
inline Lanes root(const Lanes& x) { return {_mm256_sqrt_pd(x.a), _mm256_sqrt_pd(x.b)}; }
inline Mask operator<(const Lanes& x, const Lanes& y) {
  return {_mm256_cmp_pd(x.a, y.a, _CMP_LT_OQ), _mm256_cmp_pd(x.b, y.b, _CMP_LT_OQ)};
}
inline Mask operator<=(const Lanes& x, const Lanes& y) {
  return {_mm256_cmp_pd(x.a, y.a, _CMP_LE_OQ), _mm256_cmp_pd(x.b, y.b, _CMP_LE_OQ)};
}
inline Mask operator&(const Mask& x, const Mask& y) { return {_mm256_and_pd(x.a, y.a), _mm256_and_pd(x.b, y.b)}; }
inline Mask operator^(const Mask& x, const Mask& y) { return {_mm256_xor_pd(x.a, y.a), _mm256_xor_pd(x.b, y.b)}; }
inline unsigned bits(const Mask& x) {
  return static_cast<unsigned>(_mm256_movemask_pd(x.a)) | static_cast<unsigned>(_mm256_movemask_pd(x.b)) << 4;
}
inline Lanes select(const Mask& m, const Lanes& yes, const Lanes& no) {
  return {_mm256_blendv_pd(no.a, yes.a, m.a), _mm256_blendv_pd(no.b, yes.b, m.b)};
}
/// Lanes 1, 2, 3 of x, then lane 0 of y.
inline __m256d shift_half(__m256d x, __m256d y) { return _mm256_permute4x64_pd(_mm256_blend_pd(x, y, 1), 0x39); }
inline Lanes shift_in(const Lanes& x, const Lanes& y) { return {shift_half(x.a, x.b), shift_half(x.b, y.a)}; }
inline double sum(const Lanes& x) {
  const __m256d q = _mm256_add_pd(x.a, x.b);
  const __m128d h = _mm_add_pd(_mm256_castpd256_pd128(q), _mm256_extractf128_pd(q, 1));
  return _mm_cvtsd_f64(_mm_add_sd(h, _mm_unpackhi_pd(h, h)));
}
inline double lowest(const Lanes& x) {
  const __m256d q = _mm256_min_pd(x.a, x.b);
  const __m128d h = _mm_min_pd(_mm256_castpd256_pd128(q), _mm256_extractf128_pd(q, 1));
  return _mm_cvtsd_f64(_mm_min_sd(h, _mm_unpackhi_pd(h, h)));
}
inline double highest(const Lanes& x) {
  const __m256d q = _mm256_max_pd(x.a, x.b);
  const __m128d h = _mm_max_pd(_mm256_castpd256_pd128(q), _mm256_extractf128_pd(q, 1));
  return _mm_cvtsd_f64(_mm_max_sd(h, _mm_unpackhi_pd(h, h)));
}

inline int round_up(double x) {
  const int t = static_cast<int>(x);
  return t + (x > t);
}
inline int round_down(double x) {
  const int t = static_cast<int>(x);
  return t - (x < t);
}
inline Ints round_up(const Lanes& x) {
  return {_mm256_set_m128i(_mm256_cvtpd_epi32(_mm256_ceil_pd(x.b)), _mm256_cvtpd_epi32(_mm256_ceil_pd(x.a)))};
}
inline Ints round_down(const Lanes& x) {
  return {_mm256_set_m128i(_mm256_cvtpd_epi32(_mm256_floor_pd(x.b)), _mm256_cvtpd_epi32(_mm256_floor_pd(x.a)))};
}
inline Ints add(const Ints& x, int y) { return {_mm256_add_epi32(x.v, _mm256_set1_epi32(y))}; }
inline void store(int* p, const Ints& x) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), x.v); }
inline Ints keep(const Ints& x, int from, int to) {
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i below = _mm256_cmpgt_epi32(_mm256_set1_epi32(from), lane);
  const __m256i under_end = _mm256_cmpgt_epi32(_mm256_set1_epi32(to), lane);
  return {_mm256_andnot_si256(below, _mm256_and_si256(under_end, x.v))};
}

inline __m256i load_half(const std::uint64_t* p) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)); }
inline Words load(const std::uint64_t* p) { return {load_half(p), load_half(p + 4)}; }
inline void store(std::uint64_t* p, const Words& x) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), x.a);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p + 4), x.b);
}
/// A shift by 64 or more gives 0.
inline __m256i span_half(__m128i first, __m128i end) {
  const __m256i ones = _mm256_set1_epi64x(-1);
  return _mm256_andnot_si256(_mm256_sllv_epi64(ones, _mm256_cvtepi32_epi64(end)),
                             _mm256_sllv_epi64(ones, _mm256_cvtepi32_epi64(first)));
}
inline Words span(const Ints& first, const Ints& end, int offset) {
  const __m256i from = _mm256_set1_epi32(offset), zero = _mm256_setzero_si256();
  const __m256i a = _mm256_max_epi32(_mm256_sub_epi32(first.v, from), zero);
  const __m256i b = _mm256_max_epi32(_mm256_sub_epi32(end.v, from), zero);
  return {span_half(_mm256_castsi256_si128(a), _mm256_castsi256_si128(b)),
          span_half(_mm256_extracti128_si256(a, 1), _mm256_extracti128_si256(b, 1))};
}
inline Words operator|(const Words& x, const Words& y) {
  return {_mm256_or_si256(x.a, y.a), _mm256_or_si256(x.b, y.b)};
}
inline std::uint64_t common(const Words& x) {
  const __m256i q = _mm256_and_si256(x.a, x.b);
  const __m128i h = _mm_and_si128(_mm256_castsi256_si128(q), _mm256_extracti128_si256(q, 1));
  return static_cast<std::uint64_t>(_mm_cvtsi128_si64(h) & _mm_extract_epi64(h, 1));
}
inline Words in_rows(std::uint64_t bits, int from, int to) {
  const __m256i word = _mm256_set1_epi64x(static_cast<long long>(bits));
  const __m256i below = _mm256_set1_epi64x(from - 1), end = _mm256_set1_epi64x(to);
  const auto half = [&](__m256i row) {
    const __m256i in = _mm256_and_si256(_mm256_cmpgt_epi64(row, below), _mm256_cmpgt_epi64(end, row));
    return _mm256_and_si256(word, in);
  };
  return {half(_mm256_setr_epi64x(0, 1, 2, 3)), half(_mm256_setr_epi64x(4, 5, 6, 7))};
}
inline bool any_beyond(const Words& bits, const Words& words) {
  // testc(words, bits): no bit of `bits` outside `words`.
  return _mm256_testc_si256(words.a, bits.a) == 0 || _mm256_testc_si256(words.b, bits.b) == 0;
}

}  // namespace gridcull::masking::avx2
