// One drive of a maneuver: a scenario with its driver, run from start to end, and what was seen on the way.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hamilcar/maneuver/maneuver.hpp"

namespace hamilcar {

// What test drivers measure, row by row at a steady rate. SI units, radians, ISO 8855 axes; the car is the motor vehicle.
struct History {
    std::vector<double> time;
    std::vector<double> steering_wheel;   // angle, to the left positive
    std::vector<double> steering_torque;  // that the driver applies, without power assist [N m]
    std::vector<double> x, y, yaw;  // of the chassis's center of mass on the ground; yaw continuous, beyond pi too
    std::vector<double> speed;      // of that point along the heading
    std::vector<double> lateral_velocity;  // of that point, to the left
    std::vector<double> yaw_rate, roll, pitch;
    // Of the center of mass of the motor vehicle with its wheels, horizontal, along and across the heading.
    std::vector<double> longitudinal_acceleration, lateral_acceleration;
    // Of the chassis's center of mass, chassis axes, without gravity: where the linear model has its seat too. Only if asked for.
    std::vector<double> seat_x, seat_y, seat_z;
    std::vector<double> drive_torque;  // at all wheels together [N m]
    std::vector<double> throttle, brake, gear;
    std::vector<double> unit_speed;                // of the first power unit [rad/s]; empty without
    std::vector<std::vector<double>> wheel_load;   // of every wheel with all its tires, on the road [N]
    std::vector<std::vector<double>> wheel_speed;  // turning of every wheel [rad/s]
    // Of every wheel's contact on the ground; of dual tires the outer one's, away from its unit's middle [m].
    std::vector<std::vector<double>> wheel_x, wheel_y;

    std::size_t size() const { return time.size(); }
    // Of the center of mass, from the heading all around: near pi a car rolls backward. None below 3 m/s, where the angle
    // says little [rad].
    double sideslip(std::size_t row) const;
};

struct Trial {
    History history;
    Stopped stopped = Stopped::no;     // why the car could not go on
    std::string trouble;               // the same in words; empty where nothing stopped it
    std::optional<std::string> ended;  // what the driver's ending was, if it came before the time was up
    std::vector<std::string>
        complaints;  // what the driver could not do: a speed that was not reached, a path that was left
    EnergyBook energy;
    io::PageRun film;  // empty unless asked for

    // The whole maneuver is over, whatever this drive was for: a linkage that came apart is no limit of the vehicle.
    bool breaks_off() const { return stopped == Stopped::interrupted || stopped == Stopped::numerical; }
};

struct TrialOptions {
    double interval = 0.005;                 // between two rows, a multiple of the step [s]
    bool film = false;                       // keep rows for a page
    bool seat_acceleration = false;          // costs as much as a step each row
    std::function<bool(double)> keep_going;  // told the share done; false: stop
};

// Runs the scenario. A drive whose energy account is wrong counts as one whose mathematics gave up. Throws as Simulation does;
// where the scenario asks for more steering than the vehicle has, io::Error(numerical).
Trial drive(const VehicleDescription& vehicle, const ScenarioDescription& scenario, const TrialOptions& options = {});

}  // namespace hamilcar
