// The renderer allocates nothing per frame in steady state: operator new is replaced in this program and
// counted. That our sources never call malloc themselves is the layering test's business.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/render/gl_fixture.h"

namespace {

std::atomic<long> news{0};

}  // namespace

void* operator new(std::size_t size) {
    news.fetch_add(1, std::memory_order_relaxed);
    if (void* p = std::malloc(size)) return p;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    news.fetch_add(1, std::memory_order_relaxed);
    const auto a = static_cast<std::size_t>(alignment);
    if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
    throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
    std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
    std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
    std::free(p);
}

namespace skyig::render {
namespace {

using namespace tests;

class Allocation : public GlTest {};

TEST_F(Allocation, SteadyFramesAllocateNothing) {
    const std::vector<Channel> channels{{"a", 64, 64}, {"b", 64, 64}};
    for (auto& [name, scene] : four_times()) {
        for (const double turn : {-30.0, 30.0}) {
            add_view(scene, symmetric_frustum(30.0, 64, 64), view_from_enu(180.0, 10.0, 0.0, turn));
        }
        Renderer renderer(channels, {});
        std::vector<std::byte> pixels(64 * 64 * 4);
        const auto frame = [&](int i) {
            // The world goes on: the Sun climbs, the aircraft too, so that tables are rebuilt all the time.
            Scene now = scene;
            now.time_s = 0.03 * i;
            now.eye.height_m += 0.3 * i;
            const Horizontal sun = horizontal_of(scene.sun.direction_enu);
            now.sun.direction_enu = direction_of({sun.elevation_rad + 1e-5 * i, sun.azimuth_rad + 1e-5 * i});
            renderer.prepare(now);
            for (std::size_t c = 0; c < channels.size(); ++c) {
                renderer.draw(c);
                renderer.read_back(c, pixels);
            }
        };
        for (int i = 0; i < 10; ++i)
            frame(i);
        // llvmpipe compiles shader variants late, in C++: what frames of a world at rest allocate is the
        // driver's.
        const long before = news.load();
        for (int i = 10; i < 110; ++i)
            frame(i);
        std::printf("%-6s %ld calls of operator new in 100 frames\n", name.c_str(), news.load() - before);
        EXPECT_EQ(news.load() - before, 0) << name;
    }
}

}  // namespace
}  // namespace skyig::render
