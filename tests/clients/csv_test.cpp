// Records of CSV text with every byte kept, and numbers.
#include "clients/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <utility>

namespace skyig::clients {
namespace {

using ::testing::ElementsAre;

CsvRecord first_record(const std::string& text) {
    std::istringstream stream(text);
    return CsvReader(stream).next().value();
}

TEST(Csv, CommentsAndEmptyLinesAreLeftOutAndLinesAreCounted) {
    std::istringstream stream("# a table\n\na,b\n  \n1,2\r\n#1,3\n4,5");
    CsvReader reader(stream);
    const CsvRecord heading = reader.next().value();
    EXPECT_EQ(heading.line, 3U);
    EXPECT_EQ(heading.line_end, "\n");
    const CsvRecord row = reader.next().value();
    EXPECT_EQ(row.line, 5U);
    EXPECT_EQ(row.text, "1,2");
    EXPECT_EQ(row.line_end, "\r\n");
    EXPECT_EQ(reader.next().value().text, "4,5");
    EXPECT_FALSE(reader.next().has_value());
}

TEST(Csv, QuotedFieldsHoldCommasAndQuotes) {
    const CsvRecord record = first_record(R"(a, "b, c" ,"say ""no""", d ,"")");
    EXPECT_TRUE(record.well_formed);
    EXPECT_THAT(record.fields, ElementsAre("a", "b, c", "say \"no\"", "d", ""));
    EXPECT_EQ(record.text, R"(a, "b, c" ,"say ""no""", d ,"")");
}

TEST(Csv, EmptyFieldsAreKept) {
    EXPECT_THAT(first_record(",a,,").fields, ElementsAre("", "a", "", ""));
    EXPECT_THAT(first_record("\xEF\xBB\xBFutc,body").fields, ElementsAre("utc", "body"));
}

TEST(Csv, OpenQuotesAndTextBehindQuotesAreToldAndHurtNoOtherLine) {
    std::istringstream stream("\"a,b\n\"a\"b,c\nd,e\n");
    CsvReader reader(stream);
    EXPECT_FALSE(reader.next().value().well_formed);
    EXPECT_FALSE(reader.next().value().well_formed);
    EXPECT_THAT(reader.next().value().fields, ElementsAre("d", "e"));
}

TEST(Csv, CommentsMayStandAfterBlanks) {
    std::istringstream stream("  # a table\na\n");
    EXPECT_EQ(CsvReader(stream).next().value().text, "a");
}

TEST(Csv, LinesOfEveryLengthAroundAPieceAreWhole) {
    for (std::size_t length = 4090; length <= 4100; ++length) {
        for (const char* end : {"\n", "\r\n", ""}) {
            std::istringstream stream(std::string(length, 'x') + end);
            CsvReader reader(stream);
            EXPECT_EQ(reader.next().value().text, std::string(length, 'x')) << length;
            EXPECT_FALSE(reader.next().has_value());
            EXPECT_EQ(reader.line(), 1U);
            EXPECT_FALSE(reader.failed());
        }
    }
}

TEST(Csv, LinesBeyondTheMostAreToldAndTheRestGoesOn) {
    std::string text = "a\n";
    text.append(kMostLineBytes, 'y').append("\n").append(3 * kMostLineBytes, 'z').append("\nb");
    std::istringstream stream(text);
    CsvReader reader(stream);
    EXPECT_EQ(reader.next().value().text, "a");
    const CsvRecord longest = reader.next().value();
    EXPECT_FALSE(longest.too_long);
    EXPECT_EQ(longest.text.size(), kMostLineBytes);
    const CsvRecord cut = reader.next().value();
    EXPECT_TRUE(cut.too_long);
    EXPECT_EQ(cut.line, 3U);
    EXPECT_TRUE(cut.text.empty());
    EXPECT_EQ(reader.next().value().text, "b");
}

/// Gives some text, then an error as a broken disk does.
class BrokenBuffer : public std::streambuf {
  public:
    explicit BrokenBuffer(std::string text) : text_(std::move(text)) {
        setg(text_.data(), text_.data(), text_.data() + text_.size());
    }

  protected:
    int_type underflow() override { throw std::runtime_error("no more"); }

  private:
    std::string text_;
};

TEST(Csv, AnErrorIsNoEnd) {
    BrokenBuffer buffer("a\nb,c\nd,");
    std::istream stream(&buffer);
    CsvReader reader(stream);
    EXPECT_EQ(reader.next().value().text, "a");
    EXPECT_EQ(reader.next().value().text, "b,c");
    EXPECT_FALSE(reader.failed());
    EXPECT_FALSE(reader.next().has_value());
    EXPECT_TRUE(reader.failed());
    EXPECT_EQ(reader.line(), 2U);
}

TEST(Csv, NumbersAreWholeFields) {
    EXPECT_EQ(parse_number("1.5e3"), 1500.0);
    EXPECT_EQ(parse_number(" +2 "), 2.0);
    EXPECT_EQ(parse_number("-0.25"), -0.25);
    for (const char* text : {"", " ", "+", "+-1", "1,5", "1 2", "nan", "inf", "-inf", "1e999", "0x10", "12m"})
        EXPECT_FALSE(parse_number(text).has_value()) << text;
}

}  // namespace
}  // namespace skyig::clients
