// Conditions that end a run early.
#pragma once

#include <optional>
#include <string>

#include "hamilcar/description/driver.hpp"
#include "hamilcar/driver/observation.hpp"
#include "hamilcar/driver/path.hpp"

namespace hamilcar {

// Everything that later decisions depend on.
struct EndingMemory {
    enum class Reason { none, speed_below, speed_above, distance, station, path_offset, lateral_acceleration, roll };
    Reason reason = Reason::none;  // the first condition that was met
    double reached = 0, time = 0;  // value and time at which it was met
    bool begun = false;
    double x = 0, y = 0, lateral_velocity = 0, last_time = 0;  // at the last update
    double distance = 0;                                       // driven [m]
    double lateral_acceleration = 0;                           // smoothed [m/s^2]
};

class Ending {
public:
    // Throws std::invalid_argument for a condition on a path if there is none.
    Ending(const EndingDescription& description, bool follows_path);

    bool exists() const;
    // `place`: position relative to the path, if there is one.
    void update(const Observation& observation, const PathPlace& place, EndingMemory& memory) const;
    // The condition that was met, with the value reached.
    std::optional<std::string> reason(const EndingMemory& memory) const;

private:
    void integrate(const Observation& observation, EndingMemory& memory) const;

    EndingDescription limits_;
};

}  // namespace hamilcar
