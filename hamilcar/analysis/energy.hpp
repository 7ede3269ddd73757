// Energy of a car, and the balance that must hold whatever the driver does: kinetic + potential - prescribed - work is
// constant (docs/theory/formulation.md, energy). The prescribed part, sum x.h, is what the motion of the rack holds.
#pragma once

#include <array>

#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

template <class T>
struct Energy {
    T kinetic, potential, prescribed, work;  // [J]
    T balance() const { return kinetic + potential - prescribed - work; }
};

// Of one suspension; `height` of a point in the axes of its unit.
template <class T, class Height>
void add_energy_of(const Suspension<T>& suspension, const SuspensionVelocity<T>& at,
                   const SuspensionMomenta<T>& momenta, const State<T>& state, const T& gravity, const Height& height,
                   RackKind rack, Energy<T>& e) {
    for (std::size_t i = 0; i < suspension.bodies.size(); ++i) {
        const auto& [frame, body] = suspension.bodies[i];
        const Spatial<T>& motion = at.motion[frame];
        const Spatial<T> Mv = at.inertia[i] * motion;
        e.kinetic += T(0.5) * motion.dot(Mv);
        e.potential += body.mass * gravity * height(at.at.pose[frame].point(body.center));
        if (rack == RackKind::prescribed) e.prescribed += at.at.motion.x[frame].dot(Mv);
    }
    for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
        const SuspensionWheel<T>& wheel = suspension.wheels[i];
        const T p_s = suspension.wheel_state(static_cast<int>(i), state.values.data()).spin_momentum;
        const WheelForces<T>& f = momenta.wheels[i];
        e.kinetic += T(0.5) * p_s * p_s / wheel.wheel.spin_inertia;
        e.potential += wheel.bump.potential(f.travel) + wheel.rebound.potential(T(-f.travel));
        for (int k = 0; k < wheel.tires; ++k) {
            e.potential +=
                std::visit([&](const auto& tire) { return tire.potential(f.tires[k].frame.depth); }, wheel.tire);
        }
        if (rack == RackKind::prescribed) {
            e.prescribed += angular(at.at.motion.x[wheel.frame]).dot(at.spin_momentum[i]);
        }
    }
    for (std::size_t i = 0; i < suspension.springs.size(); ++i) {
        e.potential += suspension.springs[i].spring.potential(momenta.springs[i].length);
    }
}

// Suspensions, the bars between their wheels, trailers.
template <class T>
void add_suspension_energy(const Model<T>& model, const State<T>& state, const Velocity<T>& velocity,
                           const Momenta<T>& momenta, Energy<T>& e) {
    const Vehicle<T>& vehicle = model.vehicle;
    std::array<UnitPose<T>, max_trailers + 1> places;
    places[0] = {state.position(), velocity.R_GC};
    const auto height_in = [&](std::size_t unit) {
        return [&place = places[unit]](const Vec3<T>& p) { return place.R.row(2).dot(p) + place.position[2]; };
    };
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        const Trailer<T>& trailer = vehicle.trailers[i];
        const TrailerVelocity<T>& at = velocity.trailers[i];
        places[i + 1] = behind(places[static_cast<std::size_t>(trailer.tow)], at.pose);
        e.kinetic += T(0.5) * at.motion.dot(trailer.chassis_inertia * at.motion);
        e.potential += trailer.chassis.mass * vehicle.gravity * height_in(i + 1)(trailer.chassis.center);
    }
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const Suspension<T>& suspension = vehicle.suspensions[s];
        add_energy_of(suspension, velocity.suspensions[s], momenta.suspensions[s], state, vehicle.gravity,
                      height_in(static_cast<std::size_t>(suspension.unit)),
                      vehicle.steering.exists() && suspension.follows_rack() ? RackKind::free : RackKind::prescribed,
                      e);
    }
    const std::array<T, max_vehicle_wheels> deflection = bar_deflections(vehicle, state, velocity);
    for (const AntiRollBar<T>& bar : vehicle.anti_roll_bars) {
        const T difference = deflection[bar.left] - deflection[bar.right];
        e.potential += T(0.5) * bar.rate * difference * difference;
    }
}

// The plane that the hull is held against.
template <class T>
TangentPlane<T> hull_road(const Model<T>& model, const State<T>& state, const Velocity<T>& velocity) {
    UnevenGround<T> uneven;
    const UnitPose<T> place{state.position(), velocity.R_GC};
    const TangentPlane<T> plane = model.road.seen_from(place.position, place.R);
    return ground_of_hull(ground_below(model, place, plane, 0, uneven), model.vehicle.hull, velocity.chassis).plane;
}

template <class T>
Energy<T> energy(const Model<T>& model, const State<T>& state, const Velocity<T>& velocity, const Momenta<T>& momenta) {
    const Vehicle<T>& vehicle = model.vehicle;
    const auto height = [&](const Vec3<T>& p) { return velocity.R_GC.row(2).dot(p) + state.position()[2]; };
    Energy<T> e;
    e.kinetic = T(0.5) * velocity.chassis.dot(vehicle.chassis_inertia * velocity.chassis);  // (56)
    for (const PowerUnit<T>& unit : vehicle.powertrain.units) {
        if (!unit.rotor_is_free) continue;
        const auto at = unit.state(state.values.data());
        e.kinetic += T(0.5) * at.momentum * at.momentum * unit.inverse_inertia;
        if (unit.shafts.exist()) e.kinetic += T(0.5) * at.shafts[0] * at.shafts[0] * unit.shafts.inverse_inertia;
    }
    if (vehicle.steering.exists()) {
        const auto steering = vehicle.steering.state(state.values.data());
        e.kinetic += vehicle.steering.kinetic(steering, velocity.rack.rate);
    }
    e.potential = vehicle.chassis.mass * vehicle.gravity * height(vehicle.chassis.center) +
                  vehicle.hull.potential(hull_road(model, state, velocity));
    if (vehicle.steering.exists()) {
        e.potential += vehicle.steering.potential(vehicle.steering.state(state.values.data()));
    }
    e.prescribed = T(0);
    e.work = state.work();
    add_suspension_energy(model, state, velocity, momenta, e);
    return e;
}

extern template Energy<double> energy<double>(const Model<double>&, const State<double>&, const Velocity<double>&,
                                              const Momenta<double>&);

}  // namespace hamilcar
