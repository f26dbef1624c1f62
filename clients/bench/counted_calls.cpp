// In a file of its own, so that no copy of the function is made with another name for its one caller.
#include "clients/bench/family.h"

extern "C" double skyig_bench_counted_calls(const skyig::clients::bench::Work* work, std::uint64_t first,
                                            std::uint64_t calls) {
    // Read back, so that the work is called from here and not jumped to.
    const volatile double result = (*work)(first, calls);
    return result;
}
