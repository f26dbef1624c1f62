#include "clients/instructor/instructor.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <utility>

#include "clients/instructor/almanac.h"
#include "clients/instructor/daemon_watch.h"
#include "clients/instructor/page_files.h"
#include "clients/instructor/station.h"
#include "clients/instructor/web_server.h"
#include "protocol/transport/udp.h"
#include "server/stop_signal.h"

namespace skyig::clients {

namespace instructor {
namespace {

namespace ephemeris = server::ephemeris;
namespace transport = protocol::transport;
using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds kStep{20};
constexpr double kStatusEvery_s = 0.5;
constexpr double kAlmanacEvery_s = 1.0;
/// An aircraft's way that moves rise and set by a quarter of a minute.
constexpr double kSameSite_deg = 0.05;

template <class T>
T value_or_throw(protocol::Result<T, std::string> result) {
    if (!result) throw std::runtime_error(result.error());
    return std::move(result).value();
}

std::string saved_path(const InstructorOptions& options) {
    if (options.saved_path != "default") return options.saved_path;
    // Read once, before any thread starts.
    const char* state = std::getenv("XDG_STATE_HOME");  // NOLINT(concurrency-mt-unsafe)
    const char* home = std::getenv("HOME");             // NOLINT(concurrency-mt-unsafe)
    if (state != nullptr && *state != '\0') return fmt::format("{}/skyig/instructor.json", state);
    return home == nullptr ? std::string() : fmt::format("{}/.local/state/skyig/instructor.json", home);
}

Json counts_json(const WebCounts& counts, std::size_t open) {
    Json json{{"open", open}};
    for (const NamedWebCount& count : kWebCountNames)
        json[std::string(count.name)] = counts.*count.value;
    return json;
}

/// One byte of length, the channel's name, the JPEG.
std::string picture_bytes(const DaemonWatch::Picture& picture) {
    std::string bytes(1, static_cast<char>(picture.channel.size()));
    return bytes.append(picture.channel).append(picture.jpeg);
}

class Program {
  public:
    Program(const InstructorOptions& options, const server::Clock& clock)
        : clock_(clock),
          to_(value_or_throw(transport::parse_endpoint(options.cigi_to))),
          sender_(value_or_throw(transport::UdpSender::open())),
          station_(value_or_throw(SavedSettings::open(saved_path(options)))),
          web_(value_or_throw(WebServer::open(web_options(options), clock, handlers()))),
          watch_(value_or_throw(status::parse_url(options.daemon_status)), clock) {}

    void run(server::StopSignal& stop) {
        while (!stop.requested()) {
            web_->step(kStep);
            take_news();
            if (const auto bytes = station_.due_message(now_s()); !bytes.empty())
                (void)sender_.send(to_, bytes);
            publish();
        }
    }
    [[nodiscard]] transport::Endpoint local() const { return web_->local(); }

  private:
    static WebOptions web_options(const InstructorOptions& options) {
        WebOptions web;
        web.listen = value_or_throw(transport::parse_endpoint(options.listen));
        web.token = options.token;
        web.names = options.names;
        return web;
    }

    WebServer::Handlers handlers() {
        return {[this](std::string_view path) { return page(path); }, [this] { return greeting(); },
                [this](std::string_view text) { return station_.take(text, now_s()); }};
    }

    [[nodiscard]] double now_s() const noexcept { return static_cast<double>(clock_.monotonic_ns()) * 1e-9; }
    [[nodiscard]] Json port_json() const { return counts_json(web_->counts(), web_->open_sockets()); }

    [[nodiscard]] server::status::HttpAnswer page(std::string_view path) const {
        if (path != "/counts") return page_answer(path);
        server::status::HttpAnswer answer;
        answer.content_type = "application/json";
        answer.body = std::make_shared<const std::string>(port_json().dump(2) + '\n');
        return answer;
    }

    [[nodiscard]] std::vector<std::string> greeting() const {
        std::vector<std::string> texts{Station::greeting_text(), station_.state_text(),
                                       station_.status_text(now_s(), port_json())};
        if (!almanac_.empty()) texts.push_back(almanac_);
        return texts;
    }

    void take_news() {
        auto news = watch_.take_news();
        if (!news) return;
        if (news->status) {
            station_.daemon_says(Json::parse(*news->status, nullptr, false), now_s());
        } else {
            station_.daemon_is_silent(news->silence);
        }
        std::vector<std::string> channels;
        if (web_->open_sockets() > 0) channels = station_.channel_names();
        watch_.want(std::move(channels));
    }

    void publish() {
        if (station_.revision() != revision_) {
            revision_ = station_.revision();
            web_->publish(station_.state_text());
            status_s_ = 0.0;
        }
        if (const double time_s = now_s(); time_s - status_s_ >= kStatusEvery_s) {
            status_s_ = time_s;
            web_->publish_update(station_.status_text(time_s, port_json()));
        }
        for (const DaemonWatch::Picture& picture : watch_.take_pictures())
            web_->publish_picture(picture_bytes(picture));
        publish_almanac();
    }

    void publish_almanac() {
        const double time_s = now_s();
        if (time_s - almanac_s_ < kAlmanacEvery_s || !station_.status().contains("world")) return;
        almanac_s_ = time_s;
        const Json& world = station_.status()["world"];
        const auto utc = ephemeris::parse_utc(world.value("utc", std::string()));
        const Json place = world.value("ownship", Json::object());
        const ephemeris::Geodetic site{place.value("latitude_deg", 0.0), place.value("longitude_deg", 0.0),
                                       0.0};
        if (!utc || (utc->mjd() == almanac_mjd_ &&
                     std::abs(site.latitude_deg - almanac_site_.latitude_deg) < kSameSite_deg &&
                     std::abs(site.longitude_deg - almanac_site_.longitude_deg) < kSameSite_deg))
            return;
        almanac_mjd_ = utc->mjd();
        almanac_site_ = site;
        almanac_ = almanac_text(*utc, site);
        web_->publish(almanac_);
    }

    const server::Clock& clock_;
    transport::Endpoint to_;
    transport::UdpSender sender_;
    Station station_;
    std::unique_ptr<WebServer> web_;
    DaemonWatch watch_;
    std::uint64_t revision_ = 0;
    double status_s_ = 0.0;
    std::string almanac_;
    double almanac_s_ = 0.0;
    std::int32_t almanac_mjd_ = 0;
    ephemeris::Geodetic almanac_site_;
};

}  // namespace
}  // namespace instructor

int run_instructor(const InstructorOptions& options) {
    try {
        server::StopSignal stop;
        server::SystemClock clock;
        instructor::Program program(options, clock);
        fmt::print(stderr, "skyig instructor: http://{}/ for the daemon at {}, CIGI to {}\n",
                   protocol::transport::to_string(program.local()), options.daemon_status, options.cigi_to);
        program.run(stop);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "skyig instructor: {}\n", error.what());
        return 1;
    }
}

}  // namespace skyig::clients
