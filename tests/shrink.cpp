#include "shrink.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace gridcull::test {
namespace {

class Shrinker {
 public:
  Shrinker(WorldScript script, const std::function<bool(const WorldScript&)>& fails, int budget)
      : best_(std::move(script)), fails_(fails), budget_(budget), most_cells_(4.0 * cells(best_)) {}

  WorldScript run() {
    while (pass()) {
    }
    return best_;
  }

 private:
  /// Rounder bounds or cells may mean millions of cells: not simpler.
  static double cells(const WorldScript& s) {
    double count = 1.0;
    for (int k = 0; k < s.dimension; ++k) count *= std::max(1.0, (s.bounds.max[k] - s.bounds.min[k]) / s.cell);
    return count;
  }

  template <class Change>
  bool attempt(Change&& change) {
    if (budget_ <= 0) return false;
    WorldScript candidate = best_;
    if (!change(candidate) || !(cells(candidate) <= most_cells_)) return false;
    --budget_;
    if (!fails_(candidate)) return false;
    best_ = std::move(candidate);
    return true;
  }

  /// Leaves out elements of a list one by one, from the back.
  template <class List>
  bool thin(List&& list) {
    bool changed = false;
    for (std::size_t i = list(best_).size(); i-- > 0;) {
      changed = attempt([&](WorldScript& s) {
                  auto& v = list(s);
                  v.erase(v.begin() + static_cast<std::ptrdiff_t>(i));
                  return true;
                }) ||
                changed;
    }
    return changed;
  }

  bool pass() {
    bool changed = thin_frames();
    changed = forget_objects() || changed;
    for (std::size_t f = 0; f < best_.frames.size(); ++f) {
      changed = thin([f](WorldScript & s) -> auto& { return s.frames[f].views; }) || changed;
      changed = thin([f](WorldScript & s) -> auto& { return s.frames[f].add; }) || changed;
      changed = thin([f](WorldScript & s) -> auto& { return s.frames[f].remove; }) || changed;
      changed = thin([f](WorldScript & s) -> auto& { return s.frames[f].moves; }) || changed;
    }
    changed = simplify_options() || changed;
    for_each_object([&](auto at) { changed = simplify_object(at) || changed; });
    for (std::size_t f = 0; f < best_.frames.size(); ++f) {
      changed = simplify_number([f](WorldScript& s) -> double& { return s.frames[f].time; }) || changed;
      for (std::size_t i = 0; i < best_.frames[f].moves.size(); ++i) {
        changed = simplify_pose([f, i](WorldScript& s) -> Pose& { return s.frames[f].moves[i].pose; }) || changed;
      }
      for (std::size_t i = 0; i < best_.frames[f].views.size(); ++i) {
        changed = simplify_view([f, i](WorldScript& s) -> View& { return s.frames[f].views[i]; }) || changed;
      }
    }
    return changed && budget_ > 0;
  }

  bool thin_frames() {
    bool changed = thin([](WorldScript & s) -> auto& { return s.frames; });
    // A frame whose changes matter, but not as a frame of its own: hand them to the next one.
    for (std::size_t f = 0; f + 1 < best_.frames.size(); ++f) {
      changed = attempt([f](WorldScript& s) {
                  const ScriptFrame from = s.frames[f];
                  ScriptFrame& to = s.frames[f + 1];
                  to.remove.insert(to.remove.begin(), from.remove.begin(), from.remove.end());
                  to.add.insert(to.add.begin(), from.add.begin(), from.add.end());
                  to.moves.insert(to.moves.begin(), from.moves.begin(), from.moves.end());
                  s.frames.erase(s.frames.begin() + static_cast<std::ptrdiff_t>(f));
                  return true;
                }) ||
                changed;
    }
    return changed;
  }

  bool forget_objects() {
    bool changed = false;
    for (std::size_t i = best_.objects.size(); i-- > 0;) {
      changed = attempt([i](WorldScript& s) {
                  const ObjectId id = s.objects[i].id;
                  s.objects.erase(s.objects.begin() + static_cast<std::ptrdiff_t>(i));
                  for (ScriptFrame& frame : s.frames) {
                    std::erase_if(frame.moves, [&](const ScriptMove& m) { return m.id == id; });
                    std::erase(frame.remove, id);
                  }
                  return true;
                }) ||
                changed;
    }
    return changed;
  }

  template <class F>
  void for_each_object(F&& f) {
    for (std::size_t i = 0; i < best_.objects.size(); ++i) {
      f([i](WorldScript& s) -> Object& { return s.objects[i]; });
    }
    for (std::size_t k = 0; k < best_.frames.size(); ++k) {
      for (std::size_t i = 0; i < best_.frames[k].add.size(); ++i) {
        f([k, i](WorldScript& s) -> Object& { return s.frames[k].add[i]; });
      }
    }
  }

  /// Sets a value if it is another one.
  template <class At, class Value>
  bool set(At&& at, const Value& value) {
    return attempt([&](WorldScript& s) {
      if (at(s) == value) return false;
      at(s) = value;
      return true;
    });
  }

  bool simplify_options() {
    bool changed = set(
        [](WorldScript & s) -> auto& { return s.tbv; }, std::string("off"));
    changed = set(
                  [](WorldScript & s) -> auto& { return s.tbv; }, std::string("solid")) ||
              changed;
    changed = set(
                  [](WorldScript & s) -> auto& { return s.threads; }, 1) ||
              changed;
    changed = simplify_number([](WorldScript& s) -> double& { return s.cell; }) || changed;
    for (int k = 0; k < best_.dimension; ++k) {
      changed = simplify_number([k](WorldScript& s) -> double& { return s.bounds.min[k]; }) || changed;
      changed = simplify_number([k](WorldScript& s) -> double& { return s.bounds.max[k]; }) || changed;
    }
    return changed;
  }

  /// Fewer digits.
  template <class At>
  bool simplify_number(At&& at) {
    const double value = at(best_);
    if (value == 0.0 || !std::isfinite(value)) return false;
    if (set(at, 0.0)) return true;
    for (const double scale : {1.0, 2.0, 10.0, 100.0, 1e4, 1e6}) {
      const double rounded = std::round(value * scale) / scale;
      if (rounded == value) return false;
      if (set(at, rounded)) return true;
    }
    return false;
  }

  template <class At>
  bool simplify_pose(At&& at) {
    bool changed = attempt([&](WorldScript& s) {
      Quat& q = at(s).orientation;
      if (q.w == 1.0) return false;
      q = Quat{};
      return true;
    });
    for (int k = 0; k < best_.dimension; ++k) {
      changed = simplify_number([&, k](WorldScript& s) -> double& { return at(s).position[k]; }) || changed;
    }
    return changed;
  }

  template <class At>
  bool simplify_view(At&& at) {
    bool changed = simplify_pose([&](WorldScript& s) -> Pose& { return at(s).pose; });
    changed = set(
                  [&](WorldScript & s) -> auto& { return at(s).rides; }, no_id) ||
              changed;
    changed = set(
                  [&](WorldScript & s) -> auto& { return at(s).range; }, View{}.range) ||
              changed;
    changed = set(
                  [&](WorldScript & s) -> auto& { return at(s).fov; }, View{}.fov) ||
              changed;
    changed = attempt([&](WorldScript& s) {
                const bool had = at(s).frustum.has_value();
                at(s).frustum.reset();
                return had;
              }) ||
              changed;
    changed = simplify_number([&](WorldScript& s) -> double& { return at(s).range; }) || changed;
    if (!at(best_).frustum) return changed;
    const auto number = [&](double Frustum::*part) {
      changed = simplify_number([&](WorldScript& s) -> double& { return *at(s).frustum.*part; }) || changed;
    };
    changed = set(
                  [&](WorldScript & s) -> auto& { return at(s).frustum->far; }, Frustum{}.far) ||
              changed;
    number(&Frustum::fov_y);
    number(&Frustum::aspect);
    number(&Frustum::near);
    number(&Frustum::far);
    return changed;
  }

  template <class At>
  bool simplify_object(At&& at) {
    bool changed = simplify_pose([&](WorldScript& s) -> Pose& { return at(s).pose; });
    changed = set(
                  [&](WorldScript & s) -> auto& { return at(s).is_static; }, true) ||
              changed;
    changed = set(
                  [&](WorldScript & s) -> auto& { return at(s).max_speed; }, std::optional<double>{}) ||
              changed;
    if (at(best_).max_speed) {
      changed = simplify_number([&](WorldScript& s) -> double& { return *at(s).max_speed; }) || changed;
    }
    return simplify_shape(at) || changed;
  }

  template <class At>
  bool simplify_shape(At&& at) {
    return std::visit(
        [&](const auto& kind) {
          using Kind = std::decay_t<decltype(kind)>;
          const auto shape = [&](WorldScript& s) -> Kind& { return std::get<Kind>(at(s).shape); };
          bool changed = false;
          if constexpr (requires { Kind::radius; }) {
            changed = simplify_number([&](WorldScript& s) -> double& { return shape(s).radius; });
          } else if constexpr (requires { Kind::size; }) {
            for (int k = 0; k < best_.dimension; ++k) {
              changed = simplify_number([&, k](WorldScript& s) -> double& { return shape(s).size[k]; }) || changed;
            }
          } else if constexpr (requires { Kind::vertices; }) {
            changed = simplify_vertices(shape);
          }
          return changed;
        },
        Shape(at(best_).shape));
  }

  template <class At>
  bool simplify_vertices(At&& at) {
    bool changed = false;
    if constexpr (requires(WorldScript & s) { at(s).triangles; }) {
      changed = thin([&](WorldScript & s) -> auto& { return at(s).triangles; });
    } else {
      changed = thin([&](WorldScript & s) -> auto& { return at(s).vertices; });
    }
    if constexpr (requires(WorldScript & s) { at(s).height; }) {
      changed = simplify_number([&](WorldScript& s) -> double& { return at(s).height; }) || changed;
    }
    const int parts = at(best_).vertices.front().length();
    for (std::size_t i = 0; i < at(best_).vertices.size(); ++i) {
      for (int k = 0; k < parts; ++k) {
        changed = simplify_number([&, i, k](WorldScript& s) -> double& { return at(s).vertices[i][k]; }) || changed;
      }
    }
    return changed;
  }

  WorldScript best_;
  const std::function<bool(const WorldScript&)>& fails_;
  int budget_;
  double most_cells_;
};

}  // namespace

WorldScript shrink(WorldScript script, const std::function<bool(const WorldScript&)>& fails, int budget) {
  return Shrinker(std::move(script), fails, budget).run();
}

}  // namespace gridcull::test
