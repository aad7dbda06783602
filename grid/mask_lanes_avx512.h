// Eight lanes in one register of AVX-512 (F, DQ, BW, VL). See mask_lanes_scalar.h for what each does.
#pragma once

#include <cstdint>

#include <immintrin.h>

namespace gridcull::masking::avx512 {

struct Lanes {
  __m512d v;
};
struct Mask {
  __mmask8 bits;
};
struct Ints {
  __m256i v;
};
struct Words {
  __m512i v;
};

inline Lanes splat(double a) { return {_mm512_set1_pd(a)}; }
inline Lanes iota() { return {_mm512_setr_pd(0, 1, 2, 3, 4, 5, 6, 7)}; }
inline Lanes load(const double* p) { return {_mm512_loadu_pd(p)}; }
inline void store(double* p, const Lanes& a) { _mm512_storeu_pd(p, a.v); }
/// Three loads of what is there, then x, y and z picked out of them.
inline void load_rays(const double* rays, int count, Lanes& x, Lanes& y, Lanes& z) {
  const unsigned there = (1u << 3 * count) - 1u;  // 24 doubles at most
  const __m512d a = _mm512_maskz_loadu_pd(static_cast<__mmask8>(there), rays);
  const __m512d b = _mm512_maskz_loadu_pd(static_cast<__mmask8>(there >> 8), rays + 8);
  const __m512d c = _mm512_maskz_loadu_pd(static_cast<__mmask8>(there >> 16), rays + 16);
  const __m512i order = _mm512_min_epi64(_mm512_setr_epi64(0, 1, 2, 3, 4, 5, 6, 7), _mm512_set1_epi64(count - 1));
  const auto pick = [&](__m512i from_ab, __mmask8 in_c, __m512i from_c) {
    const __m512d ab = _mm512_permutex2var_pd(a, from_ab, b);
    return Lanes{_mm512_permutexvar_pd(order, _mm512_mask_permutexvar_pd(ab, in_c, from_c, c))};
  };
  x = pick(_mm512_setr_epi64(0, 3, 6, 9, 12, 15, 0, 0), 0xC0, _mm512_setr_epi64(0, 0, 0, 0, 0, 0, 2, 5));
  y = pick(_mm512_setr_epi64(1, 4, 7, 10, 13, 0, 0, 0), 0xE0, _mm512_setr_epi64(0, 0, 0, 0, 0, 0, 3, 6));
  z = pick(_mm512_setr_epi64(2, 5, 8, 11, 14, 0, 0, 0), 0xE0, _mm512_setr_epi64(0, 0, 0, 0, 0, 1, 4, 7));
}
inline Lanes operator+(const Lanes& a, const Lanes& b) { return {_mm512_add_pd(a.v, b.v)}; }
inline Lanes operator-(const Lanes& a, const Lanes& b) { return {_mm512_sub_pd(a.v, b.v)}; }
inline Lanes operator*(const Lanes& a, const Lanes& b) { return {_mm512_mul_pd(a.v, b.v)}; }
inline Lanes operator/(const Lanes& a, const Lanes& b) { return {_mm512_div_pd(a.v, b.v)}; }
inline Lanes smaller(const Lanes& a, const Lanes& b) { return {_mm512_min_pd(a.v, b.v)}; }
inline Lanes larger(const Lanes& a, const Lanes& b) { return {_mm512_max_pd(a.v, b.v)}; }
inline Lanes magnitude(const Lanes& a) { return {_mm512_abs_pd(a.v)}; }
inline Lanes root(const Lanes& a) { return {_mm512_sqrt_pd(a.v)}; }
inline Mask operator<(const Lanes& a, const Lanes& b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ)}; }
inline Mask operator<=(const Lanes& a, const Lanes& b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LE_OQ)}; }
inline Mask operator&(Mask a, Mask b) { return {static_cast<__mmask8>(a.bits & b.bits)}; }
inline Mask operator^(Mask a, Mask b) { return {static_cast<__mmask8>(a.bits ^ b.bits)}; }
inline unsigned bits(Mask a) { return a.bits; }
inline Lanes select(Mask m, const Lanes& yes, const Lanes& no) { return {_mm512_mask_blend_pd(m.bits, no.v, yes.v)}; }
inline Lanes shift_in(const Lanes& a, const Lanes& b) {
  return {_mm512_castsi512_pd(_mm512_alignr_epi64(_mm512_castpd_si512(b.v), _mm512_castpd_si512(a.v), 1))};
}
inline double sum(const Lanes& a) {
  const __m256d q = _mm256_add_pd(_mm512_castpd512_pd256(a.v), _mm512_extractf64x4_pd(a.v, 1));
  const __m128d h = _mm_add_pd(_mm256_castpd256_pd128(q), _mm256_extractf128_pd(q, 1));
  return _mm_cvtsd_f64(_mm_add_sd(h, _mm_unpackhi_pd(h, h)));
}
inline double lowest(const Lanes& a) {
  const __m256d q = _mm256_min_pd(_mm512_castpd512_pd256(a.v), _mm512_extractf64x4_pd(a.v, 1));
  const __m128d h = _mm_min_pd(_mm256_castpd256_pd128(q), _mm256_extractf128_pd(q, 1));
  return _mm_cvtsd_f64(_mm_min_sd(h, _mm_unpackhi_pd(h, h)));
}
inline double highest(const Lanes& a) {
  const __m256d q = _mm256_max_pd(_mm512_castpd512_pd256(a.v), _mm512_extractf64x4_pd(a.v, 1));
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
inline Ints round_up(const Lanes& a) {
  return {_mm512_cvt_roundpd_epi32(a.v, _MM_FROUND_TO_POS_INF | _MM_FROUND_NO_EXC)};
}
inline Ints round_down(const Lanes& a) {
  return {_mm512_cvt_roundpd_epi32(a.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC)};
}
inline Ints add(const Ints& a, int b) { return {_mm256_add_epi32(a.v, _mm256_set1_epi32(b))}; }
inline void store(int* p, const Ints& a) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a.v); }
inline Ints keep(const Ints& a, int from, int to) {
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __mmask8 in =
      _mm256_cmpge_epi32_mask(lane, _mm256_set1_epi32(from)) & _mm256_cmplt_epi32_mask(lane, _mm256_set1_epi32(to));
  return {_mm256_maskz_mov_epi32(in, a.v)};
}

inline Words load(const std::uint64_t* p) { return {_mm512_loadu_si512(p)}; }
inline void store(std::uint64_t* p, const Words& a) { _mm512_storeu_si512(p, a.v); }
/// A shift by 64 or more gives 0.
inline Words span(const Ints& first, const Ints& end, int offset) {
  const __m256i from = _mm256_set1_epi32(offset), zero = _mm256_setzero_si256();
  const __m512i a = _mm512_cvtepi32_epi64(_mm256_max_epi32(_mm256_sub_epi32(first.v, from), zero));
  const __m512i b = _mm512_cvtepi32_epi64(_mm256_max_epi32(_mm256_sub_epi32(end.v, from), zero));
  const __m512i ones = _mm512_set1_epi64(-1);
  return {_mm512_andnot_si512(_mm512_sllv_epi64(ones, b), _mm512_sllv_epi64(ones, a))};
}
inline Words operator|(const Words& a, const Words& b) { return {_mm512_or_si512(a.v, b.v)}; }
inline std::uint64_t common(const Words& a) {
  const __m256i q = _mm256_and_si256(_mm512_castsi512_si256(a.v), _mm512_extracti64x4_epi64(a.v, 1));
  const __m128i h = _mm_and_si128(_mm256_castsi256_si128(q), _mm256_extracti128_si256(q, 1));
  return static_cast<std::uint64_t>(_mm_cvtsi128_si64(h) & _mm_extract_epi64(h, 1));
}
inline Words in_rows(std::uint64_t bits, int from, int to) {
  const unsigned rows = (255u << from) & (255u >> (8 - to));
  return {_mm512_maskz_set1_epi64(static_cast<__mmask8>(rows), static_cast<long long>(bits))};
}
inline bool any_beyond(const Words& bits, const Words& words) {
  const __m512i open = _mm512_andnot_si512(words.v, bits.v);
  return _mm512_test_epi64_mask(open, open) != 0;
}

}  // namespace gridcull::masking::avx512
