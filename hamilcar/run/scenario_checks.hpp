// What a scenario asks of a vehicle that it cannot do: a person's mistakes, found before anything moves.
#pragma once

#include <optional>
#include <string>

#include "hamilcar/description/scenario.hpp"
#include "hamilcar/description/vehicle.hpp"

namespace hamilcar {

// A mistake at a key of the scenario; the message begins with the key's place, and goes on after its name. Throws
// io::Error(bad_file).
[[noreturn]] void reject_key(const ScenarioDescription& scenario, const std::string& key, const std::string& message);

// The first instant at which a steering input asks for more than the rack's stops allow; nothing where it never does.
struct RackBeyondStops {
    double time, displacement;  // [s], [m]
};
std::optional<RackBeyondStops> rack_beyond_stops(const ScenarioDescription& scenario,
                                                 const SteeringDescription& steering);

// Throws io::Error(bad_file) for an input that nothing in the vehicle listens to, a gear that it does not have, a driver who
// cannot drive it, a rack beyond its stops, a post under no wheel.
void check_scenario(const ScenarioDescription& scenario, const VehicleDescription& vehicle);

// The vehicle as the scenario drives it: checked, and without power units where they are not used (is_powered).
VehicleDescription as_driven(VehicleDescription vehicle, const ScenarioDescription& scenario);

}  // namespace hamilcar
