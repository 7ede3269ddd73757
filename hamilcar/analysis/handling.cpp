// A steady motion is z' = A dz + B_s ds + B_T dT = 0 for rack s and drive torque T, bordered by what is asked of it:
//
//     | A    B_s  B_T |  | dz |   | 0  |
//     | C_v  D_vs D_vT|  | ds | = | dv |     v the speed, r the yaw rate
//     | C_r  D_rs D_rT|  | dT |   | dr |
//
// At constant torque the speed is the slowest of all motions, tens of seconds, and without air and rolling resistance A is
// singular. Here the torque is whatever keeps the speed, so the matrix is regular where the vehicle can be steered and
// driven, and nothing has to be left out of A. Straight ahead and left and right alike, dT = 0 comes out by itself.
#include "hamilcar/analysis/handling.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "hamilcar/analysis/held_axle.hpp"
#include "hamilcar/analysis/no_solution.hpp"
#include "hamilcar/math/dense.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct SteadyChange {
    double rack;             // [m]
    Eigen::VectorXd output;  // of the model's outputs
};

// To the neighboring steady motion.
SteadyChange steady_change(const LinearModel& m, double speed, double yaw_rate) {
    const Eigen::Index n = m.A.rows();
    Eigen::MatrixXd steady(n + 2, n + 2);
    steady.topRows(n) << m.A, m.B.col(rack), m.B.col(drive_torque);
    for (const auto& [row, output] : {std::pair{n, output_speed}, std::pair{n + 1, output_yaw_rate}}) {
        steady.row(row) << m.C.row(output), m.D(output, rack), m.D(output, drive_torque);
    }
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(n + 2);
    wanted[n] = speed, wanted[n + 1] = yaw_rate;
    const Eigen::VectorXd x = solve(steady, wanted);
    return {x[n], m.C * x.head(n) + m.D.col(rack) * x[n] + m.D.col(drive_torque) * x[n + 1]};
}

// Where the rack stands at `displacement`.
double rack_per_angle_of(const SteeringDescription& steering, double displacement) {
    const Column column(steering);
    return column.exists() ? column.rack(column.angle(displacement)).slope : none;
}

// How fast a wheel's steer angle turns while its carrier moves so.
double steer_rate(const WheelMotion& wheel, const Spatial<double>& motion) {
    const Vec3<double>& e = wheel.axis;
    const Vec3<double> e_rate = motion.tail<3>().cross(e);
    return (e[0] * e_rate[1] - e[1] * e_rate[0]) / (e[0] * e[0] + e[1] * e[1]);  // of atan2(-e_x, e_y)
}

// Mean of both wheels per displacement of the rack, their centers held at their heights [rad/m].
double steer_per_rack(const WheelMotion& left, const WheelMotion& right) {
    const auto rise = [](const WheelMotion& w) { return velocity_at<double>(w.steer, w.center)[2]; };
    const Eigen::VectorXd held = HeldAxle::motion_for(left, right, {-rise(left), -rise(right)});
    Eigen::Index next = 0;
    const auto rate = [&](const WheelMotion& wheel) {
        Spatial<double> motion = wheel.steer;
        for (const Spatial<double>& column : wheel.J) motion += column * held[next++];
        return steer_rate(wheel, motion);
    };
    const double of_left = rate(left);
    if (share_suspension(left, right)) next = 0;
    return 0.5 * (of_left + rate(right));
}

struct SteeringGeometry {
    double steer_per_rack = none;  // [rad/m]
    double wheelbase = none;       // [m]
};

SteeringGeometry geometry(const Linearizer& linearizer, const OperatingPoint& at) {
    const VehicleDescription& vehicle = linearizer.vehicle();
    const std::vector<WheelMotion> wheels =
        wheel_motions(vehicle, linearizer.model(), at.state, at.input.rack.displacement);
    std::vector<bool> towed;
    for_each_wheel(vehicle, [&](const auto&, std::size_t unit) { towed.push_back(unit != 0); });
    SteeringGeometry out;
    double front = -std::numeric_limits<double>::infinity(), rear = 0;
    int fixed = 0;
    for (const AxleWheels& axle : axles_of(wheels)) {
        const WheelMotion &left = wheels[axle.left], &right = wheels[axle.right];
        const double x = 0.5 * (left.center[0] + right.center[0]);
        const bool steered = left.steer.norm() + right.steer.norm() > 1e-6;
        if (towed[axle.left]) continue;
        if (!steered) rear += x, ++fixed;
        if (steered && x > front) front = x, out.steer_per_rack = steer_per_rack(left, right);
    }
    if (fixed > 0) out.wheelbase = front - rear / fixed;
    return out;
}

OperatingPoint found_point(const Linearizer& linearizer, const Operation& operation) {
    if (!(operation.speed > 0)) {
        throw NoSolution(
            fmt::format("handling is that of a vehicle that drives: got a speed of {} m/s", operation.speed));
    }
    const OperatingPoint at = linearizer.operating_point(operation);
    if (!at.found) throw NoSolution(at.problem);
    return at;
}

}  // namespace

SteadyHandling steady_handling(const Linearizer& linearizer, const OperatingPoint& at) {
    const LinearModel model = linearizer.linearize(at);
    const SteadyChange per_yaw_rate = steady_change(model, 0, 1);
    const Eigen::VectorXd& dy = per_yaw_rate.output;
    const double v_x = model.output[output_speed], v_y = model.output[output_lateral_velocity];
    const double sideslip = (v_x * dy[output_lateral_velocity] - v_y * dy[output_speed]) / (v_x * v_x + v_y * v_y);
    const SteeringGeometry steering = geometry(linearizer, at);

    SteadyHandling out;
    out.speed = v_x, out.lateral_acceleration = v_x * model.output[output_yaw_rate];
    out.drive_torque = at.input.drive_torque;
    out.yaw_rate_gain = 1 / per_yaw_rate.rack;
    out.lateral_acceleration_gain = v_x / per_yaw_rate.rack;
    out.roll_gain = dy[output_roll] / per_yaw_rate.rack;
    out.sideslip_gain = sideslip / per_yaw_rate.rack;
    out.rack_per_angle = rack_per_angle_of(linearizer.vehicle().steering, at.input.rack.displacement);
    out.steering_ratio = 1 / (out.rack_per_angle * steering.steer_per_rack);
    out.wheelbase = steering.wheelbase;
    // d delta_H / d a_y less what the circle itself asks for, whose curvature grows by 1 / v^2.
    const double circle = out.steering_ratio * out.wheelbase;
    out.understeer_gradient = per_yaw_rate.rack / (v_x * out.rack_per_angle) - circle / (v_x * v_x);
    out.roll_gradient = dy[output_roll] / v_x;
    out.sideslip_gradient = sideslip / v_x;
    const double squared = circle / out.understeer_gradient;  // the gain of yaw rate is v / (circle + gradient v^2)
    out.characteristic_speed = squared > 0 ? std::sqrt(squared) : none;
    out.critical_speed = squared < 0 ? std::sqrt(-squared) : none;
    return out;
}

SteadyHandling steady_handling(const VehicleDescription& vehicle, double speed) {
    const Linearizer linearizer(vehicle);
    return steady_handling(linearizer, found_point(linearizer, {.speed = speed}));
}

double constant_radius_gradient(const Linearizer& linearizer, const OperatingPoint& at) {
    const LinearModel model = linearizer.linearize(at);
    const double speed = model.output[output_speed], yaw_rate = model.output[output_yaw_rate];
    // On the circle the yaw rate grows as the speed does, and a_y = v r by both.
    const SteadyChange per_speed = steady_change(model, 1, yaw_rate / speed);
    return per_speed.rack / rack_per_angle_of(linearizer.vehicle().steering, at.input.rack.displacement) /
           (2 * yaw_rate);
}

double constant_radius_gradient(const VehicleDescription& vehicle, double radius, double speed) {
    const Linearizer linearizer(vehicle);
    return constant_radius_gradient(
        linearizer, found_point(linearizer, {.speed = speed, .lateral_acceleration = speed * speed / radius}));
}

std::vector<std::complex<double>> steering_response(const LinearModel& model, double rack_per_angle,
                                                    LinearOutput output, const std::vector<double>& frequencies) {
    std::vector<std::complex<double>> out = frequency_response(model, output, rack, rack_rate, frequencies);
    for (std::complex<double>& one : out) one *= rack_per_angle;
    return out;
}

}  // namespace hamilcar
