// What a step costs as the wheels grow from 4 to 40: solid axles on leaves on one frame, the same axles two by two under a
// train of trailers, and single wheels on five links; with the straight line through the times.
#include <fmt/format.h>

#include <cmath>

#include "hamilcar/bench/interleave.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/simulation.hpp"

namespace {

using namespace hamilcar;

void shift(Point& point, double x) {
    point[0] += x;
}

// The same suspension further back.
SuspensionDescription moved(SuspensionDescription suspension, double x, const std::string& name) {
    suspension.name = name;
    for (TreeJointDescription& joint : suspension.linkage.joints) shift(joint.point, x);
    for (CutJointDescription& cut : suspension.linkage.cuts) shift(cut.tip, x), shift(cut.foot, x);
    for (SuspensionBodyDescription& body : suspension.bodies) shift(body.body.center_of_mass, x);
    for (SuspensionWheelDescription& wheel : suspension.wheels) {
        shift(wheel.wheel.center, x);
        wheel.drive_share = 0;
    }
    for (SuspensionSpringDescription& spring : suspension.springs)
        shift(spring.line.on_part, x), shift(spring.line.on_base, x);
    for (SuspensionDamperDescription& damper : suspension.dampers)
        shift(damper.line.on_part, x), shift(damper.line.on_base, x);
    return suspension;
}

// Suspensions named like `pattern`, as many as carry so many wheels, one meter apart under a frame that weighs as they can bear.
VehicleDescription on_one_frame(const VehicleDescription& from, const std::string& pattern, int wheels) {
    std::vector<SuspensionDescription> group;
    for (const SuspensionDescription& suspension : from.suspensions) {
        if (suspension.name.starts_with(pattern)) group.push_back(suspension);
    }
    int per_group = 0;
    for (const SuspensionDescription& suspension : group) per_group += static_cast<int>(suspension.wheels.size());
    const int groups = wheels / per_group;
    VehicleDescription out = from;
    out.suspensions.clear(), out.anti_roll_bars.clear(), out.trailers.clear();
    out.hull = {};
    const double first = group[0].wheels[0].wheel.center[0];
    for (int i = 0; i < groups; ++i) {
        for (const SuspensionDescription& suspension : group) {
            out.suspensions.push_back(moved(suspension, -first - i, fmt::format("{}_{}", suspension.name, i)));
        }
    }
    double carried = 0;
    for (const SuspensionSpringDescription& spring : out.suspensions[0].springs)
        carried += spring.spring.force_at_design;
    out.chassis.mass = 0.9 * carried * (out.suspensions.size()) / 9.81;
    out.chassis.center_of_mass = {-0.5 * (groups - 1), 0, 1};
    const double m = out.chassis.mass, length = groups;
    out.chassis.inertia = {m, m * (1 + length * length / 12), m * (1 + length * length / 12)};
    out.chassis.products = {};
    return out;
}

// The axles of that frame two by two under a motor vehicle and up to eight trailers, each on a ball.
VehicleDescription as_a_train(const VehicleDescription& from, int wheels) {
    VehicleDescription out = on_one_frame(from, "rear_1", wheels);
    const std::size_t axles = out.suspensions.size(), units = std::max<std::size_t>(1, axles / 2);
    out.chassis.mass /= static_cast<double>(units);
    const double m = out.chassis.mass;
    out.chassis.inertia = {m, m, m}, out.chassis.center_of_mass = {-0.5, 0, 1};
    for (std::size_t unit = 1; unit < units; ++unit) {
        TrailerDescription trailer;
        trailer.name = fmt::format("trailer_{}", unit), trailer.tow = unit - 1;
        trailer.chassis = out.chassis;
        const double front = -2.0 * static_cast<double>(unit);
        trailer.chassis.center_of_mass[0] = front - 0.5;
        trailer.hitch_point = {front + 0.5, 0, 0.8};
        out.trailers.push_back(trailer);
    }
    for (std::size_t i = 0; i < axles; ++i) out.suspensions[i].unit = std::min(i / 2, units - 1);
    return out;
}

struct Line {
    double start, slope, unexplained;  // [s], [s per wheel], 1 - R^2
};

Line fit(const std::vector<double>& x, const std::vector<double>& y) {
    const double n = static_cast<double>(x.size());
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), start = (sy - slope * sx) / n;
    double left = 0, all = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        left += std::pow(y[i] - start - slope * x[i], 2), all += std::pow(y[i] - sy / n, 2);
    }
    return {start, slope, left / all};
}

void measure(const char* name, const std::vector<int>& wheels, const std::function<VehicleDescription(int)>& vehicle) {
    ScenarioDescription scenario;
    scenario.name = "wheels", scenario.duration = 1e6;
    scenario.initial.velocity = {10, 0, 0};
    std::vector<Simulation> simulations;
    for (const int count : wheels) simulations.emplace_back(vehicle(count), scenario);
    std::vector<BenchmarkCase> cases;
    for (Simulation& simulation : simulations) {
        cases.push_back({"", [&simulation](long steps) {
                             for (long i = 0; i < steps; ++i) simulation.advance();
                         }});
    }
    const InterleavedTimes result = interleave(cases, 0.01, 15);
    std::vector<double> x, y;
    fmt::print("{}\n  {:>6}  {:>10}  {:>14}\n", name, "wheels", "a step", "per wheel");
    for (std::size_t i = 0; i < wheels.size(); ++i) {
        x.push_back(wheels[i]), y.push_back(result.time(i));
        fmt::print("  {:>6}  {:>7.2f} us  {:>11.0f} ns\n", wheels[i], 1e6 * y[i], 1e9 * y[i] / wheels[i]);
    }
    const Line line = fit(x, y);
    fmt::print("  line: {:.2f} us + {:.0f} ns a wheel; {:.2f} % of the variance left\n", 1e6 * line.start,
               1e9 * line.slope, 100 * line.unexplained);
}

}  // namespace

int main() {
    const auto read = [](const char* name) {
        return io::read_vehicle(fmt::format("{}/vehicles/{}.toml", HAMILCAR_SOURCE_DIR, name));
    };
    const VehicleDescription truck = read("truck_semitrailer"), sedan = read("bmw_e90_330i");
    const std::vector<int> even{4, 8, 12, 16, 20, 24, 28, 32, 36, 40}, trains{4, 8, 12, 16, 20, 24, 28, 32, 36};
    measure("solid axles with dual wheels on one frame", even, [&](int n) { return on_one_frame(truck, "rear_1", n); });
    measure("the same, two axles to a trailer", trains, [&](int n) { return as_a_train(truck, n); });
    measure("single wheels on five links", even, [&](int n) { return on_one_frame(sedan, "rear", n); });
}
