// Which page a path names, made of the newest snapshot.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/clock.h"
#include "server/preview.h"
#include "server/status/account.h"
#include "server/status/http.h"
#include "server/status/snapshot_exchange.h"

namespace skyig::server::status {

/// What is not the frame loop's to tell: it comes from threads of its own.
struct Edges {
    std::vector<BusRow> buses;
    std::optional<RecorderState> recorder;
};

/// /status, /metrics, /healthz, and the channels' pictures where there is a preview: /channels/NAME.jpg, the
/// next one, and NAME.mjpg, all that come (multipart/x-mixed-replace). For one thread. A page is made anew at
/// most ten times a second, whoever asks how often.
class Pages {
  public:
    /// \param exchange  whose reader this is; \param edges  may be called on any thread, throws nothing but
    /// std::bad_alloc
    /// \param preview  null: no pictures; must outlive this
    Pages(Facts facts, SnapshotExchange& exchange, const Clock& clock, std::function<Edges()> edges,
          Preview* preview = nullptr);

    [[nodiscard]] HttpAnswer answer(std::string_view path, const PortCounts& port);

  private:
    struct Page {
        std::string_view path;
        std::string_view content_type;
        std::string (*make)(const Account&);
        HttpAnswer made{};
        std::int64_t made_ns = 0;
    };

    [[nodiscard]] std::optional<HttpAnswer> picture(std::string_view path) const;
    [[nodiscard]] Account account(std::int64_t now_ns, const PortCounts& port);

    Facts facts_;
    SnapshotExchange& exchange_;
    const Clock& clock_;
    std::function<Edges()> edges_;
    Preview* preview_;
    std::array<Page, 2> pages_;
};

}  // namespace skyig::server::status
