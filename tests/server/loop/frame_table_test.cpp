#include "server/frame_table.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/server/loop/recording_fixture.h"

namespace skyig::server {
namespace {

TEST(FrameTable, TellsAFrameALineWithItsChannels) {
    const tests::Scratch scratch;
    config::Config config = config::default_config();
    config.channels.assign(2, config.channels.front());
    config.channels[0].name = "left";
    config.channels[1].name = "right";
    FrameTimes times(2);
    {
        FrameTable table(scratch.file("times.csv"), config.channels);
        times.input().add(1'500);
        times.shared().add(20'000);
        times.channel(0).add(300'000);
        times.channel(1).add(400'100);
        times.frame().add(721'600);
        table.add({7, 1'782'000'000'000'000'001, 2, true, 18, 5000}, times);
        times.frame().add(5);
        table.add({8, 1'782'000'000'016'666'667, 1, false, 0, 0}, times);
    }
    std::ifstream file(scratch.file("times.csv"));
    const std::string text(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(text,
              "frame,utc_ns,slots,late,arrivals,input_us,shared_us,left_us,right_us,frame_us,shown_ns\n"
              "7,1782000000000000001,2,1,18,1.5,20.0,300.0,400.1,721.6,5000\n"
              "8,1782000000016666667,1,0,0,1.5,20.0,300.0,400.1,0.0,0\n");
}

TEST(FrameTable, FileThatCannotBeHadIsOneLine) {
    try {
        const FrameTable table("no/such/place/a.csv", {});
        FAIL() << "a table without a file";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(),
                     "no/such/place/a.csv: cannot be made for times: No such file or directory");
    }
}

}  // namespace
}  // namespace skyig::server
