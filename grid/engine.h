// The regular-grid engine: methods `voxel` (Batagelo and Wu 2002) and `silhouette` (DESIGN section 5), 2D and 3D.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "gridcull/core/bound_kind.h"
#include "gridcull/core/bounds.h"
#include "gridcull/core/culler.h"
#include "gridcull/core/drawing.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/grid/static_cells.h"
#include "gridcull/grid/static_store.h"
#include "gridcull/grid/static_tiles.h"
#include "gridcull/grid/tile_stream.h"

namespace gridcull {

/// The two ways to hide inside the one engine (DESIGN section 5).
enum class Hiding {
  voxel,      ///< occluders are opaque cells, fused in object space (Batagelo and Wu 2002)
  silhouette  ///< occluders are the silhouettes of what was found visible, fused in image space
};

enum class TbvMode {
  off,     ///< every moving object is read and discretised in every frame
  solid,   ///< temporal bounding volumes as filled discs or balls: the safe default
  hollow,  ///< outlines only (2D circle, 3D cube faces), where that is provably safe; solid elsewhere
  /// solid, but for `silhouette` in 3D while there is no source: told of every move it gains nothing from them, since
  /// to see that a ball stays in its node of the index costs no more than to see that it stays in its volume.
  automatic
};

struct GridOptions {
  int dimension = 2;
  Bounds bounds{};
  double cell = 1.0;                                  ///< metres, > 0
  TbvMode tbv = TbvMode::solid;                       ///< `silhouette` takes hollow as solid
  int threads = 1;                                    ///< 1 .. 256; viewers run in parallel
  std::uint64_t max_memory = std::uint64_t{4} << 30;  ///< bytes for the matrices and masks
  Hiding hiding = Hiding::silhouette;
  int resolution = 0;  ///< `silhouette` in 3D: pixels along the mask's longer side, 8 .. 8192; 0: chosen per viewer
  /// `silhouette` in 3D: the volume that objects are tested with, in their local axes. None, the default: a ball as
  /// itself; a box as itself; a prism or a hull of few corners as its convex hull; anything else as its box.
  std::optional<BoundKind> bound{};
  /// Where static objects' cells are kept. With StoreKind::openvdb `max_memory` bounds a viewer's window and not the
  /// whole lattice, whose matrices then take room only where something is.
  StoreKind store = StoreKind::dense;
  /// Cells that were discretised before, of static objects that may be added; those that it does not hold, or holds
  /// otherwise, are discretised. Let go once used. Must fit the lattice.
  std::shared_ptr<const StaticCells> static_cells{};
  /// `voxel`: the same, read as viewers come near and let go again (tile_stream.h), for the static objects that are
  /// added before the first query and stay as they are. Must fit the lattice.
  std::shared_ptr<TiledCells> static_tiles{};
  std::uint64_t static_memory = std::uint64_t{1} << 30;  ///< bytes for cells of static_tiles
};

const MethodInfo& grid_engine_info(Hiding hiding);

/// Bytes held, by part.
struct MemoryUse {
  std::uint64_t matrices = 0;  ///< O, O_s and the heads of I and T
  std::uint64_t viewers = 0;   ///< per-thread H, view copies and queues
  std::uint64_t entries = 0;   ///< entries of I and T
  std::uint64_t objects = 0;   ///< object table and shapes
  std::uint64_t total() const { return matrices + viewers + entries + objects; }
};

/// One world on one grid. No global state: any number may live in a process; one instance is used by one
/// thread at a time (it runs threads of its own inside query()).
class GridEngine final : public Culler {
 public:
  /// Throws Error(bad_scene) or Error(limit) as Lattice does, Error(bad_scene) for static cells or tiles of another
  /// lattice, and Error(usage) for threads out of range or a store that is not there.
  explicit GridEngine(const GridOptions& options);
  ~GridEngine() override;

  const MethodInfo& info() const override;
  void add(const Object& object) override;
  void remove(ObjectId object) override;
  void move(ObjectId object, const Pose& pose) override;
  void move_all(std::span<const Move> moves) override;
  void set_source(PositionSource* source) override;
  void announce_jump(ObjectId object) override;
  void query(double time, std::span<const View> views, Answers& out) override;

  /// Draws the traversals of these viewers in the next query() (once), each into its own sink, instead of what was to
  /// be drawn before.
  void draw_next(std::span<const Drawing> drawings);
  /// The same for one viewer; nullptr cancels.
  void draw_next(ViewerId viewer, DrawSink* sink);

  const Lattice& lattice() const;
  MemoryUse memory() const;
  /// What is held of GridOptions::static_tiles; zeros without.
  TileUse tiles() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gridcull
