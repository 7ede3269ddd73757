#include "hamilcar/block/road_wheels.hpp"

namespace hamilcar {

std::vector<RoadWheel> road_wheels(const Model<double>& model, const Momenta<double>& momenta, State<double>& state) {
    std::vector<RoadWheel> out;
    const Vehicle<double>& vehicle = model.vehicle;
    for (int i = 0; i < vehicle.spoke_count(); ++i) {
        const Spoke<double>& spoke = vehicle.spokes[static_cast<std::size_t>(i)];
        const SpokeState<double> at = state.spoke(i);
        out.push_back(
            {0,
             &spoke.brake,
             &at.brake_windup,
             {{&spoke.tire, &momenta.spokes[static_cast<std::size_t>(i)].forces, &at.deflection_x, &at.deflection_y}}});
    }
    for (std::size_t s = 0; s < vehicle.composed.size(); ++s) {
        const ComposedSpoke<double>& spoke = vehicle.composed[s];
        for (std::size_t i = 0; i < spoke.wheels.size(); ++i) {
            const ComposedWheel<double>& wheel = spoke.wheels[i];
            const auto at = spoke.wheel_state(static_cast<int>(i), state.values.data());
            RoadWheel& one = out.emplace_back(RoadWheel{spoke.unit, &wheel.brake, &at.brake_windup, {}});
            for (std::ptrdiff_t k = 0; k < wheel.tires; ++k) {
                one.tires.push_back({&wheel.tire,
                                     &momenta.composed.spokes[s].wheels[i].tires[static_cast<std::size_t>(k)],
                                     &at.deflection[2 * k], &at.deflection[2 * k + 1]});
            }
        }
    }
    return out;
}

Vec3<double> gravity_in_unit(const Model<double>& model, const Velocity<double>& velocity,
                             const Momenta<double>& momenta, int unit) {
    if (unit > 0) return momenta.composed.trailers[static_cast<std::size_t>(unit) - 1].surroundings.gravity;
    return velocity.R_GC.transpose() * Vec3<double>(0, 0, -model.vehicle.gravity);
}

double rolling_radius(const Tire<double>& tire) {
    return std::visit([](const auto& model) { return model.rolling_radius; }, tire);
}

Vec3<double> mass_moment(const Model<double>& model, const Velocity<double>& velocity) {
    const Vehicle<double>& vehicle = model.vehicle;
    std::vector<Vec3<double>> moment(vehicle.trailers.size() + 1);
    std::vector<double> mass(vehicle.trailers.size() + 1);
    moment[0] = vehicle.chassis_inertia.moment, mass[0] = vehicle.chassis.mass;
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        moment[i + 1] = vehicle.trailers[i].chassis_inertia.moment, mass[i + 1] = vehicle.trailers[i].chassis.mass;
    }
    for (int i = 0; i < vehicle.spoke_count(); ++i) {
        visit_spoke(vehicle, velocity, i, [&](const auto&, const auto&, const auto& at) {
            moment[0] += at.inertia.moment, mass[0] += at.inertia.mass;
        });
    }
    for (std::size_t s = 0; s < vehicle.composed.size(); ++s) {
        const auto unit = static_cast<std::size_t>(vehicle.composed[s].unit);
        for (std::size_t i = 0; i < vehicle.composed[s].bodies.size(); ++i) {
            const SpatialInertia<double>& inertia = velocity.composed.spokes[s].inertia[i];
            moment[unit] += inertia.moment, mass[unit] += inertia.mass;
        }
    }
    for (std::size_t i = vehicle.trailers.size(); i > 0; --i) {
        const auto tow = static_cast<std::size_t>(vehicle.trailers[i - 1].tow);
        const Pose<double>& pose = velocity.composed.trailers[i - 1].pose;
        moment[tow] += pose.R * moment[i] + mass[i] * pose.p;
        mass[tow] += mass[i];
    }
    return moment[0];
}

}  // namespace hamilcar
