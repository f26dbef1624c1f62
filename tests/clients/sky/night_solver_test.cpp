// Night rows are answered alike whatever was asked before.
#include "clients/skyig/sky/night_solver.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "clients/skyig/sky/atmosphere.h"

namespace skyig::clients::sky {
namespace {

TEST(NightSolver, AnswersDoNotDependOnTheOrderOfRows) {
    const Atmosphere atmosphere = load_atmosphere("A");
    NightSolver after_ground(atmosphere, std::nullopt, std::nullopt);
    NightSolver alone(atmosphere, std::nullopt, std::nullopt);
    after_ground.begin(0.0, 130.0);
    const double ground = after_ground.xyz(80.0, 90.0).y;
    after_ground.begin(150.0, 130.0);
    alone.begin(150.0, 130.0);
    const double first = alone.xyz(80.0, 90.0).y;
    std::printf("10 deg up: %.5g cd/m2 from 0 m, %.5g from 150 m\n", ground, first);
    EXPECT_EQ(after_ground.xyz(80.0, 90.0).y, first);
    EXPECT_NE(first, ground);
    after_ground.begin(0.0, 130.0);
    EXPECT_EQ(after_ground.xyz(80.0, 90.0).y, ground);
}

}  // namespace
}  // namespace skyig::clients::sky
