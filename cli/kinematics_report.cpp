#include "kinematics_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "hamilcar/base/units.hpp"
#include "hamilcar/io/csv.hpp"

namespace hamilcar::cli {

namespace {

using units::degree;

// One figure of an axle: a column of the tables.
struct Figure {
    std::string name, unit;
    std::function<double(const AxleFigures&)> read;
};

std::vector<Figure> figures() {
    std::vector<Figure> out{{"travel", "mm", [](const AxleFigures& f) { return 1e3 * f.travel; }},
                            {"roll", "deg", [](const AxleFigures& f) { return f.roll / degree; }},
                            {"rack", "mm", [](const AxleFigures& f) { return 1e3 * f.rack; }}};
    struct Own {
        const char *name, *unit;
        double WheelFigures::*member;
        double scale;
    };
    const Own own[] = {{"travel", "mm", &WheelFigures::travel, 1e3},
                       {"toe_in", "deg", &WheelFigures::toe, 1 / degree},
                       {"camber", "deg", &WheelFigures::camber, 1 / degree},
                       {"steer", "deg", &WheelFigures::steer, 1 / degree},
                       {"caster", "deg", &WheelFigures::caster, 1 / degree},
                       {"kingpin_inclination", "deg", &WheelFigures::inclination, 1 / degree},
                       {"scrub_radius", "mm", &WheelFigures::scrub, 1e3},
                       {"mechanical_trail", "mm", &WheelFigures::trail, 1e3},
                       {"wheelbase_change", "mm", &WheelFigures::center_x, 1e3},
                       {"contact_outward", "mm", &WheelFigures::contact_y, 1e3},
                       {"spring_ratio", "1", &WheelFigures::spring_ratio, 1},
                       {"damper_ratio", "1", &WheelFigures::damper_ratio, 1},
                       {"wheel_rate", "N/mm", &WheelFigures::wheel_rate, 1e-3},
                       {"brake_slope", "1", &WheelFigures::dive_slope, 1},
                       {"drive_slope", "1", &WheelFigures::drive_slope, 1}};
    for (const bool left : {true, false}) {
        for (const Own& one : own) {
            out.push_back(
                {(left ? "left." : "right.") + std::string(one.name), one.unit,
                 [one, left](const AxleFigures& f) { return one.scale * ((left ? f.left : f.right).*one.member); }});
        }
    }
    out.push_back({"track_change", "mm", [](const AxleFigures& f) { return 1e3 * f.track_change; }});
    out.push_back({"roll_center_height", "mm", [](const AxleFigures& f) { return 1e3 * f.roll_center; }});
    out.push_back({"roll_stiffness", "N m/deg", [](const AxleFigures& f) { return f.roll_stiffness * degree; }});
    out.push_back({"ackermann_error", "deg", [](const AxleFigures& f) { return f.ackermann / degree; }});
    return out;
}

io::Chart chart(const Sweep& sweep, const std::string& title, const std::string& x_name, const std::string& x_label,
                const std::string& y_label, const std::vector<std::pair<std::string, std::string>>& curves) {
    const std::vector<Figure> all = figures();
    const auto column = [&](const std::string& name) {
        std::vector<double> values;
        for (const Figure& figure : all) {
            if (figure.name != name) continue;
            for (const AxleFigures& row : sweep.rows) values.push_back(figure.read(row));
        }
        return values;
    };
    io::Chart out{.title = title, .x_label = x_label, .y_label = y_label, .curves = {}, .vertical_marks = {}};
    for (const auto& [name, label] : curves) out.curves.push_back({label, column(x_name), column(name)});
    return out;
}

const Sweep* find(const AxleReport& axle, const char* name) {
    for (const Sweep& sweep : axle.sweeps) {
        if (sweep.name == name && !sweep.rows.empty()) return &sweep;
    }
    return nullptr;
}

// Whether the right wheel's figures are the left one's.
bool is_symmetric(const AxleReport& axle) {
    const std::vector<Figure> all = figures();
    for (const Figure& figure : all) {
        if (!figure.name.starts_with("left.")) continue;
        const auto twin = std::ranges::find(all, "right." + figure.name.substr(5), &Figure::name);
        const double to_left = figure.name == "left.steer" ? -1 : 1;  // of both sides
        const double left = figure.read(axle.design), right = to_left * twin->read(axle.design);
        if (std::abs(left - right) > 1e-6 * std::max(1.0, std::abs(left))) return false;
    }
    return true;
}

}  // namespace

std::string table_of(const Sweep& sweep) {
    const std::vector<Figure> all = figures();
    std::vector<std::string> headings;
    for (const Figure& figure : all) headings.push_back(fmt::format("{} [{}]", figure.name, figure.unit));
    io::CsvText table(headings);
    for (const AxleFigures& row : sweep.rows) {
        for (const Figure& figure : all) table.cell(figure.read(row), 7);
        table.end_row();
    }
    return table.text();
}

std::vector<io::Chart> charts(const AxleReport& axle) {
    std::vector<io::Chart> out;
    const bool one_side = is_symmetric(axle);
    if (const Sweep* bump = find(axle, "bump")) {
        const auto add = [&](const char* title, const char* unit, const std::string& name) {
            std::vector<std::pair<std::string, std::string>> curves{{name, ""}};
            if (!one_side && name.starts_with("left.")) curves = {{name, "left"}, {"right." + name.substr(5), "right"}};
            out.push_back(chart(*bump, title, "travel", "bump travel [mm]", unit, curves));
        };
        add("Toe-in", "[deg]", "left.toe_in"), add("Camber", "[deg]", "left.camber");
        if (std::isfinite(axle.design.left.caster)) {
            add("Caster", "[deg]", "left.caster");
            add("Kingpin inclination", "[deg]", "left.kingpin_inclination");
            add("Scrub radius", "[mm]", "left.scrub_radius"), add("Mechanical trail", "[mm]", "left.mechanical_trail");
        }
        add("Track change", "[mm]", "track_change"), add("Wheelbase change", "[mm]", "left.wheelbase_change");
        add("Roll center height", "[mm]", "roll_center_height");
        out.push_back(chart(*bump, "Motion ratios", "travel", "bump travel [mm]", "[1]",
                            {{"left.spring_ratio", "spring"}, {"left.damper_ratio", "damper"}}));
        add("Wheel rate of the springs", "[N/mm]", "left.wheel_rate");
    }
    if (const Sweep* roll = find(axle, "roll")) {
        out.push_back(chart(*roll, "Camber in roll", "roll", "roll of the axle against the body [deg]", "[deg]",
                            {{"left.camber", "left"}, {"right.camber", "right"}}));
        out.push_back(chart(*roll, "Roll steer", "roll", "roll of the axle against the body [deg]", "to the left [deg]",
                            {{"left.steer", "left"}, {"right.steer", "right"}}));
    }
    if (const Sweep* steer = find(axle, "steer")) {
        out.push_back(
            chart(*steer, "Steer", "rack", "rack [mm]", "[deg]", {{"left.steer", "left"}, {"right.steer", "right"}}));
        out.push_back(chart(*steer, "Ackermann error", "rack", "rack [mm]", "[deg]", {{"ackermann_error", ""}}));
        out.push_back(chart(*steer, "Camber over steer", "rack", "rack [mm]", "[deg]",
                            {{"left.camber", "left"}, {"right.camber", "right"}}));
    }
    return out;
}

nlohmann::json json_of(const AxleReport& axle) {
    nlohmann::json design, sweeps = nlohmann::json::array();
    for (const Figure& figure : figures()) design[figure.name + "_" + figure.unit] = figure.read(axle.design);
    for (const Sweep& sweep : axle.sweeps) {
        sweeps.push_back({{"name", sweep.name}, {"rows", sweep.rows.size()}, {"ended", sweep.ended}});
    }
    return {{"axle", axle.name},
            {"design", design},
            {"sweeps", sweeps},
            {"anti_under_braking_percent", axle.anti_brake},
            {"anti_under_drive_percent", axle.anti_drive}};
}

io::Table design_table(const AxleReport& axle) {
    io::Table table{axle.name + " axle at design", {{"", ""}, {"value", ""}, {"unit", ""}}, {}};
    for (const Figure& figure : figures()) {
        const double value = figure.read(axle.design);
        if (std::isfinite(value)) table.rows.push_back({figure.name, value, figure.unit});
    }
    return table;
}

}  // namespace hamilcar::cli
