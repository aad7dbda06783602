#include "hand_made_scenes.h"

namespace gridcull::test {

std::span<const HandMadeScene> hand_made_scenes() {
  static const std::vector<HandMadeScene> all = [] {
    std::vector<HandMadeScene> scenes = hand_made_scenes_2d();
    for (HandMadeScene& scene : hand_made_scenes_3d()) scenes.push_back(std::move(scene));
    return scenes;
  }();
  return all;
}

}  // namespace gridcull::test
