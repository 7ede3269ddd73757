// Follows a path with the steering wheel: optimal preview control, plus an integral of the offset that compensates errors of the
// driver's internal model, so that the offset vanishes on a circle.
#pragma once

#include "hamilcar/driver/observation.hpp"
#include "hamilcar/driver/path.hpp"
#include "hamilcar/driver/preview.hpp"
#include "hamilcar/driver/steering_actuator.hpp"
#include "hamilcar/math/signal.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

// Everything that later decisions depend on.
struct PathMemory {
    bool begun = false;
    double station = 0, offset = 0;  // of the center of mass now [m]
    double shift = 0;                // integral of the offset, expressed as a distance [m]
    double farthest = 0;             // largest offset so far, on either side [m]
    double farthest_station = 0;     // where it occurred [m]
};

class PathFollower {
public:
    // Throws std::invalid_argument if the car has no steering.
    PathFollower(const PathFollowerDescription& description, const DrivenCar& car, const Column& column);

    // Locates the car relative to the path.
    void update(const Observation& observation, PathMemory& memory) const;
    // Motion of the rack over the next interval; `rack`: its present motion.
    SignalValue<double> steer(const Observation& observation, const SignalValue<double>& rack, double interval,
                              PathMemory& memory) const;

    const Path& path() const { return path_; }

private:
    double wanted_angle(const Observation& observation, const LateralState& now, double speed, double interval,
                        PathMemory& memory) const;

    Path path_;
    Preview preview_;
    SteeringActuator actuator_;
    Column column_;
    double wheels_per_angle_;
};

}  // namespace hamilcar
