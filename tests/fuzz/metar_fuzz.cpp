// Any text as weather reports: what is read keeps what report.h promises.
#include <cstdlib>
#include <string_view>

#include "protocol/metar/decode.h"
#include "tests/protocol/metar/report_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace skyig::protocol::metar;
    std::string_view rest(reinterpret_cast<const char*>(data), size);
    while (const auto text = next_report(rest))
        if (!skyig::tests::broken_promise(decode(*text)).empty()) std::abort();
    return 0;
}
