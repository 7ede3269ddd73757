// A scenario with a free steering: what it refuses, what it leaves as it was, and going back to a place in its run, with hands that let go,
// an assist at work and wound-up friction, to the same bits.
#include <gmock/gmock.h>

#include "hamilcar/batch/batch.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/run/channels.hpp"
#include "io/files.hpp"
#include "run/checkpoint_folder.hpp"
#include "support/allocation_guard.hpp"
#include "support/free_steering.hpp"

namespace hamilcar {
namespace {

using testing::EndsWith;
using testing::StartsWith;

VehicleDescription sedan() {
    return test::with_mechanics(test::shipped("bmw_323i"), test::full_mechanics());
}

// What a run of that scenario, read from a file, is refused with; the file's own name left out.
std::string refusal(const VehicleDescription& vehicle, const std::string& text) {
    const io::TemporaryFolder folder;
    const std::string name = folder.write("scenario.toml", "name = 'x'\nvehicle = 'v.toml'\nduration_s = 1\n" + text);
    try {
        const Simulation simulation(vehicle, io::read_scenario(name));
    } catch (const io::Error& error) {
        EXPECT_EQ(error.code(), io::ExitCode::bad_file);
        const std::string message = error.what();
        EXPECT_THAT(message, StartsWith(name));
        return message.substr(name.size());
    }
    return "";
}

TEST(SteeringScenario, IsRefusedForACarWithoutMechanics) {
    VehicleDescription car = sedan();
    car.steering.mechanics.reset();
    const std::string rest =
        ": " + car.name + " has no mechanics of its steering; expected [steering.rack] and [steering.column] there";
    const auto expect = [&](const std::string& text, const std::string& place_and_key) {
        EXPECT_EQ(refusal(car, text), place_and_key + rest);
    };
    expect("steering_mechanics = true\n", ":4:22: key 'steering_mechanics'");
    expect("[inputs.hands]\nhold = [1, 0]\ntime_s = [0, 1]\n", ":4:1: key 'inputs.hands'");
    expect("[inputs.steering_torque]\ntorque_N_m = 2\n", ":4:1: key 'inputs.steering_torque'");
    expect("steering_mechanics = true\n[inputs.hands]\nhold = 0\n", ":4:22: key 'steering_mechanics'");
    EXPECT_EQ(refusal(car, "steering_mechanics = false\n"), "");
}

TEST(SteeringScenario, IsRefusedWithWhatItCannotGoWith) {
    EXPECT_EQ(refusal(sedan(), "steering_mechanics = true\n[inputs.rack]\ndisplacement_m = 0.01\n"),
              ":4:22: key 'steering_mechanics': expected inputs.steering_wheel in the place of inputs.rack");
    EXPECT_EQ(refusal(sedan(), "[solver]\nconstraints = 'stabilized'\n[inputs.hands]\nhold = 1\n"),
              ":6:1: key 'inputs.hands': expected solver.constraints = \"exact\" beside it");
    EXPECT_THAT(refusal(sedan(), "steering_mechanics = true\n[inputs.steering_wheel]\nangle_deg = 800\n"),
                StartsWith(":5:1: key 'inputs.steering_wheel' at t = 0 s: the rack would stand at 0.08"));
    EXPECT_THAT(refusal(sedan(), "[inputs.hands]\nhold = 1.5\n"), StartsWith(":5:8: "));
    EXPECT_EQ(refusal(sedan(), "[inputs.hands]\nhold = 0.5\n[inputs.steering_wheel]\nangle_deg = 20\n"), "");
}

TEST(SteeringScenario, ReadsHandsAndTheirTorque) {
    const io::TemporaryFolder folder;
    const ScenarioDescription s = io::read_scenario(folder.write("scenario.toml", R"(
name = 'x'
vehicle = 'v.toml'
duration_s = 1
[inputs.hands]
time_s = [0, 0.5]
hold = [1, 0.25]
[inputs.steering_torque]
time_s = [0, 1]
torque_N_m = [-2, 3]
)"));
    EXPECT_FALSE(s.steering_mechanics);
    const Simulation run(sedan(), s);
    EXPECT_TRUE(run.vehicle().steering.moves_on_its_own());
    EXPECT_EQ(run.schedule()(0).hands_hold, 1);
    EXPECT_EQ(run.schedule()(0.7).hands_hold, 0.25);
    EXPECT_EQ(run.schedule()(0).hands_torque, -2);
    EXPECT_EQ(run.schedule()(1).hands_torque, 3);
}

// Who does not ask for the mechanics has the run that there was without them.
TEST(SteeringScenario, LeavesOtherRunsAsTheyWere) {
    VehicleDescription without = sedan();
    without.steering.mechanics.reset();
    Simulation one(sedan(), test::everything_moves(sedan(), 1)), other(without, test::everything_moves(without, 1));
    ASSERT_EQ(one.model().vehicle.state_size, other.model().vehicle.state_size);
    EXPECT_FALSE(one.schedule().has_free_rack());
    test::run_to_end(one), test::run_to_end(other);
    expect_same(one, other);
    EXPECT_EQ(all_channels(one.vehicle()).size(), all_channels(other.vehicle()).size());
}

ScenarioDescription let_go(double speed) {
    ScenarioDescription s = test::set_free(test::everything_moves(sedan()));
    s.initial.velocity[0] = speed;
    for (double& angle : s.steering.value) angle *= 3;
    s.hands = test::table({0.8, 1.1}, {1, 0.1});
    s.steering_torque = test::table({0.5, 1.5}, {0, 2});
    return s;
}

void advance(Simulation& car, int steps) {
    for (int i = 0; i < steps; ++i) ASSERT_FALSE(car.advance());
}

Simulation advanced(Simulation car, int steps) {
    advance(car, steps);
    return car;
}

class SteeringSnapshot : public Checkpoint {
protected:
    SteeringSnapshot() : start_(sedan(), let_go(15)), car_(advanced(start_, 903)), later_(advanced(car_, 400)) {
        const auto at = test::steering_state(car_.model(), car_.state());
        EXPECT_GT(std::abs(at.rack), 1e-4);
        EXPECT_GT(std::abs(at.rack_windup), 1e-6);
        EXPECT_GT(std::abs(at.wheel_windup), 1e-4);
        EXPECT_GT(std::abs(at.assist), 1) << "everything has something to keep";
    }
    Simulation start_, car_, later_;  // at its start, in the middle, and 400 steps later
};

TEST_F(SteeringSnapshot, GoesBackToTheSameBits) {
    const auto snapshot = std::make_unique<Snapshot>();
    car_.save(*snapshot);
    for (const Simulation& from : {car_, later_, start_}) {
        Simulation back(from);
        back.restore(*snapshot);
        advance(back, 400);
        expect_same(back, later_);
    }
}

TEST_F(SteeringSnapshot, GoesOnFromAFileToTheSameBits) {
    write_checkpoint(path(), car_, {});
    Simulation other = start_;
    read_checkpoint(path(), other);
    expect_same(other, car_);
    advance(other, 400);
    expect_same(other, later_);
}

TEST_F(SteeringSnapshot, OfAFreeSteeringIsNoneOfAPrescribedOne) {
    write_checkpoint(path(), car_, {});
    Simulation prescribed(sedan(), test::everything_moves(sedan()));
    EXPECT_NE(message_of(path(), prescribed), "");
    EXPECT_EQ(prescribed.steps_taken(), 0);
}

// A torque that a simulator's driver applies goes with the snapshot.
TEST_F(SteeringSnapshot, RemembersATorqueThatWasTold) {
    const auto snapshot = std::make_unique<Snapshot>();
    car_.follow(Control::hands_torque, {-4, 0, 0});
    car_.follow(Control::hands_hold, {0, 0, 0});
    car_.save(*snapshot);
    advance(car_, 200);
    Simulation other = start_;
    other.restore(*snapshot);
    EXPECT_EQ(other.schedule()(other.time()).hands_torque, -4);
    advance(other, 200);
    expect_same(other, car_);
    EXPECT_LT(test::steering_state(car_.model(), car_.state()).wheel,
              test::steering_state(later_.model(), later_.state()).wheel);
}

TEST_F(SteeringSnapshot, HasTheSameBitsInABatchThatGoesBackAndBegins) {
    std::vector<Simulation> cars;
    for (int i = 0; i < 4; ++i) cars.emplace_back(sedan(), let_go(13.0 + i));
    Batch batch(cars, {});
    const auto expect = [&](std::size_t car, const Simulation& alone) {
        const State<double> there = batch.state(car);
        for (std::size_t k = 0; k < there.values.size(); ++k) {
            ASSERT_EQ(there.values[k], alone.state().values[k]) << "car " << car << ", number " << k;
        }
    };
    batch.advance(903);
    const auto snapshot = std::make_unique<Snapshot>();
    batch.save(2, *snapshot);
    expect(2, car_);
    batch.restart(0), batch.replace(1, cars[3]);
    batch.advance(400);
    expect(0, advanced(cars[0], 400));
    expect(1, advanced(cars[3], 400));
    expect(2, later_);
    batch.restore(2, *snapshot);
    batch.advance(400);
    expect(2, later_);
    Simulation back = start_;
    back.restore(*snapshot);
    advance(back, 400);
    expect_same(back, later_);
}

TEST_F(SteeringSnapshot, AllocatesNothingInAStep) {
    const test::AllocationGuard guard;
    for (int i = 0; i < 50; ++i) EXPECT_FALSE(car_.advance());
    EXPECT_EQ(guard.allocations(), 0);
}

// Channels as a batch has them compiled, and what they say of the state.
TEST_F(SteeringSnapshot, HasItsChannelsCompiledToTheSameBits) {
    TracedReaders readers;
    std::vector<Channel> channels;
    for (Channel& channel : all_channels(car_.vehicle())) {
        if (!channel.column.name.starts_with("steering.")) continue;
        ASSERT_TRUE(channel.trace) << channel.column.name;
        readers.push_back(channel.trace), channels.push_back(std::move(channel));
    }
    ASSERT_EQ(channels.size(), 9u);
    std::vector<Simulation> cars;
    for (int i = 0; i < 3; ++i) cars.emplace_back(sedan(), let_go(14.0 + i));
    Batch batch(cars, {});
    batch.advance(903);
    const Batch::Sampler sampler = batch.sampler(readers);
    std::vector<double> values(cars.size() * sampler.count);
    batch.sample(sampler, values.data());
    const Sample plain = car_.sample();
    for (std::size_t k = 0; k < channels.size(); ++k) {
        EXPECT_EQ(values[sampler.count + k], channels[k].read(plain)) << channels[k].column.name;
    }
    const auto value = [&](const std::string& name) {
        const auto same = [&](const Channel& channel) { return channel.column.name == name; };
        return std::ranges::find_if(channels, same)->read(plain);
    };
    const auto at = test::steering_state(car_.model(), car_.state());
    EXPECT_EQ(value("steering.rack"), at.rack);
    EXPECT_NEAR(value("steering.wheel"), at.wheel * 180 / std::numbers::pi, 1e-12);
    EXPECT_NEAR(value("steering.wheel_speed"), at.wheel_momentum / 0.04 * 180 / std::numbers::pi, 1e-9);
    EXPECT_EQ(value("steering.assist_force"), at.assist);
}

}  // namespace
}  // namespace hamilcar
