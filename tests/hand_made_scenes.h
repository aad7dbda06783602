// Small worlds with answers that a person can check on paper: who must be seen and who must not.
// The exact reference must agree with both lists, a conservative method must report at least `sees`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull::test {

struct HandMadeScene {
  std::string name;
  int dimension = 2;
  std::vector<Object> objects;
  View view;
  std::vector<ObjectId> sees;   ///< visible with a comfortable width
  std::vector<ObjectId> hides;  ///< truly not visible; an over-estimating method may still report them
};

/// All of them, 2D first.
std::span<const HandMadeScene> hand_made_scenes();

std::vector<HandMadeScene> hand_made_scenes_2d();
std::vector<HandMadeScene> hand_made_scenes_3d();

}  // namespace gridcull::test
