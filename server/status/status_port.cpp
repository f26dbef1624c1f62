#include "server/status/status_port.h"

#include <utility>

namespace skyig::server::status {

protocol::Result<std::unique_ptr<StatusPort>, std::string> StatusPort::open(
    const config::Status& settings, Facts facts, SnapshotExchange& exchange, const Clock& clock,
    std::function<Edges()> edges, Preview* preview) {
    HttpOptions options;
    const auto address = protocol::transport::parse_ipv4(settings.listen.address);
    if (!address) return protocol::Error{address.error()};
    options.listen = {*address, settings.listen.port};
    std::unique_ptr<StatusPort> port(
        new StatusPort(Pages(std::move(facts), exchange, clock, std::move(edges), preview)));
    auto server = HttpServer::open(options, clock,
                                   [&pages = port->pages_](std::string_view path, const PortCounts& counts) {
                                       return pages.answer(path, counts);
                                   });
    if (!server) return protocol::Error{server.error()};
    port->server_ = std::move(server).value();
    return port;
}

}  // namespace skyig::server::status
