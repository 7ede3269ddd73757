// The Momenta block of one suspension, or of two side by side: forces and the rates of its momenta, with sums over its
// bodies and wheels,
//     P_V' = sum J^T (Qhat - v_u x* h) + sum J'^T h + sum F dl/dV                       // (71); J' as seen from the unit
// Springs, dampers, stops, bars and half-shafts act between bodies of the car: they enter through P_V' alone.
//
// The rate of `work` is the power of all forces that have no potential, less the power of the motion x that the rack
// prescribes: d/dt (T + U - sum x.h) = sum Q_nc.v - sum x.Q - sum x'.h  (docs/theory/formulation.md, energy).
#pragma once

#include "hamilcar/block/velocity.hpp"
#include "hamilcar/block/wheel_momenta.hpp"

namespace hamilcar {

template <class T>
struct AxialForce {
    T force, length, rate;  // [N, m, m/s], or [N m, rad, rad/s]
};

template <class T>
struct SuspensionMomenta {
    std::array<T, max_freedoms> momentum_rate;
    std::array<T, max_equations> W_rate;
    std::array<T, max_wheels> spin_momentum_rate, windup_rate;
    std::array<WheelForces<T>, max_wheels> wheels;
    std::array<AxialForce<T>, max_axial_elements> springs, dampers;
    SuspensionMomenta() {}
};

// What is computed along the motion that the rack gives: its force where it moves on its own; where it is prescribed, the work of that
// force, or nothing where no balance of energy is kept.
enum class RackKind { free, prescribed, without_work };

// What other parts of the car do to a wheel.
template <class T>
struct WheelLoads {
    T bar;          // of anti-roll bars along its travel [N], or their moment on its arm [N m]
    T active;       // that part of it that an actuator makes, along its travel [N]
    T shaft;        // torque of a driveline [N m]
    T brake_limit;  // torque that its brake can hold [N m]
};

// Evaluates the forces and rates of one suspension, and what they add to its unit.
template <class T>
class SuspensionEvaluator {
public:
    SuspensionEvaluator(const Suspension<T>& suspension, const SuspensionVelocity<T>& velocity, const T* values,
                        const WheelInput<T>& input, const Surroundings<T>& world, const UnitGround<T>& ground,
                        RackKind kind, SuspensionMomenta<T>& out)
        : suspension_(suspension),
          velocity_(velocity),
          at_(velocity.at),
          values_(values),
          input_(input),
          world_(world),
          ground_(ground),
          kind_(kind),
          out_(out),
          n_(suspension.linkage.nV()) {
        const RackMotion<T>& rack = input.rack;
        suspension.linkage.find_rates(at_, velocity.own.V_rate, rack, rates_);
        const RackMotion<T> unit{rack.displacement, T(1), T(0)};
        if (kind != RackKind::without_work) {
            suspension.linkage.find_prescribed_rates(at_, rates_, kind == RackKind::free ? unit : rack, world.gain,
                                                     x_rate_);
        }
        external_.setZero();
        for (int j = 0; j < n_; ++j) out.momentum_rate[j] = T(0);
        for (int i = 0; i < suspension.linkage.nW(); ++i) out.W_rate[i] = rates_.q[suspension.linkage.dependent[i]];
    }

    void add_bodies() {
        for (std::size_t i = 0; i < suspension_.bodies.size(); ++i) {
            const int frame = suspension_.bodies[i].frame;
            const SpatialInertia<T>& inertia = velocity_.inertia[i];
            const Spatial<T> weight =
                spatial<T>(world_.gravity * inertia.mass, inertia.first_moment.cross(world_.gravity));
            external_ += weight;
            add(frame, weight, inertia * velocity_.motion[frame]);
        }
    }

    // `first`: number of its first wheel in the vehicle, or of the first of both.
    void add_wheels(const std::array<int, 2>& first, const std::array<WheelLoads<T>, max_wheels>& loads) {
        std::array<MovingWheel<T>, max_wheels> moving;
        for (std::size_t i = 0; i < suspension_.wheels.size(); ++i) {
            moving[i] = moving_wheel(static_cast<int>(i), loads[i]);
        }
        if constexpr (has_pairs<T>) {
            if (!suspension_.both_wheels.empty()) return add_both_wheels(first[0], moving, loads);
        }
        for (std::size_t i = 0; i < suspension_.wheels.size(); ++i) {
            const int number = static_cast<int>(i);
            const GroundOfWheel<T> below{ground_, {first[0] + number, first[1] + number}};
            const auto momenta = wheel_momenta(suspension_.wheels[i], moving[i], below, out_.wheels[i]);
            add_wheel(number, moving[i], momenta, loads[i]);
        }
    }

    // Of the shaft to a differential on this axle, about the shaft; the chassis gets the same the other way.
    void add_shaft(const T& torque) {
        const int frame = suspension_.shaft_frame;
        const Vec3<T>& axis = suspension_.shaft_axis;
        add(frame, spatial<T>(Vec3<T>::Zero(), axis * torque), Spatial<T>::Zero());
        work_ += torque * axis.dot(Vec3<T>(angular(velocity_.motion[frame]) - angular(velocity_.motion[0])));
    }

    // `shares`: of the dampers' forces, of those that are adjustable.
    void add_springs(const std::array<T, max_axial_elements>& shares) {
        const auto state = suspension_.state(values_);
        const auto line_of = [&](const auto& element) {
            return suspension_.linkage.line(element.line, at_, state.independent, state.dependent);
        };
        for (std::size_t i = 0; i < suspension_.springs.size(); ++i) {
            const LineOfAction<T> line = line_of(suspension_.springs[i]);
            out_.springs[i] = {suspension_.springs[i].spring.force(line.length), line.length, rate_of(line)};
            push(out_.springs[i].force, line);
        }
        for (std::size_t i = 0; i < suspension_.dampers.size(); ++i) {
            const LineOfAction<T> line = line_of(suspension_.dampers[i]);
            const T rate = rate_of(line);
            T force = suspension_.dampers[i].damper.force(rate);
            if (suspension_.dampers[i].actuator >= 0) force = force * shares[i];
            out_.dampers[i] = {force, line.length, rate};
            push(out_.dampers[i].force, line);
            work_ += out_.dampers[i].force * rate;
        }
    }

    // The equations of motion, once all forces are added.
    void finish() {
        for (int frame = 1; frame <= suspension_.linkage.nq(); ++frame) {
            if (!loaded_[frame]) continue;
            const Spatial<T> net = Q_[frame] - cross_force<T>(world_.chassis, h_[frame]);
            for (int j = 0; j < n_; ++j) {
                out_.momentum_rate[j] +=
                    at_.motion.J[frame].col(j).dot(net) + rates_.motion.J[frame].col(j).dot(h_[frame]);  // (71)
            }
            if (kind_ == RackKind::without_work) continue;
            const T along = at_.motion.x[frame].dot(net) + x_rate_[frame].dot(h_[frame]);
            if (kind_ == RackKind::free) {
                driven_ += along;
            } else {
                work_ -= along;
            }
        }
    }

    const Spatial<T>& external() const { return external_; }
    const T& work() const { return work_; }
    // On a rack that moves on its own, in the sense of its momentum's rate [N].
    const T& on_rack() const { return driven_; }

private:
    T rate_of(const LineOfAction<T>& line) const {
        T rate = line.prescribed_rate * at_.pace;
        for (int j = 0; j < n_; ++j) rate += line.gradient[j] * velocity_.own.V_rate[j];
        return rate;
    }

    MovingWheel<T> moving_wheel(int i, const WheelLoads<T>& loads) const {
        const SuspensionWheel<T>& wheel = suspension_.wheels[i];
        const auto state = suspension_.wheel_state(i, values_);
        MovingWheel<T> out{.spin_momentum = state.spin_momentum,
                           .brake_windup = state.brake_windup,
                           .deflection = {},
                           .center = velocity_.center[i],
                           .axis = velocity_.axis[i],
                           .carrier = velocity_.motion[wheel.frame],
                           .drive_torque = wheel.drive_share * input_.drive_torque + loads.shaft,
                           .brake_limit = loads.brake_limit};
        std::copy_n(state.deflection, 2 * wheel.tires, out.deflection.begin());
        return out;
    }

    // Both wheels of an axle side by side.
    void add_both_wheels(int first, const std::array<MovingWheel<T>, max_wheels>& moving,
                         const std::array<WheelLoads<T>, max_wheels>& loads) {
        using S = Paired<T>;
        const SuspensionWheel<S>& wheels = suspension_.both_wheels[0];
        const UnitGround<S> ground{in_both<S>(ground_.plane), ground_.uneven};
        WheelForces<S> forces;
        const WheelMomenta<S> both = wheel_momenta(wheels, side_by_side<S>(moving[0], moving[1], wheels.tires),
                                                   {ground, {first, first + 1}}, forces);
        for (int i = 0; i < 2; ++i) {
            add_wheel(i, moving[i], unpack_wheel(both, forces, wheels.tires, i, out_.wheels[i]), loads[i]);
        }
    }

    // Adds a wheel's forces and rates to the suspension's.
    void add_wheel(int i, const MovingWheel<T>& at, const WheelMomenta<T>& momenta, const WheelLoads<T>& loads) {
        const SuspensionWheel<T>& wheel = suspension_.wheels[i];
        WheelForces<T>& f = out_.wheels[i];
        out_.windup_rate[i] = momenta.windup_rate;
        out_.spin_momentum_rate[i] = momenta.spin_momentum_rate;
        work_ += momenta.lost_in_tires;
        external_ += momenta.wrench;
        Spatial<T> wrench = momenta.wrench;
        const Spatial<T> shaft = spatial<T>(Vec3<T>::Zero(), at.axis * f.drive_torque);
        if (wheel.reaction != wheel.frame) wrench += shaft;
        add(wheel.frame, wrench, spatial<T>(Vec3<T>::Zero(), velocity_.spin_momentum[i]));
        if (wheel.reaction != 0 && wheel.reaction != wheel.frame) {
            add(wheel.reaction, Spatial<T>(-shaft), Spatial<T>::Zero());
        }
        const T turned = at.axis.dot(angular(at.carrier) - angular(velocity_.motion[wheel.reaction]));
        work_ += f.drive_torque * (f.spin + turned) + f.brake_torque * f.spin;

        f.travel = at.center[2] - wheel.wheel.center[2];
        f.bar = loads.bar;
        f.stop = wheel.bump.force(f.travel) - wheel.rebound.force(T(-f.travel));
        LineOfAction<T> line;
        line.length = f.travel;
        suspension_.linkage.along(Vec3<T>::UnitZ(), at.center, wheel.frame, 0, at_.own, line);
        if (wheel.bar_arm < 0) {
            work_ += loads.active * rate_of(line);
            return push(f.stop + f.bar, line);
        }
        push(f.stop, line);
        const auto state = suspension_.state(values_);
        push(f.bar, suspension_.linkage.along(wheel.bar_arm, at_, state.independent, state.dependent));
    }

    // Adds the force on a body or a wheel on `frame`, and its momentum.
    void add(int frame, const Spatial<T>& Q, const Spatial<T>& h) {
        if (loaded_[frame]) {
            Q_[frame] += Q, h_[frame] += h;
        } else {
            Q_[frame] = Q, h_[frame] = h, loaded_[frame] = true;
        }
    }

    void push(const T& force, const LineOfAction<T>& line) {
        for (int j = 0; j < n_; ++j) out_.momentum_rate[j] += force * line.gradient[j];
        if (kind_ == RackKind::free) {
            driven_ += force * line.prescribed_rate;
        } else {
            work_ -= force * line.prescribed_rate;
        }
    }

    const Suspension<T>& suspension_;
    const SuspensionVelocity<T>& velocity_;
    const LinkagePosition<T>& at_;
    const T* values_;
    const WheelInput<T>& input_;
    const Surroundings<T>& world_;
    const UnitGround<T>& ground_;
    RackKind kind_;
    SuspensionMomenta<T>& out_;
    int n_;
    LinkageRates<T> rates_;
    std::array<Spatial<T>, max_frames> x_rate_, Q_, h_;
    std::array<bool, max_frames> loaded_{};
    Spatial<T> external_;
    T work_{0};
    T driven_{0};  // force along the motion that a rack on its own gives, per unit of its rate [N]
};

}  // namespace hamilcar
