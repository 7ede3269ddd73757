// The Velocity block's suspensions and trailers, each on a unit (the motor vehicle or a trailer) whose chassis moves
// with v_u. With h = Mhat (v_u + J V' + x) + (0 ; e p_s) of its bodies and wheels and P_V = sum J^T h, a suspension
// sums over them,
//     m = sum J^T Mhat J,   C = sum Mhat J,   k = P_V - sum J^T (Mhat x + (0 ; e p_s))
// eliminates V' = m^-1 (k - C^T v_u) and adds to its unit an inertia and a momentum:
//     K = sum Mhat - C m^-1 C^T,   b = sum (Mhat x + (0 ; e p_s)) + C m^-1 k              // (58), (59)
// A trailer is a unit to which its own suspensions have been added in this way; in the axes of the towing unit its K
// and b take the place of Mhat and Mhat x, and the hitch, a suspension without loops, is condensed by the same code.
// So the cost stays linear in the number of bodies.
#pragma once

#include "hamilcar/block/condensation.hpp"
#include "hamilcar/block/condensed.hpp"
#include "hamilcar/block/model.hpp"
#include "hamilcar/block/static_vector.hpp"

namespace hamilcar {

template <class T>
struct SuspensionVelocity {
    LinkagePosition<T> at;
    std::array<SpatialInertia<T>, max_bodies> inertia;
    std::array<Vec3<T>, max_wheels> center, axis, spin_momentum;  // of the wheels: e, e p_s
    OwnEquation<T> own;
    std::array<Spatial<T>, max_frames> motion;  // v_u + J V' + x
    SuspensionVelocity() {}
};

template <class T>
struct TrailerVelocity {
    LinkagePosition<T> hitch;  // relative to the towing unit
    Pose<T> pose;              // likewise
    CondensedUnit<T> condensed;
    OwnEquation<T> own;
    Spatial<T> motion;  // in the trailer's axes about its origin
    TrailerVelocity() {}
};

// S is the scalar type for pairs. For a suspension of a pair `suspensions` holds only what other code reads (see `unpack`).
template <class T, class S = T>
struct Velocity {
    Health<T> health;
    Mat3<T> R_GC;         // chassis to ground axes
    Spatial<T> momentum;  // (p ; L) in chassis axes
    Spatial<T> chassis;   // v_1
    RackMotion<T> rack;   // as prescribed, or as it moves on its own; its acceleration only where prescribed
    std::array<RackMotion<T>, max_axle_steers> axle_racks;  // of axles with an actuator of their own
    StaticVector<SuspensionVelocity<T>, max_suspensions> suspensions;
    StaticVector<SuspensionVelocity<S>, has_pairs<T> ? max_suspensions / 2 : 1> pairs;
    StaticVector<TrailerVelocity<T>, max_trailers> trailers;
    Velocity() {}
};

template <class S, class T>
RackMotion<S> in_both(const RackMotion<T>& rack) {
    return {S(rack.displacement), S(rack.rate), S(rack.acceleration)};
}

// That which moves a suspension.
template <class T, class S>
const RackMotion<T>& rack_of(const Suspension<T>& suspension, const Velocity<T, S>& velocity) {
    return suspension.steered_by < 0 ? velocity.rack
                                     : velocity.axle_racks[static_cast<std::size_t>(suspension.steered_by)];
}

// Transforms a force from a frame's axes and origin to those of the parent, in which its pose is given.
template <class T>
Spatial<T> force_to_parent(const Pose<T>& pose, const Spatial<T>& force) {
    const Vec3<T> f = pose.R * linear(force);
    return spatial<T>(f, pose.R * angular(force) + pose.p.cross(f));
}

// Transforms a motion the other way.
template <class T>
Spatial<T> motion_to_frame(const Pose<T>& pose, const Spatial<T>& motion) {
    return spatial<T>(pose.R.transpose() * velocity_at<T>(motion, pose.p), pose.R.transpose() * angular(motion));
}

template <class T>
void add_inertia(const SpatialInertia<T>& inertia, Matrix<T, 6, 6>& K) {
    Matrix<T, 6, 6> lower = Matrix<T, 6, 6>::Zero();
    inertia.add_to_lower(lower);
    for (int j = 0; j < 6; ++j) {
        K(j, j) += lower(j, j);
        for (int i = j + 1; i < 6; ++i) K(i, j) += lower(i, j), K(j, i) += lower(i, j);
    }
}

// What a suspension adds to its unit; with `coupling`, x is the motion per unit of the rack's rate, which is not known yet.
template <class T>
CondensedUnit<T> condense_suspension(const Suspension<T>& suspension, const T* values, const RackMotion<T>& rack,
                                     const T& gain, SuspensionVelocity<T>& out, Health<T>& health,
                                     RackCoupling<T>* coupling = nullptr) {
    const Linkage<T>& linkage = suspension.linkage;
    const auto state = suspension.state(values);
    const int n = linkage.nV();
    linkage.find_position(state.independent, state.dependent, rack, gain, out.at);
    CondensedUnit<T> own;
    own.K.setZero(), own.b.setZero();
    Matrix<T, max_freedoms, max_freedoms> m = Matrix<T, max_freedoms, max_freedoms>::Zero();
    out.own.C.setZero();
    for (int j = 0; j < n; ++j) out.own.k[j] = state.momentum[j], out.own.d[j] = T(0);
    const auto add_momentum = [&](int frame, const Spatial<T>& h) {
        own.b += h;
        for (int j = 0; j < n; ++j) out.own.k[j] -= out.at.motion.J[frame].col(j).dot(h);  // (57)
        if (coupling) coupling->momentum += out.at.motion.x[frame].dot(h);
    };
    for (std::size_t i = 0; i < suspension.bodies.size(); ++i) {
        const auto& [frame, body] = suspension.bodies[i];
        const Placement<T>& pose = out.at.pose[frame];
        const auto& J = out.at.motion.J[frame];
        out.inertia[i] =
            SpatialInertia<T>::about_origin(body.mass, pose.point(body.center), body.inertia.rotated(pose.R));
        add_inertia(out.inertia[i], own.K);
        for (int j = 0; j < n; ++j) {
            const Spatial<T> MJ = out.inertia[i] * Spatial<T>(J.col(j));
            out.own.C.col(j) += MJ;
            for (int k = 0; k < n; ++k) m(k, j) += J.col(k).dot(MJ);  // (59), A.5
        }
        const Spatial<T> Mx = out.inertia[i] * out.at.motion.x[frame];
        if (!coupling) {
            add_momentum(frame, Mx);
            continue;
        }
        coupling->c += Mx, coupling->inertia += out.at.motion.x[frame].dot(Mx);
        for (int j = 0; j < n; ++j) out.own.d[j] += J.col(j).dot(Mx);
    }
    for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
        const SuspensionWheel<T>& wheel = suspension.wheels[i];
        const Placement<T>& pose = out.at.pose[wheel.frame];
        out.center[i] = pose.point(wheel.wheel.center);
        out.axis[i] = pose.direction(wheel.wheel.axis);
        out.spin_momentum[i] = out.axis[i] * suspension.wheel_state(static_cast<int>(i), values).spin_momentum;
        add_momentum(wheel.frame, spatial<T>(Vec3<T>::Zero(), out.spin_momentum[i]));
    }
    condense(n, m, out.own, own);
    if (coupling) condense_rack(n, out.own.m_inverse, out.own, *coupling);
    T violation(0);
    for (int e = 0; e < linkage.nW(); ++e) violation = max(violation, abs(out.at.Phi[e]));
    health = {violation, out.at.determinant * suspension.inverse_design_determinant};
    return own;
}

// Adds both suspensions of a pair to their unit, one after the other.
template <class T, class S>
void condense_pair(const SuspensionPair<S>& pair, const T* values, const RackMotion<T>& rack, const T& gain,
                   Velocity<T, S>& out, CondensedUnit<T>& unit, RackCoupling<T>* coupling) {
    const auto numbers = gather_pair(pair, values);
    Health<S> both;
    SuspensionVelocity<S>& at = out.pairs.emplace_back();
    RackCoupling<S> of_both;
    const CondensedUnit<S> own = condense_suspension<S>(pair.both, numbers.data(), in_both<S>(rack), S(gain), at, both,
                                                        coupling ? &of_both : nullptr);
    for (int l = 0; l < 2; ++l) {
        if (coupling) {
            RackCoupling<T> of_one{.inertia = lane(of_both.inertia, l), .momentum = lane(of_both.momentum, l)};
            unpack(of_both.c, l, of_one.c);
            coupling->add(of_one);
        }
        CondensedUnit<T> one;
        unpack(own.K, l, one.K), unpack(own.b, l, one.b);
        unit.K += one.K, unit.b += one.b;
        out.health.include({lane(both.violation, l), lane(both.mobility, l)});
        SuspensionVelocity<T>& suspension = out.suspensions.emplace_back();
        unpack(at.at.correction, l, suspension.at.correction);
        unpack(at.center, l, suspension.center);
        unpack(at.axis, l, suspension.axis);
    }
}

// Adds a trailer, with everything condensed onto it, to the towing unit.
template <class T>
void condense_trailer(const Trailer<T>& trailer, const T* values, TrailerVelocity<T>& out, CondensedUnit<T>& tow) {
    const int n = trailer.freedoms();
    const T* angles = values + trailer.offset;
    trailer.hitch.find_position(angles, nullptr, RackMotion<T>{}, T(0), out.hitch);
    out.pose = out.hitch.pose[n].pose();
    CondensedUnit<T> seen;
    Matrix<T, 6, 6> turned;
    for (int j = 0; j < 6; ++j) turned.col(j) = force_to_parent<T>(out.pose, out.condensed.K.col(j));
    for (int i = 0; i < 6; ++i) seen.K.row(i) = force_to_parent<T>(out.pose, turned.row(i).transpose()).transpose();
    seen.b = force_to_parent(out.pose, out.condensed.b);
    const auto& J = out.hitch.motion.J[n];
    Matrix<T, max_freedoms, max_freedoms> m;
    for (int j = 0; j < n; ++j) {
        out.own.C.col(j) = seen.K * J.col(j);
        for (int i = 0; i < n; ++i) m(i, j) = J.col(i).dot(out.own.C.col(j));
        out.own.k[j] = angles[n + j] - J.col(j).dot(seen.b);
    }
    condense(n, m, out.own, seen);
    tow.K += seen.K, tow.b += seen.b;
}

// Condenses all suspensions and trailers onto the motor vehicle's chassis; with `coupling`, for a rack that moves on its own. The racks
// are those of `out`.
template <class T, class S>
CondensedUnit<T> condense_suspensions(const Model<T>& model, const State<T>& state, Velocity<T, S>& out,
                                      RackCoupling<T>* coupling = nullptr) {
    const Vehicle<T>& vehicle = model.vehicle;
    CondensedUnit<T> motor_vehicle;
    motor_vehicle.K.setZero(), motor_vehicle.b.setZero();
    for (const Trailer<T>& trailer : vehicle.trailers) {
        CondensedUnit<T>& own = out.trailers.emplace_back().condensed;
        own.K.setZero(), own.b.setZero();
        add_inertia(trailer.chassis_inertia, own.K);
    }
    const auto unit = [&](int i) -> CondensedUnit<T>& {
        return i == 0 ? motor_vehicle : out.trailers[static_cast<std::size_t>(i) - 1].condensed;
    };
    const T* values = state.values.data();
    vehicle.for_each_suspension(
        [&](std::size_t s) {
            const Suspension<T>& suspension = vehicle.suspensions[s];
            Health<T> health;
            RackCoupling<T> of_one;  // summed by itself, as that of one of a pair
            const bool couples = coupling && suspension.follows_rack();
            const CondensedUnit<T> own =
                condense_suspension(suspension, values, rack_of(suspension, out), model.stabilization_gain,
                                    out.suspensions.emplace_back(), health, couples ? &of_one : nullptr);
            if (couples) coupling->add(of_one);
            unit(suspension.unit).K += own.K, unit(suspension.unit).b += own.b;
            out.health.include(health);
        },
        [&](const auto& pair, std::size_t) {
            const Suspension<T>& first = vehicle.suspensions[static_cast<std::size_t>(pair.first)];
            condense_pair(pair, values, rack_of(first, out), model.stabilization_gain, out, unit(pair.both.unit),
                          first.follows_rack() ? coupling : nullptr);
        });
    for (std::size_t i = vehicle.trailers.size(); i-- > 0;) {
        condense_trailer(vehicle.trailers[i], state.values.data(), out.trailers[i], unit(vehicle.trailers[i].tow));
    }
    return motor_vehicle;
}

// The motion of a unit's chassis.
template <class T, class S>
const Spatial<T>& unit_motion(int unit, const Velocity<T, S>& velocity) {
    return unit == 0 ? velocity.chassis : velocity.trailers[static_cast<std::size_t>(unit) - 1].motion;
}

template <class T>
void move_suspension(const Suspension<T>& suspension, const Spatial<T>& v_u, SuspensionVelocity<T>& at) {
    const int n = suspension.linkage.nV();
    at.own.solve(n, v_u);  // (58)
    for (int frame = 0; frame <= suspension.linkage.nq(); ++frame) {
        at.motion[frame] = v_u + at.at.motion.x[frame] * at.at.pace;  // (18), (42)
        for (int j = 0; j < n; ++j) at.motion[frame] += at.at.motion.J[frame].col(j) * at.own.V_rate[j];
    }
}

// Once the rate of a rack that moves on its own is known: makes it a part of what suspensions know.
template <class T, class S>
void move_rack(const Vehicle<T>& vehicle, const T& rate, Velocity<T, S>& out) {
    vehicle.for_each_suspension(
        [&](std::size_t s) {
            const Suspension<T>& suspension = vehicle.suspensions[s];
            if (!suspension.follows_rack()) return;
            out.suspensions[s].at.pace = rate;
            out.suspensions[s].own.subtract_rack(suspension.linkage.nV(), rate);
        },
        [&](const auto& pair, std::size_t number) {
            if (!pair.both.follows_rack()) return;
            out.pairs[number].at.pace = S(rate);
            out.pairs[number].own.subtract_rack(pair.both.linkage.nV(), S(rate));
        });
}

// Once the chassis's motion is known: the rates of trailers, from front to back, and of all suspensions.
template <class T, class S>
void move_suspensions(const Vehicle<T>& vehicle, Velocity<T, S>& out) {
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        const Trailer<T>& trailer = vehicle.trailers[i];
        TrailerVelocity<T>& at = out.trailers[i];
        const Spatial<T>& tow = unit_motion(trailer.tow, out);
        at.own.solve(trailer.freedoms(), tow);
        Spatial<T> motion = tow;
        for (int j = 0; j < trailer.freedoms(); ++j) {
            motion += at.hitch.motion.J[trailer.freedoms()].col(j) * at.own.V_rate[j];
        }
        at.motion = motion_to_frame(at.pose, motion);
    }
    vehicle.for_each_suspension(
        [&](std::size_t s) {
            const Suspension<T>& suspension = vehicle.suspensions[s];
            move_suspension(suspension, unit_motion(suspension.unit, out), out.suspensions[s]);
        },
        [&](const auto& pair, std::size_t number) {
            SuspensionVelocity<S>& at = out.pairs[number];
            move_suspension(pair.both, in_both<S>(unit_motion(pair.both.unit, out)), at);
            for (int l = 0; l < 2; ++l) {
                SuspensionVelocity<T>& suspension =
                    out.suspensions[static_cast<std::size_t>(pair.first) + static_cast<std::size_t>(l)];
                for (int frame = 0; frame <= pair.both.linkage.nq(); ++frame) {
                    unpack(at.motion[frame], l, suspension.motion[frame]);
                }
                for (int j = 0; j < pair.both.linkage.nV(); ++j) {
                    suspension.own.V_rate[j] = lane(at.own.V_rate[j], l);
                }
            }
        });
}

}  // namespace hamilcar
