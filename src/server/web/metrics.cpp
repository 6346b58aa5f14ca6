#include "server/web/metrics.hpp"

#include <prometheus/metric_family.h>
#include <prometheus/text_serializer.h>

#include <utility>
#include <vector>

#include "protocol/plan_messages.hpp"

namespace nbvopt {
namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;
using Labels = std::vector<ClientMetric::Label>;

/// Families of metrics, in the order in which they are shown.
class Families {
 public:
  /// Metrics that are added from here on belong to it.
  void begin(MetricType type, const char* name, const char* help) {
    families_.push_back({std::string("nbvopt_") + name, help, type, {}});
  }

  void add(double value, Labels labels = {}) {
    ClientMetric& metric = add_metric(std::move(labels));
    if (families_.back().type == MetricType::Counter) {
      metric.counter.value = value;
    } else {
      metric.gauge.value = value;
    }
  }

  void add(ClientMetric::Histogram histogram, Labels labels) {
    add_metric(std::move(labels)).histogram = std::move(histogram);
  }

  void gauge(const char* name, const char* help, double value) {
    begin(MetricType::Gauge, name, help);
    add(value);
  }

  void counter(const char* name, const char* help, double value) {
    begin(MetricType::Counter, name, help);
    add(value);
  }

  std::string text() const { return prometheus::TextSerializer().Serialize(families_); }

 private:
  ClientMetric& add_metric(Labels labels) {
    ClientMetric& metric = families_.back().metric.emplace_back();
    metric.label = std::move(labels);
    return metric;
  }

  std::vector<MetricFamily> families_;
};

double number(std::uint64_t value) { return static_cast<double>(value); }

/// Every fourth bound, each twice the one before: a monitor keeps a series of each.
ClientMetric::Histogram histogram_s(const v1::Latency& latency) {
  constexpr int kStep = 4;
  ClientMetric::Histogram histogram;
  histogram.sample_count = latency.calls();
  histogram.sample_sum = 1e-3 * latency.sum_ms();
  std::uint64_t so_far = 0;
  for (int i = 0; i < latency.upper_bounds_ms_size(); ++i) {
    so_far += latency.counts(i);
    if (i % kStep == 0) histogram.bucket.push_back({so_far, 1e-3 * latency.upper_bounds_ms(i)});
  }
  return histogram;
}

void add_calls(Families& families, const v1::GetStatusReply& status) {
  families.begin(MetricType::Histogram, "call_duration_seconds",
                 "From receipt of a call to its reply, of those that were answered; each plan and "
                 "each scan of a stream is a call.");
  for (const v1::Latency& each : status.latencies()) {
    families.add(histogram_s(each), {{"method", each.method()}});
  }
  families.begin(MetricType::Counter, "calls_failed_total",
                 "Calls that ended with an error, by gRPC's status code.");
  for (const v1::Latency& each : status.latencies()) {
    for (const v1::FailureCount& failure : each.failures()) {
      families.add(number(failure.calls()), {{"method", each.method()}, {"code", failure.code()}});
    }
  }
  families.begin(MetricType::Counter, "calls_shed_total",
                 "Calls that were refused since too many waited.");
  for (const v1::Latency& each : status.latencies()) {
    families.add(number(each.shed()), {{"method", each.method()}});
  }
  families.begin(MetricType::Counter, "plans_total", "Plans that were answered, by their status.");
  for (const v1::PlanCount& each : status.plans()) {
    families.add(number(each.plans()), {{"status", to_string(from_message(each.status()))}});
  }
}

void add_map(Families& families, const v1::GetStatusReply& status) {
  const v1::ScanTotals& totals = status.scan_totals();
  families.counter("scans_total", "Scans that were inserted.", number(status.scans()));
  families.counter("scan_points_total", "Their points that were used.",
                   number(totals.points_used()));
  families.counter("scan_points_ignored_total",
                   "Their points that were too near, not finite or off the lattice.",
                   number(totals.points_ignored()));
  families.counter("voxels_changed_total", "Voxels that scans changed.",
                   number(totals.voxels_changed()));
  families.gauge("information_gained", "What scans added to the map's information (Eq. 11).",
                 totals.information_gained());
  families.gauge("map_version", "The newest version of the map.", number(status.map_version()));
  families.gauge("map_durable_version", "The newest version on disk; 0: none.",
                 number(status.durable_version()));
  families.gauge("snapshot_failed", "1 while the last attempt to write a snapshot failed.",
                 status.snapshot_error().empty() ? 0.0 : 1.0);
  families.gauge("map_resolution_meters", "The size of the map's voxels.", status.resolution_m());
  families.begin(MetricType::Gauge, "map_bytes", "Memory of the map.");
  families.add(number(status.map_bytes()), {{"part", "map"}});
  families.add(number(status.map_copy_bytes()), {{"part", "copies"}});
  if (status.hazards().empty()) return;
  families.begin(MetricType::Gauge, "hazard_hits",
                 "How often rays met a surface in a context of unknown space, prior included.");
  for (const v1::HazardCount& each : status.hazards()) {
    families.add(each.hits(), {{"context", each.context()}});
  }
  families.begin(MetricType::Gauge, "hazard_meters",
                 "Over how many metres of rays they met them, prior included.");
  for (const v1::HazardCount& each : status.hazards()) {
    families.add(each.metres(), {{"context", each.context()}});
  }
}

void add_clients(Families& families, const v1::GetStatusReply& status, const WebLog& web) {
  families.gauge("connections", "Clients that are connected.", number(status.connections()));
  families.counter("connections_refused_total", "Connections for which there was no place.",
                   number(status.connections_refused()));
  families.counter("connections_silent_total", "Connections that were closed unheard.",
                   number(status.connections_silent()));
  families.gauge("streams", "Streams that are open.", number(status.streams()));
  families.gauge("message_bytes", "Messages that wait or are at work.",
                 number(status.message_bytes()));
  families.gauge("web_connections", "Browsers and monitors that are connected.",
                 number(web.connections.open));
  families.counter("web_connections_refused_total", "Those for which there was no place.",
                   number(web.connections.refused));
  families.counter("web_answers_total", "Their requests that were answered.", number(web.answers));
  families.counter("web_forbidden_total", "Their requests that were not let in.",
                   number(web.forbidden));
  families.counter("web_events_total", "Changes that readers of the page were told.",
                   number(web.events));
  families.counter("web_event_waits_total",
                   "Tenths of a second in which a reader had not taken the last one yet.",
                   number(web.waits));
  families.begin(MetricType::Gauge, "limit", "The limits that the server was started with.");
  for (const v1::Limit& limit : status.limits()) {
    families.add(limit.value(), {{"name", limit.name()}});
  }
}

}  // namespace

std::string metrics_text(const v1::GetStatusReply& status, const WebLog& web) {
  Families families;
  families.begin(MetricType::Gauge, "build_info", "1, with the server's version.");
  families.add(1.0, {{"version", status.version()}});
  families.gauge("uptime_seconds", "Since the server started.", status.uptime_s());
  add_calls(families, status);
  add_map(families, status);
  add_clients(families, status, web);
  return families.text();
}

}  // namespace nbvopt
