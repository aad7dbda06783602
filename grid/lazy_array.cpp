#include "gridcull/grid/lazy_array.h"

#include <cstdlib>
#include <string>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

constexpr std::uint64_t from_heap = 64 << 10;     // smaller blocks
constexpr std::uint64_t no_huge_pages = 1 << 28;  // beyond this a huge page for a single write would be too much

[[noreturn]] void refuse(std::uint64_t bytes) {
  throw Error(ErrorCode::limit, "grid.cell: no room for a matrix of " + std::to_string(bytes) + " bytes of addresses");
}

}  // namespace

LazyMemory::LazyMemory(std::uint64_t bytes) : bytes_(bytes) {
  if (bytes == 0) return;
  if (bytes < from_heap) {
    data_ = std::calloc(1, bytes);
    if (data_ == nullptr) refuse(bytes);
    return;
  }
  void* mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) refuse(bytes);
  if (bytes > no_huge_pages) (void)::madvise(mapped, bytes, MADV_NOHUGEPAGE);
  data_ = mapped;
}

LazyMemory::~LazyMemory() {
  if (data_ == nullptr) return;
  if (bytes_ < from_heap) {
    std::free(data_);
  } else {
    ::munmap(data_, bytes_);
  }
}

std::uint64_t LazyMemory::resident() const {
  if (data_ == nullptr || bytes_ < from_heap) return bytes_;
  const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  constexpr std::uint64_t at_once = 1 << 16;
  std::vector<unsigned char> here(at_once);
  std::uint64_t pages = 0;
  for (std::uint64_t from = 0; from < bytes_; from += at_once * page) {
    const std::uint64_t length = bytes_ - from < at_once * page ? bytes_ - from : at_once * page;
    if (::mincore(static_cast<char*>(data_) + from, length, here.data()) != 0) return bytes_;
    for (std::uint64_t i = 0; i * page < length; ++i) pages += here[i] & 1u;
  }
  return pages * page;
}

}  // namespace gridcull
