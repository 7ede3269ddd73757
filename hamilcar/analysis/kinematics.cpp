#include "hamilcar/analysis/kinematics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "hamilcar/analysis/held_axle.hpp"
#include "hamilcar/analysis/loops.hpp"
#include "hamilcar/analysis/no_solution.hpp"
#include "hamilcar/block/initial_process.hpp"
#include "hamilcar/block/road_wheels.hpp"

namespace hamilcar {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// The lowest point of a wheel of that radius.
Vec3<double> contact_of(const WheelMotion& wheel, double radius) {
    const Vec3<double> down = (Vec3<double>::UnitZ() - wheel.axis * wheel.axis[2]).normalized();
    return wheel.center - down * radius;
}

// How fast a motion changes what has that gradient by the coordinates from `first` on.
double rate_along(const std::vector<double>& gradient, const Eigen::VectorXd& dq, Eigen::Index first) {
    double rate = 0;
    for (std::size_t j = 0; j < gradient.size(); ++j) rate += gradient[j] * dq[first + static_cast<Eigen::Index>(j)];
    return rate;
}

double spring_lift(const WheelMotion& wheel, const Eigen::VectorXd& dq, Eigen::Index first) {
    double power = 0;
    for (const LineMotion& spring : wheel.springs) {
        for (std::size_t j = 0; j < spring.gradient.size(); ++j) {
            power -= spring.force * spring.gradient[j] * dq[first + static_cast<Eigen::Index>(j)];
        }
    }
    return power;
}

// Shortening of the wheel's own first spring or damper.
double ratio(const std::vector<LineMotion>& lines, const std::string& wheel, const Eigen::VectorXd& dq,
             Eigen::Index first) {
    const auto own = std::ranges::find(lines, wheel, &LineMotion::name);
    if (own == lines.end()) return none;
    return -rate_along(own->gradient, dq, first);
}

// How the arm of an anti-roll bar turns.
double arm_rate(const WheelMotion& wheel, const Eigen::VectorXd& dq, Eigen::Index first) {
    return wheel.bar_arm.empty() ? none : rate_along(wheel.bar_arm, dq, first);
}

struct Side {
    double outward;  // 1 on the left, -1 on the right
    double loaded_radius;
    Eigen::Index first;  // of its coordinates in a motion of the axle
};

Spatial<double> carrier_motion(const WheelMotion& wheel, const Eigen::VectorXd& dq, Eigen::Index first) {
    Spatial<double> v = Spatial<double>::Zero();
    for (std::size_t j = 0; j < wheel.J.size(); ++j) v += wheel.J[j] * dq[first + static_cast<Eigen::Index>(j)];
    return v;
}

void read_steering_axis(const WheelMotion& wheel, const Side& side, const Vec3<double>& contact, WheelFigures& out) {
    out.caster = out.inclination = out.scrub = out.trail = none;
    const Vec3<double> w = wheel.steer.tail<3>(), v = wheel.steer.head<3>();
    if (w.norm() < 1e-6) return;
    const Vec3<double> e = w[2] < 0 ? Vec3<double>(-w.normalized()) : Vec3<double>(w.normalized());
    const Vec3<double> p = w.cross(v) / w.squaredNorm();  // of the screw's axis
    const Vec3<double> foot = p + e * ((contact[2] - p[2]) / e[2]);
    out.caster = std::atan2(-e[0], e[2]);
    out.inclination = std::atan2(-side.outward * e[1], e[2]);
    out.scrub = side.outward * (contact[1] - foot[1]);
    out.trail = foot[0] - contact[0];
}

WheelFigures figures(const WheelMotion& wheel, const Side& side, const Eigen::VectorXd& bump) {
    WheelFigures out;
    const Vec3<double> contact = contact_of(wheel, side.loaded_radius);
    WheelMotion at_design = wheel;
    at_design.center = wheel.design_center, at_design.axis = wheel.design_axis;
    const Vec3<double> moved = contact - contact_of(at_design, side.loaded_radius);
    out.travel = wheel.center[2] - wheel.design_center[2];
    out.steer = std::atan2(-wheel.axis[0], wheel.axis[1]);
    out.toe = -side.outward * out.steer;
    out.camber = -side.outward * std::asin(wheel.axis[2]);
    out.center_x = wheel.center[0] - wheel.design_center[0];
    out.contact_y = side.outward * moved[1];
    const Spatial<double> v = carrier_motion(wheel, bump, side.first);
    out.spring_ratio = ratio(wheel.springs, wheel.name, bump, side.first);
    out.damper_ratio = ratio(wheel.dampers, wheel.name, bump, side.first);
    out.dive_slope = velocity_at<double>(v, contact)[0];
    out.drive_slope = wheel.own_differential ? out.dive_slope : velocity_at<double>(v, wheel.center)[0];
    out.wheel_rate = none;  // of differences, by the sweep
    read_steering_axis(wheel, side, contact, out);
    return out;
}

// Everything about one axle that does not change with its position.
struct AxleFacts {
    AxleWheels wheels;
    double track, wheelbase;  // at design; to the mean of the axles that are not steered [m]
    Side left, right;
};

AxleFigures read_axle(const HeldAxle& axle, const AxleFacts& facts) {
    const std::vector<WheelMotion> all = axle.wheels();
    const WheelMotion &left = all[facts.wheels.left], &right = all[facts.wheels.right];
    AxleFacts sides = facts;
    const bool shared = share_suspension(left, right);
    sides.right.first = shared ? 0 : static_cast<Eigen::Index>(left.coordinates.size());
    const Eigen::VectorXd bump = HeldAxle::motion_for(left, right, {1, 1});
    const Eigen::VectorXd roll = HeldAxle::motion_for(left, right, {1, -1});
    AxleFigures out;
    out.rack = axle.rack();
    out.left = figures(left, sides.left, bump), out.right = figures(right, sides.right, bump);
    out.travel = 0.5 * (out.left.travel + out.right.travel);
    out.roll = (out.left.travel - out.right.travel) / facts.track;
    out.track_change = out.left.contact_y + out.right.contact_y;
    const Vec3<double> at_left = contact_of(left, sides.left.loaded_radius),
                       at_right = contact_of(right, sides.right.loaded_radius);
    const double aside = velocity_at<double>(carrier_motion(left, roll, sides.left.first), at_left)[1] +
                         velocity_at<double>(carrier_motion(right, roll, sides.right.first), at_right)[1];
    // What the contacts move sideways in roll the chassis would move over the road: the axis lies that much higher.
    out.roll_center = 0.5 * (at_left[1] - at_right[1]) * 0.5 * aside;
    out.roll_stiffness = out.ackermann = none;  // of differences, by the sweep
    out.bar_twist = 0.5 * (arm_rate(left, roll, sides.left.first) - arm_rate(right, roll, sides.right.first));
    const bool to_left = out.left.steer + out.right.steer > 0;
    const double inner = std::abs(to_left ? out.left.steer : out.right.steer),
                 outer = std::abs(to_left ? out.right.steer : out.left.steer);
    if (std::abs(out.rack) > 1e-9 && outer > 1e-3 && facts.wheelbase > 0) {
        const double wanted = std::atan(1 / (1 / std::tan(outer) - facts.track / facts.wheelbase));
        out.ackermann = inner - wanted;
    }
    return out;
}

// Power of the springs while both wheels move at those rates [m/s].
double spring_power(const HeldAxle& axle, const AxleFacts& facts, const std::array<double, 2>& rates) {
    const std::vector<WheelMotion> all = axle.wheels();
    const WheelMotion &left = all[facts.wheels.left], &right = all[facts.wheels.right];
    const Eigen::VectorXd motion = HeldAxle::motion_for(left, right, {rates[0], rates[1]});
    const double power = spring_lift(left, motion, 0);
    if (share_suspension(left, right)) return power;
    return power + spring_lift(right, motion, static_cast<Eigen::Index>(left.coordinates.size()));
}

// How the springs' forces change about the axle's position: by differences, in a common bump and in roll.
void add_spring_rates(const HeldAxle& axle, const AxleFacts& facts, const Vec3<double>& target, AxleFigures& row) {
    constexpr double step = 1e-4;  // [m]
    const auto slope = [&](const std::array<double, 2>& way) {
        HeldAxle nearby = axle;
        if (!nearby.move(target[0] + step * way[0], target[1] + step * way[1], target[2]).empty()) return none;
        const double above = spring_power(nearby, facts, way);
        if (!nearby.move(target[0] - step * way[0], target[1] - step * way[1], target[2]).empty()) return none;
        return (above - spring_power(nearby, facts, way)) / (2 * step);
    };
    const double half_track = facts.track / 2;  // travel of a wheel per roll
    row.left.wheel_rate = row.right.wheel_rate = slope({1, 1}) / 2;
    row.roll_stiffness = slope({1, -1}) * half_track * half_track;
}

Sweep sweep(const VehicleDescription& vehicle, const Model<double>& model, const AxleFacts& facts, const char* name,
            int steps, const std::function<Vec3<double>(double)>& at) {
    Sweep out{.name = name, .rows = {}, .ended = {}};
    std::vector<AxleFigures> below;
    for (const int direction : {-1, 1}) {
        HeldAxle axle(vehicle, model, facts.wheels);
        for (int i = direction < 0 ? 1 : 0; i <= steps / 2; ++i) {
            const Vec3<double> target = at(2.0 * direction * i / steps);
            const std::string problem = axle.move(target[0], target[1], target[2]);
            if (!problem.empty()) {
                out.ended += fmt::format("{}{} (travel {:.1f} mm left, {:.1f} mm right, rack {:.1f} mm)",
                                         out.ended.empty() ? "" : "; ", problem, 1e3 * target[0], 1e3 * target[1],
                                         1e3 * target[2]);
                break;
            }
            AxleFigures row = read_axle(axle, facts);
            add_spring_rates(axle, facts, target, row);
            (direction < 0 ? below : out.rows).push_back(row);
        }
    }
    out.design = below.size();
    out.rows.insert(out.rows.begin(), below.rbegin(), below.rend());
    return out;
}

// How much of the load transfer an axle's geometry carries (Gillespie, Fundamentals of Vehicle Dynamics, chapter 7): by
// virtual work a force F along the road lifts the body with -F dx/dz, the transfer is that of the whole force over h / L.
void add_anti_figures(double share_of_brakes, double share_of_drive, double length_over_height, bool front,
                      AxleReport& report) {
    const double sign = front ? 1 : -1;
    report.anti_brake = 100 * sign * share_of_brakes * report.design.left.dive_slope * length_over_height;
    report.anti_drive = 100 * sign * share_of_drive * report.design.left.drive_slope * length_over_height;
}

// Of every wheel in the order of `wheel_motions`.
struct WheelShare {
    double brake, drive;
    std::size_t unit;
};

std::vector<WheelShare> shares_of(const VehicleDescription& d) {
    std::vector<WheelShare> out;
    double brakes = 0;
    for_each_wheel(d, [&](const auto& wheel, std::size_t unit) {
        out.push_back({wheel.brake.max_torque, wheel.drive_share, unit});
    });
    for (const WheelShare& share : out) brakes += share.brake;
    for (WheelShare& share : out) share.brake = brakes > 0 ? share.brake / brakes : 0;
    return out;
}

bool steers(const WheelMotion& wheel) {
    return wheel.steer.norm() > 1e-6;
}

// Distance from an axle to the mean of those of the motor vehicle that do not steer; zero without such.
double base_of(const std::vector<WheelMotion>& wheels, const std::vector<WheelShare>& shares, double x) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < wheels.size(); ++i) {
        if (steers(wheels[i]) || shares[i].unit != 0) continue;
        sum += wheels[i].center[0], ++count;
    }
    return count > 0 ? std::abs(x - sum / count) : 0;
}

}  // namespace

std::vector<AxleReport> kinematics(const VehicleDescription& vehicle, const SweepRange& range) {
    const Model<double> model{.vehicle = Vehicle<double>(vehicle), .road = PlaneRoad<double>(0, 0, 1)};
    State<double> state = design_state(model, Vec3<double>::Zero(), Mat3<double>::Identity());
    const AssemblyResult assembly = assemble(model, {}, state);
    if (!assembly.assembled) throw NoSolution(assembly_problem(vehicle, model, assembly.worst));
    const std::vector<WheelMotion> wheels = wheel_motions(vehicle, model, state, 0);
    const std::vector<WheelShare> shares = shares_of(vehicle);
    const Vec3<double> center = mass_moment(model, velocity_block(model, state, {})) / model.vehicle.total_mass;
    double front = -1e9, rear = 1e9;
    for (const WheelMotion& wheel : wheels) {
        front = std::max(front, wheel.center[0]), rear = std::min(rear, wheel.center[0]);
    }
    std::vector<AxleReport> out;
    for (const AxleWheels& axle : axles_of(wheels)) {
        const WheelMotion &left = wheels[axle.left], &right = wheels[axle.right];
        // Vehicle files have their origin on the ground; where one has not, the tire's radius says where the road is.
        const double loaded = left.center[2] > 0 && left.center[2] < left.radius ? left.center[2] : left.radius;
        const AxleFacts facts{axle,
                              left.center[1] - right.center[1],
                              base_of(wheels, shares, left.center[0]),
                              {1, loaded, 0},
                              {-1, loaded, 0}};
        AxleReport report;
        report.name = axle.name;
        HeldAxle held(vehicle, model, axle);
        report.design = read_axle(held, facts);
        const double half_track = facts.track / 2;
        report.sweeps.push_back(sweep(vehicle, model, facts, "bump", range.steps, [&](double share) {
            return Vec3<double>(share * range.travel, share * range.travel, 0);
        }));
        report.sweeps.push_back(sweep(vehicle, model, facts, "roll", range.steps, [&](double share) {
            return Vec3<double>(share * range.roll * half_track, -share * range.roll * half_track, 0);
        }));
        if (steers(left) && vehicle.steering.rack_travel > 0) {
            report.sweeps.push_back(sweep(vehicle, model, facts, "steer", range.steps, [&](double share) {
                return Vec3<double>(0, 0, share * vehicle.steering.rack_travel);
            }));
        }
        const Sweep& bump = report.sweeps[0];
        if (bump.design < bump.rows.size()) report.design = bump.rows[bump.design];
        report.anti_brake = report.anti_drive = none;
        if (vehicle.trailers.empty()) {  // behind a hitch load transfer has another base
            const double height = center[2] - (left.center[2] - loaded);
            add_anti_figures(shares[axle.left].brake + shares[axle.right].brake,
                             shares[axle.left].drive + shares[axle.right].drive, (front - rear) / height,
                             left.center[0] > center[0], report);
        }
        out.push_back(report);
    }
    return out;
}

}  // namespace hamilcar
