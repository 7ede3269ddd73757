// A mass with an engine, a clutch and a gearbox, for tests of the driver.
#pragma once

#include <algorithm>
#include <cmath>

#include "hamilcar/driver/driver.hpp"
#include "hamilcar/driver/schedule.hpp"

namespace hamilcar::test {

struct PoweredCar {
    double mass = 1400, wheel_radius = 0.3, final_ratio = 3.6;  // [kg], [m], [1]
    double rotor_inertia = 0.2, clutch_capacity = 400;          // [kg m^2], [N m]
    double grade = 0;                                           // rise over length [1]
    double idle_speed = 85, full_brake_force = 14e3;            // [rad/s], [N]
    GearboxDescription gearbox{.ratios = {3.7, 2.1, 1.4, 1.05, 0.85},
                               .reverse_ratio = 3.5,
                               .shift_time = 0.5,
                               .upshift_speed = 600,
                               .upshift_speed_closed = 220,
                               .downshift_speed = 350,
                               .downshift_speed_closed = 110};
    double x = 0, speed = 0, rotor = 85;  // [m], [m/s], [rad/s]
    double lowest_rotor = 1e9, highest_rotor = 0;

    double ratio(double gear) const {
        // A constant-rate change may end beyond the last gear by round-off.
        const auto of = [&](int whole) {
            const auto place = std::min(static_cast<std::size_t>(std::max(whole, 1)), gearbox.ratios.size()) - 1;
            return whole == 0 ? 0 : whole < 0 ? -gearbox.reverse_ratio : gearbox.ratios[place];
        };
        const int below = static_cast<int>(std::floor(gear));
        const double share = gear - below;
        return share == 0 ? of(below) : (1 - share) * of(below) + share * of(below + 1);
    }
    double max_torque() const { return std::max(0.0, 210 - 1.2e-3 * (rotor - 400) * (rotor - 400)); }
    // Overrun, and a governor that keeps the engine idling.
    double min_torque() const {
        return -0.05 * rotor + std::clamp(3 * (idle_speed - rotor), 0.0, 80.0) + 0.05 * idle_speed;
    }

    // Throttle, brake, clutch and gear from the schedule.
    void step(const Schedule& schedule, double time, double h) {
        const auto at = [&](Control control) { return schedule.signal(control).at(time).value; };
        const double throttle = at(Control::throttle), total = ratio(at(Control::gear)) * final_ratio;
        const double engine = min_torque() + throttle * std::max(0.0, max_torque() - min_torque());
        const double slip = rotor - total * speed / wheel_radius;
        const bool open = total == 0;
        const double torque = open ? 0 : clutch_capacity * (1 - at(Control::clutch)) * std::tanh(slip / 0.5);
        const double brake = at(Control::brake) * full_brake_force * std::tanh(speed / 0.05);
        const double resistance =
            0.012 * mass * 9.81 * std::tanh(speed / 0.05) + 0.4 * speed * speed + grade * mass * 9.81;
        rotor += h * (engine - torque) / rotor_inertia;
        speed += h * ((torque * total + at(Control::drive_torque)) / wheel_radius - brake - resistance) / mass;
        x += h * speed;
        lowest_rotor = std::min(lowest_rotor, rotor), highest_rotor = std::max(highest_rotor, rotor);
    }
    Observation observation(const Schedule& schedule, double time) const {
        Observation out{.time = time, .x = x, .speed = speed, .gear = schedule.signal(Control::gear).at(time).value};
        const double total = ratio(out.gear) * final_ratio;
        out.unit_count = 1;
        out.units[0] = {.speed = rotor,
                        .shaft_speed = total * speed / wheel_radius,
                        .wheel_ratio = total,
                        .min_torque = min_torque(),
                        .max_torque = max_torque()};
        return out;
    }
    DrivenCar known() const {
        return {.mass = mass,
                .wheel_radius = wheel_radius,
                .full_brake_force = full_brake_force,
                .powered = true,
                .gears = static_cast<int>(gearbox.ratios.size()),
                .has_reverse = gearbox.reverse_ratio > 0,
                .has_clutch = !gearbox.automatic,
                .gearbox = gearbox,
                .idle_speed = idle_speed};
    }
};

// Car, driver and controls together, with short steps because an engaged clutch is stiff.
struct PoweredDrive {
    PoweredCar car;
    Schedule schedule;
    Driver driver;
    int steps = 0;
    static constexpr double h = 2e-4;
    static constexpr int interval = 25;

    PoweredDrive(const PoweredCar& of, const DriverDescription& description, const ScenarioDescription& scenario = {})
        : car(of), schedule(scenario, {}), driver(description, of.known(), Column()) {
        driver.begin(schedule);
    }
    double time() const { return steps * h; }
    double value(Control control) const { return schedule.signal(control).at(time()).value; }
    // As at the start of a run: a first gear, matching rotor speeds, and the first decision repeated.
    void begin() {
        driver.act(car.observation(schedule, 0), schedule);
        driver.act(car.observation(schedule, 0), schedule);
        if (value(Control::clutch) < 1)
            car.rotor = std::max(car.idle_speed, car.observation(schedule, 0).units[0].shaft_speed);
    }
    // Calls `at_decision` at every decision.
    template <class Look>
    void go(double duration, Look&& at_decision) {
        if (steps == 0) begin();
        for (const int end = steps + static_cast<int>(std::lround(duration / h)); steps < end; ++steps) {
            if (steps % interval == 0) driver.act(car.observation(schedule, time()), schedule), at_decision();
            car.step(schedule, time(), h);
        }
    }
    void go(double duration) {
        go(duration, [] {});
    }
};

}  // namespace hamilcar::test
