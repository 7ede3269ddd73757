#include "hamilcar/template/vehicle_template.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hamilcar/analysis/kinematics.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/template/vehicle_sizes.hpp"

namespace hamilcar {

namespace {

constexpr double damping_share = 0.3;     // of critical, of the body on its springs
constexpr double front_bar_share = 0.65;  // of what the bars hold together

AxleSizes axle_before_kinematics(const VehicleSizes& sizes, bool is_front) {
    const ClassValues& v = sizes.values();
    AxleSizes axle;
    axle.recipe = is_front ? sizes.request->front : sizes.request->rear;
    axle.is_front = is_front, axle.mass = v.mass, axle.tire_radius = v.tire_radius;
    axle.spin_inertia = 0.0078 * v.mass * v.tire_radius * v.tire_radius;
    const double radius = v.tire_radius - sizes.load(axle) / sizes.tire_stiffness;
    axle.wheel = {is_front ? 0 : -v.wheelbase, (is_front ? v.front_track : v.rear_track) / 2, radius};
    // By the loads at 1.1 g: up to there the front axle locks first.
    const double front_share = v.front_load + 1.1 * v.center_height / v.wheelbase;
    const double share = std::clamp(is_front ? front_share : 1 - front_share, 0.15, 0.85);
    axle.brake_torque = 1.6 * share * v.mass * gravity * radius / 2;
    const DrivenWheels driven = sizes.request->drive;
    axle.drive_share = driven == DrivenWheels::all ? 0.5 : (driven == DrivenWheels::front) == is_front ? 1 : 0;
    axle.spring_rate = 1.5 * sizes.wheel_rate(axle), axle.damping = 0.1 * axle.spring_rate;
    return axle;
}

VehicleSizes before_kinematics(const TemplateRequest& request) {
    VehicleSizes sizes{.request = &request};
    sizes.tire_load = request.values.mass * gravity / 4;
    sizes.tire_stiffness = sizes.tire_load / (deflection_share * request.values.tire_radius);
    sizes.front = axle_before_kinematics(sizes, true), sizes.rear = axle_before_kinematics(sizes, false);
    return sizes;
}

std::vector<AxleReport> kinematics_of(const VehicleSizes& sizes) {
    io::Node document = io::parse_toml(sizes.request->name, vehicle_text(sizes));
    return kinematics(io::read_vehicle(document), {.travel = 0.02, .roll = 0.02, .steps = 60});
}

// A spring's rate for the wheel's, which the preload of an inclined spring changes a little: linear in the rate.
void size_springs(VehicleSizes& sizes, const std::vector<AxleReport>& reports) {
    for (AxleSizes* axle : {&sizes.front, &sizes.rear}) {
        const WheelFigures& wheel = reports[axle->is_front ? 0 : 1].design.left;
        const double target = sizes.wheel_rate(*axle);
        axle->spring_rate += (target - wheel.wheel_rate) / (wheel.spring_ratio * wheel.spring_ratio);
        const double critical = 2 * std::sqrt(target * sizes.carried(*axle));
        axle->damping = damping_share * critical / (wheel.damper_ratio * wheel.damper_ratio);
    }
}

// m h a = (K - m g h) phi, the body rolling about the axis through the roll centers; the tires' part of the roll comes first.
void size_bars(VehicleSizes& sizes, const std::vector<AxleReport>& reports) {
    const ClassValues& v = sizes.values();
    const double roll_axis =
        v.front_load * reports[0].design.roll_center + (1 - v.front_load) * reports[1].design.roll_center;
    const double body = 2 * (sizes.carried(sizes.front) + sizes.carried(sizes.rear));
    double tires = 0;
    for (const double track : {v.front_track, v.rear_track}) tires += track * track / 2 * sizes.tire_stiffness;
    const double of_body = v.roll_gradient - v.mass * v.center_height / tires;
    double body_moment = v.mass * v.center_height;  // about the road
    for (const AxleSizes* axle : {&sizes.front, &sizes.rear}) body_moment -= unsprung_mass(*axle) * axle->wheel[2];
    double bars = (body_moment - body * roll_axis) * (1 / std::max(of_body, 0.2 * v.roll_gradient) + gravity);
    for (const AxleReport& report : reports) bars -= report.design.roll_stiffness;
    for (AxleSizes* axle : {&sizes.front, &sizes.rear}) {
        const double share = axle->is_front ? front_bar_share : 1 - front_bar_share, track = 2 * axle->wheel[1];
        axle->bar_rate = std::max(0.0, share * bars / (track * track));
    }
}

void size_steering(VehicleSizes& sizes, const AxleReport& front) {
    const Sweep& sweep = *std::ranges::find(front.sweeps, "steer", &Sweep::name);
    const auto steer = [&](std::size_t row) {
        return std::max(sweep.rows[row].left.steer, sweep.rows[row].right.steer);
    };
    const auto mean = [&](std::size_t row) { return (sweep.rows[row].left.steer + sweep.rows[row].right.steer) / 2; };
    const std::size_t middle = sweep.design;
    const double slope =
        (mean(middle + 1) - mean(middle - 1)) / (sweep.rows[middle + 1].rack - sweep.rows[middle - 1].rack);
    sizes.rack_per_revolution = 2 * std::numbers::pi / (sizes.values().steering_ratio * slope);
    // To where the inner wheel comes to its lock, or to the end of what its linkage lets it.
    const double lock = sizes.values().lock_angle;
    std::size_t row = middle;
    while (row + 1 < sweep.rows.size() && steer(row) < lock) ++row;
    const double back = std::max(0.0, (steer(row) - lock) / (steer(row) - steer(row - 1)));
    sizes.rack_travel = sweep.rows[row].rack - back * (sweep.rows[row].rack - sweep.rows[row - 1].rack);
}

}  // namespace

std::string vehicle_template(const TemplateRequest& request) {
    VehicleSizes sizes = before_kinematics(request);
    const std::vector<AxleReport> first = kinematics_of(sizes);
    size_springs(sizes, first), size_steering(sizes, first[0]);
    size_bars(sizes, kinematics_of(sizes));
    return vehicle_text(sizes);
}

}  // namespace hamilcar
