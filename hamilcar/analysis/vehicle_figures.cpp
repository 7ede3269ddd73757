#include "hamilcar/analysis/vehicle_figures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "hamilcar/analysis/dimensions.hpp"
#include "hamilcar/block/velocity.hpp"
#include "hamilcar/math/convert.hpp"

namespace hamilcar {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Calls f(body) for all of the motor vehicle.
template <class F>
void for_each_own_body(const VehicleDescription& vehicle, F&& f) {
    f(vehicle.chassis);
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        if (suspension.unit != 0) continue;
        for (const SuspensionBodyDescription& body : suspension.bodies) f(body.body);
    }
}

// Steiner's theorem over all bodies at design.
void add_masses(const VehicleDescription& vehicle, VehicleFigures& out) {
    Vec3<double> moment = Vec3<double>::Zero();
    out.mass = 0;
    for_each_own_body(vehicle, [&](const BodyDescription& body) {
        out.mass += body.mass, moment += body.mass * vec3(body.center_of_mass);
    });
    const Vec3<double> center = moment / out.mass;
    Vec3<double> inertia = Vec3<double>::Zero();
    for_each_own_body(vehicle, [&](const BodyDescription& body) {
        const Vec3<double> r = vec3(body.center_of_mass) - center, square = r.cwiseProduct(r);
        inertia += vec3(body.inertia) +
                   body.mass * Vec3<double>(square[1] + square[2], square[2] + square[0], square[0] + square[1]);
    });
    out.center_of_mass = {center[0], center[1], center[2]};
    out.inertia = {inertia[0], inertia[1], inertia[2]};
}

// "front" of "axle 1 (front)".
bool is_of(const AxleReport& report, const Axle& axle) {
    return axle.name.ends_with("(" + report.name + ")");
}

StandingAxle standing(const VehicleDescription& vehicle, const Axle& axle, const LinearModel& model,
                      const std::vector<AxleReport>& kinematics) {
    const std::vector<std::string> names = wheel_names(vehicle);
    const auto wheels = static_cast<Eigen::Index>(names.size());
    StandingAxle out{axle.name, axle.of_trailer, none, 0, 0, 0, none, 0, none};
    double left = -1e9, right = 1e9;
    for_each_wheel(vehicle, [&, number = Eigen::Index(0)](const auto& wheel, std::size_t) mutable {
        const Eigen::Index i = number++;
        if (std::ranges::find(axle.wheels, wheel.name) == axle.wheels.end()) return;
        left = std::max(left, wheel.wheel.center[1]), right = std::min(right, wheel.wheel.center[1]);
        const double travel = model.output[first_wheel_output + i];
        if (std::abs(travel) > std::abs(out.travel)) out.travel = travel;
        const double load = model.output[first_wheel_output + wheels + i];
        out.load += load;
        if (wheel.wheel.center[1] > 0) out.left_load += load;
    });
    if (axle.wheels.size() < 2) return out;
    out.track = left - right;
    const auto own = std::ranges::find_if(kinematics, [&](const AxleReport& one) { return is_of(one, axle); });
    const bool has_arms = own != kinematics.end() && !std::isnan(own->design.bar_twist);
    const double twist = has_arms ? own->design.bar_twist : 1;  // 1 of a bar on the travels
    for (const AntiRollBarDescription& bar : vehicle.anti_roll_bars) {
        const bool is_own = std::ranges::find(axle.wheels, names[bar.left]) != axle.wheels.end();
        if (is_own) out.bar_stiffness += bar.rate * std::pow(twist * out.track, 2);
    }
    if (own == kinematics.end()) return out;
    out.roll_stiffness = own->design.roll_stiffness + out.bar_stiffness;
    const double rate = own->design.left.wheel_rate + own->design.right.wheel_rate;
    out.ride_frequency = std::sqrt(rate * vehicle.gravity / out.load) / (2 * std::numbers::pi);
    return out;
}

// As racers count it: of the diagonal from front right to rear left.
double cross_weight(const std::vector<StandingAxle>& axles) {
    std::vector<StandingAxle> own;
    std::ranges::copy_if(axles, std::back_inserter(own), [](const StandingAxle& axle) { return !axle.of_trailer; });
    if (own.size() != 2) return none;
    return (own[0].load - own[0].left_load + own[1].left_load) / (own[0].load + own[1].load);
}

double rack_per_angle(const SteeringDescription& steering) {
    if (steering.angle.size() > 1) return steering.rack[1] / steering.angle[1];
    return steering.rack_per_revolution / (2 * std::numbers::pi);
}

const Sweep* steer_sweep(const AxleReport& axle) {
    const auto found = std::ranges::find(axle.sweeps, "steer", &Sweep::name);
    return found == axle.sweeps.end() || found->rows.size() < 3 ? nullptr : &*found;
}

// Of the first axle that the rack steers.
std::optional<SteeringFigures> steering_figures(const VehicleDescription& vehicle,
                                                const std::vector<AxleReport>& kinematics) {
    const std::vector<Axle> all = axles(vehicle);
    double x = 0, base = 0;
    int unsteered = 0;
    const Sweep* steer = nullptr;
    for (const Axle& axle : all) {
        if (axle.of_trailer) continue;
        const auto own = std::ranges::find_if(kinematics, [&](const AxleReport& one) { return is_of(one, axle); });
        const Sweep* sweep = own == kinematics.end() ? nullptr : steer_sweep(*own);
        if (sweep && !steer) steer = sweep, x = axle.x;
        if (!sweep) base += axle.x, ++unsteered;
    }
    if (!steer || unsteered == 0) return std::nullopt;
    const auto mean = [](const AxleFigures& row) { return 0.5 * (row.left.steer + row.right.steer); };
    const std::size_t middle = std::clamp<std::size_t>(steer->design, 1, steer->rows.size() - 2);
    const AxleFigures &before = steer->rows[middle - 1], &after = steer->rows[middle + 1], &lock = steer->rows.back();
    SteeringFigures out;
    out.ratio = (after.rack - before.rack) / (mean(after) - mean(before)) / rack_per_angle(vehicle.steering);
    const double one = std::abs(lock.left.steer), other = std::abs(lock.right.steer);
    out.inner = std::max(one, other), out.outer = std::min(one, other);
    out.turning_circle = 2 * (std::abs(x - base / unsteered) / std::sin(out.outer) + half_tire(vehicle));
    return out;
}

bool is_ride(const Mode& mode) {
    const std::string& name = mode.name;
    if (mode.frequency == 0) return false;  // creeps back
    return name == "heave" || name == "pitch" || name == "roll" || name.ends_with(" hop") || name.ends_with(" tramp");
}

}  // namespace

VehicleFigures vehicle_figures(const Linearizer& linearizer, const OperatingPoint& rest,
                               const std::vector<AxleReport>& kinematics) {
    const VehicleDescription& vehicle = linearizer.vehicle();
    const LinearModel model = linearizer.linearize(rest);
    VehicleFigures out;
    out.total_mass = total_mass(vehicle);
    add_masses(vehicle, out);
    const std::vector<Axle> all = axles(vehicle);
    double last = all.front().x;
    for (const Axle& axle : all) {
        out.axles.push_back(standing(vehicle, axle, model, kinematics));
        if (!axle.of_trailer) last = axle.x;
    }
    out.wheelbase = all.front().x - last;
    const Vec3<double> center = vec3(out.center_of_mass);
    const Mat3<double> R = velocity_block(linearizer.model(), rest.state, rest.input).R_GC;
    const double height = (rest.state.position() + R * center)[2];
    out.center_of_mass = {all.front().x - center[0], center[1], height};
    out.static_stability_factor = tipping_acceleration(vehicle) / vehicle.gravity;
    out.cross_weight = cross_weight(out.axles);
    out.full_brake_deceleration = full_brake_force(vehicle) / out.total_mass;
    out.steering = steering_figures(vehicle, kinematics);
    for (const Mode& mode : modes(model, vehicle)) {
        if (is_ride(mode)) out.rides.push_back(mode);
    }
    return out;
}

}  // namespace hamilcar
