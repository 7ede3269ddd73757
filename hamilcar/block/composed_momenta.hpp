// The Momenta block for composed suspensions and trailers: the same equations, with sums over a spoke's bodies,
//     P_V' = sum J^T (Qhat - v_hub x* h) + sum J'^T h + sum F dl/dV                       // (71)
// and for a hitch with h and Qhat of everything behind it, so that a trailer is a body like any other.
#pragma once

#include "hamilcar/block/unit_place.hpp"
#include "hamilcar/block/velocity.hpp"
#include "hamilcar/block/wheel_momenta.hpp"

namespace hamilcar {

template <class T>
struct ComposedWheelForces : WheelForces<T> {
    std::array<TireForces<T>, max_tires_abreast> tires;  // the first is also the wheel's own
};

template <class T>
struct AxialForce {
    T force, length, rate;  // [N, m, m/s], or [N m, rad, rad/s]
};

template <class T>
struct ComposedMomenta {
    std::array<T, max_freedoms> momentum_rate;
    std::array<T, max_equations> W_rate;
    std::array<T, max_wheels> spin_momentum_rate, windup_rate;
    std::array<ComposedWheelForces<T>, max_wheels> wheels;
    std::array<AxialForce<T>, max_axial_elements> springs, dampers;
    ComposedMomenta() {}
};

template <class T>
struct TrailerMomenta {
    std::array<T, max_freedoms> momentum_rate;
    Spatial<T> external;           // on the trailer and all it pulls, in its axes about its origin
    Surroundings<T> surroundings;  // as seen from its axes
    TrailerMomenta() {}
};

template <class T>
struct ComposedMomentaOfAll {
    StaticVector<ComposedMomenta<T>, max_composed> spokes;
    StaticVector<TrailerMomenta<T>, max_trailers> trailers;
};

// The forces and rates of one spoke, and what they add to its unit.
template <class T>
class ComposedSpokeMomenta {
public:
    ComposedSpokeMomenta(const ComposedSpoke<T>& spoke, const ComposedVelocity<T>& velocity, const T* values,
                         const Input<T>& input, const Surroundings<T>& world, const GroundBelow<T>& ground,
                         bool with_work, ComposedMomenta<T>& out)
        : spoke_(spoke),
          velocity_(velocity),
          at_(velocity.at),
          values_(values),
          input_(input),
          world_(world),
          ground_(ground),
          with_work_(with_work),
          out_(out),
          n_(spoke.linkage.nV()) {
        spoke.linkage.find_rates(at_, velocity.own.V_rate, input.rack, rates_);
        if (with_work) spoke.linkage.find_drift_rates(at_, rates_, input.rack, world.gain, x_rate_);
        external_.setZero();
        for (int j = 0; j < n_; ++j) out.momentum_rate[j] = T(0);
        for (int i = 0; i < spoke.linkage.nW(); ++i) out.W_rate[i] = rates_.q[spoke.linkage.dependent[i]];
    }

    void add_bodies() {
        for (std::size_t i = 0; i < spoke_.bodies.size(); ++i) {
            const int frame = spoke_.bodies[i].frame;
            const SpatialInertia<T>& inertia = velocity_.inertia[i];
            const Spatial<T> weight = spatial<T>(world_.gravity * inertia.mass, inertia.moment.cross(world_.gravity));
            external_ += weight;
            add(frame, weight, inertia * velocity_.motion[frame]);
        }
    }

    // `numbers`: of the wheels in the vehicle; `bar`: of anti-roll bars, along the wheel's travel [N]; `shaft`: torque of a
    // driveline [N m].
    void add_wheel(int i, const std::array<int, 2>& numbers, const T& bar, const T& shaft_torque) {
        const ComposedWheel<T>& wheel = spoke_.wheels[i];
        const auto state = spoke_.wheel_state(i, values_);
        ComposedWheelForces<T>& f = out_.wheels[i];
        const Vec3<T>& axis = velocity_.axis[i];
        const Spatial<T>& motion = velocity_.motion[wheel.frame];
        const T omega = state.spin_momentum * wheel.wheel.inverse_spin_inertia, turning = axis.dot(angular(motion));
        f.spin = omega - turning;
        f.tire_spin_torque = T(0);
        Spatial<T> wrench = Spatial<T>::Zero();
        for (int k = 0; k < wheel.tires; ++k) {
            const T aside = wheel.tires == 1 ? T(0) : k == 0 ? wheel.half_spacing : T(-wheel.half_spacing);
            T torque;
            wrench += tire_wrench<T>(wheel.tire, {ground_, numbers}, Vec3<T>(velocity_.center[i] + axis * aside), axis,
                                     motion, omega, turning, state.deflection[2 * k], state.deflection[2 * k + 1],
                                     f.tires[k], torque);
            f.tire_spin_torque += torque;
            work_ += lost_in_tire(f.tires[k]);
        }
        static_cast<TireForces<T>&>(f) = f.tires[0];
        const auto brake = wheel.brake.evaluate(input_.brake, f.spin, state.brake_windup);
        f.drive_torque = wheel.drive_share * input_.drive_torque + shaft_torque;
        f.brake_torque = brake.torque;
        out_.windup_rate[i] = brake.windup_rate;
        out_.spin_momentum_rate[i] = f.tire_spin_torque + f.drive_torque + f.brake_torque;
        external_ += wrench;
        const Spatial<T> shaft = spatial<T>(Vec3<T>::Zero(), axis * f.drive_torque);
        if (wheel.reaction != wheel.frame) wrench += shaft;
        add(wheel.frame, wrench, spatial<T>(Vec3<T>::Zero(), velocity_.spin_momentum[i]));
        if (wheel.reaction != 0 && wheel.reaction != wheel.frame) {
            add(wheel.reaction, Spatial<T>(-shaft), Spatial<T>::Zero());
        }
        const T turned = axis.dot(angular(motion) - angular(velocity_.motion[wheel.reaction]));
        work_ += f.drive_torque * (f.spin + turned) + f.brake_torque * f.spin;

        f.travel = velocity_.center[i][2] - wheel.wheel.center[2];
        f.bar = bar;
        f.stop = wheel.bump.force(f.travel) - wheel.rebound.force(T(-f.travel));
        ComposedLine<T> line;
        line.length = f.travel;
        spoke_.linkage.along(Vec3<T>::UnitZ(), velocity_.center[i], wheel.frame, 0, at_.own, line);
        push(f.stop + f.bar, line);
    }

    void add_springs() {
        const auto state = spoke_.state(values_);
        const auto line_of = [&](const auto& element) {
            return spoke_.linkage.line(element.line, at_, state.independent, state.dependent);
        };
        const auto rate_of = [&](const ComposedLine<T>& line) {
            T rate = line.drift;
            for (int j = 0; j < n_; ++j) rate += line.gradient[j] * velocity_.own.V_rate[j];
            return rate;
        };
        for (std::size_t i = 0; i < spoke_.springs.size(); ++i) {
            const ComposedLine<T> line = line_of(spoke_.springs[i]);
            out_.springs[i] = {spoke_.springs[i].spring.force(line.length), line.length, rate_of(line)};
            push(out_.springs[i].force, line);
        }
        for (std::size_t i = 0; i < spoke_.dampers.size(); ++i) {
            const ComposedLine<T> line = line_of(spoke_.dampers[i]);
            const T rate = rate_of(line);
            out_.dampers[i] = {spoke_.dampers[i].damper.force(rate), line.length, rate};
            push(out_.dampers[i].force, line);
            work_ += out_.dampers[i].force * rate;
        }
    }

    // The equations of motion, once everything has pushed.
    void finish() {
        for (int frame = 1; frame <= spoke_.linkage.nq(); ++frame) {
            if (!loaded_[frame]) continue;
            const Spatial<T> carried = Q_[frame] - cross_force<T>(world_.hub, h_[frame]);
            for (int j = 0; j < n_; ++j) {
                out_.momentum_rate[j] +=
                    at_.motion.J[frame].col(j).dot(carried) + rates_.motion.J[frame].col(j).dot(h_[frame]);  // (71)
            }
            if (with_work_) work_ -= at_.motion.x[frame].dot(carried) + x_rate_[frame].dot(h_[frame]);
        }
    }

    const Spatial<T>& external() const { return external_; }
    const T& work() const { return work_; }

private:
    // What a body or a wheel on `frame` feels, and its momentum.
    void add(int frame, const Spatial<T>& Q, const Spatial<T>& h) {
        if (loaded_[frame]) {
            Q_[frame] += Q, h_[frame] += h;
        } else {
            Q_[frame] = Q, h_[frame] = h, loaded_[frame] = true;
        }
    }

    void push(const T& force, const ComposedLine<T>& line) {
        for (int j = 0; j < n_; ++j) out_.momentum_rate[j] += force * line.gradient[j];
        work_ -= force * line.drift;
    }

    const ComposedSpoke<T>& spoke_;
    const ComposedVelocity<T>& velocity_;
    const ComposedPosition<T>& at_;
    const T* values_;
    const Input<T>& input_;
    const Surroundings<T>& world_;
    const GroundBelow<T>& ground_;
    bool with_work_;
    ComposedMomenta<T>& out_;
    int n_;
    ComposedRates<T> rates_;
    std::array<Spatial<T>, max_frames> x_rate_, Q_, h_;
    std::array<bool, max_frames> loaded_{};
    Spatial<T> external_;
    T work_{0};
};

// Forces of the bars on the wheels along their travel, wheel by wheel.
template <class T, class S>
void composed_bar_forces(const Vehicle<T>& vehicle, const ComposedVelocities<T, S>& velocity,
                         std::array<T, max_composed_wheels>& force) {
    std::array<T, max_composed_wheels> travel;
    for (std::size_t s = 0; s < vehicle.composed.size(); ++s) {
        const ComposedSpoke<T>& spoke = vehicle.composed[s];
        for (std::size_t i = 0; i < spoke.wheels.size(); ++i) {
            const std::size_t number = static_cast<std::size_t>(spoke.first_wheel) + i;
            travel[number] = velocity.spokes[s].center[i][2] - spoke.wheels[i].wheel.center[2];
            force[number] = T(0);
        }
    }
    for (const AntiRollBar<T>& bar : vehicle.composed_bars) {
        const T pull = bar.rate * (travel[bar.left] - travel[bar.right]);
        force[bar.left] -= pull;
        force[bar.right] += pull;
    }
}

template <class T>
UnitPlace<T> behind(const UnitPlace<T>& tow, const Pose<T>& pose) {
    return {tow.position + tow.R * pose.p, tow.R * pose.R};
}

template <class T>
Surroundings<T> surroundings_of(const Model<T>& model, const UnitPlace<T>& place, const Spatial<T>& motion) {
    return {model.road.seen_from(place.position, place.R), place.R.row(2).transpose() * (-model.vehicle.gravity),
            motion, model.stabilization_gain};
}

// The hitch, once everything behind it is summed up; hands the force on to the unit that pulls.
template <class T>
void finish_trailer(const Trailer<T>& trailer, const TrailerVelocity<T>& at, const Spatial<T>& tow_motion,
                    TrailerMomenta<T>& out, Spatial<T>& tow_external, T& work_rate) {
    const int n = trailer.freedoms();
    const Spatial<T> momentum = at.condensed.K * at.motion + at.condensed.b;
    const Spatial<T> h = carried_over(at.pose, momentum), Q = carried_over(at.pose, out.external);
    ComposedRates<T> rates;
    trailer.hitch.find_rates(at.hitch, at.own.V_rate, RackMotion<T>{}, rates);
    const Spatial<T> carried = Q - cross_force<T>(tow_motion, h);
    for (int j = 0; j < n; ++j) {
        out.momentum_rate[j] = at.hitch.motion.J[n].col(j).dot(carried) + rates.motion.J[n].col(j).dot(h);
    }
    const T yaw_rate = at.own.V_rate[trailer.yaw], damping = trailer.yaw_damping * yaw_rate;
    out.momentum_rate[trailer.yaw] -= damping;
    work_rate -= damping * yaw_rate;
    tow_external += Q;
}

// Number l of those abreast: what write_composed_rates asks for.
template <class T, class S>
void unpack_rates(const ComposedMomenta<S>& from, int l, ComposedMomenta<T>& to) {
    unpack(from.momentum_rate, l, to.momentum_rate);
    unpack(from.W_rate, l, to.W_rate);
    unpack(from.spin_momentum_rate, l, to.spin_momentum_rate);
    unpack(from.windup_rate, l, to.windup_rate);
    for (std::size_t i = 0; i < to.wheels.size(); ++i) {
        for (std::size_t k = 0; k < to.wheels[i].tires.size(); ++k) {
            const TireForce<S>& tire = from.wheels[i].tires[k].tire;
            to.wheels[i].tires[k].tire.u_rate = lane(tire.u_rate, l);
            to.wheels[i].tires[k].tire.v_rate = lane(tire.v_rate, l);
        }
    }
}

// Everything composed and trailed, driven by `shafts` if there are any; adds to the motor vehicle's external wrench and to the work.
template <class T, class S>
void composed_momenta(const Model<T>& model, const State<T>& state, const Input<T>& input,
                      const ComposedVelocities<T, S>& velocity, const Mat3<T>& R_GC,
                      const Surroundings<T>& motor_vehicle, const std::array<T, max_composed_wheels>* shafts,
                      ComposedMomentaOfAll<T>& out, Spatial<T>& external, T& work_rate) {
    const Vehicle<T>& vehicle = model.vehicle;
    std::array<UnitPlace<T>, max_trailers + 1> places;
    places[0] = {state.position(), R_GC};
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        const Trailer<T>& trailer = vehicle.trailers[i];
        TrailerMomenta<T>& own = out.trailers.emplace_back();
        places[i + 1] = behind(places[static_cast<std::size_t>(trailer.tow)], velocity.trailers[i].pose);
        own.surroundings = surroundings_of(model, places[i + 1], velocity.trailers[i].motion);
        own.external = spatial<T>(own.surroundings.gravity * trailer.chassis.mass,
                                  trailer.chassis_inertia.moment.cross(own.surroundings.gravity));
    }
    std::array<T, max_composed_wheels> bars;
    composed_bar_forces(vehicle, velocity, bars);
    UnevenGround<RoadNumber<T>> uneven;
    const auto world_of = [&](int unit) -> const Surroundings<T>& {
        return unit == 0 ? motor_vehicle : out.trailers[static_cast<std::size_t>(unit) - 1].surroundings;
    };
    const auto ground_of = [&](int unit) {
        return ground_below(model, places[static_cast<std::size_t>(unit)], world_of(unit).road, input.time, uneven);
    };
    const auto external_of = [&](int unit) -> Spatial<T>& {
        return unit == 0 ? external : out.trailers[static_cast<std::size_t>(unit) - 1].external;
    };
    const auto shaft_of = [&](std::size_t wheel) { return shafts ? (*shafts)[wheel] : T(0); };
    vehicle.for_each_composed(
        [&](std::size_t s) {
            const ComposedSpoke<T>& spoke = vehicle.composed[s];
            const GroundBelow<T> ground = ground_of(spoke.unit);
            ComposedSpokeMomenta<T> momenta(spoke, velocity.spokes[s], state.values.data(), input, world_of(spoke.unit),
                                            ground, model.energy_balance, out.spokes.emplace_back());
            momenta.add_bodies();
            for (std::size_t i = 0; i < spoke.wheels.size(); ++i) {
                const auto wheel = static_cast<std::size_t>(spoke.first_wheel) + i;
                const int number = vehicle.spoke_count() + static_cast<int>(wheel);
                momenta.add_wheel(static_cast<int>(i), {number, number}, bars[wheel], shaft_of(wheel));
            }
            momenta.add_springs();
            momenta.finish();
            external_of(spoke.unit) += momenta.external();
            work_rate += momenta.work();
        },
        [&](const auto& pair, std::size_t number) {
            const int unit = pair.spokes.unit;
            const auto numbers = gather_pair(pair, state.values.data());
            const GroundBelow<T> ground = ground_of(unit);
            const Surroundings<S> around = abreast<S>(world_of(unit));
            const GroundBelow<S> below{around.road, ground.uneven};
            const Input<S> inputs = abreast<S>(input);
            ComposedMomenta<S> both;
            ComposedSpokeMomenta<S> momenta(pair.spokes, velocity.pairs[number], numbers.data(), inputs, around, below,
                                            model.energy_balance, both);
            momenta.add_bodies();
            for (std::size_t i = 0; i < pair.spokes.wheels.size(); ++i) {
                std::array<std::size_t, 2> wheels;
                for (std::size_t l = 0; l < 2; ++l) {
                    const auto first = static_cast<std::size_t>(pair.first) + l;
                    wheels[l] = static_cast<std::size_t>(vehicle.composed[first].first_wheel) + i;
                }
                const int corners = vehicle.spoke_count();
                momenta.add_wheel(static_cast<int>(i),
                                  {corners + static_cast<int>(wheels[0]), corners + static_cast<int>(wheels[1])},
                                  from_places<S>(bars, wheels), shafts ? from_places<S>(*shafts, wheels) : S(T(0)));
            }
            momenta.add_springs();
            momenta.finish();
            for (int l = 0; l < 2; ++l) {
                Spatial<T> wrench;
                unpack(momenta.external(), l, wrench);
                external_of(unit) += wrench;
                work_rate += lane(momenta.work(), l);
                unpack_rates(both, l, out.spokes.emplace_back());
            }
        });
    for (std::size_t i = vehicle.trailers.size(); i-- > 0;) {
        const Trailer<T>& trailer = vehicle.trailers[i];
        const auto tow = static_cast<std::size_t>(trailer.tow);
        finish_trailer(trailer, velocity.trailers[i], tow == 0 ? motor_vehicle.hub : velocity.trailers[tow - 1].motion,
                       out.trailers[i], tow == 0 ? external : out.trailers[tow - 1].external, work_rate);
    }
}

}  // namespace hamilcar
