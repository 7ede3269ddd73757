// Every shipped vehicle, and variants for tests of conservation laws.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "support/car.hpp"
#include "support/tires.hpp"

namespace hamilcar::test {

inline const std::vector<std::string>& fleet() {
    static const std::vector<std::string> names{"bmw_323i", "bmw_e21_320i", "bmw_e90_330i", "hatchback",
                                                "formula",  "pickup",       "offroader",    "truck_semitrailer"};
    return names;
}

inline VehicleDescription shipped(const std::string& name) {
    return io::read_vehicle(source_path("vehicles/" + name + ".toml"));
}

// With further keys of one of its axles, as a file that starts from the vehicle's.
inline VehicleDescription shipped_with(const std::string& name, const std::string& axle, const std::string& keys) {
    const auto file = std::filesystem::temp_directory_path() / ("hamilcar-" + std::to_string(getpid()) + ".toml");
    std::ofstream(file) << "base = \"" << source_path("vehicles/" + name + ".toml") << "\"\n[[axle]]\nname = \"" << axle
                        << "\"\n"
                        << keys << "\n";
    const VehicleDescription car = io::read_vehicle(file);
    std::filesystem::remove(file);
    return car;
}

// Without dissipation or kinks: no dampers, no drag, no stops, tires that are bilateral vertical springs.
inline VehicleDescription made_conservative(VehicleDescription car) {
    const DamperDescription none{{-1, 1}, {0, 0}};
    const auto soften = [](TireDescription& tire) { tire = spring_of(tire); };
    for (SuspensionDescription& suspension : car.suspensions) {
        for (SuspensionDamperDescription& damper : suspension.dampers) damper.damper = none;
        for (SuspensionWheelDescription& wheel : suspension.wheels) wheel.bump = wheel.rebound = {}, soften(wheel.tire);
    }
    for (TrailerDescription& trailer : car.trailers) trailer.yaw_damping = 0;
    car.aerodynamics = {};
    car.power_units.clear(), car.differentials.clear();
    return car;
}

// A lane change at 15 m/s under drive torque, with some braking at the end: every input varies.
inline ScenarioDescription everything_moves(const VehicleDescription& car, double duration = 3) {
    ScenarioDescription s = scenario(duration, 15);
    const double torque = 0.15 * Vehicle<double>(car).total_mass;
    s.drive = table({0.1, 0.4, 1.4, 1.6}, {0, torque, torque, 0});
    s.brake = table({1.9, 2.1}, {0, 0.25});
    s.steering_input = SteeringInput::steering_wheel;
    s.steering = table({0.2, 0.7, 1.4, 2.0}, {0, 0.35, -0.35, 0});
    return s;
}

}  // namespace hamilcar::test
