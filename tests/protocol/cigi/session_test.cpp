// The link's logic: echo of frame numbers, restart, wrap, modes, database handshake.
#include <gtest/gtest.h>

#include "protocol/cigi/session.h"

namespace skyig::protocol::cigi {
namespace {

SessionEvents tell(Session& session, std::uint32_t frame, IgMode mode = IgMode::kOperate, int database = 0,
                   Version version = Version::k33) {
    return session.receive(
        {.database_number = static_cast<std::int8_t>(database), .ig_mode = mode, .host_frame_number = frame},
        version, ByteOrder::kLittle);
}

TEST(Session, BeginsInStandbyWithItsDefaultVersion) {
    Session session({.version = Version::k40});
    EXPECT_EQ(session.version(), Version::k40);
    EXPECT_FALSE(session.connected());
    const StartOfFrame first = session.next_frame(5);
    const StartOfFrame second = session.next_frame(6, false);
    EXPECT_EQ(first.ig_mode, IgMode::kStandby);
    EXPECT_EQ(first.database_number, 0);
    EXPECT_EQ(first.timestamp, 5U);
    EXPECT_TRUE(first.timestamp_valid);
    EXPECT_FALSE(second.timestamp_valid);
    EXPECT_EQ(second.ig_frame_number, first.ig_frame_number + 1);
}

TEST(Session, SpeaksTheHostsVersionFromItsFirstMessage) {
    Session session;
    const SessionEvents first = tell(session, 10, IgMode::kOperate, 0, Version::k40);
    EXPECT_TRUE(first.first_contact);
    EXPECT_FALSE(first.version_changed);
    EXPECT_EQ(session.version(), Version::k40);
    const SessionEvents second = tell(session, 11, IgMode::kOperate, 0, Version::k33);
    EXPECT_FALSE(second.first_contact);
    EXPECT_TRUE(second.version_changed);
    EXPECT_EQ(session.version(), Version::k33);
}

TEST(Session, EchoesTheHostsFrameNumber) {
    Session session;
    tell(session, 1200);
    EXPECT_EQ(session.next_frame(0).last_host_frame_number, 1200U);
    EXPECT_EQ(tell(session, 1205).frames_missed, 4U);
    EXPECT_EQ(session.next_frame(0).last_host_frame_number, 1205U);
}

TEST(Session, CountsTheRoundTripFromTheHostsEcho) {
    Session session;
    for (int i = 0; i < 7; ++i)
        static_cast<void>(session.next_frame(0));
    session.receive({.ig_mode = IgMode::kOperate, .last_ig_frame_number = 5}, Version::k33, ByteOrder::kBig);
    EXPECT_EQ(session.round_trip_frames(), 2U);
    EXPECT_EQ(session.host_order(), ByteOrder::kBig);
}

TEST(Session, FrameNumbersWrap) {
    Session session;
    tell(session, 0xFFFFFFFEU);
    const SessionEvents wrapped = tell(session, 1);
    EXPECT_FALSE(wrapped.host_restarted);
    EXPECT_FALSE(wrapped.late);
    EXPECT_EQ(wrapped.frames_missed, 2U);
}

TEST(Session, AnOvertakenMessageIsNotObeyed) {
    Session session;
    tell(session, 100);
    const SessionEvents late = tell(session, 98, IgMode::kStandby);
    EXPECT_TRUE(late.late);
    EXPECT_FALSE(late.obey);
    EXPECT_EQ(session.mode(), IgMode::kOperate);
    EXPECT_EQ(session.last_host_frame_number(), 100U);
    EXPECT_TRUE(tell(session, 101).obey);
}

TEST(Session, AHostThatNeverCountsIsObeyed) {
    Session session;
    for (int i = 0; i < 5; ++i)
        EXPECT_TRUE(tell(session, 0).obey);
}

TEST(Session, AFarJumpBackIsARestartedHost) {
    Session session;
    tell(session, 5000);
    EXPECT_TRUE(tell(session, 5000 - Session::kLateFrames).late);
    const SessionEvents again = tell(session, 0);
    EXPECT_TRUE(again.host_restarted);
    EXPECT_TRUE(again.obey);
    EXPECT_EQ(session.last_host_frame_number(), 0U);
    EXPECT_FALSE(tell(session, 1).host_restarted);
}

TEST(Session, AHostThatRestartsEarlyIsBelievedAfterAShortRun) {
    Session session;
    tell(session, 120);
    for (int i = 0; i < Session::kLateRun - 1; ++i)
        EXPECT_TRUE(tell(session, static_cast<std::uint32_t>(i)).late) << i;
    EXPECT_TRUE(tell(session, Session::kLateRun - 1).host_restarted);
    EXPECT_TRUE(tell(session, Session::kLateRun).obey);
}

TEST(Session, ShuffledMessagesAreNoRestart) {
    Session session;
    tell(session, 0);
    int late = 0;
    for (std::uint32_t frame = 2; frame < 2000; frame += 2) {
        EXPECT_FALSE(tell(session, frame).host_restarted);
        const SessionEvents overtaken = tell(session, frame - 1);
        EXPECT_FALSE(overtaken.host_restarted);
        late += overtaken.late ? 1 : 0;
    }
    EXPECT_EQ(late, 999);
}

TEST(Session, StandbyObeysTheModeOnly) {
    Session session;
    const SessionEvents standby = tell(session, 1, IgMode::kStandby, 7);
    EXPECT_FALSE(standby.obey);
    EXPECT_FALSE(standby.entered_standby);
    EXPECT_EQ(session.next_frame(0).database_number, 0);
    const SessionEvents operate = tell(session, 2, IgMode::kOperate);
    EXPECT_TRUE(operate.obey);
    EXPECT_TRUE(operate.mode_changed);
    EXPECT_EQ(session.next_frame(0).ig_mode, IgMode::kOperate);
    EXPECT_FALSE(tell(session, 3, IgMode::kDebug).entered_standby);
    const SessionEvents back = tell(session, 4, IgMode::kStandby);
    EXPECT_TRUE(back.entered_standby);
    EXPECT_FALSE(back.obey);
    EXPECT_EQ(session.next_frame(0).ig_mode, IgMode::kStandby);
}

TEST(Session, DatabaseIsReportedLoadingThenLoaded) {
    Session session;
    tell(session, 1, IgMode::kOperate, 7);
    EXPECT_EQ(session.next_frame(0).database_number, -7);
    tell(session, 2, IgMode::kOperate, 7);  // the host repeats until it sees -7
    EXPECT_EQ(session.next_frame(0).database_number, -7);
    tell(session, 3, IgMode::kOperate, 0);
    EXPECT_EQ(session.next_frame(0).database_number, 7);
    tell(session, 4, IgMode::kOperate, 0);
    EXPECT_EQ(session.next_frame(0).database_number, 7);
}

TEST(Session, DatabaseIsReportedLoadingForAFrameEvenIfTheHostSaysZeroAtOnce) {
    Session session;
    tell(session, 1, IgMode::kOperate, 5);
    tell(session, 2, IgMode::kOperate, 0);
    EXPECT_EQ(session.next_frame(0).database_number, -5);
    EXPECT_EQ(session.next_frame(0).database_number, 5);
}

TEST(Session, DatabaseLoadsAgainOnRequest) {
    Session session;
    for (const int number : {127, 3, 3}) {  // another one, then the same once more
        tell(session, 1, IgMode::kOperate, number);
        EXPECT_EQ(session.next_frame(0).database_number, -number);
        tell(session, 1, IgMode::kOperate, 0);
        EXPECT_EQ(session.next_frame(0).database_number, number);
    }
}

TEST(Session, StandbyForgetsAnUnfinishedLoad) {
    Session session;
    tell(session, 1, IgMode::kOperate, 4);
    EXPECT_EQ(session.next_frame(0).database_number, -4);
    tell(session, 2, IgMode::kStandby, 4);
    EXPECT_EQ(session.next_frame(0).database_number, 0);
}

TEST(Session, WithoutADatabaseItReportsZero) {
    Session session({.database = DatabasePolicy::kNone});
    tell(session, 1, IgMode::kOperate, 9);
    EXPECT_EQ(session.next_frame(0).database_number, 0);
}

}  // namespace
}  // namespace skyig::protocol::cigi
