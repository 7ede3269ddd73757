#include "hamilcar/block/road_wheels.hpp"

namespace hamilcar {

std::vector<RoadWheel> road_wheels(const Model<double>& model, const Momenta<double>& momenta, State<double>& state) {
    std::vector<RoadWheel> out;
    const Vehicle<double>& vehicle = model.vehicle;
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const Suspension<double>& suspension = vehicle.suspensions[s];
        for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
            const SuspensionWheel<double>& wheel = suspension.wheels[i];
            const auto at = suspension.wheel_state(static_cast<int>(i), state.values.data());
            RoadWheel& one =
                out.emplace_back(RoadWheel{suspension.unit, out.size(), &wheel.brake, &at.brake_windup, {}});
            for (std::ptrdiff_t k = 0; k < wheel.tires; ++k) {
                one.tires.push_back({&wheel.tire, &momenta.suspensions[s].wheels[i].tires[static_cast<std::size_t>(k)],
                                     &at.deflection[2 * k], &at.deflection[2 * k + 1]});
            }
        }
    }
    return out;
}

Vec3<double> gravity_in_unit(const Model<double>& model, const Velocity<double>& velocity,
                             const Momenta<double>& momenta, int unit) {
    if (unit > 0) return momenta.trailers[static_cast<std::size_t>(unit) - 1].surroundings.gravity;
    return velocity.R_GC.transpose() * Vec3<double>(0, 0, -model.vehicle.gravity);
}

double rolling_radius(const Tire<double>& tire) {
    return std::visit([](const auto& model) { return model.rolling_radius; }, tire);
}

Vec3<double> mass_moment(const Model<double>& model, const Velocity<double>& velocity) {
    const Vehicle<double>& vehicle = model.vehicle;
    std::vector<Vec3<double>> moment(vehicle.trailers.size() + 1);
    std::vector<double> mass(vehicle.trailers.size() + 1);
    moment[0] = vehicle.chassis_inertia.first_moment, mass[0] = vehicle.chassis.mass;
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        moment[i + 1] = vehicle.trailers[i].chassis_inertia.first_moment,
                   mass[i + 1] = vehicle.trailers[i].chassis.mass;
    }
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const auto unit = static_cast<std::size_t>(vehicle.suspensions[s].unit);
        for (std::size_t i = 0; i < vehicle.suspensions[s].bodies.size(); ++i) {
            const SpatialInertia<double>& inertia = velocity.suspensions[s].inertia[i];
            moment[unit] += inertia.first_moment, mass[unit] += inertia.mass;
        }
    }
    for (std::size_t i = vehicle.trailers.size(); i > 0; --i) {
        const auto tow = static_cast<std::size_t>(vehicle.trailers[i - 1].tow);
        const Pose<double>& pose = velocity.trailers[i - 1].pose;
        moment[tow] += pose.R * moment[i] + mass[i] * pose.p;
        mass[tow] += mass[i];
    }
    return moment[0];
}

}  // namespace hamilcar
