// A vehicle's way through one maneuver: the settings in SI units, the drives, and the outcome that grows by them.
#pragma once

#include <fmt/format.h>

#include <string_view>

#include "hamilcar/analysis/dimensions.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/maneuver/drive.hpp"

namespace hamilcar {

using units::degree, units::kilometer_per_hour;
inline constexpr double standard_gravity = 9.80665;                            // [m/s^2]
inline constexpr double not_shown = std::numeric_limits<double>::quiet_NaN();  // the value of what a drive did not show

class TestRun {
public:
    TestRun(const Maneuver& maneuver, const VehicleDescription& vehicle, const Settings& complete,
            const ManeuverOptions& options);

    VehicleDescription vehicle;
    ManeuverOptions options;
    Outcome outcome;
    const std::string maneuver_name;

    double operator[](std::string_view setting) const;  // in SI units: angles in radians, shares of 1 for percent
    double typed(std::string_view setting) const;       // in the unit that the setting has for people
    bool is_on(std::string_view flag) const { return typed(flag) == 1; }
    const std::string& choice(std::string_view setting) const;

    // `value` as its unit says; NaN where the drive did not show it.
    void figure(std::string name, std::string unit, double value, std::string meaning = "");
    void verdict(std::string criterion, bool passed, std::string found);
    io::Chart& chart(std::string title, std::string x_label, std::string y_label, std::vector<io::Curve> curves = {});
    template <class... Args>
    void note(fmt::format_string<Args...> text, Args&&... args) {
        outcome.notes.push_back(fmt::format(text, std::forward<Args>(args)...));
    }
    // The maneuver could not be driven.
    template <class... Args>
    void fail(fmt::format_string<Args...> why, Args&&... args) {
        outcome.failed = fmt::format(why, std::forward<Args>(args)...);
    }
    // Settings that contradict each other: throws io::Error(bad_file) at the setting.
    template <class... Args>
    [[noreturn]] void reject(std::string_view setting, fmt::format_string<Args...> why, Args&&... args) const {
        reject_setting(setting, fmt::format(why, std::forward<Args>(args)...));
    }

    Drive drive(const ScenarioDescription& scenario, const DriveOptions& drive_options = {}) const {
        return hamilcar::drive(vehicle, scenario, drive_options, options);
    }
    // Each takes a drive's part in the outcome, and returns whether the maneuver may go on: an interruption or a failure of the
    // mathematics ends it and is its failure.
    // Its energy and its step alone, of a drive on the way to those that count, where all else that goes wrong is what it is for.
    bool take_energy(const Drive& drive);
    // Energy, replay, warnings, limits of validity, and a fall as a note.
    bool take(Drive& drive);
    // The same of a drive that says nothing unless it came to its end: a fall is a failure too.
    bool take_whole(Drive& drive);

private:
    [[noreturn]] void reject_setting(std::string_view setting, const std::string& why) const;
    const Setting& known(std::string_view name) const;

    std::vector<Setting> known_;
    Settings complete_;
};

// Why a vehicle cannot do a maneuver, or nothing.
std::string needs_steering(const VehicleDescription& vehicle);
std::string needs_drive(const VehicleDescription& vehicle);
std::string needs_steering_and_drive(const VehicleDescription& vehicle);
std::string needs_power_units(const VehicleDescription& vehicle);
std::string needs_brakes(const VehicleDescription& vehicle);

// To a whole multiple of `step`, downward: default values that a person would type.
double rounded_down(double value, double step);

// Of a channel, either way.
double largest(const Recording& recording, std::string_view channel);
// From one level to another, both crossed in this direction, from an instant on [s]; nothing unless both are.
struct Interval {
    double begin, end;  // [s]
    double length() const { return end - begin; }
};
std::optional<Interval> between_levels(const Series& series, double from, double to, Crossing direction,
                                       double earliest = -endless);

// A channel over time, times a factor and counted from `zero` [s], and one over another; every row.
io::Curve over_time(const Recording& recording, std::string label, std::string_view channel, double factor = 1,
                    double zero = 0);
io::Curve over_channel(const Recording& recording, std::string_view x, std::string label, std::string_view channel);
// Runs as points: members or functions of a run over each other.
template <class Runs, class X, class Y>
io::Curve over_runs(std::string label, const Runs& runs, X&& x, Y&& y) {
    io::Curve out{.label = std::move(label), .points = true};
    for (const auto& run : runs) out.x.push_back(std::invoke(x, run)), out.y.push_back(std::invoke(y, run));
    return out;
}
// Of drives that are steered to one side first, 1 is the left one: a curve each.
template <class Run, class Side, class X, class Y>
std::vector<io::Curve> over_runs_by_side(const std::vector<Run>& runs, Side&& side, X&& x, Y&& y) {
    std::vector<Run> left, right;
    for (const Run& run : runs) (std::invoke(side, run) > 0 ? left : right).push_back(run);
    return {over_runs("left first", left, x, y), over_runs("right first", right, x, y)};
}
// One list over another one, thinned.
io::Curve curve(std::string label, std::span<const double> x, std::span<const double> y, std::size_t max_count = 1500);

}  // namespace hamilcar
