// Arrays that take memory only where they were written: a matrix of a big world is mostly empty. The system hands out
// zeroed pages on the first write; until then they cost addresses, not memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace gridcull {

/// Zeroed memory. Small blocks come from the heap, large ones from the system's pages.
class LazyMemory {
 public:
  LazyMemory() = default;
  /// Throws Error(limit) when there are not that many bytes of addresses.
  explicit LazyMemory(std::uint64_t bytes);
  ~LazyMemory();
  LazyMemory(LazyMemory&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
  LazyMemory& operator=(LazyMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }

  void* data() const { return data_; }
  /// Bytes that were handed out: of pages that were written, whole.
  std::uint64_t resident() const;

 private:
  void* data_ = nullptr;
  std::uint64_t bytes_ = 0;
};

/// `T` is made of zero bytes: all elements are that at first. Never grows.
template <class T>
requires std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>
class LazyArray {
 public:
  LazyArray() = default;
  explicit LazyArray(std::size_t count) : memory_(std::uint64_t{count} * sizeof(T)), count_(count) {}

  T& operator[](std::size_t i) { return static_cast<T*>(memory_.data())[i]; }
  const T& operator[](std::size_t i) const { return static_cast<const T*>(memory_.data())[i]; }
  std::size_t size() const { return count_; }
  bool empty() const { return count_ == 0; }
  std::uint64_t bytes() const { return memory_.resident(); }

 private:
  LazyMemory memory_;
  std::size_t count_ = 0;
};

}  // namespace gridcull
