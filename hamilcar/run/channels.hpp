// The one list of channels: name, unit, meaning and how to read it. Result columns, plots and every skin come from here.
//
// Angles are in degrees where people read them; the unit says so. Ground axes and vehicle axes follow ISO 8855.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hamilcar/io/results.hpp"
#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

struct Channel {
    io::Column column;
    std::function<double(const Sample&)> read;
    bool standard = false;  // part of the default set
};

// Every channel of a vehicle: the car's own, then each wheel's and each suspension's with its name in front.
std::vector<Channel> all_channels(const VehicleDescription& vehicle);

// The channels whose names match (a trailing '*' stands for anything); the default set for an empty list. Throws
// io::Error(bad_file) for a name that matches nothing, with the nearest known one.
std::vector<Channel> select_channels(const std::vector<Channel>& all, const std::vector<std::string>& names,
                                     const std::shared_ptr<const Places>& places = nullptr);

// Adds the channels that are not among the chosen ones, and of all those that a picture of the vehicle is drawn from.
void add_missing(const std::vector<Channel>& further, std::vector<Channel>& chosen);
void add_missing_motion(const std::vector<Channel>& all, std::vector<Channel>& chosen);

}  // namespace hamilcar
