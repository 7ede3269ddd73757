// ISO 3888-2: round an obstacle and back, after the VDA's test. Lengths and widths as public simulators have them (Project
// Chrono's demo_VEH_DoubleLaneChange): lanes of 12, 11 and 12 m, gaps of 13.5 and 12.5 m, 61 m in all; widths of 1.1 vehicle
// widths and 0.25 m, of a vehicle width and 1 m, and of 1.3 vehicle widths and 0.25 m, at least 3 m. The second lane begins
// 1 m to the left of the others, whose left borders are in line. The throttle is released 2 m behind the first cones.
#include <algorithm>

#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/lane_change.hpp"

namespace hamilcar {

namespace {

constexpr double offset = 1;   // from the first lane's left border to the second one's right border [m]
constexpr double release = 2;  // of the throttle, behind the first cones [m]

LaneChange lane_change(const VehicleDescription& vehicle) {
    constexpr double play = 0.25, wide_play = 1, min_exit = 3;  // [m]
    const double b = footprint(vehicle).width(), entry = 1.1 * b + play, exit = std::max(1.3 * b + play, min_exit);
    const double left = 0.5 * entry;  // the first lane's middle is y = 0
    return {.title = "Obstacle avoidance",
            .lanes = {{0, 12, left - entry, left},
                      {25.5, 36.5, left + offset, left + offset + b + wide_play},
                      {49, 61, left - exit, left}},
            .lift = release};
}

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    constexpr double moderate = 60, asked = 8;  // [km/h], [m/s^2]; the standard leaves the speed open
    return lane_change_settings(default_entry_speed(vehicle, moderate, asked), true);
}

}  // namespace

Maneuver obstacle_avoidance() {
    return through_lanes(
        lane_change,
        {.name = "obstacle_avoidance",
         .title = "Obstacle avoidance",
         .standard = "ISO 3888-2",
         .summary = "Round an obstacle and back between cones with the throttle released, as fast as no cone falls.",
         .settings = settings});
}

}  // namespace hamilcar
