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

#include "render/output/png.h"
#include "server/clock.h"
#include "server/endpoint_format.h"
#include "server/frame_loop.h"
#include "server/from_config.h"
#include "server/gl_painter.h"
#include "server/live_wire.h"
#include "server/log.h"
#include "server/stop_signal.h"

namespace skyig::server {

namespace {

/// Frames whose images may be under way at once: enough to bridge a slow file without holding much memory.
constexpr std::size_t kImageBuffers = 3;

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

/// Who is heard where: "CIGI on udp 127.0.0.1:8004, answers to 127.0.0.1:8005; instructor on udp ...".
std::string heard_text(const config::Config& config, const LiveWire& wire) {
    std::string text = "no host";
    if (const auto local = wire.local(0)) {
        text = fmt::format("CIGI on udp {}, answers to {}", *local,
                           config.host.reply_to ? fmt::format("{}:{}", config.host.reply_to->address,
                                                              config.host.reply_to->port)
                                                : std::string("the sender"));
    }
    for (std::size_t i = 0; i < config.sources.size(); ++i) {
        const config::Source& source = config.sources[i];
        if (const auto local = wire.local(i + 1)) {
            fmt::format_to(std::back_inserter(text), "; {} on udp {}", source.name, *local);
        } else {
            fmt::format_to(std::back_inserter(text), "; {} on {}", source.name, source.interface);
        }
    }
    return text;
}

void say_banner(Log& log, const config::Config& config, const GlPainter& painter, const LiveWire& wire) {
    std::string channels;
    for (const config::Channel& channel : config.channels) {
        fmt::format_to(std::back_inserter(channels), "{}{} {}x{}", channels.empty() ? "" : ", ", channel.name,
                       channel.width_px, channel.height_px);
    }
    log.info("skyigd {}: OpenGL {}; channels {}; {:g} Hz; {}", SKYIG_VERSION, painter.description(), channels,
             config.daemon.rate_hz, heard_text(config, wire));
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
    LiveWire wire(config);
    ClockPace pace(clock, config.daemon.rate_hz);
    const std::unique_ptr<ImageWriter> images = open_images(options, config);
    GlPainter painter(render_channels(config), display_settings(config));
    say_banner(log, config, painter, wire);

    FrameLoop loop(config, {clock, log, pace, wire, world, painter, images.get()}, options.frames,
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
