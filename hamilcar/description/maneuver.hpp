// Which standard maneuver to drive, as a person writes it down.
#pragma once

#include <map>
#include <string>

namespace hamilcar {

struct ManeuverDescription {
    std::string name;                        // "double_lane_change"; empty: none
    std::map<std::string, double> settings;  // by the names that the maneuver lists, in the units it lists
};

}  // namespace hamilcar
