// Pressures of shipped cars' brakes against closed forms of the orifice's law and of first-order lags, what the pedal makes against the
// lever's arithmetic, and the torque of discs and drums by hand.
#include "hamilcar/driveline/brake_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "hamilcar/vehicle/build_brakes.hpp"
#include "support/fleet.hpp"

namespace hamilcar {
namespace {

constexpr double bar = 1e5;  // [Pa]
constexpr ValvePositions<double> at_rest{1, 0, 0}, held{0, 0, 0}, releasing{0, 1, 0};

BrakeSystem<double> brakes_of(const VehicleDescription& car) {
    return make_brakes<double>(car, CommandLayout(car));
}

// Pressure after a time, by small steps of Runge and Kutta.
double after(const std::function<double(double)>& rate, double pressure, double duration) {
    constexpr double h = 2e-5;
    const long steps = std::lround(duration / h);
    for (long i = 0; i < steps; ++i) {
        const double k1 = rate(pressure), k2 = rate(pressure + h / 2 * k1), k3 = rate(pressure + h / 2 * k2),
                     k4 = rate(pressure + h * k3);
        pressure += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return pressure;
}
double after(const BrakeSystem<double>& brakes, std::size_t line, const ValvePositions<double>& valves, double control,
             double pressure, double duration) {
    return after([&](double p) { return brakes.pressure_rate(brakes.lines[line], valves, control, p); }, pressure,
                 duration);
}

class FluidLine : public testing::Test {
protected:
    VehicleDescription car_ = test::shipped("bmw_e90_330i");
    BrakeSystem<double> brakes_ = brakes_of(car_);
    const BrakeDescription& front_ = car_.suspensions[0].wheels[0].brake;
    double k_ = front_.line_flow / front_.volume * std::sqrt(100 * bar);  // [Pa^0.5/s]
    double softness_ = std::max(1e4, (k_ / 250) * (k_ / 250));            // [Pa]

    // Time in which a difference falls from one value to another: the integral of sqrt(x + x_0) / (k x).
    double time_between(double from, double to) const {
        const auto antiderivative = [&](double x) {
            const double r = std::sqrt(x + softness_), r_0 = std::sqrt(softness_);
            return 2 * r + r_0 * std::log((r - r_0) / (r + r_0));
        };
        return (antiderivative(from) - antiderivative(to)) / k_;
    }
};

TEST_F(FluidLine, FillsAsThroughAnOrifice) {
    const double supply = 90 * bar;
    for (const double start : {0.0, 30 * bar}) {
        // While the difference is large compared with x_0, sqrt(s - p) falls evenly.
        const double time = 0.02, root = std::sqrt(supply - start) - k_ * time / 2;
        const double pressure = after(brakes_, 0, at_rest, supply, start, time);
        EXPECT_NEAR(pressure, supply - root * root, 0.01 * supply) << "from " << start;
        EXPECT_NEAR(time_between(supply - start, supply - pressure), time, 1e-9) << "with x_0";
        const double late = after(brakes_, 0, at_rest, supply, start, 0.14);
        EXPECT_NEAR(time_between(supply - start, supply - late), 0.14, 1e-7) << "to the end";
        EXPECT_NEAR(late, supply, 1e-3 * supply);
    }
    // As the file states it: the line's flow at 100 bar of difference, but for x_0.
    EXPECT_NEAR(brakes_.pressure_rate(brakes_.lines[0], at_rest, 100 * bar, 0),
                front_.line_flow / front_.volume * 100 * bar, 5e-3 * front_.line_flow / front_.volume * 100 * bar);
}

TEST_F(FluidLine, FollowsItsSupplyNoFasterThanAStepStands) {
    const double supply = 20 * bar, tiny = 10;  // [Pa]
    for (const auto& line : brakes_.lines) {
        const double rate = brakes_.pressure_rate(line, at_rest, supply, supply - tiny) / tiny;
        EXPECT_LE(rate, 250 * (1 + 1e-9));
        EXPECT_GT(rate, 100);
    }
}

TEST_F(FluidLine, FlowsBackToThePedalAsItCame) {
    for (const double difference : {1e2, 1e5, 5e6}) {
        EXPECT_DOUBLE_EQ(brakes_.pressure_rate(brakes_.lines[0], at_rest, 5e6 + difference, 5e6),
                         -brakes_.pressure_rate(brakes_.lines[0], at_rest, 5e6, 5e6 + difference));
    }
}

TEST_F(FluidLine, HoldsExactly) {
    for (const auto& line : brakes_.lines) EXPECT_EQ(brakes_.pressure_rate(line, held, 80 * bar, 33 * bar), 0);
    const double pressure = 33 * bar;
    EXPECT_EQ(after(brakes_, 0, held, 80 * bar, pressure, 0.1), pressure);
}

TEST_F(FluidLine, EmptiesThroughItsOutlet) {
    const double start = 90 * bar, left = after(brakes_, 0, releasing, 90 * bar, start, 0.05);
    EXPECT_NEAR(time_between(start, left), 0.05, 1e-9);
    EXPECT_LT(after(brakes_, 0, releasing, 90 * bar, start, 0.3), 1);
    EXPECT_DOUBLE_EQ(brakes_.pressure_rate(brakes_.lines[0], {0, 0.25, 0}, 0, start),
                     0.25 * brakes_.pressure_rate(brakes_.lines[0], releasing, 0, start));
}

TEST_F(FluidLine, RisesByThePumpToThePumpsPressure) {
    const double q = car_.brakes.pump_flow / front_.volume * 100 * bar, most = car_.brakes.pump_pressure, time = 0.3;
    EXPECT_NEAR(after(brakes_, 0, {0, 0, 1}, 0, 0, time), most * (1 - std::exp(-q / most * time)), 1e-6 * most);
    EXPECT_EQ(brakes_.pressure_rate(brakes_.lines[0], {0, 0, 1}, 0, 1.1 * most), 0) << "the pump takes nothing back";
}

TEST_F(FluidLine, SharesThePumpAmongWheels) {
    const CommandLayout layout(car_);
    const auto share_of = [&](const std::vector<double>& asked) {
        std::vector<double> commands = layout.rest(), out;
        for (std::size_t i = 0; i < asked.size(); ++i) {
            commands[static_cast<std::size_t>(layout.brake(i) + BrakeCommand::pump)] = asked[i];
        }
        for (std::size_t i = 0; i < asked.size(); ++i) {
            out.push_back(brakes_.valves(i, commands.data(), brakes_.share_of_pump(commands.data())).pump);
        }
        return out;
    };
    EXPECT_EQ(share_of({1, 0, 0, 0}), (std::vector<double>{1, 0, 0, 0}));
    EXPECT_EQ(share_of({0.5, 0.25, 0, 0}), (std::vector<double>{0.5, 0.25, 0, 0})) << "less than there is";
    EXPECT_EQ(share_of({1, 1, 1, 1}), (std::vector<double>{0.25, 0.25, 0.25, 0.25}));
    EXPECT_EQ(share_of({1, 0, 0.25, 0}), (std::vector<double>{0.8, 0, 0.2, 0}));
    const ValvePositions<double> resting = brakes_.valves(0, nullptr, brakes_.share_of_pump(nullptr));
    EXPECT_EQ(resting.inlet, 1);
    EXPECT_EQ(resting.outlet, 0);
    EXPECT_EQ(resting.pump, 0);
}

TEST_F(FluidLine, IsSuppliedBehindItsValveAndByItsCircuit) {
    for (SuspensionWheelDescription& wheel : car_.suspensions[1].wheels) {
        wheel.brake.valve_command = 0.4, wheel.brake.valve_slope = 0.25;
    }
    const BrakeSystem<double> with_valve = brakes_of(car_);
    const double full = car_.brakes.full_pressure;
    std::size_t rear = 0;
    while (with_valve.lines[rear].valve_reduction == 0) ++rear;
    EXPECT_DOUBLE_EQ(with_valve.lines[rear].supply(0.3 * full), 0.3 * full);
    EXPECT_NEAR(with_valve.lines[rear].supply(0.8 * full), (0.4 + 0.25 * 0.4) * full, 1e-9 * full);
    EXPECT_DOUBLE_EQ(with_valve.lines[0].supply(0.8 * full), 0.8 * full);

    // Wheels in the file's order; which of them have pressure.
    const auto supplied = [&](BrakeCircuits circuits, int failed) {
        car_.brakes.circuits = circuits, car_.brakes.failed_circuit = failed;
        std::map<std::string, bool> out;
        const BrakeSystem<double> brakes = brakes_of(car_);
        std::size_t number = 0;
        for_each_wheel(car_, [&](const SuspensionWheelDescription& wheel, std::size_t) {
            out[wheel.name] = brakes.lines[number++].supply(bar) > 0;
        });
        return out;
    };
    using Which = std::map<std::string, bool>;
    EXPECT_EQ(supplied(BrakeCircuits::front_rear, 1),
              (Which{{"front_left", false}, {"front_right", false}, {"rear_left", true}, {"rear_right", true}}));
    EXPECT_EQ(supplied(BrakeCircuits::front_rear, 2),
              (Which{{"front_left", true}, {"front_right", true}, {"rear_left", false}, {"rear_right", false}}));
    EXPECT_EQ(supplied(BrakeCircuits::diagonal, 1),
              (Which{{"front_left", false}, {"front_right", true}, {"rear_left", true}, {"rear_right", false}}));
    EXPECT_EQ(supplied(BrakeCircuits::diagonal, 2),
              (Which{{"front_left", true}, {"front_right", false}, {"rear_left", false}, {"rear_right", true}}));
}

// The E90's file: 250 N on the pedal, times 3.6 by the lever, times 5.8 by the booster, on a piston of one inch; 95 bar at the knee.
TEST(PedalPressure, IsForceOverAreaUpToTheKnee) {
    const BrakeSystem<double> brakes = brakes_of(test::shipped("bmw_e90_330i"));
    const double area = std::numbers::pi / 4 * 0.0254 * 0.0254;
    const auto boosted = [&](double force) { return force * 3.6 * 5.8 / area; };
    for (const double command : {0.0, 0.1, 0.5, 0.9}) {
        EXPECT_NEAR(brakes.pedal_pressure.at(command), boosted(250 * command), 1) << command;
    }
    const double knee_force = 95 * bar * area / (3.6 * 5.8);
    for (const double command : {0.95, 1.0}) {
        const double by_foot = (250 * command - knee_force) * 3.6 / area;
        EXPECT_NEAR(brakes.pedal_pressure.at(command), 95 * bar + by_foot, 1) << command;
    }
}

// What the pedal makes, and at a trailer what that makes, each with its lag: 1 - exp(-t / tau), and of two in a row.
TEST(PedalPressure, ComesWithALag) {
    for (const char* name : {"bmw_e90_330i", "truck_semitrailer"}) {
        const VehicleDescription car = test::shipped(name);
        ScenarioDescription s = test::scenario(0.4);
        s.brake = {{0, 0.1}, {0, 0.5}, Interpolation::steps};
        s.solver.integrator = "rk4";
        Simulation run(car, s);
        const double target = brakes_of(car).pedal_pressure.at(0.5), tau = car.brakes.response_time;
        for (int i = 0; i < 400; ++i) {
            ASSERT_FALSE(run.advance());
            const double t = run.time() - 0.1, *values = run.state().values.data();
            if (i % 50 != 49 || t < 1e-3) continue;
            const BrakeSystem<double>& brakes = run.model().vehicle.brakes;
            EXPECT_NEAR(brakes.control(0, values), target * (1 - std::exp(-t / tau)), 5e-3 * target) << name << t;
            if (car.trailers.empty()) continue;
            const double later = car.brakes.trailer_response_time;
            const double expected =
                target * (1 - (later * std::exp(-t / later) - tau * std::exp(-t / tau)) / (later - tau));
            EXPECT_NEAR(brakes.control(1, values), expected, 5e-3 * target) << name << t;
        }
    }
}

TEST(AirLine, FillsAndEmptiesByExponentials) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const BrakeSystem<double> brakes = brakes_of(truck);
    const BrakeDescription& brake = truck.suspensions[0].wheels[0].brake;
    const double supply = 6 * bar, start = 1 * bar;
    EXPECT_NEAR(after(brakes, 0, at_rest, supply, start, 0.3),
                supply + (start - supply) * std::exp(-0.3 / brake.fill_time), 1e-6 * supply);
    EXPECT_NEAR(after(brakes, 0, at_rest, start, supply, 0.2),
                start + (supply - start) * std::exp(-0.2 / brake.release_time), 1e-6 * supply)
        << "the foot valve lets air out faster than in";
    EXPECT_NEAR(after(brakes, 0, releasing, supply, supply, 0.2), supply * std::exp(-0.2 / brake.release_time),
                1e-6 * supply);
    EXPECT_EQ(brakes.pressure_rate(brakes.lines[0], held, supply, start), 0);
    const double full = truck.brakes.full_pressure;
    EXPECT_NEAR(after(brakes, 0, {0, 0, 1}, 0, start, 0.1), full + (start - full) * std::exp(-0.1 / brake.fill_time),
                1e-6 * full)
        << "by the reservoir's pressure";
}

TEST(AirLine, GetsWhatItAsksForWhateverTheOthersGet) {
    const VehicleDescription truck = test::shipped("truck_semitrailer");
    const BrakeSystem<double> brakes = brakes_of(truck);
    std::vector<double> commands = CommandLayout(truck).rest();
    for (const auto& line : brakes.lines) commands[static_cast<std::size_t>(line.command + BrakeCommand::pump)] = 1;
    EXPECT_EQ(brakes.valves(0, commands.data(), brakes.share_of_pump(commands.data())).pump, 1);
}

TEST(BrakeTorque, IsThatOfTheFilesFriction) {
    VehicleDescription car = test::shipped("bmw_e90_330i");
    BrakeDescription& brake = car.suspensions[0].wheels[0].brake;
    brake.temperature = {20, 300, 600}, brake.friction = {0.9, 1.1, 0.5};
    const double full = car.brakes.full_pressure, torque = brake.max_torque / 2;  // at half pressure
    const auto limit = [&](double temperature, double spin) {
        return brakes_of(car).lines[0].limit(full / 2, temperature, spin);
    };
    EXPECT_NEAR(limit(-10, 0), 0.9 * torque, 1e-9);
    EXPECT_NEAR(limit(160, 0), 1.0 * torque, 1e-9);
    EXPECT_NEAR(limit(450, 0), 0.8 * torque, 1e-9);
    EXPECT_NEAR(limit(900, 0), 0.5 * torque, 1e-9);
    brake.friction_loss_per_speed = 0.01, brake.friction_radius = 0.15;
    EXPECT_NEAR(limit(160, 100), (1 - 0.15) * torque, 1e-9);
    EXPECT_NEAR(limit(160, -100), (1 - 0.15) * torque, 1e-9) << "either way";
    EXPECT_NEAR(limit(160, 1e5), 0.1 * torque, 1e-9) << "never nothing";
    brake.friction_loss_per_speed = 0;
    brake.self_energizing = 0.6;  // what a shoe gains, it loses likewise: f (1 - s) / (1 - s f)
    EXPECT_NEAR(limit(160, 0), torque, 1e-9) << "as the file says at f = 1";
    EXPECT_NEAR(limit(450, 0), 0.8 * 0.4 / (1 - 0.6 * 0.8) * torque, 1e-9);
    EXPECT_NEAR(limit(900, 0), 0.5 * 0.4 / (1 - 0.6 * 0.5) * torque, 1e-9);
    EXPECT_EQ(brakes_of(car).lines[0].limit(-5.0, 20, 0), 0) << "an integrator's undershoot pulls nothing";
}

TEST(BrakeTorque, WarmsAndCoolsByTheFilesNumbers) {
    const VehicleDescription car = test::shipped("bmw_e90_330i");
    const SuspensionWheelDescription& wheel = car.suspensions[0].wheels[0];
    const BrakeHeatDescription& heat = wheel.brake.heat;
    const BrakeLine<double> line = brakes_of(car).lines[0];
    const double speed = 80 * casing_of(wheel.tire).rolling_radius;
    const double cooling = (heat.cooling + heat.cooling_per_speed * speed) * (320 - 20);
    EXPECT_NEAR(line.cooling_power(320, -80), cooling, 1e-9 * cooling);
    EXPECT_NEAR(line.temperature_rate(30e3, 320, 80), (30e3 - cooling) / heat.capacity, 1e-9);
    EXPECT_EQ(line.temperature_rate(0, 20, 80), 0);
}

TEST(BrakeTorque, IsNoneWithoutABrake) {
    VehicleDescription car = test::shipped("bmw_e90_330i");
    car.suspensions[0].wheels[0].brake.max_torque = 0;
    const BrakeSystem<double> brakes = brakes_of(car);
    ASSERT_EQ(brakes.lines.size(), 3u);
    EXPECT_EQ(brakes.lines[0].wheel, 1);
    EXPECT_EQ(CommandLayout(car).brake(0), -1);
    EXPECT_FALSE(Vehicle<double>(test::paper_car()).brakes.exists());
}

}  // namespace
}  // namespace hamilcar
