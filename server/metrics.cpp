#include "metrics.h"

#include <fmt/format.h>
#include <prometheus/collectable.h>
#include <prometheus/counter.h>
#include <prometheus/exposer.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <mutex>

#include "service/server.h"
#include "service/status.h"

namespace sundial {

namespace {

using prometheus::BuildCounter;
using prometheus::BuildHistogram;

// Gauges, read when asked for.
class Gauges final : public prometheus::Collectable {
 public:
  void watch(const Server* server) {
    const std::lock_guard lock(mutex_);
    server_ = server;
  }
  std::vector<prometheus::MetricFamily> Collect() const override {
    const std::lock_guard lock(mutex_);
    if (!server_) return {};
    const RenderQueue::Counts counts = server_->queue().counts();
    return {
        gauge("sundial_queue_waiting", "Renderings that wait", counts.waiting),
        gauge("sundial_rendering", "Renderings on the device", counts.rendering),
        gauge("sundial_unsent_bytes", "Image data that waits for its clients", counts.unsentBytes),
        gauge("sundial_scenes", "Scenes loaded", server_->store().count()),
        gauge("sundial_scene_bytes", "Memory of loaded scenes", server_->store().bytes()),
    };
  }

 private:
  template <class Number>
  static prometheus::MetricFamily gauge(const char* name, const char* help, Number value) {
    prometheus::ClientMetric metric;
    metric.gauge.value = static_cast<double>(value);
    return {name, help, prometheus::MetricType::Gauge, {metric}};
  }
  mutable std::mutex mutex_;
  const Server* server_ = nullptr;
};

class Exposed final : public Metrics {
 public:
  explicit Exposed(const std::string& address)
      : calls_(BuildCounter().Name("sundial_calls_total").Help("Calls that ended").Register(*registry_)),
        bytes_(BuildCounter()
                   .Name("sundial_sent_bytes_total")
                   .Help("Image data sent")
                   .Register(*registry_)
                   .Add({})),
        seconds_(BuildHistogram()
                     .Name("sundial_render_seconds")
                     .Help("Time on the device's thread, of one rendering")
                     .Register(*registry_)
                     .Add({}, prometheus::Histogram::BucketBoundaries{0.005, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2,
                                                                      5, 10, 30, 60})),
        exposer_(address) {
    exposer_.RegisterCollectable(registry_);
    exposer_.RegisterCollectable(gauges_);
  }
  void count(const CallRecord& call) override {
    calls_.Add({{"rpc", call.rpc}, {"status", statusName(call.status)}}).Increment();
    if (call.bytesSent > 0) bytes_.Increment(static_cast<double>(call.bytesSent));
    if (call.renderMs > 0) seconds_.Observe(call.renderMs / 1000);
  }
  void watch(const Server* server) override { gauges_->watch(server); }

 private:
  const std::shared_ptr<prometheus::Registry> registry_ = std::make_shared<prometheus::Registry>();
  const std::shared_ptr<Gauges> gauges_ = std::make_shared<Gauges>();
  prometheus::Family<prometheus::Counter>& calls_;
  prometheus::Counter& bytes_;
  prometheus::Histogram& seconds_;
  prometheus::Exposer exposer_;
};

}  // namespace

Result<std::unique_ptr<Metrics>> Metrics::serve(const std::string& address) {
  try {
    return std::make_unique<Exposed>(address);
  } catch (const std::exception&) {
    const auto why = whyNotListening(address);
    return fail(
        ErrorCode::failedPrecondition,
        fmt::format("--metrics {}: {}", address, why ? *why : "can't listen there; give another address"));
  }
}

}  // namespace sundial
