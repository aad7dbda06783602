#include "gridcull/service/server/metrics.h"

#include <prometheus/text_serializer.h>

#include "gridcull/sim/stats.h"

namespace gridcull {
namespace {

prometheus::Counter& counter(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildCounter().Name(name).Help(help).Register(registry).Add({});
}

prometheus::Gauge& gauge(prometheus::Registry& registry, const char* name, const char* help) {
  return prometheus::BuildGauge().Name(name).Help(help).Register(registry).Add({});
}

prometheus::Histogram& histogram(prometheus::Registry& registry, const char* name, const char* help,
                                 const prometheus::Histogram::BucketBoundaries& bounds) {
  return prometheus::BuildHistogram().Name(name).Help(help).Register(registry).Add({}, bounds);
}

}  // namespace

Metrics::Metrics()
    : rejected_(prometheus::BuildCounter()
                    .Name("gridcull_rejected_messages_total")
                    .Help("Messages that were answered with an error, by its code")
                    .Register(registry_)),
      memory_(gauge(registry_, "gridcull_memory_bytes", "Resident memory of the server")),
      frames(counter(registry_, "gridcull_frames_total", "Frames applied")),
      queries(counter(registry_, "gridcull_queries_total", "Views answered")),
      positions_read(counter(registry_, "gridcull_positions_read_total", "Positions that methods used")),
      tbv_revealed(counter(registry_, "gridcull_tbv_revealed_total", "Temporal bounding volumes found visible")),
      audited(counter(registry_, "gridcull_audited_answers_total", "Answers held against the exact reference")),
      audit_skipped(counter(registry_, "gridcull_audit_skipped_total",
                            "Answers that were to be audited while the auditor was behind")),
      audit_missed(counter(registry_, "gridcull_audit_missed_objects_total",
                           "Visible objects that audited answers of conservative methods lacked")),
      slow_closed(counter(registry_, "gridcull_slow_connections_closed_total",
                          "Connections closed because their other end did not read")),
      sessions(gauge(registry_, "gridcull_sessions", "Sessions, those that wait for their client included")),
      connections(gauge(registry_, "gridcull_connections", "Open connections")),
      frame_seconds(histogram(registry_, "gridcull_frame_seconds", "From a frame's message to its answer's bytes",
                              {1e-4, 2.5e-4, 5e-4, 1e-3, 2.5e-3, 5e-3, 1e-2, 2.5e-2, 5e-2, 0.1, 0.25, 0.5, 1.0, 2.5})),
      pvs_objects(histogram(registry_, "gridcull_pvs_objects", "Objects in a view's potentially visible set",
                            {0, 1, 3, 10, 30, 100, 300, 1000, 3000, 10000, 100000})) {}

std::string Metrics::text() const {
  memory_.Set(static_cast<double>(resident_bytes()));
  return prometheus::TextSerializer().Serialize(registry_.Collect());
}

void Metrics::count_rejected(const std::string& code) { rejected_.Add({{"code", code}}).Increment(); }

}  // namespace gridcull
