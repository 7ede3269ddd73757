// Follows a path with the steering wheel: optimal preview, and an integral of the offset that takes back what the driver's
// idea of the car leaves open, so that it vanishes on a circle.
#pragma once

#include "hamilcar/driver/arms.hpp"
#include "hamilcar/driver/path.hpp"
#include "hamilcar/driver/preview.hpp"
#include "hamilcar/driver/senses.hpp"
#include "hamilcar/math/signal.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

// All that later decisions depend on.
struct PathMemory {
    bool begun = false;
    double station = 0, offset = 0;  // of the center of mass now [m]
    double shift = 0;                // integral of the offset, as a distance [m]
    double farthest = 0;             // offset so far, either side [m]
    double farthest_station = 0;     // where that was [m]
};

class PathFollower {
public:
    // Throws std::invalid_argument where the car has nothing to steer with.
    PathFollower(const PathFollowerDescription& description, const DrivenCar& car, const Column& column);

    // Finds the car beside the path.
    void look(const Senses& senses, PathMemory& memory) const;
    // How the rack is to go on over the coming interval; `rack` as it moves now.
    SignalValue<double> steer(const Senses& senses, const SignalValue<double>& rack, double interval,
                              PathMemory& memory) const;

    const Path& path() const { return path_; }

private:
    double wanted_angle(const Senses& senses, const LateralState& now, double speed, double interval,
                        PathMemory& memory) const;

    Path path_;
    Preview preview_;
    Arms arms_;
    Column column_;
    double wheels_per_angle_;
};

}  // namespace hamilcar
