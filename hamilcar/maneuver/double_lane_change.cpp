// ISO 3888-1: out into the next lane and back. Lengths and widths as in the diagrams of public simulators (Project Chrono's
// demo_VEH_DoubleLaneChange; Simscape Vehicle Templates): lanes of 15, 25 and 30 m (the last one of two sections of 15 m),
// gaps of 30 and 25 m, widths of 1.1, 1.2 and 1.3 vehicle widths and 0.25 m. The offset of 3.5 m is between right borders.
#include "hamilcar/maneuver/catalog.hpp"
#include "hamilcar/maneuver/lane_change.hpp"

namespace hamilcar {

namespace {

constexpr double offset = 3.5;  // of the second lane's right border to the left of the others' [m]

LaneChange lane_change(const VehicleDescription& vehicle) {
    constexpr double play = 0.25;  // [m]
    const double b = footprint(vehicle).width();
    const double right = -0.5 * (1.1 * b + play);  // the first lane's middle is y = 0
    return {.title = "Double lane change",
            .lanes = {{0, 15, right, right + 1.1 * b + play},
                      {45, 70, right + offset, right + offset + 1.2 * b + play},
                      {95, 125, right, right + 1.3 * b + play}},
            .lift = {}};
}

std::vector<Setting> settings(const VehicleDescription& vehicle) {
    constexpr double standard = 80, asked = 7;  // [km/h], [m/s^2]
    return lane_change_settings(default_entry_speed(vehicle, standard, asked), false);
}

}  // namespace

Maneuver double_lane_change() {
    return through_lanes(lane_change, {.name = "double_lane_change",
                                       .title = "Double lane change",
                                       .standard = "ISO 3888-1",
                                       .summary = "Out into the next lane and back between cones, at a held speed.",
                                       .settings = settings});
}

}  // namespace hamilcar
