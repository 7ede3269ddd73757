// Energy of a car, and the balance that must hold whatever the driver does: kinetic + potential - drift - work is constant
// (docs/theory/formulation.md, energy). The drift, sum x.h, is what the prescribed rack's motion carries.
#pragma once

#include "hamilcar/block/momenta.hpp"

namespace hamilcar {

template <class T>
struct Energy {
    T kinetic, potential, drift, work;  // [J]
    T balance() const { return kinetic + potential - drift - work; }
};

template <class T>
Energy<T> energy(const Model<T>& model, const State<T>& state, const Velocity<T>& velocity, const Momenta<T>& momenta) {
    const Vehicle<T>& vehicle = model.vehicle;
    const auto height = [&](const Vec3<T>& p) { return velocity.R_GC.row(2).dot(p) + state.position()[2]; };
    Energy<T> e;
    e.kinetic = T(0.5) * velocity.hub.dot(vehicle.chassis_inertia * velocity.hub);  // (56)
    e.potential = vehicle.chassis.mass * vehicle.gravity * height(vehicle.chassis.center) +
                  vehicle.hull.potential(model.road.seen_from(state.position(), velocity.R_GC));
    e.drift = T(0);
    e.work = state.work();
    for (int i = 0; i < vehicle.spoke_count(); ++i) {
        visit_spoke(vehicle, velocity, i, [&](const Spoke<T>& spoke, const auto&, const auto& at) {
            const SpokeForces<T>& f = momenta.spokes[i].forces;
            const T p_s = state.spoke(i).spin_momentum;
            const Spatial<T> Mv = at.inertia * at.motion;
            e.kinetic += T(0.5) * (at.motion.dot(Mv) + p_s * p_s / spoke.wheel.spin_inertia);
            e.potential += spoke.carrier.mass * vehicle.gravity * height(at.position.pose.point(spoke.carrier.center)) +
                           spoke.spring.potential(f.spring_length) + spoke.bump.potential(f.travel) +
                           spoke.rebound.potential(T(-f.travel)) +
                           std::visit([&](const auto& tire) { return tire.potential(f.frame.depth); }, spoke.tire);
            e.drift += at.position.x.dot(Mv) + angular(at.position.x).dot(at.spin_momentum);
        });
    }
    for (const AntiRollBar<T>& bar : vehicle.anti_roll_bars) {
        const T difference = momenta.spokes[bar.left].forces.travel - momenta.spokes[bar.right].forces.travel;
        e.potential += T(0.5) * bar.rate * difference * difference;
    }
    return e;
}

}  // namespace hamilcar
