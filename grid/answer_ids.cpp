#include "gridcull/grid/answer_ids.h"

#include <algorithm>

#include "gridcull/grid/bits.h"

namespace gridcull {

// Slots mostly run with the ids, so a long answer is sorted by marking its slots in a row of bits.
void AnswerIds::list(const ObjectTable& objects, const std::vector<Slot>& seen, std::vector<ObjectId>& ids) {
  const auto add = [&](Slot slot) { ids.push_back(objects[slot].id); };
  if (seen.size() < objects.size() / 64) {
    std::for_each(seen.begin(), seen.end(), add);
  } else {
    bits_.resize(std::max(bits_.size(), objects.size() / 64 + 1), 0);
    for (const Slot slot : seen) bits_[slot / 64] |= std::uint64_t{1} << (slot % 64);
    for (std::size_t w = 0; w < bits_.size(); ++w) {
      for_each_bit(bits_[w], [&](int bit) { add(static_cast<Slot>(64 * w + static_cast<std::size_t>(bit))); });
      bits_[w] = 0;
    }
  }
  if (!std::is_sorted(ids.begin(), ids.end())) std::sort(ids.begin(), ids.end());
}

}  // namespace gridcull
