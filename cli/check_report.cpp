#include "check_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"

namespace hamilcar::cli {

namespace {

using units::degree;

nlohmann::json json_of(const SuspensionReport& report) {
    const SuspensionStructure& s = report.structure;
    return {{"name", s.name},
            {"suspension", s.suspension},
            {"tree_joints", s.joints},
            {"cut_joints", s.cuts},
            {"independent", s.independent},
            {"dependent", s.dependent},
            {"cut_equations", s.cut_equations},
            {"violation_m", report.loops.violation},
            {"mobility", report.loops.mobility},
            {"static_load_N", report.static_load}};
}

nlohmann::json json_of(const Table2& table) {
    nlohmann::json rows = nlohmann::json::array();
    for (const ConstraintRow& row : table.rows) rows.push_back({{"what", row.what}, {"constraints", row.constraints}});
    return {{"coordinates", table.coordinates}, {"constraints", table.constraints}, {"rows", rows}};
}

nlohmann::json json_of(const VehicleFigures& f) {
    nlohmann::json axles = nlohmann::json::array(), rides = nlohmann::json::array();
    for (const StandingAxle& axle : f.axles) {
        axles.push_back({{"name", axle.name},
                         {"track_m", axle.track},
                         {"load_N", axle.load},
                         {"left_load_N", axle.left_load},
                         {"travel_m", axle.travel},
                         {"roll_stiffness_N_m_per_rad", axle.roll_stiffness},
                         {"anti_roll_bar_N_m_per_rad", axle.bar_stiffness},
                         {"ride_frequency_Hz", axle.ride_frequency}});
    }
    for (const Mode& mode : f.rides) {
        rides.push_back({{"mode", mode.name}, {"frequency_Hz", mode.frequency}, {"damping_ratio", mode.damping_ratio}});
    }
    nlohmann::json out{{"mass_kg", f.mass},
                       {"wheelbase_m", f.wheelbase},
                       {"center_of_mass_behind_first_axle_m", f.center_of_mass[0]},
                       {"center_of_mass_to_the_left_m", f.center_of_mass[1]},
                       {"center_of_mass_height_m", f.center_of_mass[2]},
                       {"inertia_kg_m2", f.inertia},
                       {"static_stability_factor", f.static_stability_factor},
                       {"cross_weight", f.cross_weight},
                       {"full_brake_deceleration_m_per_s2", f.full_brake_deceleration},
                       {"axles", axles},
                       {"natural_frequencies", rides},
                       {"steering", nullptr}};
    if (f.steering) {
        out["steering"] = {{"ratio", f.steering->ratio},
                           {"inner_lock_deg", f.steering->inner / degree},
                           {"outer_lock_deg", f.steering->outer / degree},
                           {"turning_circle_m", f.steering->turning_circle}};
    }
    return out;
}

std::string list_of(const std::vector<std::string>& words) {
    return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

std::string text_of(const SuspensionReport& report) {
    const SuspensionStructure& s = report.structure;
    std::string on_road;
    for (const double load : report.static_load)
        on_road += fmt::format("{}{:.0f} N", on_road.empty() ? "" : " and ", load);
    std::string out = fmt::format("{} ({}), {} on the road\n", s.name, s.suspension, on_road);
    out += fmt::format("  tree joints   {}\n  cut joints    {}\n", list_of(s.joints), list_of(s.cuts));
    out += fmt::format("  independent   {}\n  dependent     {}\n", list_of(s.independent), list_of(s.dependent));
    if (s.cut_equations > 0) {
        out += fmt::format("  loops         closed within {:.1e} m, mobility {:.3f} (0 would be locked)\n",
                           report.loops.violation, report.loops.mobility);
    }
    return out;
}

// A number with its unit; a dash where it is none.
std::string shown(double value, int digits, const char* unit) {
    if (std::isnan(value)) return "-";
    return fmt::format("{} {}", fixed_text(value, digits), unit);
}

std::string axle_table(const std::vector<StandingAxle>& axles) {
    double loads = 0, rolls = 0;
    for (const StandingAxle& axle : axles) loads += axle.load, rolls += axle.roll_stiffness;
    constexpr const char* row = "  {:<25}{:>9}{:>11}{:>7}{:>10}{:>9}{:>16}{:>7}{:>8}\n";
    std::string s =
        "\n" + fmt::format(row, "axle", "track", "load", "", "travel", "ride", "roll stiffness", "", "bars");
    for (const StandingAxle& axle : axles) {
        s += fmt::format(row, axle.name, shown(axle.track, 3, "m"), shown(axle.load, 0, "N"),
                         shown(100 * axle.load / loads, 0, "%"), shown(1e3 * axle.travel, 1, "mm"),
                         shown(axle.ride_frequency, 2, "Hz"), shown(axle.roll_stiffness * degree, 0, "N m/deg"),
                         shown(100 * axle.roll_stiffness / rolls, 0, "%"),
                         shown(100 * axle.bar_stiffness / axle.roll_stiffness, 0, "%"));
    }
    return s;
}

std::string corner_loads(const VehicleFigures& f) {
    std::string s;
    for (const StandingAxle& axle : f.axles) {
        if (!axle.of_trailer) s += fmt::format("{:.0f} and {:.0f} N, ", axle.left_load, axle.load - axle.left_load);
    }
    return s + fmt::format("cross weight {} %", fixed_text(100 * f.cross_weight, 2));
}

std::string text_of(const VehicleFigures& f) {
    const auto line = [](const char* name, const std::string& value) {
        return fmt::format("  {:<25}{}\n", name, value);
    };
    const auto& c = f.center_of_mass;
    std::string s = line("wheelbase", fmt::format("{:.3f} m", f.wheelbase));
    s += line("center of mass", fmt::format("{:.3f} m behind the first axle, {:.3f} m high{}", c[0], c[2],
                                            std::abs(c[1]) < 5e-4 ? "" : fmt::format(", {:+.3f} m to the left", c[1])));
    s += line("moments of inertia", fmt::format("roll {:.0f}, pitch {:.0f}, yaw {:.0f} kg m^2 about it", f.inertia[0],
                                                f.inertia[1], f.inertia[2]));
    s += line("static stability factor", fmt::format("{:.2f}", f.static_stability_factor));
    if (!std::isnan(f.cross_weight)) s += line("corner loads", corner_loads(f));
    if (const auto& steering = f.steering) {
        s += line("steering ratio", fmt::format("{:.1f}", steering->ratio));
        s += line("full lock",
                  fmt::format("{:.1f} deg inside, {:.1f} deg outside; turning circle {:.1f} m",
                              steering->inner / degree, steering->outer / degree, steering->turning_circle));
    }
    s += line("all brakes", fmt::format("{:.1f} m/s^2, were the road to take it", f.full_brake_deceleration));
    s += axle_table(f.axles);
    s += fmt::format("\n  {:<25}{:>9} {:>17}\n", "natural frequency", "", "damping ratio");
    for (const Mode& mode : f.rides)
        s += fmt::format("  {:<25}{:>6.2f} Hz {:>17.2f}\n", mode.name, mode.frequency, mode.damping_ratio);
    return s;
}

std::string structure_text(const CheckReport& report) {
    const Structure& counted = report.counted;
    std::string s;
    for (const SuspensionReport& suspension : report.suspensions) s += text_of(suspension);
    const int hitches = counted.hitch_freedoms;
    s += fmt::format("\ncoordinates q            {} (chassis 6, suspensions {}{})\n", counted.coordinates,
                     counted.coordinates - 6 - hitches, hitches > 0 ? fmt::format(", hitches {}", hitches) : "");
    s += fmt::format("cut constraint equations {}\n", counted.cut_equations);
    s += fmt::format("degrees of freedom       {} = 6 + {} independent suspension coordinates{} (and {} wheel spins)\n",
                     counted.degrees_of_freedom, counted.degrees_of_freedom - 6 - hitches,
                     hitches > 0 ? fmt::format(" + {} of hitches", hitches) : "", counted.wheel_spins);
    if (!report.table_2) return s;
    const int coordinates = report.table_2->coordinates, left = coordinates - report.table_2->constraints;
    s += fmt::format("counted as in the paper's Table 2: {} x 7 = {} coordinates - {} constraints = {}\n",
                     counted.bodies, coordinates, report.table_2->constraints, left);
    s += fmt::format(
        "  (with the steering driver among the constraints, as printed there, {}: but the driver's coordinate,\n"
        "   the rack q17, is not among the {}; it is prescribed and removes nothing)\n",
        left - 1, coordinates);
    return s;
}

}  // namespace

std::string sentence(const Oddity& oddity) {
    return fmt::format("{}: {}: {}", oddity.where, oddity.what, oddity.cause);
}

std::string text_of(const CheckReport& report, bool structure) {
    const std::size_t odd = report.oddities.size();
    std::string s =
        fmt::format("{}: ok{}\n{}, {:.1f} kg, {} bodies\n\n", report.file,
                    odd == 0 ? "" : fmt::format(", but {} {} odd", odd, odd == 1 ? "thing is" : "things are"),
                    report.vehicle, report.figures.total_mass, report.counted.bodies);
    for (const Oddity& oddity : report.oddities) s += fmt::format("odd: {}\n", sentence(oddity));
    if (odd > 0) s += "\n";
    s += text_of(report.figures);
    for (const std::string& note : report.notes) s += fmt::format("\nnote: {}", note);
    if (!report.notes.empty()) s += "\n";
    return structure ? s + "\n" + structure_text(report) : s;
}

nlohmann::json json_of(const CheckReport& report) {
    nlohmann::json suspensions = nlohmann::json::array(), channels = nlohmann::json::array(),
                   odd = nlohmann::json::array();
    for (const SuspensionReport& suspension : report.suspensions) suspensions.push_back(json_of(suspension));
    for (const io::Column& channel : report.channels) {
        channels.push_back({{"name", channel.name}, {"unit", channel.unit}, {"meaning", channel.description}});
    }
    for (const Oddity& oddity : report.oddities)
        odd.push_back({{"where", oddity.where}, {"what", oddity.what}, {"cause", oddity.cause}});
    const Structure& counted = report.counted;
    return {{"file", report.file},
            {"vehicle", report.vehicle},
            {"mass_kg", report.figures.total_mass},
            {"figures", json_of(report.figures)},
            {"odd", odd},
            {"bodies", counted.bodies},
            {"coordinates", counted.coordinates},
            {"cut_equations", counted.cut_equations},
            {"degrees_of_freedom", counted.degrees_of_freedom},
            {"hitch_freedoms", counted.hitch_freedoms},
            {"wheel_spins", counted.wheel_spins},
            {"suspensions", suspensions},
            {"table_2", report.table_2 ? json_of(*report.table_2) : nlohmann::json(nullptr)},
            {"notes", report.notes},
            {"channels", channels}};
}

}  // namespace hamilcar::cli
