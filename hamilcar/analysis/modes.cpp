// A mode's name is that of the motion with the largest amplitude at the vehicle's ends: heave as it is, pitch and roll as the
// lift of an axle's end or a wheel, wheels as they go up and down over the road, sideways motion and yaw as displacements of
// the ends.
#include "hamilcar/analysis/modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace hamilcar {

namespace {

constexpr double standstill = 1e-5;  // an eigenvalue below it is zero but for round-off [1/s]

struct WheelPlace {
    std::string name, axle;  // "rear_left", "rear"
    double x, y;             // [m]
    std::size_t unit;
};

std::vector<WheelPlace> wheel_places(const VehicleDescription& d) {
    std::vector<WheelPlace> out;
    for_each_wheel(d, [&](const auto& one, std::size_t unit) {
        const Point& center = one.wheel.center;
        out.push_back({one.name, one.name.substr(0, one.name.rfind('_')), center[0], center[1], unit});
    });
    return out;
}

struct NamedMotion {
    std::string name;
    double amplitude;  // [m]
};

int index_of(const std::vector<std::string>& names, const std::string& name) {
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

// Of the wheels of one axle: hop where both move together, tramp where they move against each other.
void add_axle_motions(const std::vector<WheelPlace>& wheels, const std::vector<std::complex<double>>& travel,
                      std::vector<NamedMotion>& to) {
    for (std::size_t i = 0; i + 1 < wheels.size(); ++i) {
        if (wheels[i].axle != wheels[i + 1].axle) continue;
        to.push_back({wheels[i].axle + " wheel hop", std::abs(travel[i] + travel[i + 1]) / 2});
        to.push_back({wheels[i].axle + " wheel tramp", std::abs(travel[i] - travel[i + 1]) / 2});
    }
}

// Amplitudes of everything that can name a mode, as displacements [m].
std::vector<NamedMotion> motions(const LinearModel& m, const VehicleDescription& d, const Eigen::VectorXcd& v,
                                 std::complex<double> eigenvalue) {
    const Eigen::VectorXcd y = m.C.cast<std::complex<double>>() * v;
    const std::vector<WheelPlace> wheels = wheel_places(d);
    double front = -1e9, rear = 1e9, half_track = 0;
    for (const WheelPlace& wheel : wheels) {
        if (wheel.unit != 0) continue;
        front = std::max(front, wheel.x), rear = std::min(rear, wheel.x);
        half_track = std::max(half_track, std::abs(wheel.y));
    }
    const double half_base = std::max(0.5 * (front - rear), half_track);
    const auto state = [&](const std::string& name) {
        const int i = index_of(m.states, name);
        return i < 0 ? std::complex<double>(0) : v[i];
    };
    // The body's middle between the axles: height is that of the vehicle frame's origin.
    const double middle = 0.5 * (front + rear);
    const std::complex<double> heave = state("height") - state("pitch") * middle;
    const double rate = std::max(std::abs(eigenvalue), 1e-3);
    const std::complex<double> s = std::abs(eigenvalue) > 1e-3 ? eigenvalue : std::complex<double>(1e-3);
    // Sideways at the road: the center of mass, from which the output comes, also moves by roll.
    const Point& mass = d.chassis.center_of_mass;
    const std::complex<double> sideways =
        (y[output_lateral_velocity] + y[output_yaw_rate] * (middle - mass[0])) / s + state("roll") * mass[2];
    std::vector<NamedMotion> out{{"heave", std::abs(heave)},
                                 {"pitch", std::abs(state("pitch")) * half_base},
                                 {"roll", std::abs(state("roll")) * half_track},
                                 {"sideslip", std::abs(sideways)},
                                 {"yaw", std::abs(y[output_yaw_rate]) * half_base / rate},
                                 {"speed", std::abs(y[output_speed]) / rate}};
    // Over the road: of the unit's body there, and of the wheel against it.
    struct Body {
        std::complex<double> height, roll, pitch;  // at the frame's origin
    };
    std::vector<Body> bodies{{state("height"), state("roll"), state("pitch")}};
    for (const TrailerDescription& trailer : d.trailers) {
        const Body& tow = bodies[trailer.tow];
        const std::complex<double> roll = tow.roll + state(trailer.name + ".hitch.roll"),
                                   pitch = tow.pitch + state(trailer.name + ".hitch.pitch");
        bodies.push_back({tow.height + (pitch - tow.pitch) * trailer.hitch_point[0], roll, pitch});
    }
    std::vector<std::complex<double>> lift;
    for (std::size_t i = 0; i < wheels.size(); ++i) {
        const Body& body = bodies[wheels[i].unit];
        lift.push_back(body.height - body.pitch * wheels[i].x + body.roll * wheels[i].y +
                       y[first_wheel_output + static_cast<Eigen::Index>(i)]);
    }
    add_axle_motions(wheels, lift, out);
    for (const TrailerDescription& trailer : d.trailers) {
        for (const char* angle : {"yaw", "roll", "pitch"}) {
            out.push_back({trailer.name + " " + angle, std::abs(state(trailer.name + ".hitch." + angle)) *
                                                           (std::string(angle) == "roll" ? half_track : half_base)});
        }
    }
    double deflection = 0;
    for (std::size_t i = 0; i < m.states.size(); ++i) {
        const bool tire = m.state_kinds[i] == StateKind::tire_deflection;
        if (tire) deflection = std::max(deflection, std::abs(v[static_cast<Eigen::Index>(i)]));
    }
    out.push_back({"tire deflection", deflection});
    return out;
}

// A wheel that turns by itself or a brake that unwinds moves nothing else.
std::string name_of(const LinearModel& m, const Eigen::VectorXcd& v, const std::vector<NamedMotion>& ranked,
                    std::complex<double> eigenvalue, bool oscillates, bool drives) {
    if (std::abs(eigenvalue) < standstill) return "neutral";
    double body = 0, internal = 0;
    for (Eigen::Index i = 0; i < v.size(); ++i) {
        const bool own = m.state_kinds[static_cast<std::size_t>(i)] == StateKind::brake_windup;
        (own ? internal : body) = std::max(own ? internal : body, std::abs(v[i]));
    }
    if (internal > 1e3 * body) return "brake wind-up";
    const std::string& first = ranked[0].name;
    if (drives && oscillates && (first == "sideslip" || first == "yaw")) return "weave";
    if (first == "tire deflection") return oscillates ? "wheel on its carcass" : "tire relaxation";
    return first;
}

}  // namespace

std::vector<Mode> modes(const LinearModel& model, const VehicleDescription& vehicle) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(model.A);
    const double speed = model.output[output_speed];
    std::vector<Mode> out;
    for (Eigen::Index i = 0; i < model.A.rows(); ++i) {
        const std::complex<double> s = solver.eigenvalues()[i];
        if (s.imag() < 0) continue;
        const bool oscillates = s.imag() > 1e-9 * std::abs(s) && std::abs(s) > standstill;
        const Eigen::VectorXcd v = solver.eigenvectors().col(i);
        std::vector<NamedMotion> ranked = motions(model, vehicle, v, s);
        std::ranges::sort(ranked, std::greater<>(), &NamedMotion::amplitude);
        Mode mode{.eigenvalue = s,
                  .frequency = oscillates ? std::abs(s) / (2 * std::numbers::pi) : 0,
                  .damping_ratio = std::abs(s) > 0 ? -s.real() / std::abs(s) : 0,
                  .name = name_of(model, v, ranked, s, oscillates, speed > 0.1),
                  .shape = {}};
        const bool moves_something = mode.name != "brake wind-up" && mode.name != "neutral";
        for (std::size_t k = 0; moves_something && k < std::min<std::size_t>(4, ranked.size()); ++k) {
            mode.shape.emplace_back(ranked[k].name, ranked[k].amplitude / std::max(ranked[0].amplitude, 1e-300));
        }
        out.push_back(mode);
    }
    std::ranges::stable_sort(out, [](const Mode& a, const Mode& b) {
        if ((a.frequency > 0) != (b.frequency > 0)) return a.frequency > 0;
        return a.frequency > 0 ? a.frequency < b.frequency : a.eigenvalue.real() > b.eigenvalue.real();
    });
    return out;
}

}  // namespace hamilcar
