// Controls as numbers, one set after another: for a controller, a learner or another simulator in the place of tables over time
// and of a driver.
//
//     targets at the end of an interval ─► DirectControls ─► Schedule ─► Input of every step
//
// A rack whose velocity jumped would hit the car with an impulse. So the steering moves from rest to rest within its interval, a
// cubic 3 s^2 - 2 s^3 over the share s of it. In an interval of very few steps it moves evenly: a method that looks once a step,
// at its beginning, would never see it move. Pedals, torque and wind move evenly; a gear is changed at once.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/description/vehicle.hpp"
#include "hamilcar/driver/schedule.hpp"

namespace hamilcar {

class Driver;

class DirectControls {
public:
    struct Entry {
        std::string_view name, unit, meaning;
        Control control;
        double min, max;
        bool by_wheel = false;  // the steering wheel's angle, in place of the rack's displacement
    };

    DirectControls() = default;
    // What the vehicle listens to as the scenario drives it: steering and pedals, less what a driver does. `schedule`: at the start,
    // after the driver's first decision.
    DirectControls(const VehicleDescription& vehicle, const ScenarioDescription& scenario, const Schedule& schedule);

    const std::vector<Entry>& list() const { return list_; }
    // Whether rows of numbers for the one mean the same to the other.
    bool has_same_list(const DirectControls& other) const;
    // Of a control by its place in the list, in its unit.
    double value(std::size_t control, double time, const Schedule& schedule) const;
    // From some time on [s], so many steps of this size [s].
    struct Interval {
        double begin;
        long steps;
        double step;
    };
    static constexpr long fewest_steps_from_rest = 5;
    // From where it is to `target` at the interval's end. A driver who shifts is asked for the throttle; one who closes it while gears
    // change moves the pedal, too. Without allocation.
    void move(std::size_t control, double target, const Interval& interval, Schedule& schedule, Driver* driver) const;
    // How the way there goes: from 0 at the interval's beginning to 1 at its end.
    SignalPiece<double> shape(std::size_t control, const Interval& interval) const;
    // A target in the schedule's unit, and its derivative: the rack's displacement for an angle of the steering wheel.
    double scheduled(std::size_t control, double target) const { return scheduled(list_[control], target); }
    double slope(std::size_t control, double target) const;
    // At `target` from `time` on.
    void hold(std::size_t control, double target, double time, Schedule& schedule, Driver* driver) const;

private:
    double scheduled(const Entry& entry, double value) const;  // from the entry's unit to the schedule's
    // Asks the driver for the throttle; whether it is the driver's to give.
    bool left_to(Driver* driver, const Entry& entry, double target) const;

    Column column_;
    std::vector<Entry> list_;
    bool driver_gives_throttle_ = false;
};

}  // namespace hamilcar
