// What tests of lateral dynamics share: settings, an amplitude of the steering wheel that a vehicle can drive, and drives that
// aim at a lateral acceleration.
#pragma once

#include "hamilcar/maneuver/scenarios.hpp"

namespace hamilcar {

// The setting "speed"; default values of cars and of heavy vehicles [km/h].
Setting speed_setting(const VehicleDescription& vehicle, double default_value, double default_heavy);
// The setting "lateral_acceleration" that an angle of the steering wheel is chosen for [m/s^2].
Setting acceleration_setting(const VehicleDescription& vehicle, double default_value, double default_heavy,
                             const std::string& meaning);

// A steering wheel angle and the lateral acceleration that it leads to in steady driving, by Newton's method on the whole
// vehicle; less than wanted where tires or stops allow no more, with a note.
struct Amplitude {
    double angle;                 // [rad]
    double lateral_acceleration;  // [m/s^2]
    std::string note;
};
Amplitude amplitude_for(const VehicleDescription& vehicle, double speed, double lateral_acceleration);
// The angle alone, with the note among the outcome's [rad].
double angle_for(TestRun& test, double speed, double lateral_acceleration);

// Drives with an amplitude, and again with a better one where the lateral acceleration is off, since linear theory knows no
// locking differentials. The last drive counts; those before leave their energy in the outcome.
struct Aim {
    double lateral_acceleration;                              // [m/s^2]
    std::function<SignalDescription(double angle)> steering;  // over time [rad]
    std::function<double(const Recording&)> reached;          // [m/s^2]
    double interval;                                          // between rows [s]
};
Drive drive_aimed(TestRun& test, const Aim& aim, double speed, double angle);

// "speed within 2 km/h of 80 km/h from 3 s to 4 s": whether the driver held it, by default in the second before the steering.
void judge_speed(TestRun& test, const Recording& recording, double from = straight_ahead - 1,
                 double to = straight_ahead);
// "lateral acceleration within 10 percent of 4 m/s^2", the setting "lateral_acceleration".
void judge_lateral_acceleration(TestRun& test, const std::string& what, double reached);

}  // namespace hamilcar
