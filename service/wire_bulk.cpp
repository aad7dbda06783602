#include "gridcull/service/wire_bulk.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string_view>

#include "gridcull/core/error.h"
#include "gridcull/sim/scene_json.h"

namespace gridcull {
namespace {

constexpr double greatest = 1e9;

template <class Word>
Word word_at(std::string_view bytes, std::size_t index) {
  Word word = 0;
  for (std::size_t i = sizeof(Word); i-- > 0;) {
    word = static_cast<Word>(word << 8 | static_cast<std::uint8_t>(bytes[index * sizeof(Word) + i]));
  }
  return word;
}

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
    const std::size_t size = wide_ ? 8 : 4;
    if (bytes_.size() != objects * each * size) {
      json_->refuse_with("expected " + std::to_string(objects * each * size) + " bytes, " + std::to_string(each) +
                         (wide_ ? " f64" : " f32") + " for each of " + std::to_string(objects) + " ids, found " +
                         std::to_string(bytes_.size()));
    }
  }

  explicit operator bool() const { return json_.has_value(); }
  double at(std::size_t index) const {
    const double value = wide_ ? std::bit_cast<double>(word_at<std::uint64_t>(bytes_, index))
                               : static_cast<double>(std::bit_cast<float>(word_at<std::uint32_t>(bytes_, index)));
    if (!(std::fabs(value) <= greatest)) {
      json_->refuse_with("expected numbers of magnitude at most 1e9, found another at place " + std::to_string(index));
    }
    return value;
  }
  const JsonRef& json() const { return *json_; }

 private:
  std::optional<JsonRef> json_{};
  std::string_view bytes_{};
  bool wide_ = false;
};

void refuse_repeated_ids(const JsonRef& json, const std::vector<ObjectMove>& moves) {
  std::vector<ObjectId> ids;
  for (const ObjectMove& move : moves) ids.push_back(move.id);
  if (!std::is_sorted(ids.begin(), ids.end())) std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end()) json.refuse_with("expected each id once, found " + std::to_string(*twice) + " twice");
}

Quat orientation_at(const Numbers& numbers, std::size_t object) {
  const std::size_t i = 4 * object;
  try {
    return settled({numbers.at(i), numbers.at(i + 1), numbers.at(i + 2), numbers.at(i + 3)});
  } catch (const Error&) {
    numbers.json().refuse_with("expected unit quaternions, found another for id number " + std::to_string(object));
  }
}

}  // namespace

std::vector<ObjectMove> read_bulk_moves(const JsonRef& frame, int dimension) {
  const auto ids_json = frame.find(set_ids);
  const std::string_view ids = ids_json ? ids_json->bytes() : std::string_view{};
  if (ids.size() % 4 != 0) ids_json->refuse_with("expected 4 bytes an id, found " + std::to_string(ids.size()));
  const std::size_t count = ids.size() / 4;
  const auto places = static_cast<std::size_t>(dimension);
  const Numbers positions(frame, set_positions, set_positions64, places, count);
  const Numbers headings(frame, set_headings, set_headings64, 1, count);
  const Numbers orientations(frame, set_orientations, set_orientations64, 4, count);
  if (orientations && dimension == 2) orientations.json().refuse_with("a 2D scene has headings, not orientations");
  if (headings && dimension == 3) headings.json().refuse_with("a 3D scene has orientations in bulk, not headings");
  std::vector<ObjectMove> moves(count);
  for (std::size_t i = 0; i < count; ++i) {
    ObjectMove& move = moves[i];
    move.id = word_at<std::uint32_t>(ids, i);
    if (move.id == no_id) ids_json->refuse_with("expected ids of at most 4294967294, found 4294967295");
    if (positions) {
      const std::size_t at = places * i;
      move.position = Vec3(positions.at(at), positions.at(at + 1), places == 3 ? positions.at(at + 2) : 0.0);
    }
    if (headings) {
      move.heading = headings.at(i);
      move.orientation = turn_about_z(*move.heading);
    }
    if (orientations) move.orientation = orientation_at(orientations, i);
  }
  if (ids_json) refuse_repeated_ids(*ids_json, moves);
  return moves;
}

std::vector<std::uint8_t> bulk_ids(const std::vector<ObjectId>& ids) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * ids.size());
  for (const ObjectId id : ids) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(id >> shift));
  }
  return bytes;
}

}  // namespace gridcull
