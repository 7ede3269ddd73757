#include "hamilcar/maneuver/ride.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/analysis/ride_weighting.hpp"

namespace hamilcar::ride {

namespace {

constexpr double fine = 1e-3;  // between rows: the weightings reach up to 100 Hz [s]

}  // namespace

std::span<const double> between(const History& history, const std::vector<double>& values, double from, double to) {
    const std::size_t first = row_at(history, from), last = row_at(history, to);
    return std::span(values).subspan(first, std::max(last, first + 1) - first);
}

Comfort felt(const History& history, double from, double to) {
    const double rate = straight::series(history, history.seat_z).rate;
    // Filtered from the start, so that the filters are in motion at `from`.
    const std::vector<double> x = ride_weighted(RideWeighting::horizontal, history.seat_x, rate);
    const std::vector<double> y = ride_weighted(RideWeighting::horizontal, history.seat_y, rate);
    const std::vector<double> z = ride_weighted(RideWeighting::vertical, history.seat_z, rate);
    const auto part = [&](const std::vector<double>& values) { return between(history, values, from, to); };
    Comfort out{};
    out.x = root_mean_square(part(x)), out.y = root_mean_square(part(y)), out.z = root_mean_square(part(z));
    out.total = comfort_total(out.x, out.y, out.z);
    out.crest_z = crest_factor(part(z));
    out.running_z = largest_running_rms(part(z), rate);
    out.dose_z = vibration_dose(part(z), rate);
    return out;
}

void add_figures(Outcome& outcome, const Comfort& comfort) {
    const auto add = [&](const std::string& name, const std::string& unit, const std::string& meaning, double value) {
        outcome.figures.push_back({name, unit, meaning, value});
    };
    add("a_wx", "m/s^2", "r.m.s. on the seat along x, weighted with Wd", comfort.x);
    add("a_wy", "m/s^2", "likewise along y", comfort.y);
    add("a_wz", "m/s^2", "likewise along z, weighted with Wk", comfort.z);
    add("a_v", "m/s^2", "total value, the vector sum of the three", comfort.total);
    add("crest factor along z", "", "largest weighted value over its r.m.s.", comfort.crest_z);
    add("MTVV along z", "m/s^2", "largest weighted r.m.s. over a second", comfort.running_z);
    add("VDV along z", "m/s^1.75", "fourth root of the integral of the fourth power", comfort.dose_z);
}

Loads loads(const History& history, const straight::Axle& axle, double from, double to) {
    Loads worst{0, -1, 0, 0};
    for (const std::size_t wheel : axle.wheels) {
        const std::span<const double> load = between(history, history.wheel_load[wheel], from, to);
        const double mean = straight::mean(load);
        double squares = 0;
        for (const double one : load) squares += (one - mean) * (one - mean);
        const double deviation = std::sqrt(squares / static_cast<double>(load.size()));
        if (deviation > worst.deviation) {
            worst = {mean, deviation, *std::ranges::min_element(load), *std::ranges::max_element(load)};
        }
    }
    return worst;
}

TrialOptions trial_options(const ManeuverOptions& options) {
    TrialOptions out = straight::trial_options(options, 0, 1);
    out.interval = fine;
    out.seat_acceleration = true;
    return out;
}

ManeuverOptions with_fine_step(const ManeuverOptions& options) {
    ManeuverOptions out = options;
    out.solver.step = std::min(out.solver.step, fine);
    return out;
}

void thin_out(io::PageRun& film, const History& history) {
    if (history.size() < 2) return;
    constexpr double interval = 0.01;  // of a film [s]
    const auto every =
        static_cast<std::size_t>(std::max(1L, std::lround(interval / (history.time[1] - history.time[0]))));
    for (std::vector<double>& column : film.values) {
        std::vector<double> kept;
        for (std::size_t i = 0; i < column.size(); i += every) kept.push_back(column[i]);
        column = std::move(kept);
    }
}

}  // namespace hamilcar::ride
