// Masks over a 64-cell brick and over rows of words.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace gridcull {

/// Bits [low, high] of a word; 0 <= low <= high <= 63.
inline std::uint64_t bit_range(int low, int high) { return (~std::uint64_t{0} >> (63 - (high - low))) << low; }

/// Calls f(index of bit) for every set bit, ascending.
template <class F>
void for_each_bit(std::uint64_t word, F&& f) {
  for (; word != 0; word &= word - 1) f(std::countr_zero(word));
}

/// Calls f(first, last) for every run of set bits in a row of words, ascending; runs may span words.
template <class F>
void for_each_run(std::span<const std::uint64_t> row, F&& f) {
  const int words = static_cast<int>(row.size());
  int start = -1;
  for (int w = 0; w < words; ++w) {
    std::uint64_t bits = row[static_cast<std::size_t>(w)];
    if (start >= 0) {
      const int ones = std::countr_one(bits);
      if (ones == 64) continue;
      f(start, 64 * w + ones - 1);
      start = -1;
      bits &= ~std::uint64_t{0} << ones;
    }
    while (bits != 0) {
      const int first = std::countr_zero(bits);
      const int ones = std::countr_one(bits >> first);
      if (first + ones == 64) {
        start = 64 * w + first;
        break;
      }
      f(64 * w + first, 64 * w + first + ones - 1);
      bits &= ~std::uint64_t{0} << (first + ones);
    }
  }
  if (start >= 0) f(start, 64 * words - 1);
}

/// Sets bits [first, last] of a row of words; 0 <= first <= last.
inline void set_run(std::uint64_t* row, int first, int last) {
  const int w0 = first >> 6, w1 = last >> 6;
  if (w0 == w1) {
    row[w0] |= bit_range(first & 63, last & 63);
    return;
  }
  row[w0] |= bit_range(first & 63, 63);
  for (int w = w0 + 1; w < w1; ++w) row[w] = ~std::uint64_t{0};
  row[w1] |= bit_range(0, last & 63);
}

}  // namespace gridcull
