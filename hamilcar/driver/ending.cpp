#include "hamilcar/driver/ending.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "hamilcar/driver/words.hpp"

namespace hamilcar {

namespace {

using Reason = EndingMemory::Reason;

constexpr double smoothing = 0.05;  // of the lateral acceleration [s]
constexpr double degree = std::numbers::pi / 180;

}  // namespace

Ending::Ending(const EndingDescription& description, bool follows_path) : limits_(description) {
    if (follows_path || (!limits_.station && !limits_.path_offset)) return;
    throw std::invalid_argument(std::string("an end by the ") + (limits_.station ? "station on" : "offset from") +
                                " the path needs a path to follow");
}

bool Ending::exists() const {
    return limits_.speed_below || limits_.speed_above || limits_.distance || limits_.station || limits_.path_offset ||
           limits_.lateral_acceleration || limits_.roll;
}

// Distance by chords; lateral acceleration v_y' + r v, the rate by differences.
void Ending::drive_on(const Senses& senses, EndingMemory& memory) const {
    const double passed = senses.time - memory.last_time;
    if (memory.begun && passed > 0) {
        const double dx = senses.x - memory.x, dy = senses.y - memory.y;
        memory.distance += std::sqrt(dx * dx + dy * dy);
        const double now =
            (senses.lateral_velocity - memory.lateral_velocity) / passed + senses.yaw_rate * senses.speed;
        memory.lateral_acceleration += (now - memory.lateral_acceleration) * passed / (smoothing + passed);
    }
    if (!memory.begun) memory.lateral_acceleration = senses.yaw_rate * senses.speed;
    memory.begun = true;
    memory.x = senses.x, memory.y = senses.y;
    memory.lateral_velocity = senses.lateral_velocity, memory.last_time = senses.time;
}

void Ending::look(const Senses& senses, const PathPlace& place, EndingMemory& memory) const {
    drive_on(senses, memory);
    if (memory.reason != Reason::none || senses.time < limits_.earliest) return;
    const auto end = [&](bool comes_true, Reason reason, double reached) {
        if (!comes_true || memory.reason != Reason::none) return;
        memory.reason = reason, memory.reached = reached, memory.time = senses.time;
    };
    const auto beyond = [&](const std::optional<double>& limit, Reason reason, double reached) {
        end(limit && reached >= *limit, reason, reached);
    };
    end(limits_.speed_below && senses.speed < *limits_.speed_below, Reason::speed_below, senses.speed);
    beyond(limits_.speed_above, Reason::speed_above, senses.speed);
    beyond(limits_.distance, Reason::distance, memory.distance);
    beyond(limits_.station, Reason::station, place.station);
    beyond(limits_.path_offset, Reason::path_offset, std::abs(place.offset));
    beyond(limits_.lateral_acceleration, Reason::lateral_acceleration, std::abs(memory.lateral_acceleration));
    beyond(limits_.roll, Reason::roll, std::abs(senses.roll));
}

std::optional<std::string> Ending::reason(const EndingMemory& memory) const {
    const std::string reached = spoken(memory.reached);
    const auto end = [&](const std::string& words) { return words + " at " + spoken(memory.time) + " s"; };
    switch (memory.reason) {
        case Reason::speed_below: return end("speed fell below " + spoken(*limits_.speed_below) + " m/s");
        case Reason::speed_above: return end("speed reached " + reached + " m/s");
        case Reason::distance: return end("driven " + reached + " m");
        case Reason::station: return end("came to " + reached + " m along the path");
        case Reason::path_offset: return end("left the path by " + reached + " m");
        case Reason::lateral_acceleration: return end("lateral acceleration reached " + reached + " m/s^2");
        case Reason::roll: return end("roll angle reached " + spoken(memory.reached / degree) + " deg");
        case Reason::none: break;
    }
    return {};
}

}  // namespace hamilcar
