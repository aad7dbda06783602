// What those who watch a session are told: the world once, then each frame as it was applied and answered.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "gridcull/service/session.h"

namespace gridcull {

/// `{"type": "watching", "session", "name", "method", "dimension", "cell", "bounds", "seq", "scene": {gridcull.scene/1
/// as the world stands now, without viewers}}`.
nlohmann::ordered_json watch_start(const Session& session, const std::string& id);

/// `{"type": "step", "seq", "time", "frame": {a frames/1 line}, "views": [...], "answers": [{"viewer", "visible"}],
/// "stats": {...}, "drawn": {...}}`: the last frame; "drawn" (drawn_view.h) where somebody chose a viewer;
/// the server adds "exact", the size of that viewer's exact set when it was last audited.
nlohmann::ordered_json watch_step(const Session& session, const Frame& frame);

}  // namespace gridcull
