// Counts every allocation of the program; a view must not make one after its constructor.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <new>

#include "render/sky/sky_view.h"

namespace {
std::atomic<long> allocations{0};
}

[[gnu::noinline]] void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    ++allocations;
    const auto step = static_cast<std::size_t>(alignment);
    if (void* memory = std::aligned_alloc(step, (size + step - 1) / step * step)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}

namespace skyig::render::sky {
namespace {

TEST(SkyView, AllocatesOnlyInItsConstructor) {
    const AirTables tables(air_model({}));
    const long before_view = allocations;
    SkyView view;
    const long after_view = allocations;
    EXPECT_GT(after_view, before_view);
    float sum = 0.0F;
    for (const double source : {0.5, -0.1}) {
        view.begin(tables, 1000.0, source);
        while (!view.build_rows(5)) {
        }
        for (int i = -15; i < 15; ++i) {
            const float angle = 0.1F * static_cast<float>(i);
            sum += view.xyz(angle, angle).y;
        }
        sum += static_cast<float>(tables.direct_sun_xyz(0.0, 0.5).y + tables.transmittance_rgb(0.0, 0.5).x);
    }
    const long made = allocations - after_view;
    std::printf("%ld allocations in the constructor, %ld after it\n", after_view - before_view, made);
    EXPECT_EQ(made, 0);
    EXPECT_GT(sum, 0.0F);
}

}  // namespace
}  // namespace skyig::render::sky
