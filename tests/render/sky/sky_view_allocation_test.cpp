// Counts every allocation of the program; a view must not make one after its constructor.
#include <gtest/gtest.h>

#include <cstdio>

#include "render/sky/sky_view.h"
#include "tests/support/allocation_count.h"

namespace skyig::render::sky {
namespace {

TEST(SkyView, AllocatesOnlyInItsConstructor) {
    const AirTables tables(air_model({}));
    const std::uint64_t before_view = skyig::tests::allocation_count();
    SkyView view;
    const std::uint64_t after_view = skyig::tests::allocation_count();
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
    const std::uint64_t made = skyig::tests::allocation_count() - after_view;
    std::printf("%llu allocations in the constructor, %llu after it\n",
                static_cast<unsigned long long>(after_view - before_view),
                static_cast<unsigned long long>(made));
    EXPECT_EQ(made, 0U);
    EXPECT_GT(sum, 0.0F);
}

}  // namespace
}  // namespace skyig::render::sky
