// `hamilcar kinematics VEHICLE`: every axle through bump, roll and steer, as tables and as a page of pictures.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/analysis/no_solution.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/json_text.hpp"
#include "kinematics_report.hpp"

namespace hamilcar::cli {

namespace {

using units::degree;

struct KinematicsOptions {
    VehicleChoice vehicle;
    std::string output;
    double travel = 80;  // each way [mm]
    bool json = false;
};

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
    const auto behind = [](const std::string& unit) { return unit.empty() ? "" : " " + unit; };
    const auto line = [&](const char* name, double value, const char* unit, int digits, const std::string& right = {}) {
        if (std::isfinite(value))
            fmt::print("  {:<34}{:>10}{}{}\n", name, fixed_text(value, digits), behind(unit), right);
    };
    // The right wheel where it differs in what is shown.
    const auto wheel = [&](const char* name, const char* unit, int digits, double scale, const auto& read) {
        const double left = scale * read(&AxleFigures::left), right = scale * read(&AxleFigures::right);
        const std::string text = fixed_text(right, digits);
        const bool told = std::isfinite(right) && text != fixed_text(left, digits);
        line(name, left, unit, digits, told ? ", right " + text + behind(unit) : "");
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
                write_file(fmt::format("{}/{}_{}.csv", options.output, axle.name, sweep.name), table_of(sweep));
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
