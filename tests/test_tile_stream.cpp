// Static cells read tile by tile: all of them are somewhere, none is told twice, and an engine that holds only some
// answers conservatively (the random worlds of test_property_* run one more, which holds a part).
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/core/error.h"
#include "gridcull/grid/engine.h"
#include "gridcull/grid/shared_cells.h"
#include "gridcull/grid/static_tiles.h"
#include "random_world.h"

namespace gridcull::test {
namespace {

constexpr std::uint64_t plenty = std::uint64_t{1} << 30;
constexpr std::uint64_t everything = std::numeric_limits<std::uint64_t>::max();

StaticCells cells_of(const GridOptions& options, const std::vector<Object>& objects) {
  const Lattice lattice(options.dimension, options.bounds, options.cell, plenty);
  return *discretise_static(lattice, objects, plenty, [](double) { return true; });
}

GridOptions options_of(const WorldScript& script) {
  GridOptions options;
  options.hiding = Hiding::voxel;
  options.dimension = script.dimension;
  options.bounds = script.bounds;
  options.cell = script.cell;
  return options;
}

/// A street of houses along x, 20 m apart, and a lantern behind each.
struct Street {
  explicit Street(int houses = 20) {
    options.hiding = Hiding::voxel;
    options.bounds = {{0, 0, 0}, {20.0 * houses, 64, 0}};
    for (int i = 0; i < houses; ++i) {
      const auto id = static_cast<ObjectId>(i);
      objects.push_back(make_static(id, Rectangle{{12, 8}}, {20.0 * i + 10, 32, 0}));
      objects.push_back(make_static(1000 + id, Disc{0.5}, {20.0 * i + 10, 50, 0}));
    }
  }
  std::shared_ptr<TiledCells> tiles(int shift = 3) const { return tiled(cells_of(options, objects), shift); }
  std::unique_ptr<GridEngine> engine(std::shared_ptr<TiledCells> cells, std::uint64_t bytes) {
    options.static_tiles = std::move(cells);
    options.static_memory = bytes;
    auto made = std::make_unique<GridEngine>(options);
    for (const Object& object : objects) made->add(object);
    return made;
  }
  static View view(double x, double range) {
    View v = make_view(1, {x, 10, 0});
    v.range = range;
    return v;
  }

  GridOptions options;
  std::vector<Object> objects;
};

std::vector<ObjectId> answer(GridEngine& engine, double time, const View& view) {
  Answers answers;
  engine.query(time, std::vector{view}, answers);
  return answers.views[0].visible;
}

TEST_CASE("the tiles together are all cells, each once, and know what is in them") {
  for (const int dimension : {2, 3}) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const WorldScript script = random_world(dimension, 12'000 + seed);
      const StaticCells cells = cells_of(options_of(script), script.objects);
      const auto tiles = tiled(cells, 3);
      std::map<std::pair<std::uint32_t, std::uint32_t>, BrickCover> found;
      std::vector<MemberBrick> covers;
      for (std::size_t i = 0; i < tiles->tiles().size(); ++i) {
        tiles->read(i, covers);
        CHECK(covers.size() == tiles->tiles()[i].covers);
        CHECK(tile_hash(covers) == tiles->tiles()[i].hash);
        for (const MemberBrick& at : covers)
          CHECK(found.emplace(std::pair(at.member, at.cover.brick), at.cover).second);
      }
      CHECK(found.size() == cells.bricks.size());
      for (std::uint32_t m = 0; m < cells.members.size(); ++m) {
        for (const BrickCover& cover : cells.of(cells.members[m])) {
          CHECK(found.at({m, cover.brick}).touched == cover.touched);
          CHECK(found.at({m, cover.brick}).opaque == cover.opaque);
        }
      }
      const std::string text = tiles_text(tiles->tiles(), cells);
      const auto back = parse_tiles(text, cells, tiles->layout());
      CHECK(tiles_text(back, cells) == text);
    }
  }
}

TEST_CASE("texts that are no tiles are refused") {
  const Street street(2);
  const StaticCells cells = cells_of(street.options, street.objects);
  const TileLayout layout(cells.cells, 4);
  CHECK(parse_tiles("1 2 1 ff 0 1000\n3 1 1 0 1\n", cells, layout)[3].members.size() == 1);
  for (const char* text :
       {"1", "1 2 1 ff\n", "1 2 1 ff 7\n", "1 2 1 ff 1 0\n", "1 2 1 ff 0", "3 1 1 0 1\n1 1 1 0 1\n",
        "1 1 1 0 1\n1 1 1 0 1\n", "99 1 1 0 1\n", "-1 1 1 0 1\n", "1 x 1 0 1\n", "1 1 x 0 1\n", "\n"}) {
    CAPTURE(text);
    CHECK_THROWS_AS((void)parse_tiles(text, cells, layout), Error);
  }
}

TEST_CASE("with room for all tiles the answers are those without tiles") {
  for (const int dimension : {2, 3}) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      const WorldScript script = random_world(dimension, 13'000 + seed);
      GridOptions options = options_of(script);
      GridEngine plain(options);
      options.static_tiles = tiled(cells_of(options, script.objects), 3);
      options.static_memory = everything;
      GridEngine streamed(options);
      for (const Object& object : script.objects) plain.add(object), streamed.add(object);
      Answers a, b;
      plain.query(0, script.frames[0].views, a);
      streamed.query(0, script.frames[0].views, b);
      CAPTURE(dimension);
      CAPTURE(seed);
      for (std::size_t i = 0; i < a.views.size(); ++i) CHECK(a.views[i].visible == b.views[i].visible);
    }
  }
}

TEST_CASE("what is not held hides nothing and shows everything in view") {
  Street street;
  GridEngine plain(street.options);
  for (const Object& object : street.objects) plain.add(object);
  const View view = Street::view(110, 60);
  CHECK(answer(plain, 0, view) == std::vector<ObjectId>{2, 3, 4, 5, 6, 7, 8, 1004, 1006});
  const auto none_held = street.engine(street.tiles(), 0);
  CHECK(answer(*none_held, 0, view) == std::vector<ObjectId>{2, 3, 4, 5, 6, 7, 8, 1003, 1004, 1005, 1006, 1007});
  CHECK(none_held->tiles().held == 0);
  CHECK(none_held->tiles().read == 0);
}

TEST_CASE("the nearest tiles are held, within the limit, and follow the viewer") {
  Street street(200);
  const auto all = street.tiles(4);
  std::uint64_t bytes = 0;
  for (const StaticTile& tile : all->tiles()) bytes += tile_bytes(tile);
  bytes /= 10;
  const auto engine = street.engine(all, bytes);
  GridEngine plain(street.options = [&] {
    GridOptions options = street.options;
    options.static_tiles = nullptr;
    return options;
  }());
  for (const Object& object : street.objects) plain.add(object);
  double time = 0;
  for (double x = 30; x < 3970; x += 40, ++time) {
    const View view = Street::view(x, 100);
    // A tenth is twice what such a view needs: it answers as if all were there.
    CHECK(answer(*engine, time, view) == answer(plain, time, view));
    CHECK(engine->tiles().bytes <= bytes);
    CHECK(engine->tiles().held > 0);
  }
  CHECK(engine->tiles().let_go > 100);
  CHECK(engine->tiles().read > engine->tiles().let_go);
  // Standing still costs nothing, and what is held depends on no history.
  const std::uint64_t read = engine->tiles().read;
  (void)answer(*engine, time++, Street::view(3950, 100));
  (void)answer(*engine, time++, Street::view(3950, 100));
  CHECK(engine->tiles().read <= read + 8);
  const auto fresh = street.engine(all, bytes / 8);
  const auto old = street.engine(all, bytes / 8);
  (void)answer(*old, 0, Street::view(3000, 300));
  CHECK(answer(*old, 1, Street::view(500, 300)) == answer(*fresh, 1, Street::view(500, 300)));
}

// A ball about a tile reaches farther than the tile: who stands in the tile is told within the view's range only.
TEST_CASE("an object in a tile beyond the range is not told for that") {
  Street street;
  street.objects = {make_static(0, Rectangle{{60, 4}}, {60, 32, 0}), make_static(1, Rectangle{{100, 2}}, {120, 40, 0})};
  GridEngine plain(street.options);
  for (const Object& object : street.objects) plain.add(object);
  const auto engine = street.engine(street.tiles(4), everything);
  double time = 0;
  for (double x = 4; x < 160; x += 4, ++time) {
    View view = Street::view(x, 45);
    CHECK(answer(*engine, time, view) == answer(plain, time, view));
  }
}

TEST_CASE("edits of what is in tiles: moved, removed, added again") {
  Street street;
  const auto engine = street.engine(street.tiles(), everything);
  const View view = Street::view(110, 60);
  CHECK(!sees(Answer{0, answer(*engine, 0, view), {}}, 1005));
  engine->move(5, {{110, 60, 0}});
  CHECK(sees(Answer{0, answer(*engine, 1, view), {}}, 1005));
  engine->move(5, street.objects[10].pose);
  CHECK(!sees(Answer{0, answer(*engine, 2, view), {}}, 1005));
  engine->remove(5);
  CHECK(sees(Answer{0, answer(*engine, 3, view), {}}, 1005));
  engine->add(street.objects[10]);
  CHECK(!sees(Answer{0, answer(*engine, 4, view), {}}, 1005));
  // Far away everything of it is let go of, what was edited stays.
  const auto small = street.engine(street.tiles(), 8 * 7000);
  (void)answer(*small, 0, view);
  small->remove(5);
  small->move(1004, {{95, 12, 0}});
  (void)answer(*small, 1, Street::view(390, 20));
  const auto back = answer(*small, 2, view);
  CHECK(sees(Answer{0, back, {}}, 1005));
  CHECK(!sees(Answer{0, back, {}}, 5));
  CHECK(sees(Answer{0, back, {}}, 1004));
  // A house that was moved does not come back with its tiles.
  const auto half = street.engine(street.tiles(), 80 * 7000);
  (void)answer(*half, 0, view);
  half->move(5, {{390, 55, 0}});
  (void)answer(*half, 1, Street::view(330, 200));
  CHECK(half->tiles().let_go > 10);
  CHECK(sees(Answer{0, answer(*half, 2, view), {}}, 1005));
}

/// Cells that cannot be read for a while, or are others than the directory says.
class BadTiles final : public TiledCells {
 public:
  explicit BadTiles(std::shared_ptr<TiledCells> good) : good_(std::move(good)) {}
  const StaticCells& head() const override { return good_->head(); }
  const TileLayout& layout() const override { return good_->layout(); }
  std::span<const StaticTile> tiles() const override { return good_->tiles(); }
  void read(std::size_t tile, std::vector<MemberBrick>& out) override {
    if (broken) throw Error(ErrorCode::io, "no disk");
    good_->read(tile, out);
    if (altered) out.front().cover.touched ^= 1;
  }
  std::uint64_t bytes() const override { return good_->bytes(); }
  bool broken = false, altered = false;

 private:
  std::shared_ptr<TiledCells> good_;
};

TEST_CASE("a tile that cannot be read costs its frame and nothing else") {
  Street street;
  const auto tiles = std::make_shared<BadTiles>(street.tiles());
  const auto engine = street.engine(tiles, everything);
  const View view = Street::view(110, 60);
  tiles->broken = true;
  CHECK_THROWS_AS((void)answer(*engine, 0, view), Error);
  tiles->broken = false;
  tiles->altered = true;
  CHECK_THROWS_AS((void)answer(*engine, 1, view), Error);
  tiles->altered = false;
  CHECK(answer(*engine, 2, view) == std::vector<ObjectId>{2, 3, 4, 5, 6, 7, 8, 1004, 1006});
}

TEST_CASE("a viewer in a house whose tile is not held is told of it and looks out of it") {
  Street street;
  const auto engine = street.engine(street.tiles(), 0);
  View view = Street::view(110, 25);
  view.pose.position.y = 32;
  CHECK(answer(*engine, 0, view) == std::vector<ObjectId>{4, 5, 6, 1005});
}

TEST_CASE("tiles of another lattice are refused") {
  Street street;
  const auto tiles = street.tiles();
  street.options.cell = 0.5;
  CHECK_THROWS_AS((void)street.engine(tiles, 0), Error);
}

}  // namespace
}  // namespace gridcull::test
