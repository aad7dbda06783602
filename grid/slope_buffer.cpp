#include "gridcull/grid/slope_buffer.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace gridcull {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// A dozen roundings of 2^-53.
constexpr double rounded_up = 1.0 + 0x1p-49;

/// Slope at which two lines cross, held within [low, high]. They differ in sign at both ends.
double crossing(const SlopeLine& p, const SlopeLine& q, double low, double high) {
  const double s = (p.a - q.a) / (q.b - p.b);
  return s > low ? (s < high ? s : high) : low;  // not a number: low
}

/// Greatest w of the disc's near side along slope s: the greater root of |(1, s) X - centre| = radius in 1 / X. The
/// discriminant in the form without cancellation; 0 beside the disc, where its tangents end.
double near_side(const DiscSight& d, double s) {
  const double across = d.centre.y - s * d.centre.x;
  const double square = (1.0 + s * s) * d.radius * d.radius - across * across;
  return (d.centre.x + s * d.centre.y + (square > 0.0 ? std::sqrt(square) : 0.0)) / d.power;
}

/// The near side is concave in (s, w): discs are convex, and the map keeps lines. So its difference to a line is
/// greatest where a tangent is parallel to the line, or at the end of the slopes on that side.
bool hidden_by(const SlopeBuffer::Piece& piece, const DiscSight& disc, double low, double high) {
  if (piece.steep == 0.0) return piece.line.a == infinity;
  const double beyond = piece.line.a * disc.centre.x + piece.line.b * disc.centre.y - disc.radius * piece.steep;
  if (beyond > 1.0) return true;  // wholly beyond the line
  const double scale = disc.radius / piece.steep;
  const Vec2 nearest = disc.centre - scale * Vec2(piece.line.a, piece.line.b);
  if (nearest.x > 0.0 && nearest.y >= low * nearest.x && nearest.y <= high * nearest.x) return false;
  return near_side(disc, low) * rounded_up < piece.line.at(low) &&
         near_side(disc, high) * rounded_up < piece.line.at(high);
}

}  // namespace

void SlopeBuffer::reset() {
  for (auto& list : pieces_) {
    list.clear();
    list.push_back({-1.0, {}, 0.0, nobody});
    list.push_back({1.0, {}, 0.0, nobody});
  }
}

std::size_t SlopeBuffer::find(const std::vector<Piece>& list, double slope) {
  // The last piece that begins at or before the slope; the end does not count. Halving without branches.
  std::size_t first = 0, count = list.size() - 1;
  while (count > 1) {
    const std::size_t half = count / 2;
    first = list[first + half].from <= slope ? first + half : first;
    count -= half;
  }
  return first;
}

namespace {

/// Writes pieces one after the other. Those without width vanish, neighbours from one edge are one piece.
class Writer {
 public:
  explicit Writer(SlopeBuffer::Piece* begin) : begin_(begin), end_(begin) {}
  void add(double from, const SlopeBuffer::Piece& like) {
    if (end_ != begin_ && end_[-1].from >= from) --end_;
    if (end_ != begin_) {
      const SlopeBuffer::Piece& last = end_[-1];
      if (last.owner == like.owner && last.line.a == like.line.a && last.line.b == like.line.b) return;
    }
    *end_ = like;
    (end_++)->from = from;
  }
  std::size_t count() const { return static_cast<std::size_t>(end_ - begin_); }

 private:
  SlopeBuffer::Piece *begin_, *end_;
};

}  // namespace

// Lines meet in at most one point, so an edge crosses a piece at most once: a piece becomes at most two, and the
// first and last one more.
bool SlopeBuffer::insert(int quadrant, double from, double to, const SlopeLine& low, std::uint32_t owner) {
  if (!(from < to)) return false;
  auto& list = pieces_[static_cast<std::size_t>(quadrant)];
  std::size_t first = find(list, from);
  for (;; ++first) {  // pieces that the edge lies behind
    const Piece& p = list[first];
    const double end = std::min(to, list[first + 1].from), begin = std::max(from, p.from);
    if (low.at(begin) > p.line.at(begin) || low.at(end) > p.line.at(end)) break;
    if (list[first + 1].from >= to) return false;
  }
  const double steep = low.a == infinity ? 0.0 : std::sqrt(low.a * low.a + low.b * low.b);
  const Piece edge{from, low, steep, owner};
  if (fresh_.size() < 2 * list.size() + 4) fresh_.resize(4 * list.size() + 4);
  Writer out(fresh_.data());
  if (list[first].from < from) out.add(list[first].from, list[first]);
  std::size_t i = first;
  for (;; ++i) {
    const Piece& p = list[i];
    const double begin = std::max(from, p.from), next = list[i + 1].from, end = std::min(to, next);
    const bool above_begin = low.at(begin) > p.line.at(begin), above_end = low.at(end) > p.line.at(end);
    out.add(begin, above_begin ? edge : p);
    if (above_begin != above_end) {
      const double s = crossing(low, p.line, begin, end);
      if (s < end) out.add(s, above_begin ? p : edge);
    }
    if (next < to) continue;
    if (to < next) out.add(to, p);
    break;
  }
  splice(list, first, i + 1, out.count());
  return true;
}

/// The first `fresh` of fresh_ take the place of list[first .. end).
void SlopeBuffer::splice(std::vector<Piece>& list, std::size_t first, std::size_t end, std::size_t fresh) {
  const std::size_t after = first + fresh, rest = list.size() - end;
  if (after > end) list.resize(after + rest);
  if (after != end) std::memmove(list.data() + after, list.data() + end, rest * sizeof(Piece));
  if (after < end) list.resize(after + rest);
  std::memcpy(list.data() + first, fresh_.data(), fresh * sizeof(Piece));
}

void SlopeBuffer::close(int quadrant, double from, double to) { insert(quadrant, from, to, {infinity, 0.0}, nobody); }

double SlopeBuffer::open_width(int quadrant, double from, double to, const SlopeLine& high, double enough) const {
  if (!(from < to)) return 0.0;
  const auto& list = pieces_[static_cast<std::size_t>(quadrant)];
  double width = 0.0;
  for (std::size_t i = find(list, from);; ++i) {
    const Piece& p = list[i];
    const double begin = std::max(from, p.from), next = list[i + 1].from, end = std::min(to, next);
    const bool above_begin = high.at(begin) >= p.line.at(begin), above_end = high.at(end) >= p.line.at(end);
    if (above_begin && above_end) {
      width += end - begin;
    } else if (above_begin || above_end) {
      const double middle = crossing(high, p.line, begin, end);
      width += above_begin ? middle - begin : end - middle;
    }
    if (width > enough || next >= to) return width;
  }
}

double SlopeBuffer::open_width(int quadrant, double from, double to, const DiscSight& disc, double enough) const {
  if (!(from < to)) return 0.0;
  const auto& list = pieces_[static_cast<std::size_t>(quadrant)];
  double width = 0.0;
  for (std::size_t i = find(list, from);; ++i) {
    const double begin = std::max(from, list[i].from), next = list[i + 1].from, end = std::min(to, next);
    if (!hidden_by(list[i], disc, begin, end)) width += end - begin;
    if (width > enough || next >= to) return width;
  }
}

std::size_t SlopeBuffer::size() const {
  std::size_t count = 0;
  for (const auto& list : pieces_) count += list.size() - 1;
  return count;
}

std::uint64_t SlopeBuffer::bytes() const {
  std::uint64_t bytes = fresh_.capacity() * sizeof(Piece);
  for (const auto& list : pieces_) bytes += list.capacity() * sizeof(Piece);
  return bytes;
}

}  // namespace gridcull
