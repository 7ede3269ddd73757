// What tests of lateral dynamics share: an amplitude that a vehicle can drive, angles of the steering wheel over time at a
// speed that the driver holds, and a run's place in the share that is done.
#pragma once

#include "hamilcar/analysis/series_tools.hpp"
#include "hamilcar/maneuver/common.hpp"

namespace hamilcar {

inline constexpr double straight_ahead = 4;  // before the steering wheel turns: a driver's foot has found its place [s]

// Beyond 3.5 t, UN's classes N2, N3, M2 and M3: usual speeds and accelerations are smaller.
bool is_heavy(const VehicleDescription& vehicle);

// The setting "speed"; usual values of cars and of heavy vehicles [km/h].
Setting speed_setting(const VehicleDescription& vehicle, double usual, double usual_heavy);
// The setting "lateral_acceleration" that an angle of the steering wheel is chosen for [m/s^2].
Setting acceleration_setting(const VehicleDescription& vehicle, double usual, double usual_heavy,
                             const std::string& meaning);

// A steering wheel angle and the lateral acceleration that it leads to in steady driving, by Newton's method on the whole
// vehicle; less than wanted where tires or stops allow no more, with a note.
struct Amplitude {
    double angle;                 // [rad]
    double lateral_acceleration;  // [m/s^2]
    std::string note;
};
Amplitude amplitude_for(const VehicleDescription& vehicle, double speed, double lateral_acceleration);

// The car at a speed with its steering wheel turned so; lasts until the last angle.
ScenarioDescription steered_at(const VehicleDescription& vehicle, const ManeuverOptions& options, double speed,
                               SignalDescription angle);

// An angle as a function of time, as a table fine enough for its cubics; from 0 to `duration` [s].
SignalDescription tabulated(const std::function<double(double)>& angle, double duration);

// Drives, as the part from one share of the maneuver to another.
struct Share {
    double from = 0, to = 1;
};
Trial drive_share(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                  const ManeuverOptions& options, double interval, Share part = {});

// Drives with an amplitude, and again with a better one where the lateral acceleration is off, since linear theory knows no
// locking differentials. The last drive counts; those before leave their energy in the outcome.
struct Aim {
    double lateral_acceleration;  // [m/s^2]
    std::function<ScenarioDescription(double angle)> scenario;
    std::function<double(const History&)> reached;  // [m/s^2]
};
Trial drive_aimed(const VehicleDescription& vehicle, const Aim& aim, double angle, const ManeuverOptions& options,
                  double interval, Outcome& outcome);

// A column of a history as a series.
Series series_of(const History& history, const std::vector<double>& column);
// Mean of a column over [from, to] s; NaN where there are no rows.
double mean_over(const History& history, const std::vector<double>& column, double from, double to);
std::vector<double> sideslip_of(const History& history);

// Curves in degrees, or another multiple.
std::vector<double> scaled(std::vector<double> values, double factor);
// "speed within 2 km/h of 80 km/h from 3 s to 4 s": whether the driver held it.
Verdict speed_held(const History& history, double wanted, double from, double to);

}  // namespace hamilcar
