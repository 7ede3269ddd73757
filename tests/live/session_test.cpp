// Rides without a clock, sessions with one: what is driven, paused, reset, loaded and recorded.
#include "hamilcar/live/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <fstream>

#include "hamilcar/io/result_file.hpp"
#include "live/garage.hpp"
#include "support/allocation_guard.hpp"
#include "support/fleet.hpp"

namespace hamilcar::live {
namespace {

Ride ride_of(const std::string& road = "flat") {
    const Wish wish{"car", road};
    auto [vehicle, scenario] = garage().open(wish);
    return Ride(1, wish, vehicle, scenario);
}

// Off, to the left, and braking.
Held lesson(long step) {
    const bool late = step > 1500;
    return {.page = 1,
            .sequence = static_cast<std::uint32_t>(step / 16),
            .controls = {.steer = step > 700 ? 1.0 : 0.0, .throttle = late ? 0.0 : 0.8, .brake = late ? 0.5 : 0.0}};
}

State<double> drive(Ride& ride, long steps, long show_every = 0) {
    for (long i = 0; i < steps; ++i) {
        const auto end = ride.advance(lesson(i));
        EXPECT_FALSE(end) << end->message;
        if (show_every > 0 && i % show_every == 0) ride.show(lesson(i));
    }
    return ride.state();
}

void expect_same_bits(const State<double>& a, const State<double>& b) {
    for (std::size_t k = 0; k < a.values.size(); ++k) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(a.values[k]), std::bit_cast<std::uint64_t>(b.values[k])) << k;
    }
}

TEST(Ride, GoesWhereItIsSteered) {
    Ride ride = ride_of();
    drive(ride, 2500);
    EXPECT_GT(ride.state().position()[0], 3);
    EXPECT_GT(ride.state().position()[1], 0.2);  // to the left
}

TEST(Ride, IsTheSameWithTheSameControlsHoweverOftenItIsShown) {
    Ride plain = ride_of(), shown = ride_of();
    expect_same_bits(drive(plain, 2500), drive(shown, 2500, 3));
}

TEST(Ride, StartsAnewToTheBit) {
    Ride ride = ride_of("waves");
    const State<double> start = ride.state(), first = drive(ride, 2500);
    ride.reset();
    EXPECT_EQ(ride.time(), 0);
    expect_same_bits(ride.state(), start);
    expect_same_bits(drive(ride, 2500), first);
}

TEST(Ride, AllocatesNothingWhileItIsDriven) {
    Ride ride = ride_of();
    drive(ride, 20, 5);
    const test::AllocationGuard guard;
    for (long i = 20; i < 1000; ++i) {
        ride.advance(lesson(i));
        if (i % 10 == 0) ride.show(lesson(i));
    }
    EXPECT_EQ(guard.allocations(), 0);
}

TEST(Ride, EveryShippedCarCanBeDrivenToTheLeft) {
    for (const std::string& name : test::fleet()) {
        Ride ride(1, {name, "flat"}, test::shipped(name), test::scenario(1));
        for (long i = 0; i < 3000; ++i) {
            const auto end = ride.advance({.controls = {.steer = i > 1500 ? 1.0 : 0.0, .throttle = 0.7}});
            ASSERT_FALSE(end) << name << ": " << end->message;
        }
        EXPECT_GT(ride.state().position()[0], 1) << name;
        EXPECT_GT(ride.state().position()[1], 0.05) << name;
    }
}

class Drive : public testing::Test {
protected:
    const Progress& progress() { return session.attend(), session.progress(); }
    bool waits_for(Pause pause) {
        return comes_true([&] { return progress().paused == pause; });
    }
    bool drives_until(double time) {
        return comes_true([&] { return progress().time >= time; });
    }

    std::string folder = scratch_folder();
    Session session{garage(), {"car", "flat"}, folder};
    void TearDown() override { std::filesystem::remove_all(folder); }
};

TEST_F(Drive, StandsUntilSomebodyIsAtTheWheel) {
    EXPECT_TRUE(waits_for(Pause::nobody));
    EXPECT_EQ(progress().time, 0);
    session.set_driven(true);
    EXPECT_TRUE(drives_until(0.3));
    session.pause(true);
    EXPECT_TRUE(waits_for(Pause::driver));
    const double stopped = progress().time;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(progress().time, stopped);
    session.pause(false);
    EXPECT_TRUE(drives_until(stopped + 0.1));
    session.set_driven(false);
    EXPECT_TRUE(waits_for(Pause::nobody));
    EXPECT_GT(progress().report.steps, 300);
}

TEST_F(Drive, ShowsFramesWithTheInputThatWasFelt) {
    session.set_driven(true);
    session.hold({.page = 4, .sequence = 99, .controls = {.throttle = 1}});
    EXPECT_TRUE(comes_true([&] {
        progress();
        return session.ride().frames().fetch() && session.ride().frames().value().sequence == 99;
    }));
    EXPECT_EQ(session.ride().frames().value().page, 4u);
    EXPECT_EQ(session.ride().frames().value().values.size(), session.ride().channels().size());
}

TEST_F(Drive, StartsAnew) {
    session.set_driven(true);
    ASSERT_TRUE(drives_until(0.5));
    session.pause(true);
    session.reset();
    EXPECT_TRUE(comes_true([&] { return progress().time == 0; }));
}

TEST_F(Drive, KeepsTheOldCarWhereTheNewOneFails) {
    session.set_driven(true);
    session.load({"wreck", "flat"}, 3);
    std::vector<Notice> notices;
    ASSERT_TRUE(comes_true([&] {
        EXPECT_FALSE(session.attend());
        notices = session.take_notices();
        return !notices.empty();
    }));
    EXPECT_EQ(notices[0].page, 3u);
    EXPECT_THAT(notices[0].message, testing::HasSubstr("no wheels"));
    EXPECT_EQ(session.ride().number(), 1u);
    EXPECT_TRUE(drives_until(progress().time + 0.1));
}

TEST_F(Drive, PutsAnotherCarOnAnotherRoad) {
    session.set_driven(true);
    session.load({"car", "waves", 0.5}, 1);
    ASSERT_TRUE(comes_true([&] { return session.attend(); }));
    EXPECT_EQ(session.ride().wish().road, "waves");
    EXPECT_TRUE(session.ride().uneven());
    EXPECT_EQ(session.ride().road().friction, 0.5);
    EXPECT_TRUE(comes_true([&] { return progress().car == session.ride().number() && progress().time > 0.1; }));
}

TEST_F(Drive, EndsWithAReasonAndBeginsAgain) {
    session.set_driven(true);
    session.load({"car", "drop"}, 1);
    ASSERT_TRUE(waits_for(Pause::ended));
    EXPECT_NE(progress().ended, "");
    EXPECT_GT(progress().time, 0.2);
    session.pause(true);
    session.reset();
    EXPECT_TRUE(waits_for(Pause::driver));
    EXPECT_EQ(progress().ended, "");
    EXPECT_EQ(progress().time, 0);
}

// And once more, beside the first file. The library that reads them wants to be alone, so the session goes first.
TEST(Recordings, EndWhereTheCarStartsAnew) {
    const std::string folder = scratch_folder();
    std::vector<std::string> files;
    std::string scene;
    {
        Session session(garage(), {"car", "waves"}, folder);
        const auto recorded = [&](double seconds) {
            return comes_true([&] { return session.attend(), session.recording().seconds > seconds; });
        };
        const auto stopped = [&] {
            return comes_true([&] { return session.attend(), session.recording().file.empty(); });
        };
        session.set_driven(true);
        for (int i = 0; i < 2; ++i) {
            session.record(true, 1);
            ASSERT_TRUE(recorded(0.2));
            files.push_back(session.recording().file);
            EXPECT_EQ(session.recording().lost_rows, 0);
            i == 0 ? session.reset() : session.record(false, 1);
            EXPECT_TRUE(stopped());
        }
        scene = session.ride().scene();
    }
    EXPECT_NE(files[0], files[1]);
    for (const std::string& file : files) {
        EXPECT_THAT(file, testing::MatchesRegex(folder + "/car-[0-9]+-[0-9]+(-2)?\\.nc"));
        const io::ResultFile result = io::read_result(file);
        EXPECT_EQ(result.scene, scene);
        EXPECT_FALSE(result.tiles.empty());
        const std::vector<double>& time = result.values[0];
        ASSERT_GT(time.size(), 20u);
        for (std::size_t i = 1; i < time.size(); ++i) ASSERT_NEAR(time[i] - time[i - 1], 0.01, 1e-9);
    }
    std::filesystem::remove_all(folder);
}

// Wishes that come faster than files open and cars are built: none is lost, none stays.
TEST(Recordings, FollowWishesThatComeTooFast) {
    const std::string folder = scratch_folder();
    {
        Session session(garage(), {"car", "flat"}, folder);
        const auto recorded = [&] {
            return comes_true([&] { return session.attend(), session.recording().seconds > 0.1; });
        };
        session.set_driven(true);
        session.record(true, 1);
        session.record(false, 1);
        session.record(true, 1);
        EXPECT_TRUE(recorded());
        session.record(false, 1);
        EXPECT_TRUE(comes_true([&] { return session.attend(), session.recording().file.empty(); }));
        session.load({"car", "waves"}, 1);
        session.record(true, 1);
        EXPECT_TRUE(recorded());
        EXPECT_EQ(session.ride().wish().road, "waves");
        EXPECT_TRUE(session.take_notices().empty());
    }
    std::filesystem::remove_all(folder);
}

TEST(Recordings, ThatCannotBeOpenedAreRefused) {
    const std::string folder = scratch_folder();
    std::ofstream(folder) << "a file where the folder should be";
    Session session(garage(), {"car", "flat"}, folder);
    session.record(true, 5);
    std::vector<Notice> notices;
    ASSERT_TRUE(comes_true([&] {
        session.attend();
        notices = session.take_notices();
        return !notices.empty();
    }));
    EXPECT_EQ(notices[0].page, 5u);
    EXPECT_THAT(notices[0].message, testing::HasSubstr("cannot create"));
    std::filesystem::remove(folder);
}

TEST(Sessions, DoNotBeginWithACarThatCannotBeRead) {
    EXPECT_THROW(Session(garage(), {"wreck", "flat"}, scratch_folder()), io::Error);
}

}  // namespace
}  // namespace hamilcar::live
