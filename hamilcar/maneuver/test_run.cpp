#include "hamilcar/maneuver/test_run.hpp"

#include <algorithm>
#include <cmath>

#include "hamilcar/io/error.hpp"

namespace hamilcar {

TestRun::TestRun(const Maneuver& maneuver, const VehicleDescription& described, const Settings& complete,
                 const ManeuverOptions& how)
    : vehicle(described),
      options(how),
      maneuver_name(maneuver.name),
      known_(maneuver.settings(described)),
      complete_(complete) {}

const Setting& TestRun::known(std::string_view name) const {
    return *std::ranges::find(known_, name, &Setting::name);
}

double TestRun::typed(std::string_view setting) const {
    return complete_.at(std::string(setting));
}

double TestRun::operator[](std::string_view setting) const {
    return typed(setting) * setting_factor(known(setting));
}

const std::string& TestRun::choice(std::string_view setting) const {
    return std::ranges::find(known(setting).choices, typed(setting), &Choice::number)->word;
}

void TestRun::figure(std::string name, std::string unit, double value, std::string meaning) {
    outcome.figures.push_back({std::move(name), std::move(unit), std::move(meaning), value});
}

std::optional<Figure> per_g(const Figure& figure) {
    constexpr std::string_view over_acceleration = "/(m/s^2)";
    if (!figure.unit.ends_with(over_acceleration)) return {};
    Figure out = figure;
    out.unit.replace(out.unit.size() - over_acceleration.size(), over_acceleration.size(), "/g");
    out.value *= standard_gravity;
    return out;
}

void TestRun::verdict(std::string criterion, bool passed, std::string found) {
    outcome.verdicts.push_back({std::move(criterion), passed, std::move(found)});
}

io::Chart& TestRun::chart(std::string title, std::string x_label, std::string y_label, std::vector<io::Curve> curves) {
    return outcome.charts.emplace_back(io::Chart{.title = std::move(title),
                                                 .x_label = std::move(x_label),
                                                 .y_label = std::move(y_label),
                                                 .curves = std::move(curves)});
}

void TestRun::reject_setting(std::string_view setting, const std::string& why) const {
    throw io::Error(
        io::ExitCode::bad_file,
        fmt::format("setting '{}' of maneuver '{}' = {:g}: {}", setting, maneuver_name, typed(setting), why),
        fmt::format("maneuver.settings.{}", setting));
}

bool TestRun::take_energy(const Drive& drive) {
    outcome.energy += drive.energy;
    std::vector<ValidityWarning> numerical = drive.validity;
    if (!drive.breaks_off()) std::erase_if(numerical, [](const ValidityWarning& w) { return !w.is_numerical(); });
    add_warnings(std::move(numerical), drive.name, outcome.validity);
    if (!drive.breaks_off()) return true;
    if (!outcome.failed) outcome.failed = drive.trouble;
    outcome.stopped = drive.stopped;
    return false;
}

bool TestRun::take(Drive& drive) {
    if (drive.stopped == Stopped::fell_over) drive.warnings.push_back(drive.trouble);
    outcome.notes.insert(outcome.notes.end(), drive.warnings.begin(), drive.warnings.end());
    add_warnings(drive.validity, drive.name, outcome.validity);
    if (!drive.replay.columns.empty()) outcome.runs.push_back(std::move(drive.replay));
    return take_energy(drive);
}

bool TestRun::take_whole(Drive& drive) {
    const bool fell_over = drive.stopped == Stopped::fell_over;
    if (fell_over) drive.stopped = Stopped::no;  // no note beside the failure
    if (!take(drive)) return false;
    if (!fell_over) return true;
    outcome.failed = drive.trouble;
    return false;
}

std::string needs_steering(const VehicleDescription& vehicle) {
    return vehicle.steering.rack_per_revolution > 0 ? "" : "it cannot be steered: its file has no [steering]";
}
std::string needs_drive(const VehicleDescription& vehicle) {
    return !vehicle.power_units.empty() || driven_share(vehicle) > 0 ? "" : "no wheel of it is driven";
}
std::string needs_steering_and_drive(const VehicleDescription& vehicle) {
    const std::string steering = needs_steering(vehicle);
    return steering.empty() ? needs_drive(vehicle) : steering;
}
std::string needs_power_units(const VehicleDescription& vehicle) {
    return vehicle.power_units.empty() ? "its file has no [[power_unit]]" : "";
}
std::string needs_brakes(const VehicleDescription& vehicle) {
    return full_brake_force(vehicle) > 0 ? "" : "it has no brakes";
}

double rounded_down(double value, double step) {
    return step * std::floor(value / step + 1e-9);
}

double largest(const Recording& recording, std::string_view channel) {
    return largest_magnitude(recording[channel].values);
}

std::optional<Interval> between_levels(const Series& series, double from, double to, Crossing direction,
                                       double earliest) {
    const auto begin = first_crossing(series, from, direction, earliest),
               end = first_crossing(series, to, direction, earliest);
    if (!begin || !end) return {};
    return Interval{*begin, *end};
}

io::Curve over_time(const Recording& recording, std::string label, std::string_view channel, double factor,
                    double zero) {
    return {.label = std::move(label),
            .x = shifted(recording.time(), -zero),
            .y = scaled(recording[channel].values, factor)};
}

io::Curve over_channel(const Recording& recording, std::string_view x, std::string label, std::string_view channel) {
    const auto over = recording[x].values, values = recording[channel].values;
    return {.label = std::move(label), .x = {over.begin(), over.end()}, .y = {values.begin(), values.end()}};
}

io::Curve curve(std::string label, std::span<const double> x, std::span<const double> y, std::size_t max_count) {
    return {.label = std::move(label), .x = thinned(x, max_count), .y = thinned(y, max_count)};
}

}  // namespace hamilcar
