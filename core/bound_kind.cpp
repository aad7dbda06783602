#include "gridcull/core/bound_kind.h"

namespace gridcull {

std::string_view name_of(BoundKind kind) {
  switch (kind) {
    case BoundKind::box: return "box";
    case BoundKind::sphere: return "sphere";
    case BoundKind::obb: return "obb";
    case BoundKind::dop14: return "14-dop";
    case BoundKind::dop18: return "18-dop";
    case BoundKind::dop26: return "26-dop";
    case BoundKind::hull: return "hull";
  }
  return "";
}

std::optional<BoundKind> find_bound_kind(std::string_view name) {
  for (const BoundKind kind : all_bound_kinds) {
    if (name_of(kind) == name) return kind;
  }
  return std::nullopt;
}

std::string bound_kind_names() {
  std::string names;
  for (std::size_t i = 0; i < all_bound_kinds.size(); ++i) {
    names += (i == 0 ? "" : i + 1 < all_bound_kinds.size() ? ", " : " or ") + std::string(name_of(all_bound_kinds[i]));
  }
  return names;
}

}  // namespace gridcull
