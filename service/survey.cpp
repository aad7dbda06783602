#include "gridcull/service/survey.h"

#include "gridcull/grid/choose_lattice.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/progress.h"
#include "gridcull/sim/frames.h"
#include "gridcull/sim/text_file.h"
#include "gridcull/sim/world.h"

namespace gridcull {
namespace {

void add_frame(const Frame& frame, const World& world, Survey& survey) {
  for (const SceneObject& added : frame.add) {
    survey.objects.push_back(added.object);
    if (world.has(added.object.id)) add_extent(world.object(added.object.id), survey.extent);
  }
  for (const ObjectMove& move : frame.set) add_extent(world.object(move.id), survey.extent);
  if (survey.frames == 0) survey.first_time = frame.time;
  survey.last_time = frame.time;
  survey.moves += frame.set.size();
  survey.removals += frame.remove.size();
  ++survey.frames;
}

}  // namespace

Survey survey_world(const Scene& scene, const std::string& frames) {
  Survey survey;
  for (const SceneObject& object : scene.objects) {
    survey.objects.push_back(object.object);
    add_extent(object.object, survey.extent);
  }
  if (frames.empty() || reads_once(frames)) {
    survey.frames = frames.empty() ? 1 : 0;
    return survey;
  }
  World world(scene);
  FrameReader reader(frames, scene.dimension, &stop_if_interrupted);
  Progress progress("frames looked at", std::nullopt);
  for (Frame frame; reader.next(frame);) {
    stop_if_interrupted();
    world.apply(frame);
    add_frame(frame, world, survey);
    progress.update(survey.frames);
  }
  return survey;
}

std::uint64_t count_frames(const std::string& path) {
  if (path.empty() || reads_once(path)) return 0;
  TextReader reader(path);
  std::uint64_t lines = 0;
  for (std::string line; reader.line(line);) ++lines;
  return lines == 0 ? 0 : lines - 1;
}

}  // namespace gridcull
