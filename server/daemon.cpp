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
#include <string_view>
#include <system_error>
#include <utility>

#include "render/output/jpeg.h"
#include "render/output/png.h"
#include "server/clock.h"
#include "server/endpoint_format.h"
#include "server/frame_loop.h"
#include "server/from_config.h"
#include "server/gl_painter.h"
#include "server/light_files.h"
#include "server/live_settings.h"
#include "server/log.h"
#include "server/outside.h"
#include "server/rig/fingerprint.h"
#include "server/rig_part.h"
#include "server/service/service_manager.h"
#include "server/status/status_port.h"
#include "server/stop_signal.h"
#include "server/window_layouts.h"

namespace skyig::server {

namespace {

/// Frames whose images may be under way at once: enough to bridge a slow file without holding much memory.
constexpr std::size_t kImageBuffers = 3;
/// The same of scenes, some 12 kB each: light takes a second renderer's time, a short run has all of its
/// frames.
constexpr std::size_t kSceneBuffers = 256;

std::unique_ptr<ImageWriter> open_images(const DaemonOptions& options, const config::Config& config) {
    if (options.out_directory.empty()) return nullptr;
    std::error_code error;
    std::filesystem::create_directories(options.out_directory, error);
    if (error) {
        throw std::runtime_error(fmt::format("{}: cannot be made a directory for images: {}",
                                             options.out_directory, error.message()));
    }
    ImageWriter::Settings settings{.directory = options.out_directory,
                                   .channels = render_channels(config, options.node),
                                   .buffers = kImageBuffers,
                                   .extension = options.out_format};
    if (options.out_format != "png") {
        settings.buffers = kSceneBuffers;
        settings.takes = ImageWriter::Takes::kScene;
        return std::make_unique<ImageWriter>(std::move(settings), light_files(config));
    }
    return std::make_unique<ImageWriter>(
        std::move(settings),
        [channels = render_channels(config, options.node), gamma = config.display.gamma](
            const std::string& path, const ImageWriter::Frame& frame, std::size_t i, std::string& why) {
            return render::output::write_png(path, channels[i].width_px, channels[i].height_px,
                                             frame.channels[i], why, gamma);
        });
}

std::unique_ptr<Preview> open_preview(const DaemonOptions& options, const config::Config& config) {
    if (!config.preview.enabled || !config.status.enabled) return nullptr;
    return std::make_unique<Preview>(
        render_channels(config, options.node),
        Preview::Settings{config.preview.rate_hz, config.preview.width_px, config.preview.quality},
        &render::output::encode_jpeg);
}

void say_banner(Log& log, const config::Config& config, const std::string& node, const GlPainter& painter,
                const std::string& heard) {
    std::string channels;
    for (const config::Channel& channel : config.channels) {
        if (!node.empty() && channel.node != node) continue;
        fmt::format_to(std::back_inserter(channels), "{}{} {}x{}", channels.empty() ? "" : ", ", channel.name,
                       channel.width_px, channel.height_px);
    }
    log.info("skyigd {}: OpenGL {}; channels {}; {:g} Hz; {}", SKYIG_VERSION, painter.description(),
             channels.empty() ? "none" : channels, config.daemon.rate_hz, heard);
}

/// A recording starts from the instant that it was started from, unless the settings say another.
ephemeris::UtcClockTime start_of(const config::Config& config, const Outside& outside, const Clock& wall) {
    if (!config.start.utc && outside.replay() != nullptr) {
        if (const auto recorded = ephemeris::parse_utc(outside.replay()->start_utc())) return *recorded;
    }
    return start_time(config.start, wall);
}

/// A replay is recorded on request only: its settings are those of the run that it replays.
std::string record_path(const DaemonOptions& options, const config::Config& config, const Clock& wall) {
    if (!options.record_path.empty()) {
        std::error_code none;
        if (std::filesystem::equivalent(options.record_path, options.replay_path, none))
            throw std::runtime_error(fmt::format(
                "{}: is the recording that is replayed; record into another file", options.record_path));
        return options.record_path;
    }
    if (!options.replay_path.empty()) return {};
    std::string path = config.record.file;
    const std::size_t at = path.find(config::kRecordTimeMark);
    if (at == std::string::npos) return path;
    constexpr std::int64_t kSecondNs = 1'000'000'000;
    std::string time = ephemeris::to_iso(ephemeris::UtcClockTime::from_unix(wall.utc_ns() / kSecondNs));
    std::erase_if(time, [](char c) { return c == '-' || c == ':'; });
    return path.replace(at, config::kRecordTimeMark.size(), time);
}

std::unique_ptr<FrameTable> open_table(const std::string& path, const config::Config& config) {
    return path.empty() ? nullptr : std::make_unique<FrameTable>(path, config.channels);
}

std::ofstream open_events(const std::string& path) {
    std::ofstream file;
    if (path.empty()) return file;
    file.open(path);
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be made for events", path));
    return file;
}

/// What went wrong at the edges of a run that is over.
void tell_ends(Log& log, const Outside& outside, const std::string& renderer) {
    if (const Replay* replay = outside.replay()) {
        if (!replay->trouble().empty()) log.warning("{}", replay->trouble());
        if (replay->strangers() > 0)
            log.notice("{} packets of the recording are of no source in the settings", replay->strangers());
        if (!replay->renderer().empty() && replay->renderer() != renderer) {
            log.notice("recorded with {}: pictures may differ in the last bit from those of {}",
                       replay->renderer(), renderer);
        }
    }
    if (const Recorder* recorder = outside.recorder()) {
        const Recorder::Counts counts = recorder->counts();
        if (counts.file_failed) log.error("{}: writing failed; the recording ends there", recorder->path());
        if (counts.lost > 0 && !counts.file_failed)
            log.error("{}: {} packets are missing: the disk was too slow", recorder->path(), counts.lost);
    }
}

/// What the frame loop knows of itself, and where its sources are heard.
status::Facts status_facts(const FrameLoop& loop, const Outside& outside, const Clock& clock) {
    status::Facts facts = loop.facts();
    if (const LiveWire* live = outside.live()) {
        for (std::size_t i = 0; i < facts.sources.size(); ++i) {
            if (const auto local = live->local(i)) facts.sources[i].heard_at = to_string(*local);
            if (const auto* bus = live->bus(i)) facts.sources[i].heard_at = bus->interface();
        }
    }
    constexpr std::int64_t kSecondNs = 1'000'000'000;
    facts.started_ns = clock.monotonic_ns();
    facts.started_utc = ephemeris::to_iso(ephemeris::UtcClockTime::from_unix(clock.utc_ns() / kSecondNs));
    return facts;
}

/// Null where none is wanted, or none can be had that was only the default.
std::unique_ptr<status::StatusPort> open_status(const config::Status& settings, status::Facts facts,
                                                status::SnapshotExchange& exchange, const Outside& outside,
                                                const Clock& clock, Preview* preview, Log& log) {
    // A replay is one of many, and its log is compared.
    if (!settings.enabled || (outside.replay() != nullptr && !settings.listen_given)) return nullptr;
    const auto edges = [&outside] {
        status::Edges told;
        if (const LiveWire* live = outside.live()) told.buses = live->bus_rows();
        if (const Recorder* recorder = outside.recorder()) {
            const Recorder::Counts counts = recorder->counts();
            told.recorder = {recorder->path(), counts.written, counts.lost, counts.bytes, counts.file_failed};
        }
        return told;
    };
    auto port = status::StatusPort::open(settings, std::move(facts), exchange, clock, edges, preview);
    if (!port) {
        if (settings.listen_given) throw std::runtime_error(fmt::format("status: {}", port.error()));
        log.warning("no status port: {}", port.error());
        return nullptr;
    }
    log.info("status on http://{}/status", (*port)->local());
    return std::move(port).value();
}

/// What was asked for by an option and does not hold all. \return in a line; empty: nothing
std::string incomplete_file(const DaemonOptions& options, FrameHashes* hashes, FrameTable* table,
                            std::ofstream& events, const Outside& outside) {
    const auto fault = [](const std::string& path) {
        return fmt::format("{}: not all could be written: is the disk full?", path);
    };
    if (hashes != nullptr && !hashes->finish()) return fault(options.hashes_path);
    if (table != nullptr && !table->finish()) return fault(options.times_path);
    if (events.is_open() && !events.flush()) return fault(options.events_path);
    const Recorder* recorder = options.record_path.empty() ? nullptr : outside.recorder();
    return recorder != nullptr && recorder->counts().file_failed ? fault(options.record_path) : std::string();
}

void write_report(const std::string& path, const RunReport& report) {
    std::ofstream file(path);
    file << to_json(report);
    file.close();
    if (!file) throw std::runtime_error(fmt::format("{}: the report cannot be written", path));
}

std::unique_ptr<GlPainter> make_painter(const DaemonOptions& options, const config::Config& config) {
    GlSeatSettings settings{.channels = render_channels(config, options.node),
                            .display = display_settings(config),
                            .quality = quality(config)};
    if (!options.headless && config.output.kind == config::OutputKind::kWindow) {
        settings.windows = window_layouts(config, options.node);
        settings.vsync = config.output.vsync;
    }
    return std::make_unique<GlPainter>(std::move(settings));
}

/// The log's numbers of syslog for the settings' names.
Severity severity_of(config::LogLevel level) noexcept {
    return static_cast<Severity>(static_cast<int>(Severity::kError) + static_cast<int>(level));
}

/// Who takes new settings, and who hears of it.
struct Reload {
    LiveSettings& settings;
    service::ServiceManager& service;
    const Clock& clock;
    world::World& world;
    GlPainter& painter;
    Log& log;
    /// No machine of a rig.
    bool alone;
    bool records;
    /// Settings were taken, and no frame has been drawn with them yet.
    bool taken = false;

    /// Takes what can change while frames go on.
    void take(const config::Config& before) const {
        const config::Config& now = settings.config();
        world.take_settings();
        log.set_threshold(severity_of(now.log.level));
        if (records)
            log.warning(
                "the recording does not hold settings read anew: a replay of it goes by those of its start");
        if (quality(before).error_codes == quality(now).error_codes) return;
        if (!alone)
            log.warning(
                "[quality] is taken when all machines of the rig start anew: they draw alike until then");
        else
            painter.take_quality(quality(now));
    }

    /// Once a frame: reads settings anew when that is asked for, and takes them when they have been read.
    void look(bool asked, FrameLoop& loop) {
        if (std::exchange(taken, false)) service.ready("settings taken");
        if (asked) {
            service.reloading(clock.monotonic_ns());
            settings.read_anew();
        }
        const LiveSettings::Result result =
            settings.take([this](const config::Config& before) { take(before); }, log);
        if (result == LiveSettings::Result::kNone) return;
        taken = result == LiveSettings::Result::kTaken;
        loop.note_settings(taken);
        if (!taken) service.ready("settings refused");
    }
};

/// A replay is the same each time: it listens to no new settings.
void run_frames(FrameLoop& loop, StopSignal& stop, Reload reload, bool replays) {
    loop.run([&] {
        const bool ends = stop.requested();
        reload.look(stop.reload_requested() && !replays, loop);
        return ends;
    });
    reload.service.stopping();
}

void run(const DaemonOptions& options, const config::Config& start, const config::KeyLog& keys,
         ephemeris::EarthOrientation orientation) {
    StopSignal stop(true);
    SystemClock clock;
    LiveSettings settings(options.config_path, start, keys);
    const config::Config& config = settings.config();
    service::ServiceManager service = service::ServiceManager::from_environment();
    ManualClock replay_clock;
    std::ofstream events = open_events(options.events_path);
    const FrameLoop* running = nullptr;
    Log log(options.replay_path.empty() ? static_cast<const Clock&>(clock) : replay_clock,
            severity_of(config.log.level), options.log_json ? Log::Form::kJson : Log::Form::kText);
    log.also_to([&events, &running](Severity, std::string_view line) {
        if (events.is_open())
            events << (running == nullptr ? 0 : running->frame_number()) << ' ' << line << '\n';
    });
    const bool in_rig = config.rig && !options.node.empty();
    if (config.rig && !in_rig) log.notice("without --node this machine draws the channels of the whole rig");
    Outside outside(options, config, clock, replay_clock, log,
                    !in_rig || RigPart::may_lead(*config.rig, options.node));
    const ephemeris::UtcClockTime start_utc = start_of(config, outside, clock);
    world::World world(config, start_utc, log);
    const std::unique_ptr<ImageWriter> images = open_images(options, config);
    const std::unique_ptr<FrameHashes> hashes =
        options.hashes_path.empty() ? nullptr : std::make_unique<FrameHashes>(options.hashes_path);
    const std::unique_ptr<FrameTable> table = open_table(options.times_path, config);
    const std::unique_ptr<GlPainter> made = make_painter(options, config);
    GlPainter& painter = *made;
    painter.draw_clouds();
    painter.make_ready();
    say_banner(log, config, options.node, painter, outside.heard(options, config));
    if (const std::string path = record_path(options, config, clock);
        !path.empty() && outside.wire() != nullptr) {
        outside.record(path, config,
                       {ephemeris::to_iso(start_utc, 9), config.daemon.rate_hz, "skyigd " SKYIG_VERSION,
                        painter.description()});
        log.info("records into {}", path);
    }

    const auto exchange = std::make_unique<status::SnapshotExchange>();
    const std::unique_ptr<Preview> preview = open_preview(options, config);
    std::optional<RigPart> rig;
    if (in_rig) {
        const auto idle = [&service, &clock, &stop] {
            service.frame_drawn(clock.monotonic_ns());
            return !stop.requested();
        };
        rig.emplace(config, options.node, rig::fingerprint(keys, options.config_path),
                    RigEnds{clock, log, outside.pace(), outside.wire(), painter, world, idle,
                            outside.replay() != nullptr});
    }
    FrameLoop loop(config,
                   {clock, log, rig ? rig->pace() : outside.pace(), rig ? rig->wire() : *outside.wire(),
                    world, rig ? static_cast<Painter&>(rig->painter()) : painter, images.get(), hashes.get(),
                    table.get(), exchange.get(), preview.get(), &service},
                   options.frames, options.out_every, std::move(orientation));
    log.info("ephemeris {}", loop.report().ephemeris_text());
    const auto status_port = open_status(config.status, status_facts(loop, outside, clock), *exchange,
                                         outside, clock, preview.get(), log);
    // A node may wait for its leader as long as it likes.
    if (rig) service.ready(fmt::format("{} of a rig", options.node));
    loop.warm_up();
    running = &loop;
    service.ready(outside.heard(options, config));
    painter.before_anew([&service] { service.frame_takes_long(); });
    const std::int64_t cpu_before_ns = clock.processor_ns();
    run_frames(loop, stop,
               {settings, service, clock, world, painter, log, !in_rig, outside.recorder() != nullptr},
               !options.replay_path.empty());
    const std::int64_t cpu_ns = clock.processor_ns() - cpu_before_ns;
    if (images) images->finish();
    outside.finish();
    tell_ends(log, outside, painter.description());

    RunReport report = loop.report();
    report.cpu_s = static_cast<double>(cpu_ns) * 1e-9;
    if (const LiveWire* live = outside.live()) report.buses = live->bus_rows();
    if (!options.report_path.empty()) write_report(options.report_path, report);
    fmt::print("{}", to_table(report));
    if (images && report.images_failed > 0) throw std::runtime_error(images->first_error());
    if (const std::string fault = incomplete_file(options, hashes.get(), table.get(), events, outside);
        !fault.empty()) {
        throw std::runtime_error(fault);
    }
}

}  // namespace

int run_daemon(const DaemonOptions& options, const config::Config& config, const config::KeyLog& keys,
               ephemeris::EarthOrientation orientation) {
    // Who reads our lines may go at any time: that is a failed write, not our end.
    std::signal(SIGPIPE, SIG_IGN);
    try {
        run(options, config, keys, std::move(orientation));
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyigd: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::server
