#include "kept_misses.h"

#include <limits>

namespace gridcull::test {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double all_round = View{}.fov;

}  // namespace

std::vector<KeptMiss> kept_misses() {
  return {
      {"a volume that ran out since the last frame was left, and that counted as a jump, in push mode only",
       WorldScript{2,
                   {{0, 0, 0}, {0, 0, 0}},
                   1,
                   "solid",
                   1,
                   {Object{5u, Rectangle{{2, 2}}, {{0, 38, 0}}, std::optional<double>{200}, true, false}},
                   {ScriptFrame{0, {}, {}, {}, {}}, ScriptFrame{1e6, {}, {}, {ScriptMove{5u, {{0, 0, 0}}}}, {}}}}},
      {"an object added and moved in one frame counted as a jump, in push mode only",
       WorldScript{2,
                   {{0, 0, 0}, {0, 0, 0}},
                   7,
                   "solid",
                   1,
                   {},
                   {ScriptFrame{0, {}, {}, {}, {}},
                    ScriptFrame{1,
                                {},
                                {Object{47u, Disc{3}, {{0, 0, 0}}, std::optional<double>{0}, true, false}},
                                {ScriptMove{47u, {{0, 40, 0}}}},
                                {}}}}},
      {"a hidden object beyond the lattice around the viewer and nearer than its near plane was not reported",
       WorldScript{
           3,
           {{0, 0, 0}, {0, 0, 0}},
           2,
           "solid",
           1,
           {Object{53u, Cuboid{{4, 16, 2}}, {{16, 28, 39}}, std::optional<double>{0}, true, false}},
           {ScriptFrame{-3, {}, {}, {}, {}},
            ScriptFrame{0, {}, {}, {}, {View{1u, {{16, 27, 39}}, inf, all_round, Frustum{2, 1, 13, inf}, no_id}}}}}},
      {"after a pause of 1e17 first frame steps volumes that had run out were still believed",
       WorldScript{2,
                   {{0, 0, 0}, {32, 32, 0}},
                   1,
                   "solid",
                   1,
                   {Object{1u, Rectangle{{4, 32}}, {{16, 16, 0}}, std::nullopt, true, true},
                    Object{2u, Disc{0.5}, {{28, 16, 0}}, std::optional<double>{1}, true, false}},
                   {ScriptFrame{0, {}, {}, {}, {View{1u, {{4.5, 16, 0}}}}},
                    ScriptFrame{1e-9, {}, {}, {}, {View{1u, {{4.5, 16, 0}}}}},
                    ScriptFrame{1e8, {}, {}, {ScriptMove{2u, {{10, 16, 0}}}}, {View{1u, {{4.5, 16, 0}}}}}}}},
      {"an expiry that was rounded to a later time, far from time 0, outlived its volume",
       WorldScript{3,
                   {{0, 0, 0}, {0, 0, 0}},
                   0.1,
                   "solid",
                   1,
                   {Object{37u, Sphere{0.1}, {{0, 0, 0}}, std::optional<double>{1e+09}, true, false}},
                   {ScriptFrame{1000000.0000000029, {}, {}, {ScriptMove{37u, {{1.5, 0.15, 2.1}}}}, {}},
                    ScriptFrame{1000000.000000003, {}, {}, {ScriptMove{37u, {{1.5, 0.25, 2.1}}}}, {}}}}},
      {"what lies behind an occluder's front by less than 1e-12 of the coordinates was hidden by shadow frusta",
       WorldScript{
           2,
           {{0, 0, 0}, {0, 0, 0}},
           1,
           "solid",
           1,
           {Object{8u, Rectangle{{0.3865584359337655, 2}}, {{3.753089538033879, 6, 0}}, std::nullopt, true, true},
            Object{14u, Rectangle{{1.6323668718675308, 1}}, {{0, 0, 0}}, std::nullopt, true, true}},
           {ScriptFrame{0,
                        {},
                        {},
                        {ScriptMove{14u, {{4.375993756005388, 6, 0}}}},
                        {View{0u, {{0, 6, 0}}, inf, all_round, std::nullopt, no_id}}}}}},
      {"in a world of more than 65,536 nodes along one axis the wrong nodes were opened, and nobody was seen",
       WorldScript{3,
                   {{0, 0, 0}, {300000, 8, 8}},
                   1,
                   "off",
                   1,
                   {Object{1u, Cuboid{{4, 2, 2}}, {{100, 4, 1}}, std::nullopt, true, false},
                    Object{2u, Sphere{1}, {{250000, 4, 1}}, std::nullopt, true, false}},
                   {ScriptFrame{0, {}, {}, {}, {View{1u, {{90, 4, 1.6}}}, View{2u, {{249990, 4, 1.6}}}}}}}},
  };
}

}  // namespace gridcull::test
