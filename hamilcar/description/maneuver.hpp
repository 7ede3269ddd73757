// Which standard maneuver to drive, as a person writes it down.
#pragma once

#include <map>
#include <string>
#include <variant>

namespace hamilcar {

// Settings as they were typed, by the names that the maneuver lists: a number in the unit that it lists, or a word, "left". True
// and false are the words "yes" and "no".
using TypedSettings = std::map<std::string, std::variant<double, std::string>>;

struct ManeuverDescription {
    std::string name;  // "double_lane_change"; empty: none
    TypedSettings settings;
};

}  // namespace hamilcar
