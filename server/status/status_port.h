// The daemon's read-only port: pages about itself, served on a thread of its own.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "config/config.h"
#include "server/status/http_server.h"
#include "server/status/pages.h"

namespace skyig::server::status {

class StatusPort {
  public:
    /// What is referred to must outlive the port; `edges` as for Pages. The error is one line.
    [[nodiscard]] static protocol::Result<std::unique_ptr<StatusPort>, std::string> open(
        const config::Status& settings, Facts facts, SnapshotExchange& exchange, const Clock& clock,
        std::function<Edges()> edges, Preview* preview = nullptr);

    [[nodiscard]] protocol::transport::Endpoint local() const noexcept { return server_->local(); }

  private:
    explicit StatusPort(Pages pages) : pages_(std::move(pages)) {}

    Pages pages_;
    /// Last, so that its thread ends before the pages go.
    std::unique_ptr<HttpServer> server_;
};

}  // namespace skyig::server::status
