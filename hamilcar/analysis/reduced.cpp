#include "hamilcar/analysis/reduced.hpp"

#include <fmt/format.h>

#include <cmath>

namespace hamilcar {

ReducedCoordinates::ReducedCoordinates(const VehicleDescription& d, const Vehicle<double>& vehicle) {
    names_ = {"height",
              "roll",
              "pitch",
              "momentum.x",
              "momentum.y",
              "momentum.z",
              "angular_momentum.x",
              "angular_momentum.y",
              "angular_momentum.z"};
    const auto add = [this](int place, std::string name) {
        further_.push_back(place);
        names_.push_back(std::move(name));
    };
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const Suspension<double>& suspension = vehicle.suspensions[s];
        const SuspensionDescription& described = d.suspensions[s];
        for (int j = 0; j < suspension.linkage.nV(); ++j) {
            const std::string number = std::to_string(j + 1);
            add(suspension.offset + j, described.name + ".independent." + number);
            add(suspension.offset + suspension.linkage.nq() + j, described.name + ".momentum." + number);
        }
        for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
            const std::string& name = described.wheels[i].name;
            const int wheel = suspension.offset + suspension.wheels[i].offset;
            add(wheel, name + ".spin_momentum"), add(wheel + 1, name + ".brake_windup");
            for (int k = 0; k < suspension.wheels[i].tires; ++k) {
                const char* tire = k == 0 ? "" : "_2";
                add(wheel + 2 + 2 * k, fmt::format("{}.deflection_x{}", name, tire));
                add(wheel + 3 + 2 * k, fmt::format("{}.deflection_y{}", name, tire));
            }
        }
    }
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        const Trailer<double>& trailer = vehicle.trailers[i];
        const std::vector<std::string> angles = hitch_angles(d.trailers[i].hitch);
        for (int j = 0; j < trailer.freedoms(); ++j) {
            const std::string& angle = angles[static_cast<std::size_t>(j)];
            add(trailer.offset + j, d.trailers[i].name + ".hitch." + angle);
            add(trailer.offset + trailer.freedoms() + j, d.trailers[i].name + ".hitch_momentum." + angle);
        }
    }
}

std::vector<double> reduced_from(const ReducedCoordinates& reduced, const State<double>& state) {
    const Vector<double, 4> orientation = state.orientation();
    const Mat3<double> R = quaternion_rotation<double>(orientation);
    const Vector<double, 6> stored = state.momentum();
    std::vector<double> z{state.position()[2], std::atan2(R(2, 1), R(2, 2)), -std::asin(R(2, 0))};
    for (const Eigen::Index half : {0, 3}) {
        const Vec3<double> seen = R.transpose() * Vec3<double>(stored.segment<3>(half));
        z.insert(z.end(), seen.data(), seen.data() + 3);
    }
    for (const int place : reduced.further()) z.push_back(state.values[static_cast<std::size_t>(place)]);
    return z;
}

}  // namespace hamilcar
