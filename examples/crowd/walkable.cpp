#include "walkable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <recastnavigation/DetourNavMeshBuilder.h>
#include <recastnavigation/Recast.h>

namespace {

constexpr float cell = 0.1F, wall_height = 3.0F, person_height = 1.8F, climb = 0.2F;  // metres

/// Triangles as Recast takes them: the floor, and each wall as a box.
struct Soup {
  std::vector<float> points{};
  std::vector<int> corners{};

  void add_quad(const std::array<std::array<float, 3>, 4>& quad) {
    const int first = static_cast<int>(points.size() / 3);
    for (const auto& point : quad) points.insert(points.end(), point.begin(), point.end());
    for (const int corner : {0, 1, 2, 0, 2, 3}) corners.push_back(first + corner);
  }
  /// A rectangle at this height that faces up.
  void add_level(float x0, float z0, float x1, float z1, float y) {
    add_quad({{{x0, y, z0}, {x0, y, z1}, {x1, y, z1}, {x1, y, z0}}});
  }
  void add_box(float x0, float z0, float x1, float z1) {
    add_level(x0, z0, x1, z1, wall_height);
    const std::array<std::array<float, 2>, 5> round{{{x0, z0}, {x1, z0}, {x1, z1}, {x0, z1}, {x0, z0}}};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [ax, az] = round[i];
      const auto [bx, bz] = round[i + 1];
      add_quad({{{ax, 0.0F, az}, {ax, wall_height, az}, {bx, wall_height, bz}, {bx, 0.0F, bz}}});
    }
  }
  int triangles() const { return static_cast<int>(corners.size() / 3); }
};

Soup soup_of(const FloorPlan& plan) {
  Soup out;
  out.add_level(0.0F, 0.0F, static_cast<float>(plan.width), static_cast<float>(plan.depth), 0.0F);
  for (const Wall& wall : plan.walls) {
    out.add_box(static_cast<float>(wall.min.x), static_cast<float>(wall.min.y), static_cast<float>(wall.max.x),
                static_cast<float>(wall.max.y));
  }
  return out;
}

void need(bool done, const char* what) {
  if (!done) throw std::runtime_error(std::string("Recast: ") + what + " failed");
}

template <class T, void (*Free)(T*)>
std::unique_ptr<T, decltype(Free)> held(T* made) {
  need(made != nullptr, "memory");
  return {made, Free};
}

using PolyMesh = std::unique_ptr<rcPolyMesh, decltype(&rcFreePolyMesh)>;

PolyMesh make_polygons(const Soup& soup, float radius) {
  rcContext context(false);
  std::array<float, 3> low{}, high{};
  rcCalcBounds(soup.points.data(), static_cast<int>(soup.points.size() / 3), low.data(), high.data());
  int width = 0, depth = 0;
  rcCalcGridSize(low.data(), high.data(), cell, &width, &depth);

  const auto solid = held<rcHeightfield, rcFreeHeightField>(rcAllocHeightfield());
  need(rcCreateHeightfield(&context, *solid, width, depth, low.data(), high.data(), cell, cell), "the height field");
  std::vector<unsigned char> areas(static_cast<std::size_t>(soup.triangles()), 0);
  const int points = static_cast<int>(soup.points.size() / 3), climb_cells = static_cast<int>(climb / cell);
  rcMarkWalkableTriangles(&context, 45.0F, soup.points.data(), points, soup.corners.data(), soup.triangles(),
                          areas.data());
  need(rcRasterizeTriangles(&context, soup.points.data(), points, soup.corners.data(), areas.data(), soup.triangles(),
                            *solid, climb_cells),
       "rasterising");
  const int head_room = static_cast<int>(std::ceil(person_height / cell));
  rcFilterWalkableLowHeightSpans(&context, head_room, *solid);

  const auto open = held<rcCompactHeightfield, rcFreeCompactHeightfield>(rcAllocCompactHeightfield());
  need(rcBuildCompactHeightfield(&context, head_room, climb_cells, *solid, *open), "the compact height field");
  need(rcErodeWalkableArea(&context, static_cast<int>(std::ceil(radius / cell)), *open), "eroding");
  need(rcBuildDistanceField(&context, *open), "the distance field");
  need(rcBuildRegions(&context, *open, 0, 8, 20), "the regions");
  const auto contours = held<rcContourSet, rcFreeContourSet>(rcAllocContourSet());
  need(rcBuildContours(&context, *open, 1.3F, static_cast<int>(12.0F / cell), *contours), "the contours");
  PolyMesh mesh = held<rcPolyMesh, rcFreePolyMesh>(rcAllocPolyMesh());
  need(rcBuildPolyMesh(&context, *contours, DT_VERTS_PER_POLYGON, *mesh), "the polygons");
  for (int i = 0; i < mesh->npolys; ++i) mesh->flags[i] = mesh->areas[i] == RC_WALKABLE_AREA ? 1 : 0;
  return mesh;
}

}  // namespace

NavMesh make_nav_mesh(const FloorPlan& plan, float radius) {
  const PolyMesh mesh = make_polygons(soup_of(plan), radius);
  dtNavMeshCreateParams params{};
  params.verts = mesh->verts;
  params.vertCount = mesh->nverts;
  params.polys = mesh->polys;
  params.polyAreas = mesh->areas;
  params.polyFlags = mesh->flags;
  params.polyCount = mesh->npolys;
  params.nvp = mesh->nvp;
  params.walkableHeight = person_height;
  params.walkableRadius = radius;
  params.walkableClimb = climb;
  std::copy_n(mesh->bmin, 3, params.bmin);
  std::copy_n(mesh->bmax, 3, params.bmax);
  params.cs = mesh->cs;
  params.ch = mesh->ch;
  params.buildBvTree = true;
  unsigned char* data = nullptr;
  int size = 0;
  need(dtCreateNavMeshData(&params, &data, &size), "the navigation mesh");
  NavMesh out(dtAllocNavMesh());
  need(out != nullptr && dtStatusSucceed(out->init(data, size, DT_TILE_FREE_DATA)), "the navigation mesh");
  return out;
}
