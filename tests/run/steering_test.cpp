// What a driver feels and sees of a steering with mechanics, on whole cars: each by another route than the equations of the steering.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hamilcar/analysis/rack_force.hpp"
#include "support/free_steering.hpp"

namespace hamilcar {
namespace {

constexpr double turn = 2 * std::numbers::pi;

const VehicleDescription& sedan() {
    static const VehicleDescription car = test::with_mechanics(test::shipped("bmw_323i"), test::full_mechanics());
    return car;
}
double ratio() {  // of the steering wheel's angle to the rack [rad/m]
    return turn / sedan().steering.rack_per_revolution;
}

ScenarioDescription steered(double duration, double speed, const SignalDescription& angle) {
    ScenarioDescription s = test::scenario(duration, speed);
    s.steering_input = SteeringInput::steering_wheel, s.steering = angle;
    return s;
}

// Calls look(sample) every 10 ms, and in the end.
template <class Look>
void watch(Simulation& run, const Look& look) {
    while (!run.finished()) {
        const auto end = run.advance();
        if (end) FAIL() << end->message;
        if (run.steps_taken() % 10 == 0 || run.finished()) look(run.sample());
    }
}

double force_of_tie_rods(const Sample& s) {
    return rack_force(s.model, s.state, s.input, s.velocity, s.momenta);
}
double lateral_acceleration(const Sample& s) {
    return s.velocity.chassis[5] * s.velocity.chassis[0];
}

struct Released {
    double before, opposite,
        after;     // of the rack: as held, its largest swing to the other side, where it comes to rest [m]
    double speed;  // in the end [m/s]
};

Released released(double speed, double angle) {
    ScenarioDescription s = test::set_free(steered(12, speed, test::table({0.2, 2}, {0, angle})));
    s.hands = test::table({4, 4.05}, {1, 0});
    Simulation run(sedan(), s);
    Released out{};
    watch(run, [&](const Sample& at) {
        const double rack = at.velocity.rack.displacement;
        if (at.time < 4) out.before = rack;
        out.opposite = std::max(out.opposite, -rack), out.after = rack, out.speed = at.velocity.chassis[0];
    });
    return out;
}

// The force of the tie rods per displacement of a rack that is held [N/m].
double aligning_stiffness(double speed, double rack) {
    ScenarioDescription s = test::scenario(4, speed);
    s.steering_input = SteeringInput::rack, s.steering = test::table({0.2, 1}, {0, rack});
    Simulation run(sedan(), s);
    test::run_to_end(run);
    return force_of_tie_rods(run.sample()) / rack;
}

TEST(SelfCentering, BringsTheWheelBackAsFarAsFrictionLets) {
    double least = 0;
    const double friction = 150 + 0.3 * ratio();  // of rack and steering wheel, at the rack [N]
    for (const auto& [speed, angle] : {std::pair(10.0, 3.0), {50.0, 1.2}, {100.0, 0.45}, {130.0, 0.35}}) {
        const Released car = released(speed / 3.6, angle);
        const double stiffness = aligning_stiffness(car.speed, 1e-3), overshoot = car.opposite / car.before;
        std::printf("%3.0f km/h: rack from %.2f mm to %.2f mm, friction holds %.2f mm, overshoot %.3f\n", speed,
                    1e3 * car.before, 1e3 * car.after, 1e3 * friction / stiffness, overshoot);
        EXPECT_GT(stiffness, 0);
        EXPECT_LT(std::abs(car.after), 0.5 * car.before) << "it returns";
        EXPECT_LT(std::abs(car.after), 1.05 * friction / stiffness);
        EXPECT_GE(overshoot, least) << "more of it at speed";
        least = overshoot;
    }
    EXPECT_GT(least, 0.1);
}

// Turning at standstill: hands and assist bear what tie rods and friction take.
TEST(Parking, HandsAndAssistBearTieRodsAndFriction) {
    VehicleDescription car = sedan();
    car.steering.mechanics->joint_error = 0;
    Simulation run(car, test::set_free(steered(5, 0, test::table({0.5, 4.5}, {0, 1.2 * turn}))));
    double most = 0, hands = 0;
    watch(run, [&](const Sample& at) {
        if (at.time < 1.5 || at.time > 3.5) return;  // in steady motion
        const SteeringSystem<double>::Output& steering = at.momenta.steering;
        const double wheel = steering.hands_torque - 0.3 - 0.05 * steering.wheel_rate;  // less its friction
        const double rods = force_of_tie_rods(at), friction = 150 + 60 * at.velocity.rack.rate;
        EXPECT_NEAR(wheel * ratio() + steering.assist_force, rods + friction, 0.01 * rods) << at.time;
        most = std::max(most, rods), hands = std::max(hands, steering.hands_torque);
    });
    std::printf("tie rods take up to %.0f N, hands give up to %.2f N m\n", most, hands);
    EXPECT_GT(most, 1000);
    EXPECT_LT(hands * ratio(), 0.7 * most) << "the assist helps";
}

// Largest torque of the hands while they turn at a rate [N m].
double turning_torque(const VehicleDescription& car, double rate) {
    const double begin = 0.3, end = begin + 2.4 / rate;
    ScenarioDescription s =
        test::set_free(steered(end + 0.2, 0, {{0, begin, end}, {0, 0, 2.4}, Interpolation::linear}));
    Simulation run(car, s);
    double most = 0;
    watch(run, [&](const Sample& at) {
        const bool steady = at.time > begin + 0.5 * (end - begin) && at.time < end;
        if (steady) most = std::max(most, std::abs(at.momenta.steering.hands_torque));
    });
    return most;
}

TEST(Parking, HandsAreAloneWhereThePumpDoesNotFollow) {
    VehicleDescription car = sedan();
    car.steering.mechanics->assist.fastest_rack = 0.015, car.steering.mechanics->assist.rack_band = 0.005;
    VehicleDescription without = car;
    without.steering.mechanics->assist = {};
    const double rate_of_pump = 0.015 * ratio();
    const double slow = turning_torque(car, 0.5 * rate_of_pump), fast = turning_torque(car, 2 * rate_of_pump);
    const double slow_alone = turning_torque(without, 0.5 * rate_of_pump),
                 fast_alone = turning_torque(without, 2 * rate_of_pump);
    std::printf("slowly %.2f N m of %.2f, fast %.2f N m of %.2f\n", slow, slow_alone, fast, fast_alone);
    EXPECT_LT(slow, 0.6 * slow_alone);
    EXPECT_NEAR(fast, fast_alone, 0.02 * fast_alone);
}

// Torque of the hands over time, with a cleat under the wheels on one side or on both.
std::vector<double> kickback(double right, double left) {
    ScenarioDescription s = test::set_free(test::scenario(1, 15));
    s.road.obstacles.push_back({.start = 6, .length = 0.3, .height = 0.02, .right = right, .left = left});
    VehicleDescription car = sedan();
    car.steering.mechanics->joint_error = 0;  // which has a side
    Simulation run(car, s);
    std::vector<double> out;
    watch(run, [&](const Sample& at) { out.push_back(at.momenta.steering.hands_torque); });
    return out;
}

TEST(Kickback, ComesFromACleatOnOneSideWithTheSignOfTheSide) {
    const std::vector<double> left = kickback(0, everywhere), right = kickback(-everywhere, 0);
    const std::vector<double> both = kickback(-everywhere, everywhere);
    double most = 0, of_both = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_NEAR(left[i], -right[i], 1e-7) << i;
        most = std::max(most, std::abs(left[i])), of_both = std::max(of_both, std::abs(both[i]));
    }
    std::printf("hands feel up to %.2f N m, %.1e N m of a cleat under both wheels\n", most, of_both);
    EXPECT_EQ(left[20], 0) << "nothing before";
    EXPECT_GT(most, 0.2);
    EXPECT_LT(of_both, 1e-6 * most);
}

// Hands off on a side slope: what friction holds, it holds for good.
TEST(StickSlip, TheRackStandsStillUnderAConstantLoad) {
    ScenarioDescription s = test::set_free(test::scenario(60));
    s.road.bank = 0.1, s.brake = test::table({0}, {0.5}), s.hands = test::table({0}, {0});
    Simulation run(sedan(), s);
    double from = 0, drift = 0, late_from = 0, late_drift = 0;
    watch(run, [&](const Sample& at) {
        const double rack = at.velocity.rack.displacement;
        if (at.time < 10) from = rack;
        if (at.time < 40) late_from = rack;
        drift = std::max(drift, std::abs(rack - from)), late_drift = std::max(late_drift, std::abs(rack - late_from));
    });
    const Sample end = run.sample();
    std::printf("under %.1f N the rack moves by %.1e m in 50 s, by %.1e m in the last 20 s\n", force_of_tie_rods(end),
                drift, late_drift);
    EXPECT_GT(std::abs(force_of_tie_rods(end)), 10) << "there is a load";
    EXPECT_LT(drift, 1e-9);
    EXPECT_LE(late_drift, drift);
}

// Steady circles of the same lateral acceleration, with a rack that is prescribed and with a column that gives way: the wheel has to turn
// further by the torque that the rack's force makes on it, over the torsion bar's stiffness.
TEST(Compliance, TurnsTheWheelFurtherByTheBarsTwist) {
    SteeringMechanicsDescription d = test::bare_mechanics();
    d.bar_damping = 0.4, d.rack_damping = 60;
    const VehicleDescription car = test::with_mechanics(sedan(), d);
    const auto circle = [&](double angle, bool free) {
        ScenarioDescription s = steered(10, 22, test::table({0.2, 1.5}, {0, angle}));
        s.drive = test::table({0}, {150});
        Simulation run(car, free ? test::set_free(s) : s);
        test::run_to_end(run);
        return run;
    };
    double angle = 0.6;
    const Simulation rigid = circle(angle, false);
    const Sample held = rigid.sample();
    const double wanted = lateral_acceleration(held), torque = force_of_tie_rods(held) / ratio();
    double below = angle, above = angle + 3 * torque * (1 / d.bar_stiffness + 1 / d.hands_stiffness);
    double found_below = lateral_acceleration(circle(below, true).sample()),
           found_above = lateral_acceleration(circle(above, true).sample());
    for (int i = 0; i < 4; ++i) {  // secants
        const double next = above + (wanted - found_above) * (above - below) / (found_above - found_below);
        below = above, found_below = found_above;
        above = next, found_above = lateral_acceleration(circle(next, true).sample());
    }
    const Simulation soft = circle(above, true);
    const double further = test::steering_state(soft.model(), soft.state()).wheel - angle;
    std::printf("%.3f g: %.3f N m turn the wheel further by %.4f rad, over the stiffness %.4f rad\n", wanted / 9.80665,
                torque, further, torque / d.bar_stiffness);
    EXPECT_NEAR(found_above, wanted, 1e-6 * wanted);
    EXPECT_NEAR(wanted / 9.80665, 0.2, 0.05);
    EXPECT_NEAR(further, torque / d.bar_stiffness, 0.01 * further);
    EXPECT_NEAR(above - test::steering_state(soft.model(), soft.state()).wheel, torque / d.hands_stiffness,
                0.01 * torque / d.hands_stiffness)
        << "and the hands by theirs";
}

// All that hands, assist and friction exchange in a lane change, to a thousandth.
TEST(SteeringBalance, ClosesForALaneChange) {
    for (const char* name : {"bmw_323i", "bmw_e90_330i", "offroader"}) {
        const VehicleDescription car = test::with_mechanics(test::shipped(name), test::full_mechanics());
        Simulation run(car, test::set_free(steered(4, 25, test::table({0.2, 0.7, 1.4, 2.0}, {0, 0.5, -0.5, 0}))));
        double exchanged = 0;
        while (!run.finished()) {
            ASSERT_FALSE(run.advance());
            const Sample at = run.sample();
            const auto& steering = at.momenta.steering;
            exchanged += 1e-3 * (std::abs(steering.hands_torque * steering.wheel_rate) +
                                 std::abs((steering.assist_force + steering.friction) * at.velocity.rack.rate));
        }
        const double error = std::abs(run.sample().energy.balance() - run.initial_energy_balance());
        std::printf("%s: %.2f J exchanged by the steering, %.1e J missing\n", name, exchanged, error);
        EXPECT_GT(exchanged, 1);
        EXPECT_LT(error, 1e-3 * exchanged);
    }
}

}  // namespace
}  // namespace hamilcar
