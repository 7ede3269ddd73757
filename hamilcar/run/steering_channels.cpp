#include "hamilcar/run/steering_channels.hpp"

#include "hamilcar/base/units.hpp"

namespace hamilcar {

void add_steering_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    for (std::size_t i = 0; i < vehicle.axle_steers.size(); ++i) {
        list.push_back({{vehicle.axle_steers[i].axle + ".rack", "m", "displacement of the axle's own rack"},
                        [i](const auto& s) { return s.velocity.axle_racks[i].displacement; },
                        true});
    }
    if (!vehicle.steering.moves_on_its_own()) return;
    const auto add = [&](const char* name, const char* unit, const char* meaning, auto read, bool standard = false) {
        list.push_back({{name, unit, meaning}, read, standard});
    };
    add(
        "steering.rack", "m", "displacement of the rack", [](const auto& s) { return s.velocity.rack.displacement; },
        true);
    add("steering.rack_speed", "m/s", "of the rack", [](const auto& s) { return s.velocity.rack.rate; });
    add(
        "steering.wheel", "deg", "angle of the steering wheel, to the left positive",
        [](const auto& s) {
            using T = NumberOf<decltype(s)>;
            return T(s.model.vehicle.steering.state(s.state.values.data()).wheel / units::degree);
        },
        true);
    add("steering.wheel_speed", "deg/s", "of the steering wheel",
        [](const auto& s) { return s.momenta.steering.wheel_rate / units::degree; });
    add(
        "steering.hands_torque", "N m", "of the hands on the steering wheel, to the left positive",
        [](const auto& s) { return s.momenta.steering.hands_torque; }, true);
    add(
        "steering.bar_torque", "N m", "of the torsion bar on the pinion",
        [](const auto& s) { return s.momenta.steering.bar_torque; }, true);
    add(
        "steering.assist_force", "N", "of the power assist on the rack",
        [](const auto& s) { return s.momenta.steering.assist_force; }, true);
    add("steering.friction", "N", "dry and viscous, on the rack",
        [](const auto& s) { return s.momenta.steering.friction; });
    add("steering.tie_rods", "N", "of tie rods and wheels on the rack, with what accelerates them",
        [](const auto& s) { return s.momenta.on_rack; });
}

}  // namespace hamilcar
