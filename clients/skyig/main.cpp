#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <variant>

#include "clients/instructor/instructor.h"
#include "clients/skyig/bench.h"
#include "clients/skyig/channels.h"
#include "clients/skyig/cloud.h"
#include "clients/skyig/decode.h"
#include "clients/skyig/ephem.h"
#include "clients/skyig/frame/preview_cost.h"
#include "clients/skyig/frame/rates.h"
#include "clients/skyig/frame/thinning.h"
#include "clients/skyig/host.h"
#include "clients/skyig/latency/latency.h"
#include "clients/skyig/metar.h"
#include "clients/skyig/options.h"
#include "clients/skyig/plan.h"
#include "clients/skyig/record.h"
#include "clients/skyig/replay.h"
#include "clients/skyig/rvr.h"
#include "clients/skyig/shot.h"
#include "clients/skyig/sky.h"
#include "clients/skyig/status.h"
#include "clients/skyig/tone.h"
#include "server/standard_output.h"

namespace {

int run_any_bench(const skyig::clients::BenchOptions& bench) {
    using namespace skyig::clients;
    if (bench.family == "frame") return run_frame_rates(bench);
    if (bench.family == "thinning") return run_thinning(bench);
    if (bench.family == "preview") return run_preview_cost(bench);
    return run_bench(bench);
}

int run(int argc, char** argv) {
    using namespace skyig::clients;
    const Invocation invocation = read_command_line(argc, argv);
    fmt::print("{}", invocation.output);
    fmt::print(stderr, "{}", invocation.error);
    if (const auto* host = std::get_if<HostOptions>(&invocation.options)) return run_host(*host);
    if (const auto* shot = std::get_if<ShotOptions>(&invocation.options)) return run_shot(*shot);
    if (const auto* plan = std::get_if<PlanOptions>(&invocation.options)) return run_plan(*plan);
    if (const auto* channels = std::get_if<ChannelsOptions>(&invocation.options))
        return run_channels(*channels);
    if (const auto* bench = std::get_if<BenchOptions>(&invocation.options)) return run_any_bench(*bench);
    if (const auto* latency = std::get_if<LatencyOptions>(&invocation.options)) return run_latency(*latency);
    if (const auto* ephem = std::get_if<EphemOptions>(&invocation.options)) return run_ephem(*ephem);
    if (const auto* cloud = std::get_if<CloudOptions>(&invocation.options)) return run_cloud(*cloud);
    if (const auto* decode = std::get_if<DecodeOptions>(&invocation.options)) return run_decode(*decode);
    if (const auto* metar = std::get_if<MetarOptions>(&invocation.options)) return run_metar(*metar);
    if (const auto* replay = std::get_if<ReplayOptions>(&invocation.options)) return run_replay(*replay);
    if (const auto* record = std::get_if<RecordOptions>(&invocation.options)) return run_record(*record);
    if (const auto* status = std::get_if<StatusOptions>(&invocation.options)) return run_status(*status);
    if (const auto* rvr = std::get_if<RvrOptions>(&invocation.options)) return run_rvr(*rvr);
    if (const auto* tone = std::get_if<ToneOptions>(&invocation.options)) return run_tone(*tone);
    if (const auto* instructor = std::get_if<InstructorOptions>(&invocation.options))
        return run_instructor(*instructor);
    if (const auto* sky = std::get_if<SkyOptions>(&invocation.options)) return run_sky(*sky);
    return invocation.exit_status;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return skyig::server::finish_standard_output("skyig", run(argc, argv));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "skyig: %s\n", error.what());
        return 1;
    }
}
