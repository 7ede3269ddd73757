// Controllers and sensors as a person writes them down.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hamilcar {

// A controller by the name of its kind (control/kinds.hpp) with those of its settings that the file states, in SI units.
struct ControllerDescription {
    std::size_t number = 0;  // in its file
    std::string kind;
    double rate = 100;  // decisions [1/s]
    std::vector<std::pair<std::string, double>> settings;
};

// What a sensor makes of a quantity. All zero: it shows what is there.
struct SensorDescription {
    double interval = 0;    // between two samples; 0: every step [s]
    double delay = 0;       // from the quantity to what is shown [s]
    double resolution = 0;  // it is rounded to multiples of this [unit of the quantity]
    double noise = 0;       // standard deviation of what is added [unit of the quantity]
};

struct SensorsDescription {
    SensorDescription wheel_speed;     // [rad/s]
    SensorDescription angular_rate;    // [rad/s]
    SensorDescription acceleration;    // [m/s^2]
    SensorDescription pressure;        // [Pa]
    SensorDescription steering_wheel;  // [rad]
    SensorDescription travel;          // of the wheels [m], [m/s]
    std::uint64_t seed = 1;            // of all noise
};

}  // namespace hamilcar
