// Volumes in cells, against the volume told point by point (volume_truth.h).
#include <doctest/doctest.h>

#include "gridcull/grid/cover.h"
#include "random_volumes.h"
#include "volume_truth.h"

using namespace gridcull;
using test::random_volume;
using test::VolumeTruth;

namespace {

struct Counts {
  int cells = 0, touched = 0, opaque = 0, met = 0, inside = 0;
};

class Case {
 public:
  explicit Case(std::uint64_t seed) : random_(seed) {
    cell_ = uniform(0.3, 2.0);
    const Vec3 low(uniform(-8, 2), uniform(-8, 2), uniform(-8, 2));
    lattice_ = std::make_unique<Lattice>(
        3, Bounds{low, low + cell_ * Vec3(1 + below(11), 1 + below(11), 1 + below(11))}, cell_, std::uint64_t{1} << 30);
    volume_ = std::make_unique<Volume>(random_volume(random_, uniform(0.3, 6.0)));
    pose_.position = {uniform(-4, 4), uniform(-4, 4), uniform(-4, 4)};
    if (below(3) > 0) {
      pose_.orientation = normalised({uniform(-1, 1) + 1.1, uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
    } else if (below(2) == 0) {
      // The lattices' planes fall on each other.
      const double voxel = volume_->field->frame().voxel;
      pose_.position = low + voxel * Vec3(below(9), below(9), below(9)) - volume_->field->frame().pose.position;
    }
  }

  Counts check() {
    Cover cover;
    CoverScratch scratch;
    PreparedShape(*volume_).cover(*lattice_, pose_, scratch, cover);
    const VolumeTruth truth(*volume_, pose_);
    std::vector<std::uint64_t> touched(lattice_->brick_count()), opaque(lattice_->brick_count());
    std::int64_t last = -1;
    for (const BrickCover& brick : cover.bricks) {
      CHECK(static_cast<std::int64_t>(brick.brick) > last);
      CHECK(brick.touched != 0);
      CHECK((brick.opaque & ~brick.touched) == 0);
      CHECK((brick.touched & ~lattice_->brick_cells(brick.brick)) == 0);
      last = brick.brick;
      touched[brick.brick] = brick.touched, opaque[brick.brick] = brick.opaque;
    }
    Counts sum;
    Cell c;
    const Cell n = lattice_->cells();
    for (c.z = 0; c.z < n.z; ++c.z) {
      for (c.y = 0; c.y < n.y; ++c.y) {
        for (c.x = 0; c.x < n.x; ++c.x) {
          const std::size_t brick = lattice_->brick_of(c);
          const int bit = lattice_->bit_of(c);
          judge(truth, c, (touched[brick] >> bit & 1) != 0, (opaque[brick] >> bit & 1) != 0, sum);
        }
      }
    }
    return sum;
  }

 private:
  void judge(const VolumeTruth& truth, const Cell& c, bool touched, bool opaque, Counts& sum) {
    bool any = false, all = true;
    constexpr int steps = 5;  // corners, edges, faces and within
    for (int i = 0; i < steps * steps * steps; ++i) {
      const Vec3 share(i % steps / (steps - 1.0), i / steps % steps / (steps - 1.0), i / steps / steps / (steps - 1.0));
      const Vec3 low(lattice_->boundary(0, c.x), lattice_->boundary(1, c.y), lattice_->boundary(2, c.z));
      const double depth = truth.depth(low + lattice_->cell() * share);
      any = any || depth < -1e-12;
      all = all && depth < 0.0;
    }
    if (any) CHECK(touched);
    if (opaque) CHECK(all);
    ++sum.cells;
    sum.touched += touched, sum.opaque += opaque, sum.met += any, sum.inside += all;
  }

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  std::mt19937_64 random_;
  double cell_ = 1.0;
  std::unique_ptr<Lattice> lattice_;
  std::unique_ptr<Volume> volume_;
  Pose pose_{};
};

}  // namespace

TEST_CASE("a volume's cells: none missed, none opaque that is not") {
  Counts sum;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    const Counts one = Case(seed).check();
    sum.cells += one.cells, sum.touched += one.touched, sum.opaque += one.opaque;
    sum.met += one.met, sum.inside += one.inside;
  }
  MESSAGE(sum.cells << " cells: " << sum.touched << " touched, " << sum.met << " met by a sample; " << sum.opaque
                    << " opaque, " << sum.inside << " with all samples inside");
  // Estimates, but not by much.
  CHECK(sum.touched < 2 * sum.met);
  CHECK(2 * sum.opaque > sum.inside);
}
