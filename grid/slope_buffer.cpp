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
  for (List& list : lists_) {
    if (list.pieces.size() < 2) list.pieces.resize(2);
    list.pieces[0] = {-1.0, {}, 0.0, nobody};
    list.pieces[1] = {1.0, {}, 0.0, nobody};
    list.size = 2;
  }
}

std::size_t SlopeBuffer::find(const List& list, double slope) {
  // The last piece that begins at or before the slope; the end does not count. Halving without branches.
  const Piece *pieces = list.pieces.data(), *first = pieces;
  for (std::size_t count = list.size - 1; count > 1;) {
    const std::size_t half = count / 2;
    first = first[half].from <= slope ? first + half : first;
    count -= half;
  }
  return static_cast<std::size_t>(first - pieces);
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

bool SlopeBuffer::insert(int quadrant, double from, double to, const SlopeLine& low, std::uint32_t owner) {
  if (!(from < to)) return false;
  List& list = lists_[static_cast<std::size_t>(quadrant)];
  std::size_t at = find(list, from);
  const Piece* p = &list.pieces[at];
  double begin = from, w_begin = low.at(from);
  for (;; ++p) {  // pieces that the edge lies behind
    const double next = p[1].from, end = std::min(to, next), w_end = low.at(end);
    const bool above_begin = w_begin > p->line.at(begin), above_end = w_end > p->line.at(end);
    if (above_begin || above_end) {
      const double steep = low.a == infinity ? 0.0 : std::sqrt(low.a * low.a + low.b * low.b);
      at = static_cast<std::size_t>(p - list.pieces.data());
      if (above_begin && above_end && to <= next) {
        insert_into_one(list, at, to, {begin, low, steep, owner});
      } else {
        insert_into_many(list, at, to, {begin, low, steep, owner});
      }
      return true;
    }
    if (next >= to) return false;
    begin = next;
    w_begin = w_end;
  }
}

/// The edge, up to `to`, is in front of all that it spans of one piece.
void SlopeBuffer::insert_into_one(List& list, std::size_t at, double to, const Piece& edge) {
  const Piece old = list.pieces[at];
  const bool before = old.from < edge.from, after = to < list.pieces[at + 1].from;
  if (before || after) resize_hole(list, at + 1, at + 1 + (before ? 1 : 0) + (after ? 1 : 0));
  Piece* out = &list.pieces[at];
  if (before) ++out;
  *out = edge;
  if (!after) return;
  out[1] = old;
  out[1].from = to;
}

// Lines meet in at most one point, so an edge crosses a piece at most once: a piece becomes at most two, and the
// first and last one more.
void SlopeBuffer::insert_into_many(List& list, std::size_t first, double to, const Piece& edge) {
  if (fresh_.size() < 2 * list.size + 4) fresh_.resize(4 * list.size + 4);
  Writer out(fresh_.data());
  const Piece* p = &list.pieces[first];
  const SlopeLine& low = edge.line;
  if (p->from < edge.from) out.add(p->from, *p);
  double begin = edge.from, w_begin = low.at(begin);
  for (;; ++p) {
    const double next = p[1].from, end = std::min(to, next), w_end = low.at(end);
    const bool above_begin = w_begin > p->line.at(begin), above_end = w_end > p->line.at(end);
    out.add(begin, above_begin ? edge : *p);
    if (above_begin != above_end) {
      const double s = crossing(low, p->line, begin, end);
      if (s < end) out.add(s, above_begin ? *p : edge);
    }
    if (next >= to) break;
    begin = next;
    w_begin = w_end;
  }
  if (to < p[1].from) out.add(to, *p);
  const auto end = static_cast<std::size_t>(p - list.pieces.data()) + 1;
  if (first + out.count() != end) resize_hole(list, end, first + out.count());
  std::memcpy(&list.pieces[first], fresh_.data(), out.count() * sizeof(Piece));
}

/// What begins at `end` begins at `new_end` from now on.
void SlopeBuffer::resize_hole(List& list, std::size_t end, std::size_t new_end) {
  const std::size_t rest = list.size - end;
  if (list.pieces.size() < new_end + rest) list.pieces.resize(2 * (new_end + rest));
  std::memmove(list.pieces.data() + new_end, list.pieces.data() + end, rest * sizeof(Piece));
  list.size = new_end + rest;
}

void SlopeBuffer::close(int quadrant, double from, double to) { insert(quadrant, from, to, {infinity, 0.0}, nobody); }

bool SlopeBuffer::nearer(int quadrant, double from, double to, double most) const {
  const List& list = lists_[static_cast<std::size_t>(quadrant)];
  const Piece* p = &list.pieces[find(list, from)];
  for (double begin = from;; ++p) {
    const double next = p[1].from, end = std::min(to, next);
    if (!(p->line.at(begin) > most && p->line.at(end) > most)) return false;
    if (next >= to) return true;
    begin = next;
  }
}

double SlopeBuffer::open_width(int quadrant, double from, double to, const SlopeLine& high, double enough) const {
  if (!(from < to)) return 0.0;
  const List& list = lists_[static_cast<std::size_t>(quadrant)];
  double width = 0.0;
  for (std::size_t i = find(list, from);; ++i) {
    const Piece& p = list.pieces[i];
    const double begin = std::max(from, p.from), next = list.pieces[i + 1].from, end = std::min(to, next);
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
  const List& list = lists_[static_cast<std::size_t>(quadrant)];
  double width = 0.0;
  for (std::size_t i = find(list, from);; ++i) {
    const Piece& p = list.pieces[i];
    const double begin = std::max(from, p.from), next = list.pieces[i + 1].from, end = std::min(to, next);
    if (!hidden_by(p, disc, begin, end)) width += end - begin;
    if (width > enough || next >= to) return width;
  }
}

std::size_t SlopeBuffer::size() const {
  std::size_t count = 0;
  for (const List& list : lists_) count += list.size - 1;
  return count;
}

std::uint64_t SlopeBuffer::bytes() const {
  std::uint64_t bytes = fresh_.capacity() * sizeof(Piece);
  for (const List& list : lists_) bytes += list.pieces.capacity() * sizeof(Piece);
  return bytes;
}

}  // namespace gridcull
