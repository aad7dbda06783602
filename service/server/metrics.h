// What the service counts, for Prometheus. All members may be used from any thread.
#pragma once

#include <memory>
#include <string>

#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/gauge.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

namespace gridcull {

class Metrics {
 public:
  Metrics();

  /// The text of GET /metrics.
  std::string text() const;
  /// A message that was answered with an error of this code.
  void count_rejected(const std::string& code);

 private:
  prometheus::Registry registry_;
  prometheus::Family<prometheus::Counter>& rejected_;
  prometheus::Gauge& memory_;

 public:
  prometheus::Counter &frames, &queries, &positions_read, &tbv_revealed;
  prometheus::Counter &audited, &audit_skipped, &audit_missed, &slow_closed;
  prometheus::Gauge &sessions, &connections;
  prometheus::Histogram &frame_seconds, &pvs_objects;
};

}  // namespace gridcull
