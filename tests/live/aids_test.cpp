// Aids of a live car: they intervene unless they are switched off, and what is switched stays so at the start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "live/test_catalog.hpp"
#include "support/allocation_guard.hpp"

namespace hamilcar::live {
namespace {

using testing::ElementsAre;

std::size_t channel_of(const LiveSimulation& simulation, const std::string& name) {
    const auto& list = simulation.channels();
    const auto found = std::ranges::find_if(list, [&](const Channel& one) { return one.column.name == name; });
    EXPECT_NE(found, list.end()) << name;
    return static_cast<std::size_t>(found - list.begin());
}

LiveSimulation aided_simulation(const std::vector<std::string>& controllers_off = {}) {
    const LoadRequest request{"aided", "flat", 0.3};
    ScenarioDescription scenario = test::scenario(1, 15);
    scenario.controllers_off = controllers_off;
    return LiveSimulation(1, request, test_catalog().open(request).first, scenario);
}

AidSet all_of(const LiveSimulation& simulation) {
    AidSet set;
    for (const Aid& aid : simulation.aids()) set.set(aid.controller);
    return set;
}

struct Stop {
    double activity = 0;    // largest of the anti-lock system
    double slowest = 1e9;   // of the left front wheel while the car still moves [rpm]
    State<double> state{};  // at the end
};

// With the pedal all the way down, on snow.
Stop brake_hard(LiveSimulation& simulation) {
    const std::size_t activity = channel_of(simulation, "abs.activity");
    const std::size_t spin = channel_of(simulation, "front_left.wheel.spin");
    Stop stop;
    for (int i = 0; i < 1500; ++i) {
        const auto end = simulation.advance({.controls = {.brake = 1}});
        EXPECT_FALSE(end) << end->message;
        const std::span<const double> values = simulation.channel_values();
        stop.activity = std::max(stop.activity, values[activity]);
        stop.slowest = std::min(stop.slowest, values[spin]);
    }
    stop.state = simulation.state();
    return stop;
}

TEST(Aids, InterveneUnlessTheyAreSwitchedOff) {
    LiveSimulation simulation = aided_simulation();
    const Stop controlled = brake_hard(simulation);
    EXPECT_GT(controlled.activity, 0);
    simulation.reset();
    simulation.switch_off(all_of(simulation));
    const Stop locked = brake_hard(simulation);
    EXPECT_EQ(locked.activity, 0);
    EXPECT_LT(locked.slowest, 0.1 * controlled.slowest);
}

TEST(Aids, StayOffAtTheStartAndComeBackBitForBit) {
    LiveSimulation simulation = aided_simulation();
    const Stop first = brake_hard(simulation);
    simulation.switch_off(all_of(simulation));
    simulation.reset();
    const Stop without = brake_hard(simulation);
    simulation.reset();
    EXPECT_EQ(brake_hard(simulation).state.values, without.state.values);
    EXPECT_NE(without.state.values, first.state.values);
    simulation.switch_off({});
    simulation.reset();
    EXPECT_EQ(brake_hard(simulation).state.values, first.state.values);
}

TEST(Aids, AreAllThereWhateverTheScenarioLeavesOut) {
    LiveSimulation simulation = aided_simulation({"abs", "esc"});
    EXPECT_EQ(simulation.aids().size(), 3u);
    EXPECT_GT(brake_hard(simulation).activity, 0);
}

TEST(Aids, DecideWithoutAllocation) {
    LiveSimulation simulation = aided_simulation();
    brake_hard(simulation);
    simulation.reset();
    const test::AllocationGuard guard;
    for (int i = 0; i < 500; ++i) simulation.advance({.controls = {.brake = 1}});
    EXPECT_EQ(guard.allocations(), 0);
}

class AidsOfASession : public testing::Test {
protected:
    // Whether traction control intervenes within two seconds of simulated time.
    bool intervenes() {
        LiveSimulation& simulation = session.simulation();
        const std::size_t activity = channel_of(simulation, "traction_control.activity");
        session.reset();
        EXPECT_TRUE(becomes_true([&] { return session.update(), session.progress().time == 0; }));
        session.set_driven(true);
        bool seen = false;
        EXPECT_TRUE(becomes_true([&] {
            session.update();
            simulation.frames().fetch();
            const Frame& frame = simulation.frames().value();
            seen = seen || (frame.time > 0 && frame.time < 3 && frame.values[activity] > 0);
            return seen || frame.time > 2;
        }));
        session.set_driven(false);
        EXPECT_TRUE(becomes_true([&] { return session.update(), session.progress().paused == Pause::no_driver; }));
        return seen;
    }

    std::string folder = scratch_folder();
    Session session{test_catalog(), {"aided", "flat", 0.15}, folder};
    void TearDown() override { std::filesystem::remove_all(folder); }
};

TEST_F(AidsOfASession, AreSwitchedByTheirKeywords) {
    EXPECT_THAT(session.switched_off(), ElementsAre());
    EXPECT_FALSE(session.switch_aid("horn", false));
    EXPECT_TRUE(session.switch_aid("esc", false));
    EXPECT_TRUE(session.switch_aid("abs", false));
    EXPECT_THAT(session.switched_off(), ElementsAre("abs", "esc"));
    EXPECT_TRUE(session.switch_aid("abs", true));
    session.reset();
    EXPECT_THAT(session.switched_off(), ElementsAre("esc"));
    session.load({"aided", "waves"}, 1);
    ASSERT_TRUE(becomes_true([&] { return session.update(); }));
    EXPECT_THAT(session.switched_off(), ElementsAre());
}

TEST_F(AidsOfASession, AreOffForTheThreadThatSteps) {
    session.set_controls({.page = 1, .controls = {.throttle = 1}});
    EXPECT_TRUE(intervenes());
    session.switch_aid("traction_control", false);
    session.switch_aid("esc", false);
    EXPECT_FALSE(intervenes());
    session.switch_aid("traction_control", true);
    EXPECT_TRUE(intervenes());
}

}  // namespace
}  // namespace hamilcar::live
