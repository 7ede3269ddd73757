// What a driver has to do at the steering wheel: the torque at standstill, with an assist and beyond its reach, and the angle that a torsion
// bar that gives way asks for.
#include <algorithm>
#include <cmath>

#include "run/steered_sedan.hpp"

namespace hamilcar {
namespace {

// Turning at standstill: hands and assist bear what tie rods and friction take.
TEST(Parking, HandsAndAssistBearTieRodsAndFriction) {
    VehicleDescription car = sedan();
    car.steering.mechanics->joint_error = 0;
    car.steering.mechanics->assist.torque = {0, 0.5, 2}, car.steering.mechanics->assist.force = {0, 0, 1200};
    Simulation run(car, test::set_free(steered(5, 0, {{0, 0.5, 4.5}, {0, 0, 1.2 * turn}, Interpolation::linear})));
    double most = 0, hands = 0, worst = 0;
    watch(run, [&](const Sample& at) {
        if (at.time < 1.5 || at.time > 3.5) return;  // in steady motion
        const SteeringSystem<double>::Output& steering = at.momenta.steering;
        const double wheel = steering.hands_torque - 0.3 - 0.05 * steering.wheel_rate;  // less its friction
        const double rods = force_of_tie_rods(at), friction = 150 + 60 * at.velocity.rack.rate;
        worst = std::max(worst, std::abs(wheel * ratio() + steering.assist_force - rods - friction));
        most = std::max(most, rods), hands = std::max(hands, steering.hands_torque);
    });
    std::printf("tie rods take up to %.0f N, hands give up to %.2f N m; %.1e N missing\n", most, hands, worst);
    EXPECT_LT(worst, 2e-3 * most);
    EXPECT_GT(most, 200);
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
    SteeringAssistDescription& assist = car.steering.mechanics->assist;
    assist.torque = {0, 0.5, 2}, assist.force = {0, 0, 1200};
    assist.fastest_rack = 0.015, assist.rack_band = 0.005;
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

// Against a stop hands and assist press as far as its stiffness lets, give or take what friction holds.
TEST(Parking, TheRackEndsAtItsStop) {
    for (const double torque : {15.0, -15.0}) {
        ScenarioDescription s = test::set_free(test::scenario(4));
        s.hands = test::table({0}, {0}), s.steering_torque = test::table({0, 2}, {0, torque});
        Simulation run(sedan(), s);
        test::run_to_end(run);
        const Sample at = run.sample();
        const double slope = 1 + 2 * 0.01 * std::cos(2 * (test::steering_state(at.model, at.state).wheel - 0.3));
        const double pressed = torque / slope * ratio() + at.momenta.steering.assist_force - force_of_tie_rods(at);
        const double beyond = std::abs(at.velocity.rack.displacement) - sedan().steering.rack_travel;
        std::printf("pressed by %.0f N the rack goes %.3f mm beyond its travel\n", pressed, 1e3 * beyond);
        EXPECT_NEAR(beyond, std::abs(pressed) / 2e6, (150 + 0.3 * ratio()) / 2e6);
        EXPECT_GT(at.velocity.rack.displacement * torque, 0);
        EXPECT_LT(std::abs(at.velocity.rack.rate), 1e-3);
        EXPECT_GT(beyond, 1e-3);
    }
}

double lateral_acceleration(const Sample& s) {
    return s.velocity.chassis[5] * s.velocity.chassis[0];
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
    constexpr double angle = 0.3;
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

// An assist is a spring on the mass that the rack feels while chassis and suspensions give way: how fast, where its curve is steepest.
TEST(Assist, OfShippedCarsIsAsSlowAsAStepOfAMillisecondFollows) {
    for (const char* name : {"bmw_323i", "bmw_e90_330i", "hatchback", "offroader", "pickup", "truck_semitrailer"}) {
        const Simulation run(test::shipped(name), test::set_free(test::scenario(1)));
        const Model<double>& model = run.model();
        const SteeringSystem<double>& steering = model.vehicle.steering;
        const auto rack_rate = [&](double momentum) {
            State<double> state = run.state();
            steering.state(state.values.data()).rack_momentum += momentum;
            return velocity_block(model, state, run.schedule()(0)).rack.rate;
        };
        const double mass = 1 / (rack_rate(1) - rack_rate(0));
        const double slope = std::ranges::max(steering.assist.slope), turns = std::ranges::max(steering.pinion.slope);
        const double stiffness = slope * steering.bar_stiffness * turns;
        const double frequency = std::sqrt(stiffness * steering.assist_lead * steering.assist_rate / mass);
        std::printf("%-18s %4.0f kg, %4.0f rad/s\n", name, mass, frequency);
        EXPECT_GT(mass, 20) << name;
        EXPECT_LT(frequency, 500) << name;
    }
}

}  // namespace
}  // namespace hamilcar
