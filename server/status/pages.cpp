#include "server/status/pages.h"

#include <algorithm>
#include <utility>

#include "server/status/from_snapshot.h"

namespace skyig::server::status {

namespace {

constexpr std::int64_t kGoodFor_ns = 100'000'000;
constexpr double kNsToS = 1e-9;
constexpr int kOk = 200;
constexpr int kNotFound = 404;
constexpr int kUnavailable = 503;

}  // namespace

Pages::Pages(Facts facts, SnapshotExchange& exchange, const Clock& clock, std::function<Edges()> edges)
    : facts_(std::move(facts)),
      exchange_(exchange),
      clock_(clock),
      edges_(std::move(edges)),
      pages_{Page{"/status", "application/json", &to_json},
             Page{"/metrics", "text/plain; version=0.0.4; charset=utf-8", &to_metrics}} {}

Account Pages::account(std::int64_t now_ns, const PortCounts& port) {
    const Snapshot& snapshot = exchange_.newest();
    Account account{facts_, snapshot, make_report(facts_, snapshot), {}, port, {}, 0.0, 0.0};
    Edges edges = edges_();
    account.report.buses = std::move(edges.buses);
    account.recorder = std::move(edges.recorder);
    account.health = health_of(facts_, snapshot, now_ns);
    account.uptime_s = static_cast<double>(now_ns - facts_.started_ns) * kNsToS;
    if (snapshot.frames > 0) account.age_s = static_cast<double>(now_ns - snapshot.record.end_ns()) * kNsToS;
    return account;
}

HttpAnswer Pages::answer(std::string_view path, const PortCounts& port) {
    const std::int64_t now_ns = clock_.monotonic_ns();
    if (path == "/healthz") {
        const Health health = health_of(facts_, exchange_.newest(), now_ns);
        return line_answer(health.good ? kOk : kUnavailable, health.text);
    }
    const auto page =
        std::find_if(pages_.begin(), pages_.end(), [path](const Page& one) { return one.path == path; });
    if (page == pages_.end())
        return line_answer(kNotFound, "there is no such page; there are /status, /metrics and /healthz");
    if (!page->made.body || now_ns - page->made_ns >= kGoodFor_ns) {
        page->made = {kOk, page->content_type,
                      std::make_shared<const std::string>(page->make(account(now_ns, port)))};
        page->made_ns = now_ns;
    }
    return page->made;
}

}  // namespace skyig::server::status
