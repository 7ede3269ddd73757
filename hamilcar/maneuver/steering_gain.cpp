#include "hamilcar/maneuver/steering_gain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hamilcar/analysis/handling.hpp"
#include "hamilcar/steering/column.hpp"

namespace hamilcar {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
const double half_power = std::sqrt(0.5);

std::vector<double> magnitudes(const std::vector<std::complex<double>>& response, double factor) {
    std::vector<double> out;
    for (const auto& one : response) out.push_back(factor * std::abs(one));
    return out;
}

// A value at a frequency, linear between neighbors; NaN outside.
double value_at(const std::vector<double>& x, const std::vector<double>& y, double at) {
    const auto above = std::ranges::lower_bound(x, at - 1e-9);
    if (above == x.end() || (above == x.begin() && *above > at + 1e-9)) return none;
    const auto i = static_cast<std::size_t>(above - x.begin());
    if (i == 0) return y[0];
    return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

io::Chart gain_chart(const std::string& of, const std::string& unit, std::vector<double> x, std::vector<double> y,
                     std::vector<double> theory_x, std::vector<double> theory_y) {
    return {.title = of,
            .x_label = "frequency [Hz]",
            .y_label = unit,
            .curves = {{.label = "test", .x = std::move(x), .y = std::move(y), .points = true},
                       {.label = "linear theory", .x = std::move(theory_x), .y = std::move(theory_y)}}};
}

// One output of the vehicle: how it is called and measured.
struct Output {
    std::string name, unit;
    double factor;  // of the response per radian, in that unit
    std::vector<std::complex<double>> SteeringGain::*response;
};
const Output yaw_rate_output{"yaw rate", "deg/s/deg", 1, &SteeringGain::yaw_rate};
const Output lateral_output{"lateral acceleration", "m/s^2/deg", degree, &SteeringGain::lateral_acceleration};

void add_charts(const Output& of, const SteeringGain& found, const SteeringGain& theory, Outcome& outcome) {
    outcome.charts.push_back(gain_chart(of.name + " gain", "gain [" + of.unit + "]", found.frequency,
                                        magnitudes(found.*of.response, of.factor), theory.frequency,
                                        magnitudes(theory.*of.response, of.factor)));
    outcome.charts.push_back(gain_chart(of.name + " phase", "phase [deg]", found.frequency, phases(found.*of.response),
                                        theory.frequency, phases(theory.*of.response)));
}

void add_gain_figure(const Output& of, double gain, const SteadyGain& steady, Outcome& outcome) {
    const bool line = steady.line > 0;
    outcome.figures.push_back(
        {of.name + (line ? " gain at the lowest line" : " gain"), of.unit,
         line ? fmt::format("per angle of the steering wheel at {:.3f} Hz, the lowest line that counts", steady.line)
              : "steady, per angle of the steering wheel",
         gain * of.factor});
}

void add_lags(const Output& of, const SteeringGain& found, Outcome& outcome) {
    const std::vector<double> phase = phases(found.*of.response);
    for (const double at : {0.5, 1.0}) {
        outcome.figures.push_back({fmt::format("{} lag at {:g} Hz", of.name, at), "s", "phase as time",
                                   -value_at(found.frequency, phase, at) / 360 / at});
    }
}

// Place of the motor vehicle's center of mass, from that of its chassis: ahead and above [m].
std::array<double, 2> center_from_chassis(const VehicleDescription& vehicle) {
    const Point& chassis = vehicle.chassis.center_of_mass;
    double mass = vehicle.chassis.mass, ahead = 0, above = 0;
    const auto add = [&](const BodyDescription& body) {
        mass += body.mass;
        ahead += body.mass * (body.center_of_mass[0] - chassis[0]);
        above += body.mass * (body.center_of_mass[2] - chassis[2]);
    };
    for (const SuspensionDescription& suspension : vehicle.suspensions) {
        if (suspension.unit != 0) continue;
        for (const SuspensionBodyDescription& body : suspension.bodies) add(body.body);
    }
    return {ahead / mass, above / mass};
}

// The output of the linear model is the whole combination's. Of the motor vehicle alone: v_y' + v r at its center of mass, which
// yaw and roll move against the chassis's.
std::vector<std::complex<double>> motor_vehicle_response(const VehicleDescription& vehicle, const LinearModel& model,
                                                         double speed, double ratio, const SteeringGain& gain,
                                                         const std::vector<double>& angular) {
    std::vector<std::complex<double>> out = steering_response(model, ratio, output_lateral_velocity, angular);
    const auto roll = steering_response(model, ratio, output_roll, angular);
    const auto [ahead, above] = center_from_chassis(vehicle);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::complex<double> iw(0, angular[i]);
        out[i] = iw * out[i] + (speed + iw * ahead) * gain.yaw_rate[i] - iw * iw * above * roll[i];
    }
    return out;
}

}  // namespace

SteeringGain theoretical_gain(const VehicleDescription& vehicle, double speed, const std::vector<double>& frequency) {
    const Linearizer linearizer(vehicle);
    const OperatingPoint straight = linearizer.operating_point({.speed = speed});
    if (!straight.found) return {};
    const LinearModel model = linearizer.linearize(straight);
    const double ratio = Column(vehicle.steering).center_ratio();
    SteeringGain out{.frequency = frequency};
    const std::vector<double> angular = scaled(frequency, 2 * std::numbers::pi);
    out.yaw_rate = steering_response(model, ratio, output_yaw_rate, angular);
    out.lateral_acceleration = vehicle.trailers.empty()
                                   ? steering_response(model, ratio, output_lateral_acceleration, angular)
                                   : motor_vehicle_response(vehicle, model, speed, ratio, out, angular);
    return out;
}

std::vector<double> phases(const std::vector<std::complex<double>>& response) {
    std::vector<double> out;
    for (const auto& one : response) {
        const double now = std::arg(one) / degree, before = out.empty() ? 0 : out.back();
        out.push_back(now - 360 * std::round((now - before) / 360));
    }
    return out;
}

double falls_through(const std::vector<double>& x, const std::vector<double>& y, double level) {
    for (std::size_t i = 1; i < x.size(); ++i) {
        if (y[i - 1] > level && y[i] <= level)
            return x[i - 1] + (x[i] - x[i - 1]) * (level - y[i - 1]) / (y[i] - y[i - 1]);
    }
    return none;
}

SteadyGain lowest_gain(const SteeringGain& found) {
    if (found.frequency.empty()) return {none, none};
    return {std::abs(found.yaw_rate.front()), std::abs(found.lateral_acceleration.front())};
}

void add_yaw_rate_gain(const SteeringGain& found, const SteadyGain& steady, const SteeringGain& theory,
                       Outcome& outcome) {
    const std::vector<double>& f = found.frequency;
    if (f.empty()) return;
    const std::vector<double> gain = magnitudes(found.yaw_rate, 1 / steady.yaw_rate), phase = phases(found.yaw_rate);
    const auto top = static_cast<std::size_t>(std::ranges::max_element(gain) - gain.begin());
    constexpr double lagging = -45;   // [deg]: that of a first-order lag at 1 / T
    constexpr double visible = 1.01;  // peak ratio from which there is a peak, and not just a spectrum's noise
    const bool line = steady.line > 0, peaks = !line || gain[top] >= visible;
    const std::string compared =
        line ? fmt::format("that at {:.3f} Hz, the lowest line that counts", steady.line) : "the steady one";
    const auto add = [&](const std::string& name, const std::string& unit, const std::string& meaning, double value) {
        outcome.figures.push_back({name, unit, meaning, value});
    };
    add_gain_figure(yaw_rate_output, steady.yaw_rate, steady, outcome);
    add("yaw rate peak ratio", "", "largest gain over " + compared, gain[top]);
    add("yaw rate peak frequency", "Hz",
        peaks ? "of the largest gain" : "no gain is as much as 1 percent above " + compared, peaks ? f[top] : none);
    add("yaw rate bandwidth", "Hz", "where the gain is down to 71 percent of " + compared,
        falls_through(f, gain, half_power));
    add("yaw rate equivalent time", "s", "1 / (2 pi f) where the yaw rate lags by 45 degrees",
        1 / (2 * std::numbers::pi * falls_through(f, phase, lagging)));
    add_lags(yaw_rate_output, found, outcome);
    add_charts(yaw_rate_output, found, theory, outcome);
}

void add_lateral_acceleration_gain(const SteeringGain& found, const SteadyGain& steady, const SteeringGain& theory,
                                   Outcome& outcome) {
    if (found.frequency.empty()) return;
    add_gain_figure(lateral_output, steady.lateral_acceleration, steady, outcome);
    add_lags(lateral_output, found, outcome);
    add_charts(lateral_output, found, theory, outcome);
}

void add_gain(const SteeringGain& found, const SteadyGain& steady, const SteeringGain& theory, Outcome& outcome) {
    add_yaw_rate_gain(found, steady, theory, outcome);
    add_lateral_acceleration_gain(found, steady, theory, outcome);
    if (found.yaw_coherence.empty()) return;
    outcome.charts.push_back(
        {.title = "coherence",
         .x_label = "frequency [Hz]",
         .y_label = "coherence [1]",
         .curves = {{.label = "yaw rate", .x = found.frequency, .y = found.yaw_coherence},
                    {.label = "lateral acceleration", .x = found.frequency, .y = found.lateral_coherence}}});
}

}  // namespace hamilcar
