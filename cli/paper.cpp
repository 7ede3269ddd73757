// `hamilcar paper`: the paper's case with its Tables 2 and 3 and Figures 9 and 11 to 14, as data and pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "figure_9.hpp"
#include "files.hpp"
#include "hamilcar/analysis/freedom.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/csv.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/page.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/record.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "summary.hpp"

namespace hamilcar::cli {

namespace {

struct PaperOptions {
    std::string scenario, output = "out/paper";
    bool json = false;
};

// What the paper does not print and had to be chosen; docs/theory/errata.md, sections 6 and 7.
io::Paragraph what_is_ours(const ScenarioDescription& scenario) {
    std::string text =
        "The paper prints neither the numbers of its car nor the inputs of its run: no mass, hardpoint, spring or "
        "tire, no drive torque, no steering. Those here are our own, so Figures 9 and 11 to 14 show the paper's method "
        "and quantities, not its curves.";
    const auto largest = [](const std::vector<double>& values) {
        double size = 0;
        for (const double value : values) size = std::max(size, std::abs(value));
        return size;
    };
    text += fmt::format(" Here the drive torque goes up to {:.4g} N m", largest(scenario.drive.value));
    if (scenario.steering_input == SteeringInput::steering_wheel) {
        text += fmt::format(", the steering wheel to {:.4g} degrees to a side",
                            largest(scenario.steering.value) / units::degree);
    }
    return {text + "."};
}

struct Figure {
    const char *file, *title, *channel, *y_label;
};
constexpr Figure figures[] = {
    {"fig11_lateral_position", "Fig. 11  Lateral position of the chassis", "chassis.position.y", "y [m]"},
    {"fig12_lateral_velocity", "Fig. 12  Lateral velocity of the chassis", "chassis.velocity.y", "y' [m/s]"},
    {"fig13_vertical_position", "Fig. 13  Vertical position of the chassis", "chassis.position.z", "z [m]"},
    {"fig14_vertical_velocity", "Fig. 14  Vertical velocity of the chassis", "chassis.velocity.z", "z' [m/s]"},
};

// Table 2 as it is printed, and what it counts.
struct Table2 {
    std::vector<ConstraintRow> rows;
    int constraints = 0, coordinates = 0, degrees_of_freedom = 0, cut_equations = 0;
    int as_printed() const { return coordinates - constraints; }
};

Table2 table_2_of(const Simulation& simulation) {
    const Structure counted = structure(simulation.model().vehicle, simulation.vehicle());
    Table2 table{.rows = paper_table_2(counted, true),
                 .coordinates = 7 * counted.bodies,
                 .degrees_of_freedom = counted.degrees_of_freedom,
                 .cut_equations = counted.cut_equations};
    for (const ConstraintRow& row : table.rows) table.constraints += row.constraints;
    return table;
}

void write_table_2(const std::string& folder, const Table2& counted, io::Page& page) {
    io::CsvText text({"what", "constraints"});
    io::Table table{"Table 2  Constraints and degrees of freedom", {{"what", ""}, {"constraints", ""}}, {}};
    const auto add = [&](const std::string& what, int number) {
        text.cell(what).cell(number).end_row();
        table.rows.push_back({what, double(number)});
    };
    for (const ConstraintRow& row : counted.rows) add(row.what, row.constraints);
    add("total", counted.constraints);
    add("coordinates", counted.coordinates);
    add("as printed: coordinates less constraints", counted.as_printed());
    add("degrees of freedom, the rack prescribed", counted.degrees_of_freedom);
    page.blocks.push_back(table);
    write_file(folder + "/table2_degrees_of_freedom.csv", text.text());
}

std::vector<Method> methods_of_table_3() {
    std::vector<Method> out;
    std::ranges::copy_if(methods, std::back_inserter(out),
                         [](const Method& method) { return method.paper_limit.has_value(); });
    return out;
}

void write_table_3(const std::string& folder, double step, io::Page& page) {
    io::CsvText text(
        {"method", "order", "paper's ST_k", "exact limit", "paper's alpha [1/s]", "largest stable alpha [1/s]"});
    io::Table table{"Table 3  Stability limits",
                    {{"method", ""},
                     {"order", ""},
                     {"paper's ST_k", "1"},
                     {"exact limit", "1"},
                     {"paper's alpha", "1/s"},
                     {"largest stable alpha", "1/s"}},
                    {}};
    for (const Method& method : methods_of_table_3()) {
        table.rows.push_back({std::string(method.name), double(method.order), *method.paper_limit,
                              method.real_axis_limit, *method.paper_limit / step, method.real_axis_limit / step});
        text.cell(method.name).cell(method.order).cell(*method.paper_limit).cell(method.real_axis_limit, 6);
        text.cell(*method.paper_limit / step, 6).cell(method.real_axis_limit / step, 6).end_row();
    }
    page.blocks.push_back(table);
    write_file(folder + "/table3_stability_limits.csv", text.text());
}

// Runs the case itself; Figures 11 to 14 from its samples.
RunSummary write_motion_figures(const std::string& folder, Simulation& simulation, const std::vector<Channel>& all,
                                io::Page& page) {
    std::vector<Channel> channels;
    for (const Figure& figure : figures) channels.push_back(select_channels(all, {figure.channel}).front());
    std::vector<double> time;
    std::vector<std::vector<double>> values(channels.size());
    Progress progress("paper");
    const RunSummary summary = record(
        simulation, channels, figure_interval,
        [&](const Sample& sample, const std::vector<double>& row) {
            time.push_back(sample.time);
            for (std::size_t i = 0; i < row.size(); ++i) values[i].push_back(row[i]);
        },
        [&](double share, const RunSummary&) { return progress.show(share), !interrupted(); });
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const io::Column& column = channels[i].column;
        const std::string base = folder + "/" + figures[i].file;
        write_columns(base + ".csv", {"time [s]", fmt::format("{} [{}]", column.name, column.unit)},
                      {&time, &values[i]});
        page.blocks.push_back(io::Chart{figures[i].title, "time [s]", figures[i].y_label, {{"", time, values[i]}}});
    }
    return summary;
}

struct PaperReport {
    RunReport run;
    Table2 table_2;
    Figure9 figure_9;
    std::string folder;
};

nlohmann::json json_of(const PaperReport& report) {
    nlohmann::json table_3 = nlohmann::json::array();
    for (const Method& method : methods_of_table_3()) {
        table_3.push_back({{"order", method.order}, {"paper", *method.paper_limit}, {"exact", method.real_axis_limit}});
    }
    return {{"run", json_of(report.run)},
            {"table_2",
             {{"constraints", report.table_2.constraints},
              {"coordinates", report.table_2.coordinates},
              {"as_printed", report.table_2.as_printed()},
              {"degrees_of_freedom", report.table_2.degrees_of_freedom},
              {"cut_equations", report.table_2.cut_equations}}},
            {"table_3", table_3},
            {"figure_9", json_of(report.figure_9)},
            {"folder", report.folder}};
}

void print_sweep(const GainSweep& sweep) {
    fmt::print("          steering \"{}\": ", sweep.steering);
    if (sweep.best) {
        fmt::print("smallest RMS norm {:.2e} at alpha = {:.4g}", sweep.best->rms_norm, sweep.best->gain);
    } else {
        fmt::print("no gain is stable");
    }
    if (const auto& run = sweep.at_paper_gain) {
        fmt::print("; at {:.4g} RMS {:.2e}, largest {:.2e}", run->gain, run->rms_norm, run->max_norm);
    }
    const auto& unstable = sweep.first_unstable_gain;
    fmt::print("; first run lost at {}\n", unstable ? fmt::format("{:.4g}", *unstable) : "none");
}

void print_report(const PaperReport& report) {
    print_summary(report.run);
    const Table2& table = report.table_2;
    fmt::print(
        "\nTable 2   {} coordinates - {} constraints = {} as printed; {} degrees of freedom (the rack is prescribed)\n",
        table.coordinates, table.constraints, table.as_printed(), table.degrees_of_freedom);
    fmt::print("Table 3   ST_3 = 0.4 in print, 6/11 exactly\n");
    fmt::print("Figure 9  paper: comparatively small at alpha = {:g}, norm {:g}\n", paper_gain, paper_norm);
    for (const GainSweep& sweep : report.figure_9.sweeps) print_sweep(sweep);
    fmt::print("          the stability limit S / h is {:.1f}\n", report.figure_9.stability_limit);
    fmt::print("Car, drive torque and steering are ours; the paper prints none of them.\n");
    fmt::print("\nAll tables and figures: {0}/paper.html; their data: {0}/*.csv\n", report.folder);
}

io::ExitCode paper(const PaperOptions& options) {
    const std::string file = options.scenario.empty() ? shipped_file("scenarios/paper.toml") : options.scenario;
    const ScenarioDescription scenario = io::read_scenario(file);
    const VehicleDescription vehicle = io::read_vehicle(scenario.vehicle);
    const std::string& folder = options.output;
    const io::FolderLock lock = take_folder(folder);
    const InterruptWatch watch;
    Simulation simulation(vehicle, scenario);
    io::Page page{
        .title = "The paper's case", .subtitle = vehicle.name + ", " + scenario.name, .blocks = {}, .runs = {}};
    page.blocks.push_back(what_is_ours(scenario));
    const Table2 table_2 = table_2_of(simulation);
    write_table_2(folder, table_2, page);
    write_table_3(folder, scenario.solver.step, page);
    const RunSummary summary = write_motion_figures(folder, simulation, all_channels(vehicle), page);
    io::write_page(folder + "/paper.html", page);  // whatever becomes of Figure 9
    if (summary.interrupted) {
        fmt::print(stderr, "hamilcar: interrupted; Figures 11 to 14 end at t = {:.3f} s, Figure 9 is missing\n",
                   summary.duration);
        return io::ExitCode::interrupted;
    }
    if (summary.ended_early) throw io::Error(io::ExitCode::numerical, *summary.ended_early);
    if (table_2.cut_equations == 0) {
        throw io::Error(io::ExitCode::bad_file, file + ": Figure 9 shows cut constraints, and this car has none");
    }
    const RunReport run = report_of(simulation, summary, {});
    const std::optional<Figure9> figure_9 = write_figure_9(folder, vehicle, scenario, page);
    if (!figure_9) {
        fmt::print(stderr, "hamilcar: interrupted; Figure 9 is missing\n");
        return io::ExitCode::interrupted;
    }
    io::write_page(folder + "/paper.html", page);
    const PaperReport report{run, table_2, *figure_9, folder};
    const std::string facts = io::json_text(json_of(report));
    write_file(folder + "/summary.json", facts + "\n");
    if (options.json) {
        fmt::print("{}\n", facts);
    } else {
        print_report(report);
    }
    return io::ExitCode::ok;
}

}  // namespace

void add_paper(CommandList& list) {
    auto [command, o] = list.add<PaperOptions>("paper", "run the paper's case and write its tables and figures", paper);
    command.add("scenario", o.scenario, "another scenario file than the paper's");
    command.add("-o,--output", o.output, "folder for the results");
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
