#include "hamilcar/driver/ending.hpp"

#include <cmath>
#include <stdexcept>

#include "hamilcar/base/units.hpp"
#include "hamilcar/driver/short_number.hpp"

namespace hamilcar {

namespace {

using Reason = EndingMemory::Reason;

constexpr double smoothing = 0.05;  // of the lateral acceleration [s]

}  // namespace

Ending::Ending(const EndingDescription& description, bool follows_path) : limits_(description) {
    if (follows_path || (!limits_.station && !limits_.path_offset)) return;
    throw std::invalid_argument(std::string("an end condition on the ") +
                                (limits_.station ? "station along" : "offset from") +
                                " the path requires a path to follow");
}

bool Ending::exists() const {
    return limits_.speed_below || limits_.speed_above || limits_.distance || limits_.station || limits_.path_offset ||
           limits_.lateral_acceleration || limits_.roll;
}

// Distance by chords; lateral acceleration v_y' + r v, the rate by differences.
void Ending::integrate(const Observation& observation, EndingMemory& memory) const {
    const double passed = observation.time - memory.last_time;
    if (memory.begun && passed > 0) {
        const double dx = observation.x - memory.x, dy = observation.y - memory.y;
        memory.distance += std::sqrt(dx * dx + dy * dy);
        const double now = (observation.lateral_velocity - memory.lateral_velocity) / passed +
                           observation.yaw_rate * observation.speed;
        memory.lateral_acceleration += (now - memory.lateral_acceleration) * passed / (smoothing + passed);
    }
    if (!memory.begun) memory.lateral_acceleration = observation.yaw_rate * observation.speed;
    memory.begun = true;
    memory.x = observation.x, memory.y = observation.y;
    memory.lateral_velocity = observation.lateral_velocity, memory.last_time = observation.time;
}

void Ending::update(const Observation& observation, const PathPlace& place, EndingMemory& memory) const {
    integrate(observation, memory);
    if (memory.reason != Reason::none || observation.time < limits_.earliest) return;
    const auto end = [&](bool is_met, Reason reason, double reached) {
        if (!is_met || memory.reason != Reason::none) return;
        memory.reason = reason, memory.reached = reached, memory.time = observation.time;
    };
    const auto beyond = [&](const std::optional<double>& limit, Reason reason, double reached) {
        end(limit && reached >= *limit, reason, reached);
    };
    end(limits_.speed_below && observation.speed < *limits_.speed_below, Reason::speed_below, observation.speed);
    beyond(limits_.speed_above, Reason::speed_above, observation.speed);
    beyond(limits_.distance, Reason::distance, memory.distance);
    beyond(limits_.station, Reason::station, place.station);
    beyond(limits_.path_offset, Reason::path_offset, std::abs(place.offset));
    beyond(limits_.lateral_acceleration, Reason::lateral_acceleration, std::abs(memory.lateral_acceleration));
    beyond(limits_.roll, Reason::roll, std::abs(observation.roll));
}

std::optional<std::string> Ending::reason(const EndingMemory& memory) const {
    const std::string reached = short_number(memory.reached);
    const auto end = [&](const std::string& text) { return text + " at " + short_number(memory.time) + " s"; };
    switch (memory.reason) {
        case Reason::speed_below: return end("speed fell below " + short_number(*limits_.speed_below) + " m/s");
        case Reason::speed_above: return end("speed reached " + reached + " m/s");
        case Reason::distance: return end("distance reached " + reached + " m");
        case Reason::station: return end("reached " + reached + " m along the path");
        case Reason::path_offset: return end("left the path by " + reached + " m");
        case Reason::lateral_acceleration: return end("lateral acceleration reached " + reached + " m/s^2");
        case Reason::roll: return end("roll angle reached " + short_number(memory.reached / units::degree) + " deg");
        case Reason::none: break;
    }
    return {};
}

}  // namespace hamilcar
