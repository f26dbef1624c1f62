// The seal against the vectors that its authors published.
#include "server/rig/tag.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>

namespace skyig::server::rig {
namespace {

TEST(Siphash, GivesThePapersExample) {
    // Appendix A: key 00 01 .. 0f, message 00 01 .. 0e.
    const auto key = parse_key("000102030405060708090a0b0c0d0e0f");
    ASSERT_TRUE(key) << key.error();
    std::array<std::byte, 15> message{};
    for (std::size_t i = 0; i < message.size(); ++i)
        message[i] = static_cast<std::byte>(i);
    EXPECT_EQ(siphash(*key, message), 0xa129ca6149be45e5U);
    // The first vectors of the authors' own list.
    EXPECT_EQ(siphash(*key, {}), 0x726fdb47dd0e0e31U);
    EXPECT_EQ(siphash(*key, std::span(message).first<1>()), 0x74f839c593dc67fdU);
    EXPECT_EQ(siphash(*key, std::span(message).first<8>()), 0x93f5f5799a932462U);
}

TEST(Key, IsReadFromHexadecimalDigitsAndRefusedOtherwise) {
    EXPECT_TRUE(parse_key("  000102030405060708090A0B0C0D0E0F\n"));
    for (const char* text :
         {"", "0001", "000102030405060708090a0b0c0d0e0g", "0 0102030405060708090a0b0c0d0e0f"})
        EXPECT_FALSE(parse_key(text)) << text;
    EXPECT_EQ(parse_key("0001").error(),
              "holds 4 characters; it must hold 32 hexadecimal digits, as \"openssl rand "
              "-hex 16\" writes them");
    EXPECT_EQ(read_key("/nowhere/key").error(),
              "/nowhere/key: the rig's key cannot be read (No such file or directory); it must hold 32 "
              "hexadecimal digits, the same on all machines");
}

TEST(Key, IsToldOpenWhereEveryUserCanReadItsFile) {
    namespace fs = std::filesystem;
    const fs::path path = fs::path(::testing::TempDir()) / "skyig-rig-key";
    std::ofstream(path) << "000102030405060708090a0b0c0d0e0f\n";
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
    EXPECT_FALSE(is_open_to_all(path));
    fs::permissions(path, fs::perms::others_read, fs::perm_options::add);
    EXPECT_TRUE(is_open_to_all(path));
    fs::remove(path);
    EXPECT_FALSE(is_open_to_all(path));
}

}  // namespace
}  // namespace skyig::server::rig
