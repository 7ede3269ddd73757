// `hamilcar kinematics VEHICLE`: every axle through bump, roll and steer, as tables and as a page of pictures.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/analysis/kinematics.hpp"
#include "hamilcar/analysis/no_solution.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/csv.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/page.hpp"

namespace hamilcar::cli {

namespace {

using units::degree;

struct KinematicsOptions {
    VehicleChoice vehicle;
    std::string output;
    double travel = 80;  // each way [mm]
    bool json = false;
};

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

std::string csv(const Sweep& sweep) {
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
        const double left = figure.read(axle.design), right = twin->read(axle.design);
        if (std::abs(left - right) > 1e-6 * std::max(1.0, std::abs(left))) return false;
    }
    return true;
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

// Slope of a column about the middle of the bump sweep, per meter.
using Side = WheelFigures AxleFigures::*;
double gain(const AxleReport& axle, Side side, double WheelFigures::*member) {
    const std::vector<AxleFigures>& rows = axle.sweeps[0].rows;
    const std::size_t middle = axle.sweeps[0].design;
    if (middle == 0 || middle + 1 >= rows.size()) return std::nan("");
    const WheelFigures &above = rows[middle + 1].*side, &below = rows[middle - 1].*side;
    return (above.*member - below.*member) / (above.travel - below.travel);
}

void print_report(const AxleReport& axle) {
    const bool one_side = is_symmetric(axle);
    const auto behind = [](const std::string& unit) { return unit.empty() ? "" : " " + unit; };
    const auto line = [&](const char* name, double value, const char* unit, int digits, const std::string& right = {}) {
        if (std::isfinite(value))
            fmt::print("  {:<34}{:>10}{}{}\n", name, fixed_text(value, digits), behind(unit), right);
    };
    const auto wheel = [&](const char* name, const char* unit, int digits, double scale, const auto& read) {
        const double right = scale * read(&AxleFigures::right);
        const bool told = !one_side && std::isfinite(right);
        line(name, scale * read(&AxleFigures::left), unit, digits,
             told ? fmt::format(", right {}{}", fixed_text(right, digits), behind(unit)) : "");
    };
    const auto at_design = [&](double WheelFigures::*member) {
        return [&axle, member](Side side) { return (axle.design.*side).*member; };
    };
    const auto in_bump = [&](double WheelFigures::*member) {
        return [&axle, member](Side side) { return gain(axle, side, member); };
    };
    using W = WheelFigures;
    fmt::print("{}\n", axle.name);
    wheel("toe-in", "deg", 3, 1 / degree, at_design(&W::toe));
    wheel("camber", "deg", 3, 1 / degree, at_design(&W::camber));
    wheel("caster", "deg", 2, 1 / degree, at_design(&W::caster));
    wheel("kingpin inclination", "deg", 2, 1 / degree, at_design(&W::inclination));
    wheel("scrub radius", "mm", 1, 1e3, at_design(&W::scrub));
    wheel("mechanical trail", "mm", 1, 1e3, at_design(&W::trail));
    line("roll center height", 1e3 * axle.design.roll_center, "mm", 1);
    wheel("camber gain in bump", "deg/m", 2, 1 / degree, in_bump(&W::camber));
    wheel("bump steer (toe-in)", "deg/m", 2, 1 / degree, in_bump(&W::toe));
    wheel("spring ratio", "", 4, 1, at_design(&W::spring_ratio));
    wheel("damper ratio", "", 4, 1, at_design(&W::damper_ratio));
    wheel("wheel rate of the spring", "N/mm", 2, 1e-3, at_design(&W::wheel_rate));
    line("anti-dive or anti-lift, braking", axle.anti_brake, "%", 1);
    line("anti-squat or anti-lift, driving", axle.anti_drive, "%", 1);
    for (const Sweep& sweep : axle.sweeps) {
        if (!sweep.ended.empty()) fmt::print("  {} ends early: {}\n", sweep.name, sweep.ended);
    }
}

io::ExitCode kinematics(const KinematicsOptions& options) {
    const VehicleDescription vehicle = read_vehicle(options.vehicle);
    SweepRange range;
    range.travel = 1e-3 * options.travel;
    const std::vector<AxleReport> axles = [&] {
        try {
            return hamilcar::kinematics(vehicle, range);
        } catch (const NoSolution& error) {
            throw io::Error(io::ExitCode::numerical, options.vehicle.file + ": " + error.what());
        }
    }();
    nlohmann::json all = nlohmann::json::array();
    io::Page page{.title = vehicle.name,
                  .subtitle = "Every axle in bump, roll and steer, without compliance",
                  .blocks = {},
                  .runs = {}};
    for (const AxleReport& axle : axles) {
        if (!options.output.empty()) {
            make_folder(options.output);
            for (const Sweep& sweep : axle.sweeps) {
                write_file(fmt::format("{}/{}_{}.csv", options.output, axle.name, sweep.name), csv(sweep));
            }
            page.blocks.push_back(io::Heading{axle.name + " axle"});
            for (io::Chart& chart : charts(axle)) page.blocks.push_back(std::move(chart));
            page.blocks.push_back(design_table(axle));
        }
        if (options.json) {
            all.push_back(json_of(axle));
        } else {
            print_report(axle);
        }
    }
    if (options.json) fmt::print("{}\n", io::json_text(all));
    if (!options.output.empty()) {
        io::write_page(options.output + "/kinematics.html", page);
        tell_written(options.json, "kinematics.html and the tables of every axle to " + options.output);
    }
    return io::ExitCode::ok;
}

}  // namespace

void add_kinematics(CommandList& list) {
    auto [command, o] =
        list.add<KinematicsOptions>("kinematics", "move every axle through bump, roll and steer", kinematics);
    command.add("vehicle", o.vehicle.file, "vehicle file (TOML)").required();
    add_vehicle_set(command, o.vehicle);
    command.add("--travel", o.travel, {1, 1000, "mm"}, "of the wheels, each way");
    command.add("-o,--output", o.output, "folder for tables and a page");
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
