// What controllers are shown, when, and what becomes of what they command, by a kind that a user adds: it writes down all that it
// sees, and a vehicle file names it like any other.
#include "hamilcar/control/control_system.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "hamilcar/base/units.hpp"
#include "io/files.hpp"
#include "support/allocation_guard.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;

constexpr const char* car_file = "vehicles/bmw_e90_330i.toml";

// One decision as it was written down.
struct Seen {
    double time, interval, steering_wheel, brake, throttle, gear, roll_rate, yaw_rate, forward, upward,
        control_pressure, wheel_speed, brake_pressure, rotor_speed, inlet, threshold;
};
constexpr std::size_t seen_size = sizeof(Seen) / sizeof(double), most_seen = 60;

// In its memory: how often it decided, then what it saw. It opens the outlet of the first wheel more than there is, and closes the
// inlet a little further each time.
class Recorder final : public Controller {
public:
    explicit Recorder(double threshold) : threshold_(threshold) {}
    std::size_t memory_size() const override { return 1 + most_seen * seen_size; }
    void decide(const Measured& m, std::span<double> memory, const Commands& commands) const override {
        const BrakeValves valves = commands.valves(0);
        const Seen seen{m.time,
                        m.interval,
                        m.steering_wheel,
                        m.brake,
                        m.throttle,
                        m.gear,
                        m.angular_rate[0],
                        m.angular_rate[2],
                        m.acceleration[0],
                        m.acceleration[2],
                        m.control_pressure,
                        m.wheel_speed[0],
                        m.brake_pressure[1],
                        m.rotor_speed.empty() ? -1 : m.rotor_speed[0],
                        valves.inlet,
                        threshold_};
        const auto count = static_cast<std::size_t>(memory[0]);
        if (count < most_seen) std::memcpy(&memory[1 + count * seen_size], &seen, sizeof seen);
        memory[0] += 1;
        valves.outlet = 7;
        valves.inlet -= 0.125;
    }
    double activity(std::span<const double> memory) const override { return memory[0] > 0 ? 0.25 : 0; }

private:
    double threshold_;
};

ControllerKind recorder(std::string_view keyword) {
    return {.keyword = keyword,
            .meaning = "writes down what it sees",
            .keys = {{"threshold_deg_per_s", "that it remembers", 90, 0, 1000}},
            .lacks =
                [](const VehicleDescription& car) {
                    return std::string(car.brakes.modulated ? "" : "valves at the wheels");
                },
            .make = [](const ControllerSettings& settings, const ControlledCar&) -> std::unique_ptr<const Controller> {
                return std::make_unique<Recorder>(settings["threshold_deg_per_s"]);
            }};
}

// Kinds of one class, once in a program.
void add_recorders() {
    static const bool added = [] {
        for (const char* keyword : {"recorder", "second_recorder", "third_recorder"}) {
            add_controller_kind(recorder(keyword));
        }
        return true;
    }();
    EXPECT_TRUE(added);
}

// The shipped car with those controllers instead of its own, and further text.
std::string car_with(const std::string& text) {
    std::string file = io::read_file(test::source_path(car_file));
    const std::size_t first = file.find("[[controller]]"), end = file.find("# ----", first);
    file.erase(first, end - first);
    return file + text;
}
VehicleDescription read(const std::string& text) {
    add_recorders();
    const io::TemporaryFolder folder;
    return io::read_vehicle(folder.write("car.toml", car_with(text)));
}

ScenarioDescription scenario() {
    ScenarioDescription s = test::scenario(1, 20);
    s.brake = test::table({0.02, 0.1}, {0, 0.3});
    s.steering_input = SteeringInput::steering_wheel;
    s.steering = test::table({0, 0.1}, {0, 0.7});
    s.gear = {{0}, {3}, Interpolation::steps};
    s.throttle = test::table({0, 0.1}, {0.2, 0.1});
    return s;
}

std::vector<Seen> written(const Simulation& run, std::size_t controller = 0) {
    constexpr std::size_t each = 2 + most_seen * seen_size;  // whether it is off, and its own
    const std::size_t behind = run.control()->controller_count() - controller,
                      first = run.control_memory().size() - behind * each + 1;
    std::vector<Seen> out(std::min(static_cast<std::size_t>(run.control_memory()[first]), most_seen));
    std::memcpy(out.data(), &run.control_memory()[first + 1], out.size() * sizeof(Seen));
    return out;
}

// Advances, and keeps a sample of the beginning of each step.
struct Truth {
    double wheel_speed, yaw_rate, roll_rate, pressure, control_pressure, rotor_speed, steering_wheel, brake, throttle;
};
std::vector<Truth> driven(Simulation& run, int steps) {
    std::vector<Truth> out;
    for (int i = 0; i < steps; ++i) {
        const Sample s = run.sample();
        const BrakeSystem<double>& brakes = s.model.vehicle.brakes;
        const double* values = s.state.values.data();
        const Column column(run.vehicle().steering);
        out.push_back({.wheel_speed = s.momenta.suspensions[0].wheels[0].spin,
                       .yaw_rate = s.velocity.chassis[5],
                       .roll_rate = s.velocity.chassis[3],
                       .pressure = brakes.pressure(1, values),
                       .control_pressure = brakes.control(0, values),
                       .rotor_speed = s.momenta.powertrain.units[0].spin,
                       .steering_wheel = column.angle(s.input.rack.displacement),
                       .brake = s.input.brake,
                       .throttle = s.input.throttle});
        EXPECT_FALSE(run.advance());
    }
    return out;
}

constexpr double tiny =
    1e-12;  // the compiled program's bits and the plain one's differ by no more where a sum is regrouped

TEST(UsersController, IsNamedByAFileAndSeesTheCarOneStepLate) {
    Simulation run(read("\n[[controller]]\nkind = \"recorder\"\nrate_hz = 250\nthreshold_deg_per_s = 45\n"),
                   scenario());
    const std::vector<Truth> truth = driven(run, 200);
    const std::vector<Seen> seen = written(run);
    ASSERT_EQ(seen.size(), 50u) << "every 4 ms";
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const std::size_t now = 4 * i;
        const Truth &late = truth[now == 0 ? 0 : now - 1], &at_once = truth[now];
        EXPECT_DOUBLE_EQ(seen[i].time, 4e-3 * static_cast<double>(i));
        EXPECT_DOUBLE_EQ(seen[i].interval, 4e-3);
        EXPECT_NEAR(seen[i].wheel_speed, late.wheel_speed, tiny * 100);
        EXPECT_NEAR(seen[i].yaw_rate, late.yaw_rate, tiny);
        EXPECT_NEAR(seen[i].roll_rate, late.roll_rate, tiny);
        EXPECT_NEAR(seen[i].rotor_speed, late.rotor_speed, tiny * 1000);
        EXPECT_EQ(seen[i].brake_pressure, late.pressure);
        EXPECT_EQ(seen[i].control_pressure, late.control_pressure);
        EXPECT_NEAR(seen[i].steering_wheel, at_once.steering_wheel, tiny) << "of the pedals and the wheel it knows";
        EXPECT_EQ(seen[i].brake, at_once.brake);
        EXPECT_EQ(seen[i].throttle, at_once.throttle);
        EXPECT_EQ(seen[i].gear, 3);
        EXPECT_DOUBLE_EQ(seen[i].threshold, 45 * units::degree);
    }
    EXPECT_GT(seen.back().yaw_rate, 0.1);
    EXPECT_GT(seen.back().control_pressure, 1e6);
    EXPECT_GT(seen.back().brake_pressure, 1e6);
    EXPECT_NEAR(seen.front().upward, 9.81, 0.3);
    EXPECT_LT(seen.back().forward, -1) << "it brakes";
}

TEST(UsersController, SeesWhatSensorsShow) {
    Simulation run(read("\n[[controller]]\nkind = \"recorder\"\nrate_hz = 1000\n"
                        "[sensors.wheel_speed]\nrate_hz = 250\ndelay_s = 0.008\n"
                        "[sensors.pressure]\ndelay_s = 0.005\nresolution_bar = 0.5\n"
                        "[sensors.steering_wheel]\nrate_hz = 100\n"
                        "[sensors.acceleration]\nresolution_m_per_s2 = 4\n"),
                   scenario());
    const std::vector<Truth> truth = driven(run, 60);
    const std::vector<Seen> seen = written(run);
    ASSERT_EQ(seen.size(), 60u);
    const auto measured_at = [&](long step) { return truth[static_cast<std::size_t>(std::max(step - 1, 0L))]; };
    for (long step = 0; step < 60; ++step) {
        const Seen& at = seen[static_cast<std::size_t>(step)];
        EXPECT_NEAR(at.wheel_speed, measured_at(step / 4 * 4 - 8).wheel_speed, tiny * 100) << step;
        const double late = measured_at(step - 5).pressure, grain = 0.5e5;
        EXPECT_NEAR(at.brake_pressure, late, 0.5 * grain + 1) << step;
        EXPECT_NEAR(std::remainder(at.brake_pressure, grain), 0, 1) << step;
        EXPECT_NEAR(at.steering_wheel, truth[static_cast<std::size_t>(step / 10 * 10)].steering_wheel, tiny) << step;
        EXPECT_NEAR(at.rotor_speed, measured_at(step / 4 * 4 - 8).rotor_speed, tiny * 1000) << step;
        EXPECT_EQ(at.upward, 8) << "gravity in fours";
        EXPECT_NEAR(at.yaw_rate, measured_at(step).yaw_rate, tiny) << "this one has no sensor of its own";
    }
}

TEST(UsersController, CommandsWithinLimitsAndHolds) {
    Simulation run(read("\n[[controller]]\nkind = \"recorder\"\nrate_hz = 100\n"), scenario());
    const CommandLayout& layout = run.control()->layout();
    const auto command = [&](const char* name) {
        const int place = layout.find(name);
        return place < 0 ? -1 : run.schedule().commands()[static_cast<std::size_t>(place)];
    };
    EXPECT_EQ(command("front_left.brake.inlet"), 1) << "at rest before the first decision";
    EXPECT_EQ(command("front_left.brake.outlet"), 0);
    EXPECT_EQ(command("engine.max_throttle"), 1);
    for (int step = 0; step < 100; ++step) {
        ASSERT_FALSE(run.advance());
        EXPECT_EQ(command("front_left.brake.outlet"), 1) << "7 is more than open";
        EXPECT_EQ(command("front_left.brake.inlet"), std::max(1 - 0.125 * (1 + step / 10), 0.0)) << step;
        EXPECT_EQ(command("front_right.brake.inlet"), 1) << "nothing is wanted of it";
    }
}

TEST(UsersController, DecidesInTheOrderOfTheFile) {
    Simulation run(read("\n[[controller]]\nkind = \"second_recorder\"\nrate_hz = 100\n"
                        "[[controller]]\nkind = \"recorder\"\nrate_hz = 50\n"),
                   scenario());
    driven(run, 41);
    const std::vector<Seen> first = written(run, 0), second = written(run, 1);
    ASSERT_EQ(first.size(), 5u);
    ASSERT_EQ(second.size(), 3u);
    EXPECT_EQ(first[0].inlet, 1);
    EXPECT_EQ(second[0].inlet, 0.875) << "it sees what the one before it wants";
    EXPECT_EQ(first[1].inlet, 0.75);
    EXPECT_EQ(second[1].inlet, 0.75 - 2 * 0.125);
}

TEST(UsersController, IsSwitchedOffAndOnWhileTheCarRuns) {
    Simulation run(read("\n[[controller]]\nkind = \"recorder\"\nrate_hz = 100\n"), scenario());
    const ControlSystem& control = *run.control();
    driven(run, 50);
    EXPECT_EQ(control.activity(0, run.control_memory()), 0.25);
    run.switch_controller(0, false);
    EXPECT_FALSE(control.is_on(0, run.control_memory()));
    EXPECT_TRUE(std::ranges::equal(run.schedule().commands(), control.layout().rest()));
    driven(run, 50);
    EXPECT_TRUE(std::ranges::equal(run.schedule().commands(), control.layout().rest())) << "it is not asked";
    EXPECT_EQ(control.activity(0, run.control_memory()), 0);
    run.switch_controller(0, true);
    driven(run, 20);
    EXPECT_EQ(written(run).size(), 2u) << "as at the start";
}

TEST(UsersController, IsAddedOnceAndFoundByItsKeyword) {
    add_recorders();
    EXPECT_THROW(add_controller_kind(recorder("recorder")), std::invalid_argument);
    EXPECT_THROW(add_controller_kind(recorder("abs")), std::invalid_argument);
    ASSERT_NE(find_controller_kind("recorder"), nullptr);
    EXPECT_EQ(find_controller_kind("recorder")->meaning, "writes down what it sees");
    EXPECT_EQ(find_controller_kind("no such kind"), nullptr);
    const ControllerSettings settings(*find_controller_kind("recorder"), {.kind = "recorder", .settings = {}});
    EXPECT_DOUBLE_EQ(settings["threshold_deg_per_s"], M_PI / 2) << "a key's fallback is in the key's unit";
}

TEST(ControlSystem, DecidesWithoutAllocation) {
    const Simulation run(read("\n[[controller]]\nkind = \"recorder\"\nrate_hz = 1000\n[[controller]]\nkind = \"abs\"\n"
                              "[[controller]]\nkind = \"traction_control\"\n[[controller]]\nkind = \"esc\"\n"
                              "[sensors.wheel_speed]\ndelay_s = 0.01\nnoise_rpm = 1\n"),
                         scenario());
    std::vector<double> memory = run.control_memory(), commands = run.control()->layout().rest();
    const test::AllocationGuard guard;
    for (long step = 0; step < 100; ++step) run.control()->act(step, {.brake = 1}, memory, commands);
    EXPECT_EQ(guard.allocations(), 0);
}

TEST(ControlSystem, SaysWhenTheNextDecisionIs) {
    const Simulation run(read("\n[[controller]]\nkind = \"recorder\"\nrate_hz = 125\n[[controller]]\nkind = \"abs\"\n"
                              "rate_hz = 100\n"),
                         scenario());
    EXPECT_TRUE(run.control()->is_due(0));
    EXPECT_FALSE(run.control()->is_due(1)) << "8 and 10 ms: every second step";
    EXPECT_EQ(run.control()->steps_to_next(0), 2);
    EXPECT_EQ(run.control()->steps_to_next(3), 1);
}

void expect_refused(const std::string& text, const std::string& at, const std::vector<std::string>& pieces) {
    add_recorders();
    const io::TemporaryFolder folder;
    const std::string file = car_with(text), path = folder.write("car.toml", file);
    std::vector<std::string> all = pieces;
    all.push_back(at.empty() ? path : path + ":" + io::position_in(file, at) + ": ");
    const VehicleDescription car = io::read_vehicle(path);
    io::expect_error([&] { Simulation(car, scenario()); }, io::ExitCode::bad_file, all);
}

TEST(ControlSystem, RefusesARateThatDoesNotGoWithTheStep) {
    expect_refused("\n[[controller]]\nkind = \"recorder\"\nrate_hz = 300 # three\n", "300 # three",
                   {"key 'controller[0].rate_hz' = 300: expected a rate whose period is a multiple of the step "
                    "of 0.001 s, as 250 or 333.333 [Hz]"});
    expect_refused("\n[[controller]]\nkind = \"abs\"\n[[controller]]\nkind = \"recorder\"\nrate_hz = 4000 # four\n",
                   "4000 # four", {"key 'controller[1].rate_hz' = 4000: expected a rate whose period is a multiple"});
    expect_refused("\n[[controller]]\nkind = \"recorder\"\n[sensors.pressure]\nrate_hz = 700 # seven\n", "700 # seven",
                   {"key 'sensors.pressure.rate_hz' = 700: expected a rate whose period is a multiple of the step of "
                    "0.001 s, as 500 or 1000 [Hz]"});
    ScenarioDescription finer = scenario();
    finer.solver.step = 1e-3 / 3;
    EXPECT_NO_THROW(Simulation(read("\n[[controller]]\nkind = \"recorder\"\nrate_hz = 300\n"), finer));
}

TEST(ControlSystem, RefusesMoreThanCanBeRemembered) {
    expect_refused(
        "\n[[controller]]\nkind = \"recorder\"\n[[controller]]\nkind = \"second_recorder\"\n"
        "[[controller]]\nkind = \"third_recorder\"\n",
        "", {"controllers remember ", "numbers: expected 2048 at most"});
}

TEST(ControlSystem, DoesWithoutTheControllersThatAScenarioSwitchesOff) {
    const VehicleDescription car = read("\n[[controller]]\nkind = \"recorder\"\n[[controller]]\nkind = \"abs\"\n");
    const auto left = [&](const std::vector<std::string>& off) {
        ScenarioDescription s = scenario();
        s.controllers_off = off;
        const Simulation run(car, s);
        std::vector<std::string> out;
        for (std::size_t i = 0; run.control() && i < run.control()->controller_count(); ++i) {
            out.push_back(run.control()->keyword(i));
        }
        return out;
    };
    EXPECT_THAT(left({}), testing::ElementsAre("recorder", "abs"));
    EXPECT_THAT(left({"recorder"}), testing::ElementsAre("abs"));
    EXPECT_THAT(left({"abs", "esc"}), testing::ElementsAre("recorder")) << "it has no esc";
    EXPECT_THAT(left({"all"}), testing::IsEmpty());
    EXPECT_THAT(left({"recorder", "abs"}), testing::IsEmpty());
}

}  // namespace
}  // namespace hamilcar
