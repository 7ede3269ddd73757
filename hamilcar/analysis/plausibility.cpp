#include "hamilcar/analysis/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/base/units.hpp"
#include "hamilcar/math/convert.hpp"

namespace hamilcar {

namespace {

using units::degree;

// A point of a suspension, and what it belongs to.
struct NamedPoint {
    std::string name;
    Vec3<double> at;
};

std::vector<NamedPoint> points_of(const SuspensionDescription& suspension) {
    std::vector<NamedPoint> out;
    for (const TreeJointDescription& joint : suspension.linkage.joints) {
        if (joint.kind == TreeJoint::prismatic || joint.kind == TreeJoint::free) continue;  // their point means nothing
        out.push_back({joint.part + "'s joint", vec3(joint.point)});
    }
    for (const CutJointDescription& cut : suspension.linkage.cuts) {
        out.push_back({cut.name, vec3(cut.tip)}), out.push_back({cut.name, vec3(cut.foot)});
    }
    const auto add_line = [&](const std::string& name, const LineDescription& line) {
        if (line.coordinate) return;
        out.push_back({name, vec3(line.on_part)}), out.push_back({name, vec3(line.on_base)});
    };
    for (const auto& spring : suspension.springs) add_line("spring", spring.line);
    for (const auto& damper : suspension.dampers) add_line("damper", damper.line);
    return out;
}

// The point farthest from all wheels of its suspension, beyond what any linkage spans.
void add_far_point(const SuspensionDescription& suspension, std::vector<Oddity>& to) {
    constexpr double radii = 6, millimeters = 20;  // of a wheel [1]; where no slip of a digit is the cause [m]
    double farthest = 0;
    std::string name;
    double radius = 0;
    for (const auto& wheel : suspension.wheels) radius = std::max(radius, casing_of(wheel.tire).radius);
    for (const NamedPoint& point : points_of(suspension)) {
        double nearest = 1e300;
        for (const auto& wheel : suspension.wheels) {
            nearest = std::min(nearest, (point.at - vec3(wheel.wheel.center)).norm());
        }
        if (nearest > farthest) farthest = nearest, name = point.name;
    }
    if (farthest <= radii * radius) return;
    to.push_back({suspension.name, fmt::format("a point of the {} is {:.3g} m from the wheel", name, farthest),
                  farthest > millimeters ? "millimeters where meters are wanted?" : "a wrong sign or digit?"});
}

// Rods and arms go outward from the body to the wheel. An axle of two wheels may have them any way.
void add_inverted_rods(const SuspensionDescription& suspension, std::vector<Oddity>& to) {
    constexpr double tolerance = 0.05;  // links along the vehicle may lean inward a little [m]
    if (suspension.wheels.size() != 1) return;
    const double side = suspension.wheels.front().wheel.center[1] < 0 ? -1 : 1;
    for (const CutJointDescription& cut : suspension.linkage.cuts) {
        const bool is_rod = cut.kind == CutJoint::distance || cut.kind == CutJoint::revolute_spherical;
        if (!is_rod || cut.base != 0) continue;
        const double inward = side * (cut.foot[1] - cut.tip[1]);
        if (inward <= tolerance) continue;
        to.push_back({suspension.name,
                      fmt::format("the {}'s end on the body is {:.0f} mm farther out than that on the wheel", cut.name,
                                  1e3 * inward),
                      "inner and outer point exchanged?"});
    }
}

struct Limits {
    double min, max;
    bool contain(double value) const { return std::isnan(value) || (value >= min && value <= max); }
};

void expect(const Limits& limits, double value, const std::string& where, const std::string& what,
            const std::string& unit, const std::string& cause, std::vector<Oddity>& to) {
    if (limits.contain(value)) return;
    const std::string shown = unit.empty() ? "" : " " + unit;
    to.push_back(
        {where,
         fmt::format("{} is {:.3g}{}, cars have {:g} to {:g}{}", what, value, shown, limits.min, limits.max, shown),
         cause});
}

void add_kinematics(const AxleReport& axle, std::vector<Oddity>& to) {
    const AxleFigures& design = axle.design;
    const std::string points = "upper and lower or inner and outer points exchanged?";
    expect({-20, 20}, design.left.caster / degree, axle.name, "the caster angle", "deg", points, to);
    expect({-5, 30}, design.left.inclination / degree, axle.name, "the kingpin inclination", "deg", points, to);
    expect({-0.3, 0.8}, design.roll_center, axle.name, "the height of the roll center", "m", points, to);
    expect({1e3, 2e6}, design.left.wheel_rate, axle.name, "the wheel rate of its springs", "N/m", "rate_N_per_m?", to);
    const auto bump = std::ranges::find(axle.sweeps, "bump", &Sweep::name);
    if (bump == axle.sweeps.end() || bump->design == 0 || bump->design + 1 >= bump->rows.size()) return;
    const AxleFigures &below = bump->rows[bump->design - 1], &above = bump->rows[bump->design + 1];
    const double travel = above.travel - below.travel;
    expect({-100, 30}, (above.left.camber - below.left.camber) / travel / degree, axle.name, "the camber gain in bump",
           "deg/m", points, to);
    expect({-30, 30}, (above.left.toe - below.left.toe) / travel / degree, axle.name, "the bump steer", "deg/m",
           "a tie rod or toe link that does not point where its arms do?", to);
}

// Of the wheels that are nearest to their stops.
void add_standing(const VehicleDescription& vehicle, const VehicleFigures& figures, std::vector<Oddity>& to) {
    constexpr double usual = 0.02;  // [m]
    for (const StandingAxle& axle : figures.axles) {
        bool on_stop = false;
        for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
            const bool is_own = axle.name.ends_with("(" + wheel.name.substr(0, wheel.name.find_last_of('_')) + ")");
            const double gap = axle.travel > 0 ? wheel.bump.gap : wheel.rebound.gap;
            on_stop = on_stop || (is_own && std::abs(axle.travel) > gap);
        });
        if (std::abs(axle.travel) > usual || on_stop) {
            to.push_back({axle.name,
                          fmt::format("stands {:.0f} mm {} where it was designed{}", 1e3 * std::abs(axle.travel),
                                      axle.travel > 0 ? "below" : "above", on_stop ? ", on its stops" : ""),
                          "force_at_design_N of its spring, or its rate?"});
        }
        expect({0.5, 10}, axle.ride_frequency, axle.name, "the natural frequency of its load on its springs", "Hz",
               "rate_N_per_m?", to);
        constexpr double least_share = 0.1;
        if (axle.load < least_share * figures.total_mass * vehicle.gravity / double(figures.axles.size()))
            to.push_back({axle.name, fmt::format("carries {:.0f} N", axle.load), "center_of_mass_m?"});
    }
}

void add_steering(const SteeringFigures& steering, std::vector<Oddity>& to) {
    if (steering.ratio < 0) {
        to.push_back({"steering", "a steering wheel turned to the left turns the wheels to the right",
                      "a rack behind the axle has rack_axis = [0, -1, 0]; or a sign of rack_m_per_revolution?"});
    }
    expect({3, 45}, std::abs(steering.ratio), "steering", "the ratio", "", "rack_m_per_revolution?", to);
    expect({15, 60}, steering.inner / degree, "steering", "the inner wheel's angle at full lock", "deg",
           "rack_travel_m?", to);
}

}  // namespace

std::vector<Oddity> odd_geometry(const VehicleDescription& vehicle) {
    std::vector<Oddity> all, out;
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        add_far_point(suspension, all);
        add_inverted_rods(suspension, all);
    }
    for (const Oddity& one : all) {  // told of one side, if the other one is alike
        const bool told = std::ranges::any_of(out, [&](const Oddity& o) { return o.what == one.what; });
        if (!told) out.push_back(one);
    }
    return out;
}

std::vector<Oddity> odd_figures(const VehicleDescription& vehicle, const VehicleFigures& figures,
                                const std::vector<AxleReport>& kinematics) {
    std::vector<Oddity> out;
    for (const AxleReport& axle : kinematics) add_kinematics(axle, out);
    add_standing(vehicle, figures, out);
    if (figures.steering) add_steering(*figures.steering, out);
    for (const Mode& mode : figures.rides) {
        const bool is_body = mode.name == "heave" || mode.name == "pitch" || mode.name == "roll";
        expect(is_body ? Limits{0.5, 15} : Limits{5, 30}, mode.frequency, "suspension",
               "the natural frequency of " + mode.name, "Hz", "a spring's rate_N_per_m or a mass?", out);
        expect({0.03, 1}, mode.damping_ratio, "suspension", "the damping ratio of " + mode.name, "",
               "a damper's numbers?", out);
    }
    expect({3, 40}, figures.full_brake_deceleration, "brakes", "the deceleration that all of them are able to", "m/s^2",
           "max_torque_N_m?", out);
    expect({0.4, 4}, figures.static_stability_factor, "vehicle", "track over twice the height of the center of mass",
           "", "center_of_mass_m?", out);
    return out;
}

}  // namespace hamilcar
