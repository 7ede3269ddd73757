// Active anti-roll bars and semi-active dampers do what they are for, on whole cars, and without them it is not so: roll and balance in
// turns, bumps on one side, comfort on a rough road and over a hump.
#include <gtest/gtest.h>

#include "hamilcar/base/units.hpp"
#include "hamilcar/maneuver/scenarios.hpp"
#include "support/active_chassis.hpp"

namespace hamilcar::test {
namespace {

using Keys = std::vector<std::pair<std::string, double>>;
constexpr double g = 9.81;  // [m/s^2]

VehicleDescription with_bars(const std::string& name, const Keys& keys = {}) {
    return controlled_by(with_active_bars(shipped(name)), {controller("active_anti_roll", 200, keys)});
}

double roll_of(const Sample& at) {
    return std::atan2(at.velocity.R_GC(2, 1), at.velocity.R_GC(2, 2));
}

struct Turn {
    double roll = 0, lateral = 0;  // [rad], [m/s^2]
    double spread = 0;             // of the roll in the last second [rad]
    double understeer = 0;         // turn of the steered wheels beyond that of the circle [rad]
};

// At 20 m/s the steering wheel is turned to where linear theory of the car without controllers has 0.6 g, and held.
Turn held_turn(const VehicleDescription& car, const std::vector<std::string>& off = {}) {
    constexpr double speed = 20;
    const double angle = angle_for(controlled_by(car, {}), speed, 0.6 * g);
    ManeuverOptions options;
    options.controllers_off = off;
    ScenarioDescription s = driving_at(car, options, speed, 6);
    s.steering_input = SteeringInput::steering_wheel, s.steering = turned({{0.5, 0}, {1.5, angle}});
    s.duration = 6, s.controllers_off = off, s.solver.energy_balance = false;
    Simulation run(car, s);
    Turn out;
    double count = 0, least = everywhere, most = -everywhere;
    while (!run.finished()) {
        const auto end = run.advance();
        if (end) ADD_FAILURE() << end->message;
        if (end) break;
        if (run.time() < 5 || run.steps_taken() % 10 != 0) continue;
        const Sample at = run.sample();
        const double yaw_rate = at.velocity.chassis[5], forward = at.velocity.chassis[0], roll = roll_of(at);
        const DrivenCar& driven = run.driven_car();
        out.roll += roll, out.lateral += yaw_rate * forward;
        out.understeer += driven.wheels_per_angle * angle - driven.wheelbase * yaw_rate / forward;
        least = std::min(least, roll), most = std::max(most, roll), ++count;
    }
    return {out.roll / count, out.lateral / count, most - least, out.understeer / count};
}

class ActiveAntiRollCar : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Shipped, ActiveAntiRollCar,
                         testing::Values("bmw_323i", "bmw_e90_330i", "hatchback", "offroader", "pickup"),
                         [](const auto& test) { return test.param; });

// The shares of roll that stay were found to be 0.30 (offroader) to 0.60 (pickup, whose bar is in front alone).
TEST_P(ActiveAntiRollCar, RollsLessInATurn) {
    const VehicleDescription car = with_bars(GetParam());
    const Turn active = held_turn(car), soft = held_turn(car, {"active_anti_roll"});
    const double share = active.roll / active.lateral / (soft.roll / soft.lateral);
    std::printf("%s: %.2f deg at %.2f m/s^2, without %.2f deg at %.2f m/s^2; share %.2f\n", GetParam(),
                active.roll / units::degree, active.lateral, soft.roll / units::degree, soft.lateral, share);
    EXPECT_GT(soft.roll, 0) << "to the outside of a left turn";
    EXPECT_GT(active.lateral, 0.45 * g);
    EXPECT_LT(share, 0.65);
    EXPECT_GT(share, 0.1) << "it needs some roll to act";
    EXPECT_LT(active.roll, 0.65 * soft.roll);
    EXPECT_LT(active.spread, 0.05 * units::degree) << "it stands still";
}

TEST(ActiveAntiRoll, MoreInFrontIsMoreUndersteer) {
    for (const char* name : {"bmw_323i", "bmw_e90_330i", "offroader"}) {
        double before = -everywhere;
        for (const double share : {0.4, 0.6, 0.9}) {
            const Turn turn = held_turn(with_bars(name, {{"front_share", share}}));
            const double gradient = turn.understeer / units::degree / turn.lateral;
            std::printf("%s, front_share %.1f: understeer %.4f deg/(m/s^2) at %.2f m/s^2\n", name, share, gradient,
                        turn.lateral);
            EXPECT_GT(gradient, before + 1e-3) << name << ", " << share;
            before = gradient;
        }
    }
}

struct Bump {
    double roll = 0;             // largest [rad]
    double other_travel = 0;     // largest departure of wheels of the other side [m]
    double least = 0, most = 0;  // loads of the other side's front wheel, shares of that at rest [1]
    double bars = 0;             // largest command
};

// Straight ahead at 15 m/s, 50 mm under the left wheels alone.
Bump over_bump(const VehicleDescription& car, const std::vector<std::string>& off = {}) {
    ScenarioDescription s = scenario(3, 15);
    s.road.obstacles.push_back({.shape = ObstacleShape::hump, .start = 8, .length = 2, .height = 0.05, .right = 0});
    s.controllers_off = off, s.solver.energy_balance = false;
    Simulation run(car, s);
    Bump out{.least = everywhere};
    double travel = 0, load = 0;
    while (!run.finished()) {
        const auto end = run.advance();
        if (end) ADD_FAILURE() << end->message;
        if (end) break;
        if (run.steps_taken() % 2 != 0) continue;
        const Sample at = run.sample();
        const auto [suspension, wheel] = locate_wheel(at.model.vehicle, 1);
        const WheelForces<double>& forces = at.momenta.suspensions[suspension].wheels[wheel];
        if (load == 0) load = forces.tire.Fz, travel = forces.travel;
        out.roll = std::max(out.roll, std::abs(roll_of(at)));
        out.other_travel = std::max(out.other_travel, std::abs(forces.travel - travel));
        out.least = std::min(out.least, forces.tire.Fz / load), out.most = std::max(out.most, forces.tire.Fz / load);
        for (std::size_t i = 0; i < run.schedule().commands().size(); ++i) {
            if (!run.control()->layout().commands()[i].name.ends_with("anti_roll_bar.force")) continue;
            out.bars = std::max(out.bars, std::abs(run.schedule().commands()[i]));
        }
    }
    return out;
}

TEST_P(ActiveAntiRollCar, LeavesTheOtherSideAloneOverABump) {
    const VehicleDescription car = with_bars(GetParam());
    VehicleDescription stiff = car;  // by iron, as the controller has it in a turn
    for (std::size_t i = 0; i < stiff.anti_roll_bars.size(); ++i) {
        stiff.anti_roll_bars[i].rate += 60e3 * (i == 0 ? 0.6 : 0.4);
    }
    const Bump active = over_bump(car), soft = over_bump(car, {"all"}), iron = over_bump(stiff, {"all"});
    for (const auto& [what, one] : {std::pair("active", active), {"soft", soft}, {"stiff", iron}}) {
        std::printf("%s, %s: roll %.3f deg, right front wheel %.2f mm, load %.3f to %.3f, bars %.3f\n", GetParam(),
                    what, one.roll / units::degree, 1e3 * one.other_travel, one.least, one.most, one.bars);
    }
    const auto variation = [](const Bump& one) { return one.most - one.least; };
    EXPECT_LT(variation(active), 1.02 * variation(soft));
    EXPECT_LT(active.roll, 1.02 * soft.roll);
    EXPECT_GT(variation(iron), 1.3 * variation(soft)) << "a stiff bar passes the bump on";
}

struct Comfort {
    double acceleration = 0, pitch_rate = 0, heave = 0;  // r.m.s. [m/s^2], [rad/s], [m/s]
    double load = 0;                                     // largest of a wheel's standard deviations over its mean [1]
};

// Of the chassis at its center of mass, from the first second on; all dampers held at a setting where that is not negative.
Comfort comfort(const VehicleDescription& car, ScenarioDescription s, double setting = -1,
                const std::vector<std::string>& off = {}) {
    s.controllers_off = off, s.solver.energy_balance = false;
    Simulation run(setting < 0 ? car : told(car), s);
    if (setting >= 0) {
        std::vector<double> commands = run.control()->layout().rest();
        for (std::size_t i = 0; i < commands.size(); ++i) {
            if (run.control()->layout().commands()[i].name.ends_with("damper.setting")) commands[i] = setting;
        }
        run.set_commands(commands);
    }
    constexpr double interval = 2e-3;  // [s]
    Comfort sum;
    double count = 0, before = std::nan("");
    std::array<double, 4> mean{}, square{};
    while (!run.finished()) {
        const auto end = run.advance();
        if (end) ADD_FAILURE() << end->message;
        if (end) break;
        if (run.time() < 1 || run.steps_taken() % 2 != 0) continue;
        const Sample at = run.sample();
        const double up =
            (at.velocity.R_GC * velocity_at<double>(at.velocity.chassis, at.model.vehicle.chassis.center))[2];
        const double rate = std::isnan(before) ? 0 : (up - before) / interval;
        before = up, ++count;
        sum.acceleration += rate * rate, sum.heave += up * up;
        sum.pitch_rate += at.velocity.chassis[4] * at.velocity.chassis[4];
        for (int i = 0; i < 4; ++i) {
            const auto [suspension, wheel] = locate_wheel(at.model.vehicle, i);
            const double load = at.momenta.suspensions[suspension].wheels[wheel].tire.Fz;
            mean[static_cast<std::size_t>(i)] += load, square[static_cast<std::size_t>(i)] += load * load;
        }
    }
    Comfort out{std::sqrt(sum.acceleration / count), std::sqrt(sum.pitch_rate / count), std::sqrt(sum.heave / count)};
    for (std::size_t i = 0; i < 4; ++i) {
        const double middle = mean[i] / count;
        out.load = std::max(out.load, std::sqrt(square[i] / count - middle * middle) / middle);
    }
    return out;
}

class SkyhookCar : public testing::TestWithParam<const char*> {
protected:
    VehicleDescription car_ = controlled_by(with_adjustable_dampers(shipped(GetParam())), {controller("skyhook", 500)});
    void print(const char* what, const Comfort& one) const {
        std::printf("%s, %s: heave %.3f m/s^2, %.4f m/s, pitch %.4f rad/s, load varies by %.3f\n", GetParam(), what,
                    one.acceleration, one.heave, one.pitch_rate, one.load);
    }
};
INSTANTIATE_TEST_SUITE_P(Shipped, SkyhookCar, testing::Values("bmw_323i", "bmw_e90_330i", "hatchback", "offroader"),
                         [](const auto& test) { return test.param; });

TEST_P(SkyhookCar, CalmsTheBodyOnARoughRoad) {
    ScenarioDescription s = scenario(8, 22);
    s.road.random.push_back({.road_class = 'C'});
    const Comfort sky = comfort(car_, s), off = comfort(car_, s, -1, {"skyhook"});
    const VehicleDescription free = controlled_by(car_, {});
    const Comfort own = comfort(free, s), firm = comfort(car_, s, 1), soft = comfort(car_, s, 0);
    print("skyhook", sky), print("own", own), print("firm", firm), print("soft", soft);
    // Shares of its own dampers' were found to be 0.67 to 0.79, 0.71 to 0.82 and 0.72 to 0.78.
    EXPECT_LT(sky.acceleration, 0.85 * own.acceleration);
    EXPECT_LT(sky.heave, 0.9 * own.heave);
    EXPECT_LT(sky.pitch_rate, 0.85 * own.pitch_rate);
    EXPECT_LT(sky.acceleration, 0.85 * firm.acceleration);
    EXPECT_LT(sky.pitch_rate, 0.85 * firm.pitch_rate);
    EXPECT_LT(sky.heave, 0.75 * soft.heave);
    // Found to be 1.08 to 1.20.
    EXPECT_LT(sky.load, 1.25 * own.load) << "what the wheels pay";
    EXPECT_LT(sky.load, soft.load) << "no more than for soft dampers";
    EXPECT_NEAR(off.acceleration, own.acceleration, 1e-6) << "it is the controller";
}

TEST_P(SkyhookCar, CalmsTheBodyOverAHump) {
    ScenarioDescription s = scenario(4, 22);
    s.road.obstacles.push_back({.shape = ObstacleShape::hump, .start = 25, .length = 6, .height = 0.06});
    const Comfort sky = comfort(car_, s), own = comfort(car_, s, -1, {"all"}), firm = comfort(car_, s, 1);
    print("skyhook", sky), print("own", own), print("firm", firm);
    for (const Comfort& other : {own, firm}) {
        EXPECT_LT(sky.acceleration, 0.85 * other.acceleration);
        EXPECT_LT(sky.heave, 0.95 * other.heave);
        EXPECT_LT(sky.pitch_rate, 0.85 * other.pitch_rate);
    }
    EXPECT_LT(sky.load, own.load) << "here the wheels gain, too";
}

}  // namespace
}  // namespace hamilcar::test
