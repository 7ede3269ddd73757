#include "hamilcar/driver/direct_controls.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "hamilcar/driver/driver.hpp"

namespace hamilcar {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

bool is_driven(const VehicleDescription& vehicle) {
    bool driven = false;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) { driven = driven || wheel.drive_share > 0; });
    return driven;
}
bool has_brakes(const VehicleDescription& vehicle) {
    bool brakes = false;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) { brakes = brakes || wheel.brake.max_torque > 0; });
    return brakes;
}
// The lowest and the highest.
std::array<double, 2> gears(const VehicleDescription& vehicle) {
    std::array<double, 2> out{};
    for (const auto& unit : vehicle.power_units) {
        if (unit.gearbox.reverse_ratio > 0) out[0] = -1;
        out[1] = std::max(out[1], static_cast<double>(unit.gearbox.ratios.size()));
    }
    return out;
}

}  // namespace

DirectControls::DirectControls(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                               const Schedule& schedule)
    : column_(vehicle.steering), driver_gives_throttle_(schedule.signal(Control::throttle).follows()) {
    const SteeringDescription& steering = vehicle.steering;
    const double stop = steering.rack_travel > 0 ? steering.rack_travel : unlimited;
    const DriverDescription& driver = scenario.driver;
    if (column_.exists() && !driver.steering) {
        const double angle = stop < unlimited ? std::abs(column_.angle(stop)) : unlimited;
        list_.push_back({"steering_wheel", "rad", "angle of the steering wheel, to the left positive", Control::rack,
                         -angle, angle, true});
    } else if (!driver.steering && stop < unlimited) {
        list_.push_back({"rack", "m", "displacement of the rack", Control::rack, -stop, stop});
    }
    if (schedule.has_free_rack()) {
        list_.push_back(
            {"hands", "1", "how firmly they hold the steering wheel, 0 off to 1", Control::hands_hold, 0, 1});
        list_.push_back({"steering_torque", "N m", "of the hands besides, to the left positive", Control::hands_torque,
                         -unlimited, unlimited});
    }
    if (!schedule.powered() && is_driven(vehicle) && !driver.speed) {
        list_.push_back(
            {"drive_torque", "N m", "at the driven wheels together", Control::drive_torque, -unlimited, unlimited});
    }
    if (schedule.powered() && !driver.speed) {
        list_.push_back({"throttle", "1", "pedal of the power units, 0 to 1", Control::throttle, 0, 1});
    }
    if (has_brakes(vehicle) && !(driver.speed && driver.speed->may_brake)) {
        list_.push_back({"brake", "1", "brake pedal, 0 to 1", Control::brake, 0, 1});
    }
    if (has_parking_brake(vehicle)) {
        list_.push_back({"parking_brake", "1", "its lever, 0 released to 1", Control::parking_brake, 0, 1});
    }
    if (schedule.powered() && !driver.shifting) {
        list_.push_back({"clutch", "1", "clutch pedal, 0 released to 1 pressed", Control::clutch, 0, 1});
        const auto [lowest, highest] = gears(vehicle);
        list_.push_back({"gear", "1", "-1 reverse, 0 neutral, 1 first, ...", Control::gear, lowest, highest});
    }
    if (schedule.windy()) {
        list_.push_back({"wind_x", "m/s", "velocity of the air, ground axes", Control::wind_x, -unlimited, unlimited});
        list_.push_back({"wind_y", "m/s", "velocity of the air, ground axes", Control::wind_y, -unlimited, unlimited});
    }
}

bool DirectControls::has_same_list(const DirectControls& other) const {
    return std::ranges::equal(list_, other.list_, [](const Entry& a, const Entry& b) {
        return a.control == b.control && a.by_wheel == b.by_wheel;
    });
}

double DirectControls::scheduled(const Entry& entry, double value) const {
    return entry.by_wheel ? column_.rack(value).displacement : value;
}

bool DirectControls::left_to(Driver* driver, const Entry& entry, double target) const {
    if (!driver || entry.control != Control::throttle) return false;
    driver->ask_throttle(target);
    return driver_gives_throttle_;
}

double DirectControls::value(std::size_t control, double time, const Schedule& schedule) const {
    const Entry& entry = list_[control];
    const double scheduled = schedule.signal(entry.control).at(time).value;
    return entry.by_wheel ? column_.angle(scheduled) : scheduled;
}

void DirectControls::move(std::size_t control, double target, const Interval& interval, Schedule& schedule,
                          Driver* driver) const {
    const Entry& entry = list_[control];
    const double now = schedule.signal(entry.control).at(interval.begin).value, change = scheduled(entry, target) - now;
    if (left_to(driver, entry, target)) return;
    if (change == 0 || entry.control == Control::gear) return hold(control, target, interval.begin, schedule, driver);
    SignalPiece<double> piece = shape(control, interval);
    piece.y0 = now, piece.a *= change, piece.b *= change, piece.c *= change;
    schedule.follow(entry.control, interval.begin, piece);
}

SignalPiece<double> DirectControls::shape(std::size_t control, const Interval& interval) const {
    const Control which = list_[control].control;
    if (which == Control::gear) return {.y0 = 1};
    const double duration = static_cast<double>(interval.steps) * interval.step;
    if (which == Control::rack && interval.steps >= fewest_steps_from_rest) {
        return {.inverse_duration = 1 / duration, .b = 3, .c = -2};
    }
    return {.inverse_duration = 1 / duration, .a = 1};
}

double DirectControls::slope(std::size_t control, double target) const {
    return list_[control].by_wheel ? column_.rack(target).slope : 1;
}

void DirectControls::hold(std::size_t control, double target, double time, Schedule& schedule, Driver* driver) const {
    const Entry& entry = list_[control];
    if (left_to(driver, entry, target)) return;
    schedule.follow(entry.control, time, SignalPiece<double>{.y0 = scheduled(entry, target)});
}

}  // namespace hamilcar
