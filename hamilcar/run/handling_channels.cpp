#include "hamilcar/run/handling_channels.hpp"

#include "hamilcar/analysis/acceleration.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/run/channel_names.hpp"
#include "hamilcar/scalar/elementary.hpp"

namespace hamilcar {

namespace {

using units::degree;

// Velocity of the chassis's center of mass along and across the heading [m/s].
template <class AnySample>
std::array<typename AnySample::Number, 2> horizontal_velocity(const AnySample& s) {
    using T = typename AnySample::Number;
    const Mat3<T>& R = s.velocity.R_GC;
    const Vec3<T> v = R * velocity_at<T>(s.velocity.chassis, s.model.vehicle.chassis.center);
    const T length = sqrt(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0));
    const T cosine = R(0, 0) / length, sine = R(1, 0) / length;
    return {cosine * v[0] + sine * v[1], cosine * v[1] - sine * v[0]};
}

// From the heading all around: near 180 deg a car rolls backward. None below 3 m/s, where the angle says little [deg].
template <class T>
T sideslip(const std::array<T, 2>& velocity) {
    constexpr double slow = 3;  // [m/s]
    const auto& [along, across] = velocity;
    return select(along * along + across * across < T(slow * slow), T(0), T(angle_of(across, along) / degree));
}

Vec3<double> seat_acceleration(const Sample& s) {
    return acceleration_at(s.model, s.state, s.input, s.velocity, s.momenta, s.model.vehicle.chassis.center);
}

}  // namespace

void add_handling_channels(const VehicleDescription& vehicle, std::vector<Channel>& list) {
    const auto add = [&](const char* name, const char* unit, const char* what, auto read) {
        list.push_back({{name, unit, what}, read});
    };
    add(channel::speed, "m/s", "of the chassis's center of mass, horizontal, along the heading",
        [](const auto& s) { return horizontal_velocity(s)[0]; });
    add(channel::lateral_speed, "m/s", "of that point, horizontal, across the heading, to the left positive",
        [](const auto& s) { return horizontal_velocity(s)[1]; });
    add(channel::yaw_rate, "deg/s", "angular velocity about the vertical", [](const auto& s) {
        return Vec3<NumberOf<decltype(s)>>(s.velocity.R_GC * angular(s.velocity.chassis))[2] / degree;
    });
    add(channel::sideslip, "deg", "of the chassis's center of mass; 0 below 3 m/s",
        [](const auto& s) { return sideslip(horizontal_velocity(s)); });
    const auto add_acceleration = [&](const char* name, const char* what, std::size_t axis, io::ChannelRole role) {
        if (!vehicle.trailers.empty()) {  // what pulls at the hitch is in no sum of external forces
            const auto along_the_path = [axis](const Sample& s) {
                return horizontal_acceleration(s.model, s.state, s.input, s.velocity, s.momenta)[axis];
            };
            return list.push_back({{name, "m/s^2", what, role}, along_the_path, true});
        }
        const auto by_forces = [axis](const auto& s) {
            return horizontal_acceleration_alone(s.model, s.velocity, s.momenta)[axis];
        };
        list.push_back({{name, "m/s^2", what, role}, by_forces, true});
    };
    add_acceleration(channel::longitudinal_acceleration,
                     "of the motor vehicle's center of mass with its wheels, horizontal, along the heading", 0,
                     io::ChannelRole::longitudinal_acceleration);
    add_acceleration(channel::lateral_acceleration, "of that point, horizontal, across the heading", 1,
                     io::ChannelRole::lateral_acceleration);
    const char* const seat[] = {channel::seat_x, channel::seat_y, channel::seat_z};
    for (int axis = 0; axis < 3; ++axis) {
        add(seat[axis], "m/s^2", "of the chassis's center of mass, vehicle axes, without gravity",
            [axis](const Sample& s) { return seat_acceleration(s)[axis]; });
    }
}

}  // namespace hamilcar
