// Numbers are checked and turned into poses straight from the message's bytes, in loops without branches that depend on
// them; only when something is wrong it is looked for where.
#include "gridcull/service/wire_bulk.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "gridcull/core/error.h"
#include "gridcull/core/trigonometry.h"
#include "gridcull/sim/scene_json.h"

namespace gridcull {
namespace {

constexpr double greatest = 1e9;

template <class Word>
Word in_file_order(Word word) {
  if constexpr (std::endian::native == std::endian::little) return word;
  Word turned = 0;
  for (std::size_t i = 0; i < sizeof(Word); ++i) turned = static_cast<Word>(turned << 8 | (word >> 8 * i & 0xFF));
  return turned;
}

template <class Word>
Word word_at(const char* bytes, std::size_t index) {
  Word word;
  std::memcpy(&word, bytes + index * sizeof(Word), sizeof(Word));
  return in_file_order(word);
}

/// As f32 or f64, little-endian.
template <class Float>
struct Floats {
  static constexpr std::size_t size = sizeof(Float);
  const char* bytes;

  double operator[](std::size_t index) const {
    if constexpr (size == 8) return std::bit_cast<double>(word_at<std::uint64_t>(bytes, index));
    return static_cast<double>(std::bit_cast<float>(word_at<std::uint32_t>(bytes, index)));
  }
};

/// Numbers of one key: f32, or f64 under the key's other name.
class Numbers {
 public:
  /// `each`: numbers for an object.
  Numbers(const JsonRef& frame, const char* single, const char* wide, std::size_t each, std::size_t objects) {
    const auto narrow_json = frame.find(single), wide_json = frame.find(wide);
    if (narrow_json && wide_json) {
      wide_json->refuse_with("expected either \"" + std::string(single) + "\" or \"" + wide + "\", found both");
    }
    if (!narrow_json && !wide_json) return;
    wide_ = wide_json.has_value();
    json_ = wide_ ? wide_json : narrow_json;
    bytes_ = json_->bytes();
    each_ = each;
    const std::size_t size = wide_ ? 8 : 4;
    if (bytes_.size() != objects * each * size) {
      json_->refuse_with("expected " + std::to_string(objects * each * size) + " bytes, " + std::to_string(each) +
                         (wide_ ? " f64" : " f32") + " for each of " + std::to_string(objects) + " ids, found " +
                         std::to_string(bytes_.size()));
    }
  }

  explicit operator bool() const { return json_.has_value(); }
  const JsonRef& json() const { return *json_; }

  /// Calls `action` with something whose [index] is the index-th number from the given object's first one on, once the
  /// numbers of that many objects are known to be finite and of magnitude at most 1e9.
  template <class Action>
  void use(std::size_t object, std::size_t objects, const Action& action) const {
    const std::size_t first = object * each_, count = objects * each_;
    const auto with = [&](const auto numbers) {
      bool fine = true;
      for (std::size_t i = 0; i < count; ++i) fine &= std::fabs(numbers[i]) <= greatest;
      for (std::size_t i = 0; i < count && !fine; ++i) {
        if (!(std::fabs(numbers[i]) <= greatest)) refuse_wild(first + i);
      }
      action(numbers);
    };
    wide_ ? with(Floats<double>{bytes_.data() + 8 * first}) : with(Floats<float>{bytes_.data() + 4 * first});
  }

 private:
  [[noreturn]] void refuse_wild(std::size_t place) const {
    json_->refuse_with("expected numbers of magnitude at most 1e9, found another at place " + std::to_string(place));
  }

  std::optional<JsonRef> json_{};
  std::string_view bytes_{};
  std::size_t each_ = 0;
  bool wide_ = false;
};

void read_bulk_ids(const JsonRef& json, std::vector<ObjectId>& ids) {
  const std::string_view bytes = json.bytes();
  if (bytes.size() % 4 != 0) json.refuse_with("expected 4 bytes an id, found " + std::to_string(bytes.size()));
  ids.resize(bytes.size() / 4);
  bool fine = true;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = word_at<std::uint32_t>(bytes.data(), i);
    fine &= ids[i] != no_id;
  }
  if (!fine) json.refuse_with("expected ids of at most 4294967294, found 4294967295");
  if (const auto at = first_repeated(ids)) {
    json.refuse_with("expected each id once, found " + std::to_string(ids[*at]) + " twice, the second time at place " +
                     std::to_string(*at));
  }
}

/// Moves are read so many at a time, all their parts, so that what is written stays near.
constexpr std::size_t stretch = 256;

void read_positions(const Numbers& numbers, std::size_t first, int dimension, std::span<Pose> poses) {
  numbers.use(first, poses.size(), [&](const auto at) {
    for (std::size_t i = 0; i < poses.size() && dimension == 2; ++i) {
      poses[i].position = {at[2 * i], at[2 * i + 1], 0.0};
    }
    for (std::size_t i = 0; i < poses.size() && dimension == 3; ++i) {
      poses[i].position = {at[3 * i], at[3 * i + 1], at[3 * i + 2]};
    }
  });
}

/// turn_about_z() of many.
void read_headings(const Numbers& numbers, std::size_t first, std::span<double> headings, std::span<Pose> poses) {
  std::array<double, stretch> half;
  std::array<SinCos, stretch> turned;
  numbers.use(first, poses.size(), [&](const auto at) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      headings[i] = at[i];
      half[i] = 0.5 * headings[i];
    }
  });
  stable_sincos(std::span(half.data(), poses.size()), turned);
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].orientation = {turned[i].cos, 0.0, 0.0, turned[i].sin};
}

void read_orientations(const Numbers& numbers, std::size_t first, std::span<Pose> poses) {
  numbers.use(first, poses.size(), [&](const auto at) {
    std::size_t i = 0;
    try {
      for (; i < poses.size(); ++i) {
        poses[i].orientation = settled({at[4 * i], at[4 * i + 1], at[4 * i + 2], at[4 * i + 3]});
      }
    } catch (const Error&) {
      numbers.json().refuse_with("expected unit quaternions, found another for id number " + std::to_string(first + i));
    }
  });
}

}  // namespace

void read_bulk_moves(const JsonRef& frame, int dimension, BulkMoves& out) {
  out.ids.clear();
  out.headings.clear();
  if (const auto ids = frame.find(set_ids)) read_bulk_ids(*ids, out.ids);
  const std::size_t count = out.ids.size();
  const Numbers positions(frame, set_positions, set_positions64, static_cast<std::size_t>(dimension), count);
  const Numbers headings(frame, set_headings, set_headings64, 1, count);
  const Numbers orientations(frame, set_orientations, set_orientations64, 4, count);
  if (orientations && dimension == 2) orientations.json().refuse_with("a 2D scene has headings, not orientations");
  if (headings && dimension == 3) headings.json().refuse_with("a 3D scene has orientations in bulk, not headings");
  out.poses.resize(count);
  if (headings) out.headings.resize(count);
  out.positions = static_cast<bool>(positions);
  out.orientations = headings || orientations;
  for (std::size_t first = 0; first < count; first += stretch) {
    const std::span<Pose> poses = std::span(out.poses).subspan(first, std::min(stretch, count - first));
    if (positions) read_positions(positions, first, dimension, poses);
    if (headings) read_headings(headings, first, std::span(out.headings).subspan(first), poses);
    if (orientations) read_orientations(orientations, first, poses);
  }
}

void append_bulk_ids(std::span<const ObjectId> ids, std::string& out) {
  const std::size_t before = out.size();
  out.resize(before + 4 * ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint32_t word = in_file_order(ids[i]);
    std::memcpy(out.data() + before + 4 * i, &word, sizeof word);
  }
}

}  // namespace gridcull
