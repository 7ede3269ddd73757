// Live simulations without a clock, and sessions with one: driving, pausing, resetting, loading and recording.
#include "hamilcar/live/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <fstream>

#include "hamilcar/io/result_file.hpp"
#include "live/test_catalog.hpp"
#include "support/allocation_guard.hpp"
#include "support/fleet.hpp"

namespace hamilcar::live {
namespace {

LiveSimulation simulation_on(const std::string& road = "flat") {
    const LoadRequest request{"car", road};
    auto [vehicle, scenario] = test_catalog().open(request);
    return LiveSimulation(1, request, vehicle, scenario);
}

// Pulls away, steers to the left, then brakes.
ReceivedControls maneuver(long step) {
    const bool late = step > 1500;
    return {.page = 1,
            .sequence = static_cast<std::uint32_t>(step / 16),
            .controls = {.steer = step > 700 ? 1.0 : 0.0, .throttle = late ? 0.0 : 0.8, .brake = late ? 0.5 : 0.0}};
}

State<double> drive(LiveSimulation& simulation, long steps, long show_every = 0) {
    for (long i = 0; i < steps; ++i) {
        const auto end = simulation.advance(maneuver(i));
        EXPECT_FALSE(end) << end->message;
        if (show_every > 0 && i % show_every == 0) simulation.publish_frame(maneuver(i));
    }
    return simulation.state();
}

void expect_same_bits(const State<double>& a, const State<double>& b) {
    for (std::size_t k = 0; k < a.values.size(); ++k) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(a.values[k]), std::bit_cast<std::uint64_t>(b.values[k])) << k;
    }
}

TEST(LiveSimulation, FollowsSteering) {
    LiveSimulation simulation = simulation_on();
    drive(simulation, 2500);
    EXPECT_GT(simulation.state().position()[0], 3);
    EXPECT_GT(simulation.state().position()[1], 0.2);  // to the left
}

TEST(LiveSimulation, DoesNotDependOnFrameRate) {
    LiveSimulation plain = simulation_on(), shown = simulation_on();
    expect_same_bits(drive(plain, 2500), drive(shown, 2500, 3));
}

TEST(LiveSimulation, ResetIsBitIdentical) {
    LiveSimulation simulation = simulation_on("waves");
    const State<double> start = simulation.state(), first = drive(simulation, 2500);
    simulation.reset();
    EXPECT_EQ(simulation.time(), 0);
    expect_same_bits(simulation.state(), start);
    expect_same_bits(drive(simulation, 2500), first);
}

TEST(LiveSimulation, AdvancesWithoutAllocation) {
    LiveSimulation simulation = simulation_on();
    drive(simulation, 20, 5);
    const test::AllocationGuard guard;
    for (long i = 20; i < 1000; ++i) {
        simulation.advance(maneuver(i));
        if (i % 10 == 0) simulation.publish_frame(maneuver(i));
    }
    EXPECT_EQ(guard.allocations(), 0);
}

TEST(LiveSimulation, DrivesEveryShippedCar) {
    for (const std::string& name : test::fleet()) {
        LiveSimulation simulation(1, {name, "flat"}, test::shipped(name), test::scenario(1));
        for (long i = 0; i < 3000; ++i) {
            const auto end = simulation.advance({.controls = {.steer = i > 1500 ? 1.0 : 0.0, .throttle = 0.7}});
            ASSERT_FALSE(end) << name << ": " << end->message;
        }
        EXPECT_GT(simulation.state().position()[0], 1) << name;
        EXPECT_GT(simulation.state().position()[1], 0.05) << name;
    }
}

class LiveSession : public testing::Test {
protected:
    const Progress& progress() { return session.update(), session.progress(); }
    bool becomes_paused(Pause pause) {
        return becomes_true([&] { return progress().paused == pause; });
    }
    bool drives_until(double time) {
        return becomes_true([&] { return progress().time >= time; });
    }

    std::string folder = scratch_folder();
    Session session{test_catalog(), {"car", "flat"}, folder};
    void TearDown() override { std::filesystem::remove_all(folder); }
};

TEST_F(LiveSession, PausesWithoutDriver) {
    EXPECT_TRUE(becomes_paused(Pause::no_driver));
    EXPECT_EQ(progress().time, 0);
    session.set_driven(true);
    EXPECT_TRUE(drives_until(0.3));
    session.pause(true);
    EXPECT_TRUE(becomes_paused(Pause::driver));
    const double stopped = progress().time;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(progress().time, stopped);
    session.pause(false);
    EXPECT_TRUE(drives_until(stopped + 0.1));
    session.set_driven(false);
    EXPECT_TRUE(becomes_paused(Pause::no_driver));
    EXPECT_GT(progress().report.steps, 300);
}

TEST_F(LiveSession, FramesCarryInputSequence) {
    session.set_driven(true);
    session.set_controls({.page = 4, .sequence = 99, .controls = {.throttle = 1}});
    EXPECT_TRUE(becomes_true([&] {
        progress();
        return session.simulation().frames().fetch() && session.simulation().frames().value().sequence == 99;
    }));
    EXPECT_EQ(session.simulation().frames().value().page, 4u);
    EXPECT_EQ(session.simulation().frames().value().values.size(), session.simulation().channels().size());
}

TEST_F(LiveSession, ResetsTime) {
    session.set_driven(true);
    ASSERT_TRUE(drives_until(0.5));
    session.pause(true);
    session.reset();
    EXPECT_TRUE(becomes_true([&] { return progress().time == 0; }));
}

TEST_F(LiveSession, KeepsCarWhenLoadingFails) {
    session.set_driven(true);
    session.load({"wreck", "flat"}, 3);
    std::vector<Notice> notices;
    ASSERT_TRUE(becomes_true([&] {
        EXPECT_FALSE(session.update());
        notices = session.take_notices();
        return !notices.empty();
    }));
    EXPECT_EQ(notices[0].page, 3u);
    EXPECT_THAT(notices[0].message, testing::HasSubstr("no wheels"));
    EXPECT_EQ(session.simulation().number(), 1u);
    EXPECT_TRUE(drives_until(progress().time + 0.1));
}

TEST_F(LiveSession, LoadsAnotherCarAndRoad) {
    session.set_driven(true);
    session.load({"car", "waves", 0.5}, 1);
    ASSERT_TRUE(becomes_true([&] { return session.update(); }));
    EXPECT_EQ(session.simulation().request().road, "waves");
    EXPECT_TRUE(session.simulation().uneven());
    EXPECT_EQ(session.simulation().road().friction, 0.5);
    EXPECT_TRUE(becomes_true([&] { return progress().car == session.simulation().number() && progress().time > 0.1; }));
}

TEST_F(LiveSession, EndsWithReasonAndResets) {
    session.set_driven(true);
    session.load({"car", "drop"}, 1);
    ASSERT_TRUE(becomes_paused(Pause::ended));
    EXPECT_NE(progress().ended, "");
    EXPECT_GT(progress().time, 0.2);
    session.pause(true);
    session.reset();
    EXPECT_TRUE(becomes_paused(Pause::driver));
    EXPECT_EQ(progress().ended, "");
    EXPECT_EQ(progress().time, 0);
}

// Two recordings in one folder. The netCDF library is not thread-safe, so the session is destroyed before the files are read.
TEST(Recordings, EndOnReset) {
    const std::string folder = scratch_folder();
    std::vector<std::string> files;
    std::string scene;
    {
        Session session(test_catalog(), {"car", "waves"}, folder);
        const auto recorded = [&](double seconds) {
            return becomes_true([&] { return session.update(), session.recording().seconds > seconds; });
        };
        const auto stopped = [&] {
            return becomes_true([&] { return session.update(), session.recording().file.empty(); });
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
        scene = session.simulation().scene();
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

// Requests that come faster than files open and cars are built take effect in the end.
TEST(Recordings, HandleRapidRequests) {
    const std::string folder = scratch_folder();
    {
        Session session(test_catalog(), {"car", "flat"}, folder);
        const auto recorded = [&] {
            return becomes_true([&] { return session.update(), session.recording().seconds > 0.1; });
        };
        session.set_driven(true);
        session.record(true, 1);
        session.record(false, 1);
        session.record(true, 1);
        EXPECT_TRUE(recorded());
        session.record(false, 1);
        EXPECT_TRUE(becomes_true([&] { return session.update(), session.recording().file.empty(); }));
        session.load({"car", "waves"}, 1);
        session.record(true, 1);
        EXPECT_TRUE(recorded());
        EXPECT_EQ(session.simulation().request().road, "waves");
        EXPECT_TRUE(session.take_notices().empty());
    }
    std::filesystem::remove_all(folder);
}

TEST(Recordings, ReportOpenFailure) {
    const std::string folder = scratch_folder();
    std::ofstream(folder) << "a file where the folder should be";
    Session session(test_catalog(), {"car", "flat"}, folder);
    session.record(true, 5);
    std::vector<Notice> notices;
    ASSERT_TRUE(becomes_true([&] {
        session.update();
        notices = session.take_notices();
        return !notices.empty();
    }));
    EXPECT_EQ(notices[0].page, 5u);
    EXPECT_THAT(notices[0].message, testing::HasSubstr("cannot create"));
    std::filesystem::remove(folder);
}

std::string notice_of(Session& session) {
    std::vector<Notice> notices;
    EXPECT_TRUE(becomes_true([&] {
        session.update();
        notices = session.take_notices();
        return !notices.empty();
    }));
    return notices.empty() ? "" : notices[0].message;
}

TEST(Recordings, AreAtMostSoManyInAFolder) {
    const std::string folder = scratch_folder();
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/earlier.nc") << "of another drive";
    std::ofstream(folder + "/earlier.road") << "its road";
    std::ofstream(folder + "/notes.txt") << "no recording";
    {
        Session session(test_catalog(), {"car", "flat"}, folder, {.files = 2});
        session.set_driven(true);
        session.record(true, 1);
        ASSERT_TRUE(becomes_true([&] { return session.update(), session.recording().seconds > 0.1; }));
        session.record(false, 1);
        ASSERT_TRUE(becomes_true([&] { return session.update(), session.recording().file.empty(); }));
        EXPECT_TRUE(session.take_notices().empty());
        for (int i = 0; i < 2; ++i) {
            session.record(true, 1);
            EXPECT_THAT(notice_of(session),
                        testing::HasSubstr(folder + ": holds as many recordings as it may, 2 of them"));
        }
        EXPECT_TRUE(session.recording().file.empty());
    }
    std::filesystem::remove_all(folder);
}

TEST(Recordings, StopWhenTheirFolderIsFull) {
    const std::string folder = scratch_folder();
    std::string file;
    {
        Session session(test_catalog(), {"car", "flat"}, folder, {.bytes = 50'000});
        session.set_driven(true);
        session.record(true, 1);
        const std::string told = notice_of(session);
        for (const auto& entry : std::filesystem::directory_iterator(folder)) file = entry.path().string();
        EXPECT_THAT(told, testing::HasSubstr("holds as many recordings as it may, 500 of them or 5e-05 GB"));
        EXPECT_THAT(told, testing::HasSubstr(file + " is complete up to here"));
        EXPECT_TRUE(becomes_true([&] { return session.update(), session.recording().file.empty(); }));
        EXPECT_TRUE(session.take_notices().empty());  // told once
    }
    const io::ResultFile result = io::read_result(file);
    const std::size_t rows = result.values[0].size();
    EXPECT_GT(rows, 5u);
    EXPECT_LE(rows * result.values.size() * sizeof(double), 50'000u);
    for (std::size_t i = 1; i < rows; ++i) ASSERT_NEAR(result.values[0][i] - result.values[0][i - 1], 0.01, 1e-9);
    std::filesystem::remove_all(folder);
}

TEST(Sessions, FailToStartWithUnreadableCar) {
    EXPECT_THROW(Session(test_catalog(), {"wreck", "flat"}, scratch_folder()), io::Error);
}

}  // namespace
}  // namespace hamilcar::live
