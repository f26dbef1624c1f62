#include "server/status/pages.h"

#include <fmt/format.h>

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

/// One picture of many (RFC 2046, 5.1).
std::string part_of(const std::string& file) {
    return fmt::format("--frame\r\nContent-Type: image/jpeg\r\nContent-Length: {}\r\n\r\n{}\r\n", file.size(),
                       file);
}

}  // namespace

Pages::Pages(Facts facts, SnapshotExchange& exchange, const Clock& clock, std::function<Edges()> edges,
             Preview* preview)
    : facts_(std::move(facts)),
      exchange_(exchange),
      clock_(clock),
      edges_(std::move(edges)),
      preview_(preview),
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

std::optional<HttpAnswer> Pages::picture(std::string_view path) const {
    constexpr std::string_view kFolder = "/channels/";
    constexpr std::string_view kOne = ".jpg";
    constexpr std::string_view kAll = ".mjpg";
    if (preview_ == nullptr || !path.starts_with(kFolder)) return std::nullopt;
    path.remove_prefix(kFolder.size());
    const bool endless = path.ends_with(kAll);
    if (!endless && !path.ends_with(kOne)) return std::nullopt;
    path.remove_suffix(endless ? kAll.size() : kOne.size());
    const std::optional<std::size_t> channel = preview_->find(path);
    if (!channel) return line_answer(kNotFound, "there is no such channel; /status names them");
    HttpAnswer answer;
    answer.endless = endless;
    answer.content_type = endless ? "multipart/x-mixed-replace; boundary=frame" : "image/jpeg";
    // A picture from before the last asking may be old: the next one is sent.
    answer.later = [preview = preview_, &clock = clock_, channel = *channel, endless,
                    seen = preview_->newest(*channel, clock_.monotonic_ns()).number]() mutable {
        const Preview::Picture picture = preview->newest(channel, clock.monotonic_ns());
        if (picture.number == seen) return std::shared_ptr<const std::string>();
        seen = picture.number;
        return endless ? std::make_shared<const std::string>(part_of(*picture.file)) : picture.file;
    };
    return answer;
}

HttpAnswer Pages::answer(std::string_view path, const PortCounts& port) {
    const std::int64_t now_ns = clock_.monotonic_ns();
    if (path == "/healthz") {
        const Health health = health_of(facts_, exchange_.newest(), now_ns);
        return line_answer(health.good ? kOk : kUnavailable, health.text);
    }
    if (std::optional<HttpAnswer> answer = picture(path)) return std::move(*answer);
    const auto page =
        std::find_if(pages_.begin(), pages_.end(), [path](const Page& one) { return one.path == path; });
    if (page == pages_.end())
        return line_answer(
            kNotFound,
            "there is no such page; there are /status, /metrics, /healthz and, of each channel, "
            "/channels/NAME.jpg and NAME.mjpg");
    if (!page->made.body || now_ns - page->made_ns >= kGoodFor_ns) {
        page->made.status = kOk;
        page->made.content_type = page->content_type;
        page->made.body = std::make_shared<const std::string>(page->make(account(now_ns, port)));
        page->made_ns = now_ns;
    }
    return page->made;
}

}  // namespace skyig::server::status
