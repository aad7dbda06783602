// Deltas: the paper stores, for each cell, differences to its neighbours, and the whole set for a few "key" cells.
#include "gridcull/methods/extended_baked.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gridcull/core/error.h"
#include "gridcull/methods/bytes.h"

namespace gridcull::extended {
namespace {

constexpr std::uint32_t key_every = 32;
constexpr std::uint32_t most_levels = 10;

/// Seven bits a byte, least first; the last byte is below 128.
void write_varint(ByteWriter& out, std::uint32_t value) {
  for (; value >= 128; value >>= 7) out.u8(static_cast<std::uint8_t>(value | 128u));
  out.u8(static_cast<std::uint8_t>(value));
}
std::uint32_t read_varint(ByteReader& in) {
  std::uint32_t value = 0;
  for (int shift = 0; shift < 35; shift += 7) {
    const std::uint8_t byte = in.u8();
    value |= static_cast<std::uint32_t>(byte & 127u) << shift;
    if (byte < 128) return value;
  }
  in.refuse("altered: a number without end");
}

/// An ascending list, as gaps.
void write_list(ByteWriter& out, const std::vector<std::uint32_t>& list) {
  write_varint(out, static_cast<std::uint32_t>(list.size()));
  std::uint32_t next = 0;
  for (const std::uint32_t i : list) write_varint(out, i - next), next = i + 1;
}
void read_list(ByteReader& in, std::uint32_t items, std::vector<std::uint32_t>& list) {
  const std::uint32_t count = read_varint(in);
  if (count > items || count > in.left()) in.refuse("altered: a set larger than the world");
  list.clear();
  std::uint64_t next = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    next += read_varint(in);
    if (next >= items) in.refuse("altered: a set of more than the world");
    list.push_back(static_cast<std::uint32_t>(next++));
  }
}

std::vector<std::uint32_t> without(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::vector<std::uint32_t> out;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
  return out;
}

/// One tree, checked: as many nodes as it asks for, and no deeper than allowed.
std::uint64_t read_nodes(ByteReader& in, std::uint32_t levels, std::vector<NodeKind>& nodes) {
  std::uint64_t leaves = 0;
  std::vector<std::uint32_t> open{0};  // levels of nodes to come
  while (!open.empty()) {
    const std::uint32_t level = open.back();
    open.pop_back();
    const std::uint8_t kind = in.u8();
    if (kind > 2 || (kind == 2 && level >= levels)) in.refuse("altered: no such cell");
    nodes.push_back(static_cast<NodeKind>(kind));
    leaves += kind == 1;
    if (kind == 2) open.insert(open.end(), 8, level + 1);
  }
  return leaves;
}

void write_nodes(const std::vector<NodeKind>& nodes, ByteWriter& out) {
  for (const NodeKind kind : nodes) out.u8(static_cast<std::uint8_t>(kind));
}

}  // namespace

ViewCell CellLattice::cell(const std::array<std::uint64_t, 3>& at, std::uint32_t level) const {
  const auto edge = static_cast<double>(std::uint64_t{1} << (levels - level));
  ViewCell out;
  Vec3 middle;
  double reach = 0.0;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<double>(at[static_cast<std::size_t>(k)]);
    middle[k] = (i + 0.5 * edge) * step;
    reach += std::fabs(origin[k]) + (i + edge) * step;
  }
  out.axes = axes();
  out.centre = origin + out.axes * middle;
  // The centre is off by some ten roundings of 2^-53 of `reach`, and so is the place of whoever looks for a cell.
  out.half = Vec3(0.5 * edge * step * (1.0 + 1e-12) + 4e-15 * reach);
  return out;
}

std::array<std::uint64_t, 3> CellLattice::corner(std::uint32_t root) const {
  const std::uint64_t edge = std::uint64_t{1} << levels;
  return {root % count[0] * edge, root / count[0] % count[1] * edge, root / count[0] / count[1] * edge};
}

void write_root(const RootCells& root, ByteWriter& out) {
  write_nodes(root.nodes, out);
  for (const LeafSet& leaf : root.leaves) {
    write_list(out, leaf.visible);
    write_list(out, leaf.touching);
  }
}

RootCells read_root(ByteReader& in, std::uint32_t levels, std::uint32_t items) {
  RootCells out;
  const std::uint64_t leaves = read_nodes(in, levels, out.nodes);
  for (std::uint64_t i = 0; i < leaves; ++i) {
    LeafSet& leaf = out.leaves.emplace_back();
    read_list(in, items, leaf.visible);
    read_list(in, items, leaf.touching);
  }
  return out;
}

BakedCells::BakedCells(const CellLattice& lattice, const MotionRegions& regions, std::uint32_t objects,
                       std::span<const RootCells> roots)
    : lattice_(lattice), regions_(regions), objects_(objects) {
  ByteWriter sets;
  const std::vector<std::uint32_t> nothing;
  const std::vector<std::uint32_t>* before = &nothing;
  for (const RootCells& root : roots) {
    nodes_.insert(nodes_.end(), root.nodes.begin(), root.nodes.end());
    for (const LeafSet& leaf : root.leaves) {
      if (starts_.size() % key_every == 0) before = &nothing;
      starts_.push_back(sets.span().size());
      write_list(sets, leaf.touching);
      write_list(sets, without(leaf.visible, *before));
      write_list(sets, without(*before, leaf.visible));
      before = &leaf.visible;
    }
  }
  sets_ = sets.take();
  index();
}

void BakedCells::write(ByteWriter& out) const {
  for (int k = 0; k < 3; ++k) out.f64(lattice_.origin[k]);
  out.f64(lattice_.heading);
  out.f64(lattice_.step);
  out.u32(lattice_.levels);
  for (const std::uint32_t n : lattice_.count) out.u32(n);
  for (int k = 0; k < 3; ++k) out.f64(regions_.origin[k]);
  for (int k = 0; k < 3; ++k) out.f64(regions_.edge[k]);
  for (const std::uint32_t n : regions_.count) out.u32(n);
  out.u32(objects_);
  write_nodes(nodes_, out);
  out.block(sets_);
}

BakedCells::BakedCells(ByteReader& in) {
  for (int k = 0; k < 3; ++k) lattice_.origin[k] = in.f64();
  lattice_.heading = in.f64();
  lattice_.step = in.f64();
  lattice_.levels = in.u32();
  for (std::uint32_t& n : lattice_.count) n = in.u32();
  for (int k = 0; k < 3; ++k) regions_.origin[k] = in.f64();
  for (int k = 0; k < 3; ++k) regions_.edge[k] = in.f64();
  for (std::uint32_t& n : regions_.count) n = in.u32();
  objects_ = in.u32();
  const auto product = [](const std::array<std::uint32_t, 3>& n) {
    return static_cast<double>(n[0]) * static_cast<double>(n[1]) * static_cast<double>(n[2]);
  };
  bool finite = std::isfinite(lattice_.step);
  for (int k = 0; k < 3; ++k) {
    finite = finite && std::isfinite(lattice_.origin[k]) && std::isfinite(regions_.origin[k]) && regions_.edge[k] > 0.0;
  }
  if (!finite || !(lattice_.step > 0.0) || !(std::fabs(lattice_.heading) < 100.0) || lattice_.levels > most_levels ||
      product(lattice_.count) > in.left() || product(regions_.count) > 1e9) {
    in.refuse("altered: no such lattice of cells");
  }
  std::uint64_t leaves = 0;
  for (std::uint32_t r = 0; r < lattice_.roots(); ++r) leaves += read_nodes(in, lattice_.levels, nodes_);
  const auto sets = in.block();
  sets_.assign(sets.begin(), sets.end());
  read_starts(leaves);
  index();
}

/// Where each leaf's bytes begin; checks that they are lists of what there is, and differences of what is there.
void BakedCells::read_starts(std::uint64_t leaves) {
  ByteReader reader(sets_, "its sets");
  std::vector<std::uint32_t> touching, added, removed, visible;
  for (std::uint64_t leaf = 0; leaf < leaves; ++leaf) {
    starts_.push_back(sets_.size() - reader.left());
    read_list(reader, objects_, touching);
    read_list(reader, items(), added);
    read_list(reader, items(), removed);
    if (leaf % key_every == 0) visible.clear();
    std::vector<std::uint32_t> kept = without(visible, removed);
    if (kept.size() + removed.size() != visible.size()) reader.refuse("altered: what is not there is taken away");
    if (without(added, kept).size() != added.size()) reader.refuse("altered: what is there is added");
    visible.clear();
    std::merge(kept.begin(), kept.end(), added.begin(), added.end(), std::back_inserter(visible));
  }
  reader.finish();
}

void BakedCells::index() {
  axes_ = lattice_.axes();
  skip_.assign(nodes_.size(), 0);
  leaf_rank_.assign(nodes_.size(), 0);
  std::uint32_t leaves = 0;
  std::vector<std::pair<std::uint32_t, int>> open;  // split nodes and children to come
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (open.empty()) trees_.push_back({i, leaves});
    leaf_rank_[i] = leaves;
    leaves += nodes_[i] == NodeKind::leaf;
    skip_[i] = i + 1;
    if (nodes_[i] == NodeKind::split) {
      open.emplace_back(i, 8);
      continue;
    }
    while (!open.empty() && --open.back().second == 0) {
      skip_[open.back().first] = i + 1;
      open.pop_back();
    }
  }
}

std::optional<std::uint32_t> BakedCells::find(const Vec3& point) const {
  std::array<std::uint64_t, 3> at{};
  const Vec3 local = axes_.inverse(point - lattice_.origin);
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const double i = std::floor(local[k] / lattice_.step);
    if (!(i >= 0.0 && i < std::ldexp(static_cast<double>(lattice_.count[axis]), static_cast<int>(lattice_.levels))))
      return std::nullopt;
    at[axis] = static_cast<std::uint64_t>(i);
  }
  const std::uint32_t levels = lattice_.levels;
  const auto root = static_cast<std::uint32_t>(
      (at[0] >> levels) + lattice_.count[0] * ((at[1] >> levels) + lattice_.count[1] * (at[2] >> levels)));
  std::uint32_t node = trees_[root].node, level = 0;
  for (; nodes_[node] == NodeKind::split; ++level) {
    const std::uint32_t bit = levels - level - 1;
    const auto child =
        static_cast<int>(((at[0] >> bit) & 1u) | ((at[1] >> bit) & 1u) << 1 | ((at[2] >> bit) & 1u) << 2);
    ++node;
    for (int k = 0; k < child; ++k) node = skip_[node];
  }
  if (nodes_[node] == NodeKind::none) return std::nullopt;
  for (std::uint64_t& x : at) x = x >> (levels - level) << (levels - level);
  if (!holds(lattice_.cell(at, level), point)) return std::nullopt;
  return leaf_rank_[node];
}

void BakedCells::decode(std::uint32_t leaf, LeafSet& out) const {
  out.visible.clear();
  std::vector<std::uint32_t> added, removed, kept;
  for (std::uint32_t i = leaf / key_every * key_every; i <= leaf; ++i) {
    ByteReader in(std::span<const std::byte>(sets_).subspan(starts_[i]), "its sets");
    read_list(in, items(), out.touching);
    read_list(in, items(), added);
    read_list(in, items(), removed);
    kept.clear();
    std::set_difference(out.visible.begin(), out.visible.end(), removed.begin(), removed.end(),
                        std::back_inserter(kept));
    out.visible.clear();
    std::merge(kept.begin(), kept.end(), added.begin(), added.end(), std::back_inserter(out.visible));
  }
}

SetSizes BakedCells::sizes() const {
  SetSizes out;
  out.leaves = starts_.size();
  LeafSet set;
  for (std::uint32_t leaf = 0; leaf < starts_.size(); ++leaf) {
    decode(leaf, set);
    out.entries += set.visible.size();
    out.plain += 4 * set.visible.size();
    out.bits += (items() + 7) / 8;
  }
  out.delta = sets_.size();
  return out;
}

}  // namespace gridcull::extended
