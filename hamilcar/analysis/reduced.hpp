// A vehicle on a flat road without what is indifferent or follows: no ground position and heading, no dependent coordinates,
// no work. What is left rests where the vehicle stands, drives straight or goes round in a circle:
//
//     z = (height, roll, pitch; p, L in chassis axes; V, P_V, p_s, u, v, brake wind-up of every suspension; hitches)
//
// Angles are ISO 8855's. Written for any number, so that derivatives of z' are exact.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hamilcar/block/integration.hpp"

namespace hamilcar {

// Which numbers of a state z holds, and what they are.
class ReducedCoordinates {
public:
    explicit ReducedCoordinates(const VehicleDescription& description);
    int size() const { return first_further + static_cast<int>(further_.size()); }
    const std::vector<StateNumber>& numbers() const { return numbers_; }
    const std::vector<int>& further() const { return further_; }  // places in State::values

    static constexpr int first_momentum = 3, first_further = 9;

private:
    std::vector<int> further_;
    std::vector<StateNumber> numbers_;
};

template <class T>
Mat3<T> roll_pitch_rotation(const T& roll, const T& pitch) {
    return axis_rotation<T>(Vec3<T>::UnitY(), pitch) * axis_rotation<T>(Vec3<T>::UnitX(), roll);
}

// The state that z stands for, at the origin and heading along x; dependent coordinates start from those of `around` and
// are closed, which for dual numbers gives their derivatives too.
template <class T>
State<T> state_of(const Model<T>& model, const ReducedCoordinates& reduced, const T* z, const State<double>& around,
                  const RackMotion<T>& rack) {
    State<T> state;
    for (std::size_t i = 0; i < state.values.size(); ++i) state.values[i] = T(around.values[i]);
    const auto [sr, cr] = sincos(T(z[1] * T(0.5)));
    const auto [sp, cp] = sincos(T(z[2] * T(0.5)));
    state.position() << T(0), T(0), z[0];
    state.orientation() << cp * cr, cp * sr, sp * cr, T(-(sp * sr));  // of pitch times roll
    const Mat3<T> R = roll_pitch_rotation(z[1], z[2]);
    const T* momentum = z + ReducedCoordinates::first_momentum;
    const Vec3<T> p(momentum[0], momentum[1], momentum[2]), L(momentum[3], momentum[4], momentum[5]);
    state.momentum() = spatial<T>(R * p, R * L);
    for (std::size_t i = 0; i < reduced.further().size(); ++i) {
        state.values[static_cast<std::size_t>(reduced.further()[i])] = z[ReducedCoordinates::first_further + i];
    }
    close_loops(model, rack, state, 6);
    return state;
}

// z of a state on the flat, whatever its heading.
std::vector<double> reduced_from(const ReducedCoordinates& reduced, const State<double>& state);

// What is asked of a vehicle besides z': outputs of a linear model.
template <class T>
struct ReducedOutputs {
    T speed, lateral_velocity, yaw_rate;     // of the center of mass along and across the heading [m/s], [rad/s]
    T lateral_acceleration;                  // of the whole vehicle's center of mass, across the heading [m/s^2]
    T vertical_velocity;                     // of the seat [m/s]
    std::vector<T> wheel_travel, tire_load;  // wheel by wheel [m], [N]
};

template <class T>
void add_wheel_outputs(const Vehicle<T>& vehicle, const Momenta<T>& momenta, ReducedOutputs<T>& out) {
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        for (std::size_t i = 0; i < vehicle.suspensions[s].wheels.size(); ++i) {
            const WheelForces<T>& f = momenta.suspensions[s].wheels[i];
            out.wheel_travel.push_back(f.travel);
            out.tire_load.push_back(vehicle.suspensions[s].wheels[i].tires == 2
                                        ? T(f.tires[0].tire.Fz + f.tires[1].tire.Fz)
                                        : f.tires[0].tire.Fz);
        }
    }
}

// z' and the outputs. `seat` is the point whose ride is asked for, in the vehicle frame.
template <class T>
ReducedOutputs<T> reduced_rates(const Model<T>& model, const ReducedCoordinates& reduced, const Input<T>& input,
                                const T* z, const State<double>& around, const Vec3<T>& seat, T* z_rate) {
    const State<T> state = state_of(model, reduced, z, around, input.rack);
    // Of numbers with derivatives too large for a stack.
    const std::unique_ptr<const Velocity<T>> velocities(new Velocity<T>(velocity_block(model, state, input)));
    const Velocity<T>& velocity = *velocities;
    const std::unique_ptr<const Momenta<T>> all_momenta(new Momenta<T>(momenta_block(model, state, input, velocity)));
    const Momenta<T>& momenta = *all_momenta;
    State<T> rate;
    rate_of_state(model, state, velocity, momenta, rate);
    const Vec3<T> w = angular(velocity.chassis);
    const auto [sr, cr] = sincos(z[1]);
    const auto [sp, cp] = sincos(z[2]);
    const T yaw_part = w[1] * sr + w[2] * cr;
    z_rate[0] = rate.position()[2];
    z_rate[1] = w[0] + yaw_part * sp / cp;
    z_rate[2] = w[1] * cr - w[2] * sr;
    // R^T (d/dt) - w x: rates of p and L as the chassis sees them.
    const Mat3<T>& R = velocity.R_GC;
    const Vec3<T> p = linear(velocity.momentum), L = angular(velocity.momentum);
    const Vec3<T> p_rate = R.transpose() * Vec3<T>(linear(rate.momentum())) - w.cross(p);
    const Vec3<T> L_rate = R.transpose() * Vec3<T>(angular(rate.momentum())) - w.cross(L);
    for (int i = 0; i < 3; ++i) {
        z_rate[ReducedCoordinates::first_momentum + i] = p_rate[i];
        z_rate[ReducedCoordinates::first_momentum + 3 + i] = L_rate[i];
    }
    for (std::size_t i = 0; i < reduced.further().size(); ++i) {
        z_rate[ReducedCoordinates::first_further + i] = rate.values[static_cast<std::size_t>(reduced.further()[i])];
    }
    ReducedOutputs<T> out;
    const Vec3<T> v = R * velocity_at<T>(velocity.chassis, model.vehicle.chassis.center);
    const Vec3<T> force = R * Vec3<T>(linear(momenta.external));
    out.speed = v[0], out.lateral_velocity = v[1], out.yaw_rate = yaw_part / cp;
    out.lateral_acceleration = force[1] / model.vehicle.total_mass;
    out.vertical_velocity = Vec3<T>(R * velocity_at<T>(velocity.chassis, seat))[2];
    add_wheel_outputs(model.vehicle, momenta, out);
    return out;
}

}  // namespace hamilcar
