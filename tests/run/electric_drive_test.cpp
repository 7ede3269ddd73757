// Electric drives of whole cars: where the battery's energy goes, brakes that motors help, motors in wheels and in the chassis.
#include <gtest/gtest.h>

#include <cmath>

#include "hamilcar/run/channels.hpp"
#include "support/electric.hpp"

namespace hamilcar {
namespace {

// In the balance of energy, over the kinetic energy.
double gap(const Simulation& run) {
    const Sample end = run.sample();
    return std::abs(end.energy.balance() - run.initial_energy_balance()) / end.energy.kinetic;
}

// Up, and down again on the pedal's regeneration: cells against motors, resistance and the rest on board.
TEST(Battery, EnergyOfItsCellsIsWhatMotorsAndHeatTake) {
    const VehicleDescription car = test::electric_car();
    Simulation run(car, test::pedal(12, 10, test::table({0.2, 0.6, 5, 5.5}, {0, 0.9, 0.9, 0})));
    const double step = run.scenario().solver.step;
    const Curve<double> open(car.battery.charge, car.battery.voltage);
    double cells = 0, motors = 0, heat = 0, mechanical = 0, used = 0, charge_used = 0;
    const auto read = [&](double weight) {
        const Sample s = run.sample();
        const BatteryMomenta<double>& battery = s.momenta.powertrain.battery;
        cells +=
            weight * open.at(s.model.vehicle.powertrain.battery.state(s.state.values.data()).charge) * battery.current;
        heat += weight * battery.heat, charge_used += weight * battery.current,
            used += weight * std::abs(battery.power);
        for (std::size_t i = 0; i < 2; ++i) {
            const auto& unit = s.momenta.powertrain.units[i];
            motors += weight * unit.electric_power, mechanical += weight * unit.source * unit.spin;
        }
    };
    read(step / 2);
    while (run.time() < 12 - step / 2) {
        ASSERT_FALSE(run.advance());
        read(step);
    }
    read(-step / 2);
    const double rest = 500 * 12;
    EXPECT_GT(used, 500e3) << "it was a drive";
    EXPECT_NEAR(cells, motors + rest + heat, 1e-3 * used);
    EXPECT_GT(motors, mechanical + 0.05 * used) << "motors lose";
    const Powertrain<double>& powertrain = run.model().vehicle.powertrain;
    EXPECT_NEAR(powertrain.supplied(run.state().values.data()), mechanical, 1e-4 * used);
    const double charge = powertrain.battery.state(run.state().values.data()).charge;
    EXPECT_NEAR(0.6 - charge, charge_used / car.battery.capacity, 1e-9);
    EXPECT_LT(gap(run), 1e-3);
}

// Its limit on the power: motors that ask for 170 kW get what is there, whatever shares they have.
TEST(Battery, LimitsWhatMotorsDraw) {
    VehicleDescription car = test::electric_car();
    car.battery.max_discharge = 60e3;
    Simulation run(car, test::pedal(6, 12, test::table({0.2, 0.4}, {0, 1})));
    double most = 0;
    while (run.time() < 5.9) {
        ASSERT_FALSE(run.advance());
        most = std::max(most, run.sample().momenta.powertrain.battery.power);
    }
    EXPECT_NEAR(most, 60e3, 60);
}

// With an efficiency that falls with the torque, so that a share of the torque is more than that share of the power.
TEST(Battery, LimitsMotorsWithMapsOfTheirEfficiency) {
    VehicleDescription car = test::electric_car();
    car.battery.max_discharge = 20e3;
    for (std::size_t i = 0; i < 2; ++i) {
        test::motor_of(car, i).efficiency_map = {
            .level = {20, 270}, .speed = {{0, 1000}, {0, 1000}}, .value = {{0.6, 0.6}, {0.95, 0.95}}};
    }
    Simulation run(car, test::pedal(4, 12, test::table({0.2, 0.4}, {0, 1})));
    double most = 0;
    while (run.time() < 3.9) {
        ASSERT_FALSE(run.advance());
        most = std::max(most, run.sample().momenta.powertrain.battery.power);
    }
    EXPECT_NEAR(most, 20e3, 0.02 * 20e3);
}

// An empty battery does not hold a car on a slope, and nothing chatters while it rolls back.
TEST(Battery, LetsGoOfACarOnASlopeWhenItIsEmpty) {
    VehicleDescription car = test::electric_car();
    car.battery.initial_charge = 0;
    car.controllers.clear();
    ScenarioDescription s = test::pedal(3, 0, test::table({0, 0.1}, {1, 1}));
    s.road.grade = 0.15;
    Simulation run(car, s);
    double before = run.sample().momenta.powertrain.units[0].source;
    int jumps = 0;
    while (!run.finished()) {
        ASSERT_FALSE(run.advance());
        const double torque = run.sample().momenta.powertrain.units[0].source;
        jumps += std::abs(torque - before) > 50 ? 1 : 0;
        before = torque;
    }
    EXPECT_LT(jumps, 5);
    EXPECT_LT(linear(run.sample().velocity.chassis)[0], -0.05) << "it rolls back, braked by what it generates";
}

TEST(WheelMotors, AddUpWhereTwoDriveOneWheel) {
    const auto speed = [](double torque, int motors) {
        VehicleDescription car = test::with_wheel_motors(test::shipped("electric_hatchback"), false);
        car.controllers.clear();
        for (std::size_t i = 1; i < 3; ++i) test::motor_of(car, i).max_torque = torque;
        if (motors == 2) {
            for (std::size_t i = 1; i < 3; ++i) {
                PowerUnitDescription second = car.power_units[i];
                second.name += "_2";
                car.power_units.push_back(second);
            }
            for (PowerUnitDescription& unit : car.power_units) {
                if (unit.output.wheel) unit.inertia /= 2, unit.stiffness /= 2;
            }
        }
        Simulation run(car, test::pedal(2, 5, test::table({0.1, 0.3}, {0, 0.6})));
        test::run_to_end(run);
        return linear(run.sample().velocity.chassis)[0];
    };
    EXPECT_NEAR(speed(60, 2), speed(120, 1), 0.01);
    EXPECT_GT(speed(60, 2), speed(60, 1) + 0.3);
}

// A stop with friction alone and with motors that help: the driver feels the same car, the battery does not.
TEST(Blending, BrakesAsFrictionAloneDoesAndChargesTheBattery) {
    struct Stop {
        double distance = 0, charge = 0, friction = 0;
    };
    const auto stop = [](double brake_regeneration, double top) {
        VehicleDescription car = test::electric_car(brake_regeneration);
        for (std::size_t i = 0; i < 2; ++i) test::motor_of(car, i).regeneration = 0;
        for (PowerUnitDescription& unit : car.power_units) unit.gearbox.efficiency = 1;
        ScenarioDescription s = test::pedal(6, 25, test::table({0, 1}, {0, 0}));
        s.brake = test::table({0.2, 0.5}, {0, top});
        Simulation run(car, s);
        const double step = run.scenario().solver.step;
        Stop out;
        while (run.time() < 6 - step / 2 && linear(run.sample().velocity.chassis)[0] > 3) {
            EXPECT_FALSE(run.advance());
            const Sample now = run.sample();
            for (std::size_t i = 0; i < car.suspensions.size(); ++i) {
                for (std::size_t w = 0; w < car.suspensions[i].wheels.size(); ++w) {
                    const WheelForces<double>& wheel = now.momenta.suspensions[i].wheels[w];
                    out.friction -= step * wheel.brake_torque * wheel.spin;
                }
            }
        }
        out.distance = run.state().position()[0];
        out.charge = run.model().vehicle.powertrain.battery.state(run.state().values.data()).charge - 0.6;
        return out;
    };
    for (const double pedal : {0.15, 0.4}) {
        const Stop friction = stop(0, pedal), blended = stop(1, pedal);
        EXPECT_NEAR(blended.distance, friction.distance, 0.01 * friction.distance) << pedal;
        EXPECT_LT(friction.charge, 0) << "what is on board empties it";
        EXPECT_GT(blended.charge, 1e-3) << pedal;
        EXPECT_LT(blended.friction, (pedal < 0.2 ? 0.2 : 0.75) * friction.friction) << pedal;
    }
}

// The pedal asks for what brakes would do; a battery that takes no charge leaves all of it to them.
TEST(Blending, IsLeftToFrictionWhereTheBatteryIsFull) {
    VehicleDescription car = test::electric_car(1);
    car.battery.initial_charge = 1, car.battery.auxiliary_power = 0;
    ScenarioDescription s = test::pedal(1.5, 25, test::table({0, 1}, {0, 0}));
    for (std::size_t i = 0; i < 2; ++i) test::motor_of(car, i).regeneration = 0;
    s.brake = test::table({0.1, 0.3}, {0, 0.3});
    Simulation run(car, s);
    test::run_to_end(run);
    const Sample now = run.sample();
    EXPECT_NEAR(now.momenta.powertrain.battery.power, 0, 1);
    EXPECT_NEAR(now.momenta.powertrain.units[0].source, 0, 1e-9);
    const BrakeSystem<double>& brakes = now.model.vehicle.brakes;
    for (std::size_t i = 0; i < brakes.lines.size(); ++i) {
        const auto wheel = static_cast<std::size_t>(brakes.lines[i].wheel);
        EXPECT_EQ(now.momenta.brakes.limit[wheel], now.momenta.brakes.lines[i].limit);
    }
}

// An anti-lock system has to do with friction alone: at work it takes the motors' help away, and gives it back.
TEST(Blending, IsWithheldWhileTheAntiLockSystemActs) {
    const VehicleDescription car = test::controlled_by(test::electric_car(0.5), {test::controller("abs", 200)});
    ScenarioDescription s = test::pedal(3, 20, test::table({0, 1}, {0, 0}));
    s.road.friction = 0.25;
    s.brake = test::table({0.5, 0.6, 1.5, 1.7}, {0.02, 1, 1, 0.02});
    Simulation run(car, s);
    const int place = run.control()->layout().find("front_drive.max_regeneration");
    ASSERT_GE(place, 0);
    double acting = 0, helped = 0;
    while (!run.finished()) {
        ASSERT_FALSE(run.advance());
        const bool acts = run.control()->activity(0, run.control_memory()) > 0;
        const double let = run.schedule().commands()[static_cast<std::size_t>(place)];
        ASSERT_EQ(let, acts ? 0 : 1) << run.time();
        const double regenerated = run.sample().momenta.powertrain.units[0].regenerated;
        if (acts && run.time() < 1.4) {
            acting += 1e-3;
            EXPECT_EQ(regenerated, 0);
        }
        if (run.time() > 2.5 && !acts && regenerated > 0) helped += 1e-3;
    }
    EXPECT_GT(acting, 0.5);
    EXPECT_GT(helped, 0.3);
}

// The same motors behind a differential, at each wheel on the chassis, and in the wheels: on a straight road the same speeds; energy holds.
TEST(WheelMotors, DriveAsOneBehindADifferential) {
    const VehicleDescription car = test::shipped("electric_hatchback");
    const auto drive = [](const VehicleDescription& one) {
        Simulation run(one, test::pedal(4, 8, test::table({0.2, 0.5, 2.5, 2.8}, {0, 0.5, 0.5, 0})));
        test::run_to_end(run);
        EXPECT_LT(gap(run), 1e-3);
        return linear(run.sample().velocity.chassis)[0];
    };
    const double reference = drive(car);
    EXPECT_GT(reference, 11);
    EXPECT_NEAR(drive(test::with_wheel_motors(car, false)), reference, 0.01);
    EXPECT_NEAR(drive(test::with_wheel_motors(car, true)), reference, 0.03);
}

// A motor in a wheel leans on the carrier as the wheel's brake does; a shaft leaves its reaction to the chassis. So a car that motors slow
// down pitches like one that its rear brakes slow down, if the motors sit in the wheels.
TEST(WheelMotors, LeanOnTheCarrierAsABrakeDoes) {
    constexpr double torque = 600;  // of each rear wheel [N m]
    const auto pitch = [&](bool in_wheel, bool by_motors) {
        VehicleDescription car = test::with_wheel_motors(test::shipped("electric_hatchback"), in_wheel);
        car.controllers.clear(), car.brakes = {};
        car.power_units.erase(car.power_units.begin()), car.differentials.clear();
        for (SuspensionDescription& suspension : car.suspensions) {
            for (SuspensionWheelDescription& wheel : suspension.wheels) {
                wheel.brake.max_torque = wheel.name.starts_with("rear") ? torque : 0;
            }
        }
        for (std::size_t i = 0; i < 2; ++i) {
            PowerUnitDescription& unit = car.power_units[i];
            unit.gearbox.efficiency = 1, unit.response_time = 0;
            test::motor_of(car, i).regeneration =
                by_motors ? torque / unit.gearbox.ratios[0] / test::motor_of(car, i).max_torque : 0;
        }
        ScenarioDescription s = test::pedal(1, 9, test::table({0, 1}, {0, 0}));
        if (!by_motors) s.brake = test::table({0, 0.001}, {1, 1});
        Simulation run(car, s);
        test::run_to_end(run);
        const WheelForces<double> wheel = run.sample().momenta.suspensions[2].wheels[0];
        if (in_wheel) {
            EXPECT_NEAR(wheel.drive_torque + wheel.brake_torque, -torque, 1);
        }
        return std::asin(-run.sample().velocity.R_GC(2, 0));
    };
    const double brake = pitch(true, false), in_wheel = pitch(true, true), in_chassis = pitch(false, true);
    EXPECT_NEAR(in_wheel, brake, 0.01 * std::abs(in_chassis - brake));
    EXPECT_GT(std::abs(in_chassis - brake), 1e-3)
        << "the suspension has anti-lift, which only brakes and wheel motors use";
}

// In a run without power units their commands rest, and those behind them are still read at their own places.
TEST(MotorCommands, RestInARunWithoutPowerUnits) {
    const VehicleDescription car = test::told(test::with_adjustable_dampers(test::electric_car()));
    Simulation run(car, test::scenario(0.1, 10));
    const CommandLayout &own = run.control()->layout(), all(car);
    const std::vector<double> told = test::mixed_commands(own);
    run.set_commands(told);
    const std::vector<Channel> channels = all_channels(car);
    const Sample sample = run.sample();
    std::size_t read = 0;
    for (const Command& command : all.commands()) {
        const auto channel =
            std::ranges::find(channels, "command." + command.name, [](const Channel& one) { return one.column.name; });
        ASSERT_NE(channel, channels.end());
        const int place = own.find(command.name);
        EXPECT_EQ(channel->read(sample), place < 0 ? command.rest : told[static_cast<std::size_t>(place)])
            << command.name;
        ++read;
    }
    EXPECT_GT(read, told.size() + 7) << "two motors have eight commands";
}

TEST(ParkingBrake, HoldsOnASlopeAndOnlyWhereItIsApplied) {
    VehicleDescription car = test::shipped("bmw_323i");
    for (std::size_t s = 0; s < car.suspensions.size(); ++s) {
        for (SuspensionWheelDescription& wheel : car.suspensions[s].wheels) {
            wheel.brake.parking_torque = wheel.name.starts_with("rear") ? 700 : 0;
        }
    }
    const auto slid = [&](double lever, double grade) {
        ScenarioDescription s = test::scenario(8, 0);
        s.road.grade = grade;
        s.parking_brake = test::table({0, 0.1}, {lever, lever});
        Simulation run(car, s);
        const double start = run.state().position()[0];
        test::run_to_end(run);
        return std::abs(run.state().position()[0] - start);
    };
    EXPECT_LT(slid(1, 0.2), 0.01) << "2 x 700 N m at 0.3 m hold 4.6 kN, the weight pulls with 2.6 kN";
    EXPECT_GT(slid(0, 0.2), 20);
    EXPECT_GT(slid(0.3, 0.2), 5) << "a third of it does not";
}

}  // namespace
}  // namespace hamilcar
