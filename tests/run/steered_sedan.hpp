// A sedan with all mechanics of a steering, and ways to drive it and to look at it.
#pragma once

#include <gtest/gtest.h>

#include <numbers>

#include "hamilcar/analysis/rack_force.hpp"
#include "support/free_steering.hpp"

namespace hamilcar {

inline constexpr double turn = 2 * std::numbers::pi;  // [rad]

inline const VehicleDescription& sedan() {
    static const VehicleDescription car = test::with_mechanics(test::shipped("bmw_323i"), test::full_mechanics());
    return car;
}
inline double ratio() {  // of the steering wheel's angle to the rack [rad/m]
    return turn / sedan().steering.rack_per_revolution;
}

inline ScenarioDescription steered(double duration, double speed, const SignalDescription& angle) {
    ScenarioDescription s = test::scenario(duration, speed);
    s.steering_input = SteeringInput::steering_wheel, s.steering = angle;
    return s;
}

// Calls look(sample) every 10 ms, and in the end.
template <class Look>
void watch(Simulation& run, const Look& look) {
    while (!run.finished()) {
        const auto end = run.advance();
        if (end) FAIL() << end->message;
        if (run.steps_taken() % 10 == 0 || run.finished()) look(run.sample());
    }
}

// In the sense of the rack's displacement, that holds them [N].
inline double force_of_tie_rods(const Sample& s) {
    return rack_force(s.model, s.state, s.input, s.velocity, s.momenta);
}

}  // namespace hamilcar
