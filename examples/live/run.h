// The loop of a live example: takes frames from a running simulator, asks who sees whom after each, records everything.
#pragma once

#include <functional>
#include <string>

#include <gridcull/core/culler.h>
#include <gridcull/sim/frames.h>
#include <gridcull/sim/scene.h>

struct LiveOptions {
  std::string title{};   ///< what simulates, "SUMO": the session's name and a word of the report
  std::string server{};  ///< HOST:PORT of a gridcull server; "": gridcull works in this process
  std::string out{};     ///< folder for scene.json, frames.jsonl (for `gridcull run` and `check`) and pvs.jsonl
};

/// Runs until the frames end or SIGINT or SIGTERM comes, then prints a report. `scene` holds what never moves.
/// `tell` is called once a simulated second.
void run_live(const LiveOptions& options, const gridcull::Scene& scene, gridcull::FrameSource& frames,
              const std::function<void(const gridcull::Frame&, const gridcull::Answers&)>& tell);

/// " NAME NAME ... and N more" for the first eight movers in an answer, " nobody" for none.
std::string named(const gridcull::Answer& answer, const gridcull::Scene& scene,
                  const std::function<std::string(gridcull::ObjectId)>& name);

/// What main() does with an exception: one line on standard error and status 2.
int told_fault(const char* program, const std::exception& fault);
