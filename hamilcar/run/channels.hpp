// The one list of channels: name, unit, meaning and how to read it. Result columns, plots and every skin come from here.
//
// Angles are in degrees where people read them; the unit says so. Ground axes and vehicle axes follow ISO 8855.
#pragma once

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hamilcar/engine/traced_sample.hpp"
#include "hamilcar/io/results.hpp"
#include "hamilcar/run/simulation.hpp"

namespace hamilcar {

// A reader for any kind of numbers, `[](const auto& s)`, also reads recorded ones, so that batches have it compiled; one that takes a
// Sample alone does not.
struct Channel {
    io::Column column;
    std::function<double(const Sample&)> read;
    bool standard = false;                               // part of the default set
    std::function<Traced<>(const TracedSample&)> trace;  // null where it is not compiled

    template <class Read>
    Channel(io::Column of, Read reader, bool is_standard = false)
        : column(std::move(of)), read(reader), standard(is_standard) {
        if constexpr (std::is_invocable_v<Read, const TracedSample&>) {
            trace = [reader](const TracedSample& s) -> Traced<> { return reader(s); };
        }
    }
};

// Of a sample that a reader takes, `decltype(s)`.
template <class SampleReference>
using NumberOf = typename std::remove_cvref_t<SampleReference>::Number;

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
