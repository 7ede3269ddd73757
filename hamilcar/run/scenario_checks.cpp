#include "hamilcar/run/scenario_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/io/error.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

std::optional<RackBeyondStops> rack_beyond_stops(const ScenarioDescription& scenario,
                                                 const SteeringDescription& steering) {
    if (scenario.steering_input == SteeringInput::none || steering.rack_travel <= 0) return {};
    const bool wheel = scenario.steering_input == SteeringInput::steering_wheel;
    const Column column(steering);
    for (std::size_t i = 0; i < scenario.steering.value.size(); ++i) {
        const double asked = scenario.steering.value[i], rack = wheel ? column.rack(asked).displacement : asked;
        if (std::abs(rack) > steering.rack_travel) return RackBeyondStops{scenario.steering.time[i], rack};
    }
    return {};
}

void reject_key(const ScenarioDescription& scenario, const std::string& key, const std::string& message) {
    throw io::Error(io::ExitCode::bad_file, fmt::format("{}key '{}'{}", at_key(scenario.places, key), key, message),
                    key);
}

namespace {

// An input that nothing in the car listens to is a mistake in the scenario or in the vehicle.
void check_inputs(const ScenarioDescription& scenario, const VehicleDescription& vehicle) {
    if (scenario.steering_input == SteeringInput::steering_wheel && vehicle.steering.rack_per_revolution <= 0) {
        reject_key(scenario, "inputs.steering_wheel",
                   fmt::format(": {} has no [steering]; expected rack_m_per_revolution there, or inputs.rack here",
                               vehicle.name));
    }
    const double driven = driven_share(vehicle);
    for (const double torque : scenario.drive.value) {
        if (torque == 0 || driven > 0) continue;
        reject_key(scenario, "inputs.drive",
                   fmt::format(" asks for {:g} N m, but no axle of {} is driven; expected a drive_share there", torque,
                               vehicle.name));
    }
}

// A post that stands under no wheel is a mistake in the scenario.
void check_posts(const ScenarioDescription& scenario, const VehicleDescription& vehicle) {
    std::size_t wheels = 0;
    for_each_wheel(vehicle, [&](const auto&, std::size_t) { ++wheels; });
    const std::size_t posts = scenario.road.posts.height.size();
    if (posts <= wheels) return;
    reject_key(scenario, "road.posts.wheel",
               fmt::format(": {} posts for the {} wheels of {}", posts, wheels, vehicle.name));
}

// The rack ends at its stops; a schedule that asks for more is a mistake, not a wish.
void check_rack(const ScenarioDescription& scenario, const SteeringDescription& steering) {
    const auto beyond = rack_beyond_stops(scenario, steering);
    if (!beyond) return;
    const bool wheel = scenario.steering_input == SteeringInput::steering_wheel;
    reject_key(scenario, wheel ? "inputs.steering_wheel" : "inputs.rack",
               fmt::format(" at t = {:g} s: the rack would stand at {:.4g}, expected within -{} to {} [m]",
                           beyond->time, beyond->displacement, steering.rack_travel, steering.rack_travel));
}

// Pedals and gears need power units, and a gear has to be there.
void check_power(const ScenarioDescription& scenario, const VehicleDescription& vehicle) {
    if (!is_powered(scenario)) return;
    const std::string key = !scenario.throttle.time.empty() ? "inputs.throttle"
                            : !scenario.gear.time.empty()   ? "inputs.gear"
                                                            : "driver.gear";
    if (vehicle.power_units.empty()) {
        reject_key(scenario, key,
                   fmt::format(": {} has no power unit; expected a [[power_unit]] there, or a torque at the wheels "
                               "by inputs.drive here",
                               vehicle.name));
    }
    const GearboxDescription& gearbox = vehicle.power_units.front().gearbox;
    const auto check = [&](const std::string& where, double gear) {
        const double last = static_cast<double>(gearbox.ratios.size()), first = gearbox.reverse_ratio > 0 ? -1 : 0;
        if (gear >= first && gear <= last && gear == std::floor(gear)) return;
        reject_key(scenario, where,
                   fmt::format(" = {:g}: {} has no such gear; expected one of {:g} ({}) to {:g}", gear, vehicle.name,
                               first, first < 0 ? "reverse" : "neutral", last));
    };
    if (scenario.gear.time.empty() && !scenario.driver.shifting) {
        reject_key(scenario, key, ": no gear is in; expected inputs.gear or [driver.gear] beside it");
    }
    for (const double gear : scenario.gear.value) check("inputs.gear", gear);
    const auto& shifting = scenario.driver.shifting;
    if (!shifting) return;
    if (shifting->gear) return check("driver.gear.number", *shifting->gear);
    const int last = static_cast<int>(gearbox.ratios.size());
    if (last == 0 || (shifting->first_gear >= 1 && shifting->first_gear <= last)) return;
    reject_key(
        scenario, "driver.gear.first",
        fmt::format(" = {}: {} has no such gear; expected one of 1 to {}", shifting->first_gear, vehicle.name, last));
}

// A driver who steers needs a steering wheel; one who is to go needs wheels that drive, and a gear that goes forward.
void check_driver(const ScenarioDescription& scenario, const VehicleDescription& vehicle) {
    const DriverDescription& driver = scenario.driver;
    if (driver.steering && vehicle.steering.rack_per_revolution <= 0) {
        reject_key(scenario, "driver.path",
                   fmt::format(": {} has no [steering]; expected rack_m_per_revolution there", vehicle.name));
    }
    const auto above_zero = [](double number) { return number > 0; };
    if (!driver.speed || std::ranges::none_of(driver.speed->speed.value, above_zero)) return;
    if (!is_powered(scenario) && driven_share(vehicle) <= 0) {
        reject_key(scenario, "driver.speed",
                   fmt::format(": no axle of {} is driven; expected a drive_share there", vehicle.name));
    }
    const auto refuse = [&](const std::string& key, double gear) {
        reject_key(scenario, key,
                   fmt::format(" = {:g}: {} cannot reach the wanted speed; expected a forward gear beside "
                               "[driver.speed]",
                               gear, gear < 0 ? "the reverse gear" : "neutral"));
    };
    const auto& shifting = driver.shifting;
    if (shifting && shifting->gear && *shifting->gear < 1) refuse("driver.gear.number", *shifting->gear);
    const auto& gears = scenario.gear.value;
    if (!shifting && !gears.empty() && std::ranges::none_of(gears, above_zero)) refuse("inputs.gear", gears.front());
}

void check_parking_brake(const ScenarioDescription& scenario, const VehicleDescription& vehicle) {
    if (scenario.parking_brake.time.empty() || has_parking_brake(vehicle)) return;
    reject_key(
        scenario, "inputs.parking_brake",
        fmt::format(": {} has no parking brake; expected a parking_torque_N_m in a [axle.brake] there", vehicle.name));
}

// A rack can only move on its own where the vehicle says how, and where nothing stabilizes loops at the cost of its motion.
void check_mechanics(const ScenarioDescription& scenario, const VehicleDescription& vehicle) {
    if (!has_free_rack(scenario)) return;
    const std::string key = scenario.steering_mechanics    ? "steering_mechanics"
                            : !scenario.hands.time.empty() ? "inputs.hands"
                                                           : "inputs.steering_torque";
    if (!vehicle.steering.mechanics) {
        reject_key(scenario, key,
                   fmt::format(": {} has no mechanics of its steering; expected [steering.rack] and [steering.column] "
                               "there",
                               vehicle.name));
    }
    if (scenario.solver.constraints != ConstraintMode::exact) {
        reject_key(scenario, key, ": expected solver.constraints = \"exact\" beside it");
    }
    if (scenario.steering_input == SteeringInput::rack) {
        reject_key(scenario, key, ": expected inputs.steering_wheel in the place of inputs.rack");
    }
}

bool is_off(const ScenarioDescription& scenario, const std::string& kind) {
    return std::ranges::any_of(scenario.controllers_off,
                               [&](const std::string& off) { return off == "all" || off == kind; });
}

}  // namespace

void check_scenario(const ScenarioDescription& scenario, const VehicleDescription& vehicle) {
    check_inputs(scenario, vehicle);
    check_power(scenario, vehicle);
    check_driver(scenario, vehicle);
    check_posts(scenario, vehicle);
    check_rack(scenario, vehicle.steering);
    check_mechanics(scenario, vehicle);
    check_parking_brake(scenario, vehicle);
}

VehicleDescription as_driven(VehicleDescription vehicle, const ScenarioDescription& scenario) {
    check_scenario(scenario, vehicle);
    if (!is_powered(scenario)) vehicle.power_units.clear(), vehicle.differentials.clear();
    vehicle.steering.is_free = has_free_rack(scenario);
    std::erase_if(vehicle.controllers, [&](const ControllerDescription& one) { return is_off(scenario, one.kind); });
    return vehicle;
}

}  // namespace hamilcar
