#include "hamilcar/driver/schedule.hpp"

#include <numbers>

namespace hamilcar {

Schedule::Schedule(const ScenarioDescription& scenario, const SteeringDescription& steering)
    : drive_(scenario.drive), brake_(scenario.brake) {
    if (scenario.steering_input == SteeringInput::none) return;
    const bool wheel = scenario.steering_input == SteeringInput::steering_wheel;
    rack_ = Signal(scenario.steering, wheel ? steering.rack_per_revolution / (2 * std::numbers::pi) : 1.0);
}

}  // namespace hamilcar
