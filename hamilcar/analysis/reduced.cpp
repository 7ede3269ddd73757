#include "hamilcar/analysis/reduced.hpp"

#include <cmath>

namespace hamilcar {

namespace {

// Suspensions, wheels and hitches but for what their independent coordinates imply.
bool is_free(StateKind kind) {
    switch (kind) {
        case StateKind::independent:
        case StateKind::suspension_momentum:
        case StateKind::spin_momentum:
        case StateKind::brake_windup:
        case StateKind::tire_deflection:
        case StateKind::hitch_angle:
        case StateKind::hitch_momentum: return true;
        default: return false;
    }
}

}  // namespace

ReducedCoordinates::ReducedCoordinates(const VehicleDescription& description)
    : numbers_{{StateKind::position, "height"},
               {StateKind::orientation, "roll"},
               {StateKind::orientation, "pitch"},
               {StateKind::momentum, "momentum.x"},
               {StateKind::momentum, "momentum.y"},
               {StateKind::momentum, "momentum.z"},
               {StateKind::angular_momentum, "angular_momentum.x"},
               {StateKind::angular_momentum, "angular_momentum.y"},
               {StateKind::angular_momentum, "angular_momentum.z"}} {
    const StateLayout layout(description);
    for (int place = 0; place < layout.size(); ++place) {
        const StateNumber& number = layout.numbers()[static_cast<std::size_t>(place)];
        if (!is_free(number.kind)) continue;
        further_.push_back(place);
        numbers_.push_back(number);
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
