#include "clients/bench/truth_table.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace skyig::clients::bench {
namespace {

class TruthTableTest : public testing::Test {
  protected:
    std::filesystem::path path_ = std::filesystem::path(testing::TempDir()) / "skyig-truth.csv";

    void write(const std::string& text) const { std::ofstream(path_) << text; }
    void TearDown() override { std::filesystem::remove(path_); }
};

template <class Call>
std::string message_of(Call call) {
    try {
        call();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "no complaint";
}

TEST_F(TruthTableTest, FieldsAreFoundByTheirColumn) {
    write("# a remark\r\nbody,km\r\nsun,1.47093e+08\r\n\r\n# another\nmoon,-3.5\n");
    const TruthTable table(path_);
    ASSERT_EQ(table.rows(), 2U);
    EXPECT_EQ(table.text(0, "body"), "sun");
    EXPECT_EQ(table.number(0, "km"), 1.47093e8);
    EXPECT_EQ(table.number(1, "km"), -3.5);
}

TEST_F(TruthTableTest, WhatIsWrongIsNamed) {
    EXPECT_NE(message_of([&] { TruthTable table(path_); }).find("--truth"), std::string::npos);
    write("a,b\n1,2\n3\n");
    EXPECT_NE(message_of([&] { TruthTable table(path_); }).find(":3: 1 fields"), std::string::npos);
    write("a,b\n1,\"2\n");
    EXPECT_NE(message_of([&] { TruthTable table(path_); }).find(":2: the line is too long or a quote"),
              std::string::npos);
    write("a,b\n1,2x\n");
    const TruthTable table(path_);
    EXPECT_NE(message_of([&] { (void)table.number(0, "b"); }).find("'2x' is not a number"),
              std::string::npos);
    EXPECT_NE(message_of([&] { (void)table.text(0, "c"); }).find("no column c"), std::string::npos);
}

}  // namespace
}  // namespace skyig::clients::bench
