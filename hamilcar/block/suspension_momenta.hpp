// The Momenta block's suspensions and trailers. A hitch has the equation of a suspension, with h and Qhat summed over
// everything behind it, so that a trailer is a body like any other.
#pragma once

#include "hamilcar/block/brake_momenta.hpp"
#include "hamilcar/block/suspension_evaluator.hpp"
#include "hamilcar/block/unit_pose.hpp"

namespace hamilcar {

template <class T>
struct TrailerMomenta {
    std::array<T, max_freedoms> momentum_rate;
    Spatial<T> external;           // on the trailer and all it pulls, in its axes about its origin
    Surroundings<T> surroundings;  // as seen from its axes
    TrailerMomenta() {}
};

template <class T>
struct Momenta {
    Spatial<T> external;  // (F ; N_O) on the whole car, chassis axes
    T work_rate;          // [W]
    StaticVector<SuspensionMomenta<T>, max_suspensions> suspensions;
    StaticVector<TrailerMomenta<T>, max_trailers> trailers;
    PowertrainMomenta<T> powertrain;  // where there is one
    BrakeMomenta<T> brakes;
    T on_rack;                                    // of the suspensions, where the rack moves on its own [N]
    typename SteeringSystem<T>::Output steering;  // likewise
    std::array<T, max_commands> actuator_rates;   // of adjustable dampers and active bars [1/s]
    Momenta() {}
};

// What an anti-roll bar feels of every wheel: the angle of its arm [rad], or the wheel's travel [m].
template <class T, class S>
std::array<T, max_vehicle_wheels> bar_deflections(const Vehicle<T>& vehicle, const State<T>& state,
                                                  const Velocity<T, S>& velocity) {
    std::array<T, max_vehicle_wheels> out;
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const Suspension<T>& suspension = vehicle.suspensions[s];
        const auto numbers = suspension.state(state.values.data());
        for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
            const SuspensionWheel<T>& wheel = suspension.wheels[i];
            T& deflection = out[static_cast<std::size_t>(suspension.first_wheel) + i];
            deflection = velocity.suspensions[s].center[i][2] - wheel.wheel.center[2];
            if (wheel.bar_arm >= 0)
                deflection = suspension.linkage.value(wheel.bar_arm, numbers.independent, numbers.dependent);
        }
    }
    return out;
}

// Wheel by wheel.
template <class T>
struct BarForces {
    std::array<T, max_vehicle_wheels> all, active;  // active: the part that actuators make [N]
    BarForces() {}
};

// Forces of the bars on the wheels along their travel, or moments on their arms.
template <class T, class S>
BarForces<T> anti_roll_forces(const Vehicle<T>& vehicle, const State<T>& state, const Velocity<T, S>& velocity) {
    const std::array<T, max_vehicle_wheels> deflection = bar_deflections(vehicle, state, velocity);
    BarForces<T> out;
    out.all.fill(T(0)), out.active.fill(T(0));
    for (const AntiRollBar<T>& bar : vehicle.anti_roll_bars) {
        T pull = bar.rate * (deflection[bar.left] - deflection[bar.right]);
        if (bar.actuator >= 0) {
            const T own = bar.max_force * state.values.data()[vehicle.actuator_place + bar.actuator];
            out.active[bar.left] -= own, out.active[bar.right] += own;
            pull += own;
        }
        out.all[bar.left] -= pull;
        out.all[bar.right] += pull;
    }
    return out;
}

// Shares of the dampers' forces by their settings.
template <class T>
std::array<T, max_axial_elements> damper_shares(const Vehicle<T>& vehicle, const Suspension<T>& suspension,
                                                const State<T>& state) {
    std::array<T, max_axial_elements> out;
    for (std::size_t i = 0; i < suspension.dampers.size(); ++i) {
        const SuspensionDamper<T>& damper = suspension.dampers[i];
        out[i] = T(1);
        if (damper.actuator < 0) continue;
        out[i] = damper.soft + damper.growth * state.values.data()[vehicle.actuator_place + damper.actuator];
    }
    return out;
}

template <class T>
UnitPose<T> behind(const UnitPose<T>& tow, const Pose<T>& pose) {
    return {tow.position + tow.R * pose.p, tow.R * pose.R};
}

template <class T>
Surroundings<T> surroundings_of(const Model<T>& model, const UnitPose<T>& pose, const Spatial<T>& motion) {
    return {model.road.seen_from(pose.position, pose.R), pose.R.row(2).transpose() * (-model.vehicle.gravity), motion,
            model.stabilization_gain};
}

// The hitch, once everything behind it is summed; adds the force to the towing unit's.
template <class T>
void finish_trailer(const Trailer<T>& trailer, const TrailerVelocity<T>& at, const Spatial<T>& tow_motion,
                    TrailerMomenta<T>& out, Spatial<T>& tow_external, T& work_rate) {
    const int n = trailer.freedoms();
    const Spatial<T> momentum = at.condensed.K * at.motion + at.condensed.b;
    const Spatial<T> h = force_to_parent(at.pose, momentum), Q = force_to_parent(at.pose, out.external);
    LinkageRates<T> rates;
    trailer.hitch.find_rates(at.hitch, at.own.V_rate, RackMotion<T>{}, rates);
    const Spatial<T> net = Q - cross_force<T>(tow_motion, h);
    for (int j = 0; j < n; ++j) {
        out.momentum_rate[j] = at.hitch.motion.J[n].col(j).dot(net) + rates.motion.J[n].col(j).dot(h);
    }
    const T yaw_rate = at.own.V_rate[trailer.yaw], damping = trailer.yaw_damping * yaw_rate;
    out.momentum_rate[trailer.yaw] -= damping;
    work_rate -= damping * yaw_rate;
    tow_external += Q;
}

// Of one of a pair: what the rates of a state need.
template <class T, class S>
void unpack_rates(const SuspensionMomenta<S>& from, int l, SuspensionMomenta<T>& to) {
    unpack(from.momentum_rate, l, to.momentum_rate);
    unpack(from.W_rate, l, to.W_rate);
    unpack(from.spin_momentum_rate, l, to.spin_momentum_rate);
    unpack(from.windup_rate, l, to.windup_rate);
    for (std::size_t i = 0; i < to.wheels.size(); ++i) {
        to.wheels[i].spin = lane(from.wheels[i].spin, l);
        to.wheels[i].brake_torque = lane(from.wheels[i].brake_torque, l);
        for (std::size_t k = 0; k < to.wheels[i].tires.size(); ++k) {
            const TireForce<S>& tire = from.wheels[i].tires[k].tire;
            to.wheels[i].tires[k].tire.u_rate = lane(tire.u_rate, l);
            to.wheels[i].tires[k].tire.v_rate = lane(tire.v_rate, l);
        }
    }
}

// What the powertrain does to suspensions.
template <class T>
struct ShaftTorques {
    std::array<T, max_vehicle_wheels> wheels;  // on each wheel [N m]
    std::array<T, max_suspensions> axles;      // on an axle with a differential, about the shaft that drives it [N m]
    ShaftTorques() {}
};

// All suspensions and trailers, with the torques of `shafts` and the limits of the brakes in `out`; adds to the motor
// vehicle's external wrench and to the work rate.
template <class T, class S>
void suspension_momenta(const Model<T>& model, const State<T>& state, const Input<T>& input,
                        const Velocity<T, S>& velocity, const Surroundings<T>& motor_vehicle,
                        const ShaftTorques<T>& shafts, Momenta<T>& out) {
    const Vehicle<T>& vehicle = model.vehicle;
    std::array<UnitPose<T>, max_trailers + 1> poses;
    poses[0] = {state.position(), velocity.R_GC};
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        const Trailer<T>& trailer = vehicle.trailers[i];
        TrailerMomenta<T>& own = out.trailers.emplace_back();
        poses[i + 1] = behind(poses[static_cast<std::size_t>(trailer.tow)], velocity.trailers[i].pose);
        own.surroundings = surroundings_of(model, poses[i + 1], velocity.trailers[i].motion);
        own.external = spatial<T>(own.surroundings.gravity * trailer.chassis.mass,
                                  trailer.chassis_inertia.first_moment.cross(own.surroundings.gravity));
    }
    const bool rack_is_free = vehicle.steering.exists();
    const auto kind_of = [&](const auto& suspension) {
        if (rack_is_free && suspension.follows_rack()) return RackKind::free;
        return model.energy_balance ? RackKind::prescribed : RackKind::without_work;
    };
    out.on_rack = T(0);
    const BarForces<T> bars = anti_roll_forces(vehicle, state, velocity);
    UnevenGround<T> uneven;
    const auto world_of = [&](int unit) -> const Surroundings<T>& {
        return unit == 0 ? motor_vehicle : out.trailers[static_cast<std::size_t>(unit) - 1].surroundings;
    };
    const auto ground_of = [&](int unit) {
        return ground_below(model, poses[static_cast<std::size_t>(unit)], world_of(unit).road, input.time, uneven);
    };
    const auto external_of = [&](int unit) -> Spatial<T>& {
        return unit == 0 ? out.external : out.trailers[static_cast<std::size_t>(unit) - 1].external;
    };
    vehicle.for_each_suspension(
        [&](std::size_t s) {
            const Suspension<T>& suspension = vehicle.suspensions[s];
            const UnitGround<T> ground = ground_of(suspension.unit);
            const WheelInput<T> told{rack_of(suspension, velocity), input.drive_torque};
            SuspensionEvaluator<T> momenta(suspension, velocity.suspensions[s], state.values.data(), told,
                                           world_of(suspension.unit), ground, kind_of(suspension),
                                           out.suspensions.emplace_back());
            momenta.add_bodies();
            std::array<WheelLoads<T>, max_wheels> loads;
            for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
                const auto wheel = static_cast<std::size_t>(suspension.first_wheel) + i;
                loads[i] = {bars.all[wheel], bars.active[wheel], shafts.wheels[wheel], out.brakes.limit[wheel]};
            }
            momenta.add_wheels({suspension.first_wheel, suspension.first_wheel}, loads);
            if (suspension.shaft_frame > 0) momenta.add_shaft(shafts.axles[s]);
            momenta.add_springs(damper_shares(vehicle, suspension, state));
            momenta.finish();
            external_of(suspension.unit) += momenta.external();
            out.work_rate += momenta.work();
            if (rack_is_free && suspension.follows_rack()) out.on_rack += momenta.on_rack();
        },
        [&](const auto& pair, std::size_t number) {
            const int unit = pair.both.unit;
            const auto numbers = gather_pair(pair, state.values.data());
            const UnitGround<T> ground = ground_of(unit);
            const Surroundings<S> around = in_both<S>(world_of(unit));
            const UnitGround<S> below{around.road, ground.uneven};
            const auto first = static_cast<std::size_t>(pair.first);
            const WheelInput<S> inputs =
                in_both<S>(WheelInput<T>{rack_of(vehicle.suspensions[first], velocity), input.drive_torque});
            SuspensionMomenta<S> both;
            SuspensionEvaluator<S> momenta(pair.both, velocity.pairs[number], numbers.data(), inputs, around, below,
                                           kind_of(pair.both), both);
            momenta.add_bodies();
            const std::array<int, 2> wheels{vehicle.suspensions[first].first_wheel,
                                            vehicle.suspensions[first + 1].first_wheel};
            const std::array<T, max_vehicle_wheels>& limits = out.brakes.limit;
            std::array<WheelLoads<S>, max_wheels> loads;
            for (std::size_t i = 0; i < pair.both.wheels.size(); ++i) {
                const auto left = static_cast<std::size_t>(wheels[0]) + i;
                const auto right = static_cast<std::size_t>(wheels[1]) + i;
                loads[i] = {side_by_side<S>(bars.all[left], bars.all[right]),
                            side_by_side<S>(bars.active[left], bars.active[right]),
                            side_by_side<S>(shafts.wheels[left], shafts.wheels[right]),
                            side_by_side<S>(limits[left], limits[right])};
            }
            momenta.add_wheels(wheels, loads);
            if (pair.both.shaft_frame > 0) {
                momenta.add_shaft(side_by_side<S>(shafts.axles[first], shafts.axles[first + 1]));
            }
            const auto shares = damper_shares(vehicle, vehicle.suspensions[first], state),
                       of_right = damper_shares(vehicle, vehicle.suspensions[first + 1], state);
            std::array<S, max_axial_elements> of_both;
            for (std::size_t i = 0; i < pair.both.dampers.size(); ++i) {
                of_both[i] = side_by_side<S>(shares[i], of_right[i]);
            }
            momenta.add_springs(of_both);
            momenta.finish();
            for (int l = 0; l < 2; ++l) {
                Spatial<T> wrench;
                unpack(momenta.external(), l, wrench);
                external_of(unit) += wrench;
                out.work_rate += lane(momenta.work(), l);
                if (rack_is_free && pair.both.follows_rack()) out.on_rack += lane(momenta.on_rack(), l);
                unpack_rates(both, l, out.suspensions.emplace_back());
            }
        });
    for (std::size_t i = vehicle.trailers.size(); i-- > 0;) {
        const Trailer<T>& trailer = vehicle.trailers[i];
        const auto tow = static_cast<std::size_t>(trailer.tow);
        finish_trailer(trailer, velocity.trailers[i], unit_motion(trailer.tow, velocity), out.trailers[i],
                       tow == 0 ? out.external : out.trailers[tow - 1].external, out.work_rate);
    }
}

}  // namespace hamilcar
