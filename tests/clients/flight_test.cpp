#include "clients/skyig/flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <sstream>

namespace skyig::clients {
namespace {

constexpr const char* kHeader = "t_s,lat_deg,lon_deg,alt_msl_m,yaw_deg,pitch_deg,roll_deg\n";

std::optional<Flight> read(const std::string& rows, std::string& error) {
    std::istringstream text(kHeader + rows);
    return read_flight(text, "f.csv", error);
}

Flight flight(const std::string& rows) {
    std::string error;
    std::optional<Flight> read_back = read(rows, error);
    EXPECT_TRUE(read_back) << error;
    return read_back.value_or(Flight({FlightPoint{}}));
}

std::string error_of(const std::string& text) {
    std::istringstream stream(text);
    std::string error;
    EXPECT_FALSE(read_flight(stream, "f.csv", error));
    return error;
}

TEST(Flight, IsStraightBetweenRows) {
    const FlightPoint p = flight("0,10,20,100,30,-2,4\n2,11,22,200,40,2,-4\n").at(0.5);
    EXPECT_DOUBLE_EQ(p.latitude_deg, 10.25);
    EXPECT_DOUBLE_EQ(p.longitude_deg, 20.5);
    EXPECT_DOUBLE_EQ(p.altitude_m, 125.0);
    EXPECT_DOUBLE_EQ(p.yaw_deg, 32.5);
    EXPECT_DOUBLE_EQ(p.pitch_deg, -1.0);
    EXPECT_DOUBLE_EQ(p.roll_deg, 2.0);
}

TEST(Flight, TurnsTheShortWayThroughNorth) {
    const Flight rightwards = flight("0,0,0,0,350,0,0\n1,0,0,0,20,0,0\n");
    EXPECT_NEAR(rightwards.at(0.25).yaw_deg, 357.5, 1e-12);
    EXPECT_NEAR(rightwards.at(0.5).yaw_deg, 5.0, 1e-12);
    const Flight leftwards = flight("0,0,0,0,20,0,0\n1,0,0,0,350,0,0\n");
    EXPECT_NEAR(leftwards.at(0.75).yaw_deg, 357.5, 1e-12);
    EXPECT_DOUBLE_EQ(flight("0,0,0,0,360,0,0\n").at(0.0).yaw_deg, 0.0);
}

TEST(Flight, CrossesTheAntimeridianAndRollsThroughInverted) {
    const Flight f = flight("0,0,179.9,0,0,0,170\n1,0,-179.9,0,0,0,-170\n");
    EXPECT_NEAR(std::abs(f.at(0.5).longitude_deg), 180.0, 1e-12);
    EXPECT_NEAR(f.at(0.75).longitude_deg, -179.95, 1e-12);
    EXPECT_NEAR(f.at(0.25).roll_deg, 175.0, 1e-12);
}

TEST(Flight, StandsStillBeforeItsFirstAndAfterItsLastRow) {
    const Flight f = flight("5,1,2,3,4,5,6\n6,2,3,4,5,6,7\n");
    EXPECT_DOUBLE_EQ(f.at(-100.0).latitude_deg, 1.0);
    EXPECT_DOUBLE_EQ(f.at(1e6).latitude_deg, 2.0);
    EXPECT_DOUBLE_EQ(f.at(6.0).roll_deg, 7.0);
}

TEST(Flight, TakesColumnsInAnyOrderAndIgnoresOthers) {
    std::istringstream text(
        "# a comment\r\n\r\nroll_deg, other, pitch_deg,heading_deg,alt_m,lon_deg,lat_deg,t_s\r\n"
        "6,x,5,4,3,2,1,0\r\n");
    std::string error;
    const std::optional<Flight> f = read_flight(text, "f.csv", error);
    ASSERT_TRUE(f) << error;
    const FlightPoint p = f->at(0.0);
    EXPECT_DOUBLE_EQ(p.latitude_deg, 1.0);
    EXPECT_DOUBLE_EQ(p.longitude_deg, 2.0);
    EXPECT_DOUBLE_EQ(p.altitude_m, 3.0);
    EXPECT_DOUBLE_EQ(p.yaw_deg, 4.0);
    EXPECT_DOUBLE_EQ(p.pitch_deg, 5.0);
    EXPECT_DOUBLE_EQ(p.roll_deg, 6.0);
}

TEST(Flight, NamesFileLineAndWhatIsWrong) {
    const std::string header = kHeader;
    EXPECT_EQ(error_of(""), "f.csv:0: no header line and no rows");
    EXPECT_EQ(error_of(header), "f.csv:1: no rows under the header");
    EXPECT_EQ(error_of("t_s,lat_deg\n0,1\n"), "f.csv:1: the header lacks the column 'lon_deg'");
    EXPECT_EQ(error_of(header + "0,1,2,3,4,5\n"), "f.csv:2: 6 fields where the header has 7");
    EXPECT_EQ(error_of(header + "0,1,2,3,4,5,6\n# c\n1,1,x,3,4,5,6\n"),
              "f.csv:4: lon_deg is 'x', which is no number");
    EXPECT_EQ(error_of(header + "0,1,2,3,4,5,nan\n"), "f.csv:2: roll_deg is 'nan', which is no number");
    EXPECT_EQ(error_of(header + "0,1,2,3,4,5,\n"), "f.csv:2: roll_deg is '', which is no number");
    EXPECT_EQ(error_of(header + "0,91,2,3,4,5,6\n"), "f.csv:2: lat_deg is 91, outside -90 to 90");
    EXPECT_EQ(error_of(header + "1,1,2,3,4,5,6\n1,1,2,3,4,5,6\n"),
              "f.csv:3: t_s is 1, not after the 1 of the row before");
    std::string error;
    EXPECT_FALSE(load_flight("no/such/file.csv", error));
    EXPECT_EQ(error, "no/such/file.csv: cannot be opened for reading");
}

TEST(Flight, ReadsTheRecordedFlightAndMovesSmoothly) {
    std::string error;
    const std::optional<Flight> f = load_flight(SKYIG_TEST_DATA "/flights/fg_c172p_takeoff_bikf.csv", error);
    ASSERT_TRUE(f) << error;
    EXPECT_EQ(f->size(), 3227U);
    EXPECT_DOUBLE_EQ(f->first_time_s(), 0.0);
    EXPECT_DOUBLE_EQ(f->last_time_s(), 108.8);
    // At 60 Hz a Cessna in a 21 degree bank turns at most a fraction of a degree a frame, north or not.
    double largest_turn_deg = 0.0;
    for (int i = 1; i < 6528; ++i) {
        const double turn = f->at(i / 60.0).yaw_deg - f->at((i - 1) / 60.0).yaw_deg;
        largest_turn_deg = std::max(largest_turn_deg, std::abs(std::remainder(turn, 360.0)));
    }
    std::printf("largest turn between frames at 60 Hz: %.4f deg\n", largest_turn_deg);
    EXPECT_LT(largest_turn_deg, 0.5);
    EXPECT_GT(largest_turn_deg, 0.05);
}

}  // namespace
}  // namespace skyig::clients
