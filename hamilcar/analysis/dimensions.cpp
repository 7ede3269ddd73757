#include "hamilcar/analysis/dimensions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hamilcar {

namespace {

// Calls f(body) for everything that has mass.
template <class F>
void for_each_body(const VehicleDescription& vehicle, F&& f) {
    f(vehicle.chassis);
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        for (const SuspensionBodyDescription& body : suspension.bodies) f(body.body);
    }
    for (const TrailerDescription& trailer : vehicle.trailers) f(trailer.chassis);
}

}  // namespace

double total_mass(const VehicleDescription& vehicle) {
    double mass = 0;
    for_each_body(vehicle, [&](const BodyDescription& body) { mass += body.mass; });
    return mass;
}

bool is_heavy(const VehicleDescription& vehicle) {
    constexpr double limit = 3500;  // [kg]
    return total_mass(vehicle) > limit;
}

double full_brake_force(const VehicleDescription& vehicle) {
    double force = 0;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        force += wheel.brake.max_torque / casing_of(wheel.tire).rolling_radius;
    });
    return force;
}

double brake_force_per_command(const VehicleDescription& vehicle) {
    return full_brake_force(vehicle) * vehicle.brakes.gain_below_knee();
}

std::vector<std::string> wheel_names(const VehicleDescription& vehicle) {
    std::vector<std::string> out;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) { out.push_back(wheel.name); });
    return out;
}

std::vector<double> rolling_radii(const VehicleDescription& vehicle) {
    std::vector<double> out;
    for_each_wheel(vehicle,
                   [&](const auto& wheel, std::size_t) { out.push_back(casing_of(wheel.tire).rolling_radius); });
    return out;
}

double track_width(const VehicleDescription& vehicle) {
    constexpr double min_width = 0.5;  // where all wheels follow each other in one track [m]
    double left = 0, right = 0;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        left = std::max(left, wheel.wheel.center[1]), right = std::min(right, wheel.wheel.center[1]);
    });
    return std::max(left - right, min_width);
}

double tipping_acceleration(const VehicleDescription& vehicle) {
    double mass = 0, moment = 0;
    for_each_body(
        vehicle, [&](const BodyDescription& body) { mass += body.mass, moment += body.mass * body.center_of_mass[2]; });
    double half_track = 1e9, ground = 1e9;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        half_track = std::min(half_track, std::abs(wheel.wheel.center[1]));
        ground = std::min(ground, wheel.wheel.center[2] - casing_of(wheel.tire).radius);
    });
    return vehicle.gravity * half_track / (moment / mass - ground);
}

std::vector<Axle> axles(const VehicleDescription& vehicle) {
    constexpr double one_place = 0.2;  // wheels within that are on one axle [m]
    std::vector<Axle> out;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t unit) {
        const double x = wheel.wheel.center[0];
        const auto same = [&](const Axle& a) { return std::abs(a.x - x) < one_place && a.of_trailer == (unit > 0); };
        auto axle = std::ranges::find_if(out, same);
        if (axle == out.end()) {
            const std::string name = wheel.name.substr(0, wheel.name.find_last_of('_'));
            axle = out.insert(out.end(), Axle{name, {}, x, unit > 0});
        }
        axle->wheels.push_back(wheel.name);
    });
    std::ranges::stable_sort(out, [](const Axle& a, const Axle& b) { return a.x > b.x; });
    for (std::size_t i = 0; i < out.size(); ++i) out[i].name = fmt::format("axle {} ({})", i + 1, out[i].name);
    return out;
}

double half_tire(const VehicleDescription& vehicle) {
    constexpr double min_half = 0.1;     // [m]
    constexpr double per_radius = 0.27;  // 11 R 22.5: 0.28 m wide, 1.05 m high
    double half = min_half;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        half = std::max(half, per_radius * casing_of(wheel.tire).radius);
    });
    return half;
}

Footprint footprint(const VehicleDescription& vehicle) {
    const Point& center = vehicle.chassis.center_of_mass;
    const double half = half_tire(vehicle);
    Footprint box{-1e9, 1e9, -1e9, 1e9};
    const auto add = [&](double x, double y, double beside, double ahead) {
        box.front = std::max(box.front, x - center[0] + ahead), box.rear = std::min(box.rear, x - center[0] - ahead);
        box.left = std::max(box.left, y - center[1] + beside), box.right = std::min(box.right, y - center[1] - beside);
    };
    for (const Point& point : vehicle.hull.points) add(point[0], point[1], 0, 0);
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t unit) {
        const Point& at = wheel.wheel.center;
        if (unit == 0) add(at[0], at[1], half + 0.5 * wheel.dual_spacing, at[2]);
    });
    return box;
}

double rear_end(const VehicleDescription& vehicle) {
    double rear = footprint(vehicle).rear;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        const Point& at = wheel.wheel.center;
        rear = std::min(rear, at[0] - at[2] - vehicle.chassis.center_of_mass[0]);
    });
    return rear;
}

}  // namespace hamilcar
