// Hands the temporal bounding volumes to a drawing sink, for both ways to hide.
#pragma once

#include <algorithm>

#include "gridcull/core/drawing.h"
#include "gridcull/grid/grid_world.h"
#include "gridcull/grid/view_answerer.h"

namespace gridcull {

/// `ball_of(slot)`: the volume of a hidden object, with `centre` and `radius`.
template <class BallOf>
void draw_volumes(const GridWorld& world, const ViewResult& result, BallOf&& ball_of, DrawSink& sink) {
  for (Slot slot = 0; slot < world.objects.size(); ++slot) {
    const ObjectState& state = world.objects[slot];
    if (state.place != Place::hidden) continue;
    const auto& ball = ball_of(slot);
    const bool revealed = std::find(result.revealed.begin(), result.revealed.end(), slot) != result.revealed.end();
    sink.tbv(state.id, ball.centre, ball.radius, revealed);
  }
}

}  // namespace gridcull
