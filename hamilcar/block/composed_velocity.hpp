// The Velocity block for composed suspensions and trailers. A spoke with several bodies sums over them,
//     m = sum J^T Mhat J,   C = sum Mhat J,   k = P_V - sum J^T (Mhat x + (0 ; e p_s))
// and leaves its hub an inertia and a momentum, as every spoke does:
//     K = sum Mhat - C m^-1 C^T,   b = sum (Mhat x + (0 ; e p_s)) + C m^-1 k              // (58), (59)
// A trailer is a hub that has done so with its own spokes; seen from the unit that pulls it K and b stand for Mhat and Mhat x,
// and the hitch, a spoke without loops, is condensed by the same lines. So the cost stays linear in the number of bodies.
#pragma once

#include "hamilcar/block/condensed.hpp"
#include "hamilcar/block/model.hpp"
#include "hamilcar/block/static_vector.hpp"

namespace hamilcar {

// A spoke's own equation m V' + C^T v_hub = k.
template <class T>
struct OwnEquation {
    Matrix<T, 6, max_freedoms> C;
    Matrix<T, max_freedoms, max_freedoms> m_inverse;
    std::array<T, max_freedoms> k, V_rate;
    OwnEquation() {}

    void solve(int n, const Spatial<T>& hub) {
        for (int i = 0; i < n; ++i) {
            V_rate[i] = T(0);
            for (int j = 0; j < n; ++j) V_rate[i] += m_inverse(i, j) * (k[j] - C.col(j).dot(hub));
        }
    }
};

template <class T>
struct ComposedVelocity {
    ComposedPosition<T> at;
    std::array<SpatialInertia<T>, max_bodies> inertia;
    std::array<Vec3<T>, max_wheels> center, axis, spin_momentum;  // of the wheels: e, e p_s
    OwnEquation<T> own;
    std::array<Spatial<T>, max_frames> motion;  // v_hub + J V' + x
    ComposedVelocity() {}
};

// The inertia and momentum of a hub with everything that hangs on it, in its axes about its origin.
template <class T>
struct CondensedHub {
    Matrix<T, 6, 6> K;
    Spatial<T> b;
    CondensedHub() {}
};

template <class T>
struct TrailerVelocity {
    ComposedPosition<T> hitch;  // against the unit that pulls it
    Pose<T> pose;               // likewise
    CondensedHub<T> condensed;
    OwnEquation<T> own;
    Spatial<T> motion;  // in the trailer's axes about its origin
    TrailerVelocity() {}
};

// S carries pairs; of a spoke that is one of a pair the list of all has what others ask for: `unpack`.
template <class T, class S = T>
struct ComposedVelocities {
    StaticVector<ComposedVelocity<T>, max_composed> spokes;
    StaticVector<ComposedVelocity<S>, max_composed / 2> pairs;
    StaticVector<TrailerVelocity<T>, max_trailers> trailers;
};

// Number l of those abreast, place by place.
template <class T, class S>
void unpack(const S& from, int l, T& to) {
    if constexpr (requires { from.size(); }) {
        for (int i = 0; i < static_cast<int>(from.size()); ++i) unpack(from.data()[i], l, to.data()[i]);
    } else {
        to = lane(from, l);
    }
}

template <class S, class T>
RackMotion<S> abreast(const RackMotion<T>& rack) {
    return {S(rack.displacement), S(rack.rate), S(rack.acceleration)};
}

// A force from the axes and origin of a frame to those that its pose is given in.
template <class T>
Spatial<T> carried_over(const Pose<T>& pose, const Spatial<T>& force) {
    const Vec3<T> f = pose.R * linear(force);
    return spatial<T>(f, pose.R * angular(force) + pose.p.cross(f));
}

// A motion the other way.
template <class T>
Spatial<T> seen_from(const Pose<T>& pose, const Spatial<T>& motion) {
    return spatial<T>(pose.R.transpose() * velocity_at<T>(motion, pose.p), pose.R.transpose() * angular(motion));
}

// A spoke eliminates its own rates: K and b of what it carries become what it leaves the hub.
template <class T>
void condense(int n, const Matrix<T, max_freedoms, max_freedoms>& m, OwnEquation<T>& own, CondensedHub<T>& hub) {
    own.m_inverse = m;
    invert_positive_definite<T, max_freedoms>(own.m_inverse, n);
    for (int i = 0; i < n; ++i) {
        Spatial<T> Cm = own.C.col(0) * own.m_inverse(0, i);
        for (int j = 1; j < n; ++j) Cm += own.C.col(j) * own.m_inverse(j, i);
        hub.K -= Cm * own.C.col(i).transpose();
        hub.b += Cm * own.k[i];
    }
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

// What it leaves its hub.
template <class T>
CondensedHub<T> condense_spoke(const ComposedSpoke<T>& spoke, const T* values, const RackMotion<T>& rack, const T& gain,
                               ComposedVelocity<T>& out, Health<T>& health) {
    const ComposedLinkage<T>& linkage = spoke.linkage;
    const auto state = spoke.state(values);
    const int n = linkage.nV();
    linkage.find_position(state.independent, state.dependent, rack, gain, out.at);
    CondensedHub<T> own;
    own.K.setZero(), own.b.setZero();
    Matrix<T, max_freedoms, max_freedoms> m = Matrix<T, max_freedoms, max_freedoms>::Zero();
    out.own.C.setZero();
    for (int j = 0; j < n; ++j) out.own.k[j] = state.momentum[j];
    const auto add_momentum = [&](int frame, const Spatial<T>& h) {
        own.b += h;
        for (int j = 0; j < n; ++j) out.own.k[j] -= out.at.motion.J[frame].col(j).dot(h);  // (57)
    };
    for (std::size_t i = 0; i < spoke.bodies.size(); ++i) {
        const auto& [frame, body] = spoke.bodies[i];
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
        add_momentum(frame, out.inertia[i] * out.at.motion.x[frame]);
    }
    for (std::size_t i = 0; i < spoke.wheels.size(); ++i) {
        const ComposedWheel<T>& wheel = spoke.wheels[i];
        const Placement<T>& pose = out.at.pose[wheel.frame];
        out.center[i] = pose.point(wheel.wheel.center);
        out.axis[i] = pose.direction(wheel.wheel.axis);
        out.spin_momentum[i] = out.axis[i] * spoke.wheel_state(static_cast<int>(i), values).spin_momentum;
        add_momentum(wheel.frame, spatial<T>(Vec3<T>::Zero(), out.spin_momentum[i]));
    }
    condense(n, m, out.own, own);
    T violation(0);
    for (int e = 0; e < linkage.nW(); ++e) violation = max(violation, abs(out.at.Phi[e]));
    health = {violation, out.at.determinant * spoke.inverse_design_determinant};
    return own;
}

// Both of a pair onto their hub, one after the other.
template <class T, class S>
void condense_pair(const ComposedPair<S>& pair, const T* values, const RackMotion<T>& rack, const T& gain,
                   ComposedVelocities<T, S>& out, CondensedHub<T>& hub, Health<T>& health) {
    const auto numbers = gather_pair(pair, values);
    Health<S> both;
    ComposedVelocity<S>& at = out.pairs.emplace_back();
    const CondensedHub<S> own = condense_spoke<S>(pair.spokes, numbers.data(), abreast<S>(rack), S(gain), at, both);
    for (int l = 0; l < 2; ++l) {
        CondensedHub<T> one;
        unpack(own.K, l, one.K), unpack(own.b, l, one.b);
        hub.K += one.K, hub.b += one.b;
        health.include({lane(both.violation, l), lane(both.mobility, l)});
        ComposedVelocity<T>& spoke = out.spokes.emplace_back();
        unpack(at.at.closing, l, spoke.at.closing);
        unpack(at.center, l, spoke.center);
        unpack(at.axis, l, spoke.axis);
    }
}

// The trailer with all that it carries, onto the unit that pulls it.
template <class T>
void condense_trailer(const Trailer<T>& trailer, const T* values, TrailerVelocity<T>& out, CondensedHub<T>& tow) {
    const int n = trailer.freedoms();
    const T* angles = values + trailer.offset;
    trailer.hitch.find_position(angles, nullptr, RackMotion<T>{}, T(0), out.hitch);
    out.pose = out.hitch.pose[n].pose();
    CondensedHub<T> seen;
    Matrix<T, 6, 6> turned;
    for (int j = 0; j < 6; ++j) turned.col(j) = carried_over<T>(out.pose, out.condensed.K.col(j));
    for (int i = 0; i < 6; ++i) seen.K.row(i) = carried_over<T>(out.pose, turned.row(i).transpose()).transpose();
    seen.b = carried_over(out.pose, out.condensed.b);
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

// All of them, onto the motor vehicle's chassis.
template <class T, class S>
CondensedSpoke<T> condense_composed(const Model<T>& model, const State<T>& state, const RackMotion<T>& rack,
                                    ComposedVelocities<T, S>& out, Health<T>& health) {
    const Vehicle<T>& vehicle = model.vehicle;
    CondensedHub<T> motor_vehicle;
    motor_vehicle.K.setZero(), motor_vehicle.b.setZero();
    for (const Trailer<T>& trailer : vehicle.trailers) {
        CondensedHub<T>& own = out.trailers.emplace_back().condensed;
        own.K.setZero(), own.b.setZero();
        add_inertia(trailer.chassis_inertia, own.K);
    }
    const auto unit = [&](int i) -> CondensedHub<T>& {
        return i == 0 ? motor_vehicle : out.trailers[static_cast<std::size_t>(i) - 1].condensed;
    };
    const T* values = state.values.data();
    vehicle.for_each_composed(
        [&](std::size_t s) {
            const ComposedSpoke<T>& spoke = vehicle.composed[s];
            Health<T> own_health;
            const CondensedHub<T> own =
                condense_spoke(spoke, values, rack, model.stabilization_gain, out.spokes.emplace_back(), own_health);
            unit(spoke.unit).K += own.K, unit(spoke.unit).b += own.b;
            health.include(own_health);
        },
        [&](const auto& pair, std::size_t) {
            condense_pair(pair, values, rack, model.stabilization_gain, out, unit(pair.spokes.unit), health);
        });
    for (std::size_t i = vehicle.trailers.size(); i-- > 0;) {
        condense_trailer(vehicle.trailers[i], state.values.data(), out.trailers[i], unit(vehicle.trailers[i].tow));
    }
    CondensedSpoke<T> share;
    for_each_lower([&](int i, int j, std::size_t k) { share[k] = motor_vehicle.K(i, j); });
    for (std::size_t i = 0; i < 6; ++i) share[21 + i] = motor_vehicle.b[static_cast<int>(i)];
    return share;
}

// The motion of a unit's hub.
template <class T, class Velocities>
const Spatial<T>& unit_motion(int unit, const Spatial<T>& motor_vehicle, const Velocities& velocities) {
    return unit == 0 ? motor_vehicle : velocities.trailers[static_cast<std::size_t>(unit) - 1].motion;
}

template <class T>
void move_spoke(const ComposedSpoke<T>& spoke, const Spatial<T>& hub, ComposedVelocity<T>& at) {
    const int n = spoke.linkage.nV();
    at.own.solve(n, hub);  // (58)
    for (int frame = 0; frame <= spoke.linkage.nq(); ++frame) {
        at.motion[frame] = hub + at.at.motion.x[frame];  // (18), (42)
        for (int j = 0; j < n; ++j) at.motion[frame] += at.at.motion.J[frame].col(j) * at.own.V_rate[j];
    }
}

// The chassis is known: trailers from the front to the back and all spokes read off their rates.
template <class T, class S>
void move_composed(const Vehicle<T>& vehicle, const Spatial<T>& chassis, ComposedVelocities<T, S>& out) {
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        const Trailer<T>& trailer = vehicle.trailers[i];
        TrailerVelocity<T>& at = out.trailers[i];
        const Spatial<T>& tow = unit_motion(trailer.tow, chassis, out);
        at.own.solve(trailer.freedoms(), tow);
        Spatial<T> motion = tow;
        for (int j = 0; j < trailer.freedoms(); ++j) {
            motion += at.hitch.motion.J[trailer.freedoms()].col(j) * at.own.V_rate[j];
        }
        at.motion = seen_from(at.pose, motion);
    }
    vehicle.for_each_composed(
        [&](std::size_t s) {
            const ComposedSpoke<T>& spoke = vehicle.composed[s];
            move_spoke(spoke, unit_motion(spoke.unit, chassis, out), out.spokes[s]);
        },
        [&](const auto& pair, std::size_t number) {
            ComposedVelocity<S>& at = out.pairs[number];
            move_spoke(pair.spokes, abreast<S>(unit_motion(pair.spokes.unit, chassis, out)), at);
            for (int l = 0; l < 2; ++l) {
                ComposedVelocity<T>& spoke =
                    out.spokes[static_cast<std::size_t>(pair.first) + static_cast<std::size_t>(l)];
                for (int frame = 0; frame <= pair.spokes.linkage.nq(); ++frame) {
                    unpack(at.motion[frame], l, spoke.motion[frame]);
                }
                for (int j = 0; j < pair.spokes.linkage.nV(); ++j) {
                    spoke.own.V_rate[j] = lane(at.own.V_rate[j], l);
                }
            }
        });
}

}  // namespace hamilcar
