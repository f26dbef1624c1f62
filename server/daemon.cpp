#include "server/daemon.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "protocol/transport/udp.h"
#include "render/output/png.h"
#include "server/clock.h"
#include "server/endpoint_format.h"
#include "server/frame_loop.h"
#include "server/from_config.h"
#include "server/gl_painter.h"
#include "server/log.h"
#include "server/stop_signal.h"

namespace skyig::server {

namespace transport = protocol::transport;

namespace {

/// Frames whose images may be under way at once: enough to bridge a slow file without holding much memory.
constexpr std::size_t kImageBuffers = 3;

template <class T>
T value_or_throw(protocol::Result<T, std::string> result) {
    if (!result) throw std::runtime_error(result.error());
    return std::move(result).value();
}

UdpLink open_link(const config::Host& host) {
    transport::UdpOptions options;
    options.listen = {value_or_throw(transport::parse_ipv4(host.listen.address)), host.listen.port};
    for (const config::UdpAddress& sender : host.allow)
        options.allowed.push_back(value_or_throw(transport::parse_ipv4(sender.address)));
    transport::UdpReceiver receiver = value_or_throw(transport::UdpReceiver::open(options));
    transport::UdpSender sender = value_or_throw(receiver.make_sender());
    return {std::move(receiver), std::move(sender)};
}

std::unique_ptr<ImageWriter> open_images(const DaemonOptions& options, const config::Config& config) {
    if (options.out_directory.empty()) return nullptr;
    std::error_code error;
    std::filesystem::create_directories(options.out_directory, error);
    if (error) {
        throw std::runtime_error(fmt::format("{}: cannot be made a directory for images: {}",
                                             options.out_directory, error.message()));
    }
    return std::make_unique<ImageWriter>(
        options.out_directory, render_channels(config), kImageBuffers,
        [gamma = config.display.gamma](const std::string& path, const render::Channel& channel,
                                       std::span<const std::byte> rgba, std::string& why) {
            return render::output::write_png(path, channel.width_px, channel.height_px, rgba, why, gamma);
        });
}

void say_banner(Log& log, const config::Config& config, const GlPainter& painter, const UdpLink& link) {
    std::string channels;
    for (const config::Channel& channel : config.channels) {
        fmt::format_to(std::back_inserter(channels), "{}{} {}x{}", channels.empty() ? "" : ", ", channel.name,
                       channel.width_px, channel.height_px);
    }
    const std::string answers =
        config.host.reply_to ? fmt::format("{}:{}", config.host.reply_to->address, config.host.reply_to->port)
                             : std::string("the sender");
    log.info("skyigd {}: OpenGL {}; channels {}; {:g} Hz; CIGI on udp {}, answers to {}", SKYIG_VERSION,
             painter.description(), channels, config.daemon.rate_hz, link.local(), answers);
}

void write_report(const std::string& path, const RunReport& report) {
    std::ofstream file(path);
    file << to_json(report);
    file.close();
    if (!file) throw std::runtime_error(fmt::format("{}: the report cannot be written", path));
}

void run(const DaemonOptions& options, const config::Config& config,
         ephemeris::EarthOrientation orientation) {
    StopSignal stop;
    SystemClock clock;
    Log log(clock);
    world::World world(config, start_time(config.start, clock), log);
    UdpLink link = open_link(config.host);
    const std::unique_ptr<ImageWriter> images = open_images(options, config);
    GlPainter painter(render_channels(config), display_settings(config));
    say_banner(log, config, painter, link);

    FrameLoop loop(config, {clock, log, link, world, painter, images.get()}, options.frames,
                   options.out_every, std::move(orientation));
    log.info("ephemeris {}", loop.report().ephemeris_text());
    loop.warm_up();
    loop.run([&stop] { return stop.requested(); });
    if (images) images->finish();

    const RunReport report = loop.report();
    if (!options.report_path.empty()) write_report(options.report_path, report);
    fmt::print("{}", to_table(report));
    if (images && report.images_failed > 0) throw std::runtime_error(images->first_error());
}

}  // namespace

int run_daemon(const DaemonOptions& options, const config::Config& config,
               ephemeris::EarthOrientation orientation) {
    // Who reads our lines may go at any time: that is a failed write, not our end.
    std::signal(SIGPIPE, SIG_IGN);
    try {
        run(options, config, std::move(orientation));
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyigd: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::server
