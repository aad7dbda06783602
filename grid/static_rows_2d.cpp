#include "gridcull/grid/static_rows_2d.h"

#include <algorithm>
#include <limits>

namespace gridcull {
namespace {

using Box = StaticRows2D::Box;
using Member = StaticRows2D::Member;
using Row = StaticRows2D::Row;
constexpr std::size_t lanes = StaticRows2D::lanes;

constexpr Box nothing() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {Vec2(infinity), Vec2(-infinity)};
}

void grow(Box& box, const Box& by) {
  box.low = glm::min(box.low, by.low);
  box.high = glm::max(box.high, by.high);
}

/// Members of a row behind each other. Halves are whole rows, as many as fill rows of rows where there are so many; by
/// place and slot, so that it is known who goes where, whatever sorts them.
void split(std::span<Member> members) {
  if (members.size() <= lanes) {
    std::sort(members.begin(), members.end(), [](const Member& a, const Member& b) { return a.slot < b.slot; });
    return;
  }
  Box centres = nothing();
  const auto middle = [](const Member& m) { return m.box.low + m.box.high; };
  for (const Member& m : members) grow(centres, {middle(m), middle(m)});
  const Vec2 extent = centres.high - centres.low;
  const int axis = extent.x >= extent.y ? 0 : 1;
  std::size_t whole = lanes;
  while (whole * lanes < members.size()) whole *= lanes;
  const std::size_t left = (members.size() / whole + 1) / 2 * whole;
  std::nth_element(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(left), members.end(),
                   [&](const Member& a, const Member& b) {
                     const double x = middle(a)[axis], y = middle(b)[axis];
                     return x != y ? x < y : a.slot < b.slot;
                   });
  split(members.first(left));
  split(members.subspan(left));
}

void set_lane(Row& row, std::size_t lane, std::uint32_t what, const Box& box) {
  row.boxes.set(lane, box);
  row.what[lane] = what;
  row.there = static_cast<std::uint8_t>(row.there | 1u << lane);
}

Box box_about(const Row& row) {
  Box box = nothing();
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    if ((row.there >> lane & 1) != 0) grow(box, StaticRows2D::box_of(row, lane));
  }
  return box;
}

}  // namespace

void StaticRows2D::build(std::vector<Member>& members) {
  split(members);
  levels_.clear();
  places_.clear();
  size_ = members.size();
  holes_ = 0;
  box_ = nothing();
  if (members.empty()) return;
  std::vector<Row>& rows = levels_.emplace_back((members.size() + lanes - 1) / lanes);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const Member& m = members[i];
    Row& row = rows[i / lanes];
    set_lane(row, i % lanes, m.slot, m.box);
    if (m.occluder) row.occluders = static_cast<std::uint8_t>(row.occluders | 1u << i % lanes);
    if (m.slot >= places_.size()) places_.resize(m.slot + 1, none);
    places_[m.slot] = static_cast<std::uint32_t>(i);
    grow(box_, m.box);
  }
  while (levels_.back().size() > 1) add_level();
}

void StaticRows2D::add_level() {
  const std::vector<Row>& below = levels_.back();
  std::vector<Row> rows((below.size() + lanes - 1) / lanes);
  for (std::size_t i = 0; i < below.size(); ++i) {
    set_lane(rows[i / lanes], i % lanes, static_cast<std::uint32_t>(i), box_about(below[i]));
  }
  levels_.push_back(std::move(rows));
}

void StaticRows2D::remove(Slot slot) {
  if (!holds(slot)) return;
  Row& row = levels_[0][places_[slot] / lanes];
  row.there = static_cast<std::uint8_t>(row.there & ~(1u << places_[slot] % lanes));
  places_[slot] = none;
  --size_;
  ++holes_;
}

std::uint64_t StaticRows2D::bytes() const {
  std::uint64_t bytes = places_.capacity() * sizeof(std::uint32_t);
  for (const std::vector<Row>& rows : levels_) bytes += rows.capacity() * sizeof(Row);
  return bytes;
}

}  // namespace gridcull
