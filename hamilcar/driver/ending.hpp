// What ends a run before its time is up.
#pragma once

#include <optional>
#include <string>

#include "hamilcar/description/driver.hpp"
#include "hamilcar/driver/path.hpp"
#include "hamilcar/driver/senses.hpp"

namespace hamilcar {

// All that later decisions depend on.
struct EndingMemory {
    enum class Reason { none, speed_below, speed_above, distance, station, path_offset, lateral_acceleration, roll };
    Reason reason = Reason::none;  // the first that came true
    double reached = 0, time = 0;  // what was found then
    bool begun = false;
    double x = 0, y = 0, lateral_velocity = 0, last_time = 0;  // at the last look
    double distance = 0;                                       // driven [m]
    double lateral_acceleration = 0;                           // smoothed [m/s^2]
};

class Ending {
public:
    // Throws std::invalid_argument if it asks about a path that there is not.
    Ending(const EndingDescription& description, bool follows_path);

    bool exists() const;
    // `place`: beside the path, where there is one.
    void look(const Senses& senses, const PathPlace& place, EndingMemory& memory) const;
    // What came true, with what was reached.
    std::optional<std::string> reason(const EndingMemory& memory) const;

private:
    void drive_on(const Senses& senses, EndingMemory& memory) const;

    EndingDescription limits_;
};

}  // namespace hamilcar
