#include "server/world/views.h"

#include <gtest/gtest.h>

#include "tests/server/world/host_bench.h"

namespace skyig::server::world {
namespace {

using protocol::cigi::ViewControl;
using protocol::cigi::ViewDefinition;

ViewControl yaw_control(int view_id, int group_id, float yaw_deg) {
    ViewControl control;
    control.view_id = static_cast<std::uint16_t>(view_id);
    control.group_id = static_cast<std::uint8_t>(group_id);
    control.yaw_enable = true;
    control.yaw = yaw_deg;
    return control;
}

TEST(Views, OnlyEnabledPartsReplaceThoseOfTheView) {
    Views views(three_channels().channels);
    ViewControl control = yaw_control(2, 0, 15.0F);
    control.pitch = 40.0F;  // not enabled
    control.z_enable = true;
    control.z_offset = -1.5F;
    EXPECT_EQ(views.apply(control), ViewResult::kDone);
    EXPECT_EQ(views.all()[1].pose, (ViewPose{{0.0, 0.0, -1.5}, 15.0, 0.0, 0.0}));
    EXPECT_EQ(views.all()[0].pose.yaw_deg, -60.0);
    views.reset();
    EXPECT_EQ(views.all()[1].pose, ViewPose{});
}

TEST(Views, GroupMovesAsAWholeAndLeavesItsViews) {
    Views views(three_channels().channels);
    EXPECT_EQ(views.apply(yaw_control(2, 9, 90.0F)), ViewResult::kDone);
    EXPECT_EQ(views.group(9).yaw_deg, 90.0);
    EXPECT_EQ(views.all()[1].pose.yaw_deg, 0.0);
    EXPECT_EQ(views.group(0), ViewPose{});
    views.reset();
    EXPECT_EQ(views.group(9), ViewPose{});
}

TEST(Views, RefusesWhatItCannotDraw) {
    Views views(three_channels().channels);
    EXPECT_EQ(views.apply(yaw_control(44, 0, 15.0F)), ViewResult::kUnknownView);
    ViewControl chase = yaw_control(2, 0, 15.0F);
    chase.entity_id = 5;
    EXPECT_EQ(views.apply(chase), ViewResult::kOtherEntity);
    ViewControl far = yaw_control(2, 0, 15.0F);
    far.x_enable = true;
    far.x_offset = 1.0e30F;
    EXPECT_EQ(views.apply(far), ViewResult::kFarAway);
    EXPECT_EQ(views.all()[1].pose, ViewPose{});
}

TEST(Views, DefinitionReplacesEnabledHalfAngles) {
    Views views(three_channels().channels);
    ViewDefinition definition;
    definition.view_id = 3;
    definition.group_id = 2;
    definition.left_enable = true;
    definition.left = 5.0F;
    definition.right = 99.0F;  // not enabled
    EXPECT_EQ(views.apply(definition), ViewResult::kDone);
    EXPECT_EQ(views.all()[2].half_angles, (HalfAngles{5.0, 30.0, -24.79, 24.79}));
    EXPECT_EQ(views.all()[2].group_id, 2);
}

TEST(Views, DefinitionThatLeavesNoPictureKeepsTheFrustum) {
    Views views(three_channels().channels);
    const HalfAngles before = views.all()[2].half_angles;
    ViewDefinition definition;
    definition.view_id = 3;
    definition.group_id = 7;
    definition.mirror_mode = 1;
    definition.left_enable = true;
    definition.left = 30.0F;  // equals the right side that stays
    EXPECT_EQ(views.apply(definition), ViewResult::kBadFrustum);
    EXPECT_NE(views.all()[2].group_id, 7) << "a refused packet is ignored whole";
    EXPECT_EQ(views.all()[2].mirror_mode, 0);
    definition.left = -89.0F;
    EXPECT_EQ(views.apply(definition), ViewResult::kBadFrustum);
    EXPECT_EQ(views.all()[2].half_angles, before);
    definition.view_id = 44;
    EXPECT_EQ(views.apply(definition), ViewResult::kUnknownView);
}

TEST(Views, DefinitionSaysHowAViewIsShown) {
    Views views(three_channels().channels);
    ViewDefinition definition;
    definition.view_id = 1;
    definition.mirror_mode = 3;
    definition.pixel_replication = 2;
    definition.projection_type = true;
    definition.top_enable = true;
    definition.top = 10.0F;
    EXPECT_EQ(views.apply(definition), ViewResult::kDone);
    const View& view = views.all()[0];
    EXPECT_EQ(view.mirror_mode, 3);
    EXPECT_EQ(view.pixel_replication, 2);
    EXPECT_TRUE(view.orthographic);
    EXPECT_EQ(view.half_angles.top_deg, 10.0);
    definition.mirror_mode = 0;
    definition.pixel_replication = 0;
    definition.projection_type = false;
    EXPECT_EQ(views.apply(definition), ViewResult::kDone);
    EXPECT_EQ(view.mirror_mode, 0);
    EXPECT_FALSE(view.orthographic);
}

TEST(Views, ReplicationThatNoStandardSaysIsRefusedWhole) {
    Views views(three_channels().channels);
    ViewDefinition definition;
    definition.view_id = 1;
    definition.mirror_mode = 1;
    definition.pixel_replication = 4;
    EXPECT_EQ(views.apply(definition), ViewResult::kReplication);
    EXPECT_EQ(views.all()[0].pixel_replication, 0);
    EXPECT_EQ(views.all()[0].mirror_mode, 0);
}

TEST(Views, PatternsAreShownByViewByGroupOrInAll) {
    config::Config config = three_channels();
    config.channels[0].group_id = config.channels[2].group_id = 4;
    config.channels[1].pattern = config::Pattern::kGrid;
    config.channels[1].windscreen_m = 0.8;
    Views views(config.channels);
    EXPECT_EQ(views.all()[0].windscreen_m, 0.0);
    EXPECT_EQ(views.all()[1].windscreen_m, 0.8);
    const auto shown = [&views](std::size_t i) { return views.all()[i].pattern; };
    EXPECT_EQ(shown(1), config::Pattern::kGrid);
    EXPECT_TRUE(views.show_pattern(1, config::Pattern::kChecker));
    EXPECT_FALSE(views.show_pattern(44, config::Pattern::kChecker));
    EXPECT_EQ(shown(0), config::Pattern::kChecker);
    EXPECT_TRUE(views.show_pattern_in_group(4, config::Pattern::kSeam));
    EXPECT_FALSE(views.show_pattern_in_group(5, config::Pattern::kWhite));
    EXPECT_EQ(shown(0), config::Pattern::kSeam);
    EXPECT_EQ(shown(1), config::Pattern::kGrid);
    EXPECT_EQ(shown(2), config::Pattern::kSeam);
    EXPECT_TRUE(views.show_pattern_in_group(0, config::Pattern::kOff));
    EXPECT_EQ(shown(1), config::Pattern::kOff);
    views.reset();
    EXPECT_EQ(shown(0), config::Pattern::kOff);
    EXPECT_EQ(shown(1), config::Pattern::kGrid);
}

}  // namespace
}  // namespace skyig::server::world
