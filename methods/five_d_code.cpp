// Encoder and decoder go through nodes and sets in one order: preorder, the sets of both children (or, in the plain
// coding, of the leaf) behind a node. Both stand side by side here so that they are changed together.
//
// The third coding spends one bit more a pair than the paper counts: which child is the lighter one.
#include "gridcull/methods/five_d_code.h"

#include <bit>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

using Set = std::vector<std::uint64_t>;

constexpr std::size_t most_words = std::size_t{1} << 29;

std::size_t weight(std::span<const std::uint64_t> set) {
  std::size_t count = 0;
  for (const std::uint64_t word : set) count += static_cast<std::size_t>(std::popcount(word));
  return count;
}

class BitWriter {
 public:
  void bits(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) {
      if (out_.size % 8 == 0) out_.bytes.push_back(std::byte{0});
      if (value >> i & 1) out_.bytes.back() |= static_cast<std::byte>(1u << (out_.size % 8));
      ++out_.size;
    }
  }
  BitString take() { return std::move(out_); }

 private:
  BitString out_{};
};

class BitReader {
 public:
  BitReader(const BitString& from, std::string_view name) : from_(from), name_(name) {}
  std::uint64_t bits(int count) {
    if (from_.size - at_ < static_cast<std::uint64_t>(count)) refuse("its tree is cut short");
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i, ++at_) {
      const auto byte = std::to_integer<std::uint64_t>(from_.bytes[static_cast<std::size_t>(at_ / 8)]);
      value |= (byte >> (at_ % 8) & 1) << i;
    }
    return value;
  }
  std::uint64_t left() const { return from_.size - at_; }
  [[noreturn]] void refuse(const char* why) const {
    throw Error(ErrorCode::bad_scene, std::string(name_) + ": " + why);
  }

 private:
  const BitString& from_;
  std::string_view name_;
  std::uint64_t at_ = 0;
};

/// Calls f(word, bit) for the members of `within`.
template <class F>
void for_members(std::span<const std::uint64_t> within, const F& f) {
  for (std::size_t w = 0; w < within.size(); ++w) {
    for (std::uint64_t rest = within[w]; rest != 0; rest &= rest - 1) f(w, std::countr_zero(rest));
  }
}

class Encoder {
 public:
  Encoder(const FiveDTree& tree, const FiveDSpace& space, FiveDCoding coding)
      : tree_(tree), space_(space), coding_(coding), words_(space.words()) {
    if (coding == FiveDCoding::plain) return;
    // The children of a node have greater numbers: unions are ready from the back.
    unions_.resize(tree.nodes.size() * words_);
    for (std::size_t i = tree.nodes.size(); i-- > 0;) unite(i);
  }

  BitString encode() {
    if (coding_ != FiveDCoding::plain) relative(of(0), everybody());
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) node(i);
    return pen_.take();
  }

 private:
  std::span<const std::uint64_t> of(std::size_t node) const {
    return std::span(unions_).subspan(node * words_, words_);
  }
  void unite(std::size_t i) {
    const FiveDNode& node = tree_.nodes[i];
    for (std::size_t w = 0; w < words_; ++w) {
      unions_[i * words_ + w] = node.axis == FiveDNode::leaf
                                    ? tree_.set(space_, node.second)[w]
                                    : unions_[(i + 1) * words_ + w] | unions_[node.second * words_ + w];
    }
  }
  Set everybody() const {
    Set all(words_, ~std::uint64_t{0});
    if (space_.members() % 64 != 0) all.back() = (std::uint64_t{1} << (space_.members() % 64)) - 1;
    return all;
  }
  void relative(std::span<const std::uint64_t> set, std::span<const std::uint64_t> within) {
    for_members(within, [&](std::size_t w, int bit) { pen_.bits(set[w] >> bit & 1, 1); });
  }
  void node(std::size_t i) {
    const FiveDNode& node = tree_.nodes[i];
    const bool leaf = node.axis == FiveDNode::leaf;
    pen_.bits(leaf ? 1 : 0, 1);
    if (!leaf) {
      pen_.bits(node.axis, 3);
      pen_.bits(node.step, space_.bits);
    }
    if (coding_ == FiveDCoding::plain) {
      if (leaf) relative(tree_.set(space_, node.second), everybody());
    } else if (!leaf) {
      children(i);
    }
  }
  void children(std::size_t i) {
    const std::size_t b = i + 1, c = tree_.nodes[i].second;
    if (coding_ == FiveDCoding::parent) {
      relative(of(b), of(i));
      relative(of(c), of(i));
      return;
    }
    const bool second_lighter = weight(of(c)) < weight(of(b));
    pen_.bits(second_lighter ? 1 : 0, 1);
    const auto light = of(second_lighter ? c : b), heavy = of(second_lighter ? b : c);
    relative(light, of(i));
    relative(heavy, light);  // what the lighter one lacks the heavier one has
  }

  const FiveDTree& tree_;
  const FiveDSpace& space_;
  FiveDCoding coding_;
  std::size_t words_;
  std::vector<std::uint64_t> unions_{};
  BitWriter pen_{};
};

class Decoder {
 public:
  Decoder(const BitString& bits, const FiveDSpace& space, FiveDCoding coding, std::string_view name)
      : space_(space), coding_(coding), words_(space.words()), pen_(bits, name) {}

  FiveDTree decode() {
    Set all(words_, ~std::uint64_t{0});
    if (space_.members() % 64 != 0) all.back() = (std::uint64_t{1} << (space_.members() % 64)) - 1;
    everybody_ = all;
    waiting_.push_back({0, coding_ == FiveDCoding::plain ? Set{} : relative(all), ViewSteps(space_.steps())});
    while (!waiting_.empty()) node();
    if (pen_.left() != 0) pen_.refuse("its tree goes on after its end");
    return std::move(tree_);
  }

 private:
  /// The steps a node lies between along each axis: a plane divides its node truly, which also ends the tree.
  struct ViewSteps {
    explicit ViewSteps(std::uint32_t steps) { high.fill(steps); }
    std::array<std::uint32_t, view_axes> low{}, high{};
  };
  struct Waiting {
    std::size_t parent;  ///< whose second child it is; 0: the root or a first child
    Set set;             ///< not in the plain coding
    ViewSteps steps;
  };

  Set relative(std::span<const std::uint64_t> within) {
    Set set(words_, 0);
    for_members(within, [&](std::size_t w, int bit) { set[w] |= pen_.bits(1) << bit; });
    return set;
  }
  void node() {
    Waiting next = std::move(waiting_.back());
    waiting_.pop_back();
    const auto i = static_cast<std::uint32_t>(tree_.nodes.size());
    if (next.parent != 0) tree_.nodes[next.parent - 1].second = i;
    FiveDNode& node = tree_.nodes.emplace_back();
    if (pen_.bits(1) == 1) {
      if (coding_ == FiveDCoding::plain) next.set = relative(everybody_);
      node.second = leaves_++;
      if (leaves_ * words_ > most_words) pen_.refuse("its tree would take more than 4 GiB of memory");
      tree_.sets.insert(tree_.sets.end(), next.set.begin(), next.set.end());
      return;
    }
    node.axis = static_cast<std::uint8_t>(pen_.bits(3));
    node.step = static_cast<std::uint32_t>(pen_.bits(space_.bits));
    const std::size_t axis = node.axis;
    if (axis >= view_axes || !space_.has(node.axis) || node.step <= next.steps.low[axis] ||
        node.step >= next.steps.high[axis]) {
      pen_.refuse("its tree has a plane that divides nothing");
    }
    Waiting first{0, {}, next.steps}, second{i + 1u, {}, next.steps};
    first.steps.high[axis] = second.steps.low[axis] = node.step;
    if (coding_ != FiveDCoding::plain) children(next.set, first.set, second.set);
    waiting_.push_back(std::move(second));
    waiting_.push_back(std::move(first));
  }
  void children(const Set& parent, Set& b, Set& c) {
    if (coding_ == FiveDCoding::parent) {
      b = relative(parent);
      c = relative(parent);
      return;
    }
    const bool second_lighter = pen_.bits(1) == 1;
    Set light = relative(parent), heavy = relative(light);
    for (std::size_t w = 0; w < words_; ++w) heavy[w] |= parent[w] & ~light[w];
    b = second_lighter ? heavy : light;
    c = second_lighter ? light : heavy;
  }

  const FiveDSpace& space_;
  FiveDCoding coding_;
  std::size_t words_;
  BitReader pen_;
  Set everybody_{};
  std::vector<Waiting> waiting_{};
  FiveDTree tree_{};
  std::uint32_t leaves_ = 0;
};

}  // namespace

BitString encode(const FiveDTree& tree, const FiveDSpace& space, FiveDCoding coding) {
  return Encoder(tree, space, coding).encode();
}

FiveDTree decode(const BitString& bits, const FiveDSpace& space, FiveDCoding coding, std::string_view name) {
  return Decoder(bits, space, coding, name).decode();
}

}  // namespace gridcull
