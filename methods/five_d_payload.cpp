#include "gridcull/methods/five_d_payload.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <string>

#include "gridcull/methods/five_d_bake.h"

namespace gridcull {
namespace {

void write_bounds(ByteWriter& out, const Bounds& bounds) {
  for (const Vec3& corner : {bounds.min, bounds.max}) {
    for (int k = 0; k < 3; ++k) out.f64(corner[k]);
  }
}

Bounds read_bounds(ByteReader& in) {
  Bounds bounds;
  for (Vec3* corner : {&bounds.min, &bounds.max}) {
    for (int k = 0; k < 3; ++k) (*corner)[k] = in.f64();
  }
  return bounds;
}

bool usable(const Bounds& bounds) {
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(bounds.min[k]) || !(bounds.min[k] <= bounds.max[k]) || !std::isfinite(bounds.max[k])) {
      return false;
    }
  }
  return true;
}

std::string line(const char* name, const std::string& value) {
  char text[32];
  std::snprintf(text, sizeof text, "%-16s", name);
  return text + value + "\n";
}

const char* name_of(FiveDCoding coding) {
  switch (coding) {
    case FiveDCoding::plain: return "1, leaves alone";
    case FiveDCoding::parent: return "2, within the parent";
    case FiveDCoding::sibling: return "3, within parent and sibling";
  }
  return "";
}

}  // namespace

void write_space(ByteWriter& out, const FiveDSpace& space) {
  out.u8(static_cast<std::uint8_t>(space.dimension));
  out.u8(static_cast<std::uint8_t>(space.bits));
  write_bounds(out, space.positions);
  out.u32(space.statics);
  write_bounds(out, space.region);
  for (const std::uint32_t count : space.boxes) out.u32(count);
}

FiveDSpace read_space(ByteReader& in) {
  FiveDSpace space;
  space.dimension = in.u8();
  space.bits = in.u8();
  space.positions = read_bounds(in);
  space.statics = in.u32();
  space.region = read_bounds(in);
  double boxes = 1.0;
  for (std::uint32_t& count : space.boxes) count = in.u32(), boxes *= count;
  const bool good = (space.dimension == 2 || space.dimension == 3) && space.bits >= 4 && space.bits <= 20 &&
                    usable(space.positions) && boxes <= 0x1p20 && space.statics <= 0x7FFF'FFFFu &&
                    (boxes == 0.0 || usable(space.region));
  if (!good) in.refuse("altered: its view space is none");
  return space;
}

void write_tree(ByteWriter& out, const FiveDTree& tree, const FiveDSpace& space) {
  BitString best;
  FiveDCoding coding = FiveDCoding::plain;
  for (const FiveDCoding each : five_d_codings) {
    BitString bits = encode(tree, space, each);
    if (each != FiveDCoding::plain && bits.size >= best.size) continue;
    best = std::move(bits);
    coding = each;
  }
  out.u8(static_cast<std::uint8_t>(coding));
  out.u64(best.size);
  out.block(best.bytes);
}

FiveDTree read_tree(ByteReader& in, const FiveDSpace& space, std::string_view name) {
  const std::uint8_t coding = in.u8();
  BitString bits;
  bits.size = in.u64();
  const auto bytes = in.block();
  bits.bytes.assign(bytes.begin(), bytes.end());
  if (coding < 1 || coding > 3 || (bits.size + 7) / 8 != bytes.size() || bits.size > 8 * bytes.size()) {
    in.refuse("altered: its tree is in no known coding");
  }
  return decode(bits, space, static_cast<FiveDCoding>(coding), name);
}

std::vector<std::byte> five_d_payload(const FiveDBaked& baked) {
  ByteWriter out;
  write_space(out, baked.space);
  out.u64(baked.cells);
  out.u64(baked.rays);
  write_tree(out, baked.tree, baked.space);
  return out.take();
}

FiveDBaked read_five_d_payload(std::span<const std::byte> payload, std::string_view name) {
  ByteReader in(payload, name);
  FiveDBaked baked;
  baked.space = read_space(in);
  baked.cells = in.u64();
  baked.rays = in.u64();
  baked.tree = read_tree(in, baked.space, name);
  in.finish();
  return baked;
}

std::string describe_five_d(std::span<const std::byte> payload) {
  const FiveDBaked baked = read_five_d_payload(payload, "baked tree");
  const FiveDSpace& space = baked.space;
  const std::size_t leaves = baked.tree.leaves(space);
  std::uint64_t listed = 0;
  for (const std::uint64_t word : baked.tree.sets) listed += static_cast<std::uint64_t>(std::popcount(word));
  char mean[64];
  std::snprintf(mean, sizeof mean, "%.1f of %u", static_cast<double>(listed) / static_cast<double>(leaves),
                space.members());
  std::string text = line("members", std::to_string(space.statics) + " static objects, " +
                                         std::to_string(space.box_count()) + " motion boxes");
  text += line("cells", std::to_string(baked.cells) + ", by direction " + std::to_string(leaves));
  text += line("a cell lists", mean);
  text += line("rays", std::to_string(baked.rays));
  for (const FiveDCoding coding : five_d_codings) {
    const std::uint64_t bits = encode(baked.tree, space, coding).size;
    text += line("coding", std::string(name_of(coding)) + ": " + std::to_string((bits + 7) / 8) + " bytes");
  }
  return text;
}

}  // namespace gridcull
