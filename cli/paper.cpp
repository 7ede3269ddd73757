// `hamilcar paper`: the paper's case with its Tables 2 and 3 and Figures 9 and 11 to 14, as data and pictures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "commands.hpp"
#include "hamilcar/analysis/freedom.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/page.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/record.hpp"
#include "hamilcar/run/stabilization_sweep.hpp"
#include "progress.hpp"
#include "summary.hpp"

namespace hamilcar::cli {

namespace {

constexpr double figure_interval = 0.01;  // between points [s]
// Gains of Fig. 9 [1/s] for third-order Adams-Bashforth at 1 ms, around the paper's 400 and on both sides of the limit;
// another method or step has them in the same ratio to its own limit.
const std::vector<double> sweep_gains{10, 25, 50, 100, 150, 200, 250, 300, 350, 400, 450, 500, 540, 550, 600, 800};
const std::vector<double> shown_gains{50, 200, 400, 500};
constexpr double paper_gain = 400, paper_norm = 0.005;  // [1/s]; "comparatively small", it says
constexpr double paper_limit_gain = 6.0 / 11 / 1e-3;    // [1/s]

// What the paper does not print and had to be chosen; docs/theory/errata.md, sections 6 and 7.
io::Paragraph what_is_ours(const ScenarioDescription& scenario) {
    constexpr double degree = std::numbers::pi / 180;
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
        text +=
            fmt::format(", the steering wheel to {:.4g} degrees to a side", largest(scenario.steering.value) / degree);
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

void write_columns(const std::string& path, const std::vector<std::string>& heads,
                   const std::vector<const std::vector<double>*>& columns) {
    std::string text;
    for (std::size_t j = 0; j < heads.size(); ++j) text += (j ? "," : "") + heads[j];
    text += "\n";
    std::size_t rows = 0;
    for (const auto* column : columns) rows = std::max(rows, column->size());
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t j = 0; j < columns.size(); ++j) {
            text += j ? "," : "";
            if (i < columns[j]->size()) text += fmt::format("{}", (*columns[j])[i]);
        }
        text += "\n";
    }
    write_file(path, text);
}

nlohmann::json write_table_2(const std::string& folder, const Simulation& simulation, io::Page& page) {
    const Structure counted = structure(simulation.model().vehicle, simulation.vehicle());
    std::string text = "what,constraints\n";
    int total = 0;
    io::Table table{"Table 2  Constraints and degrees of freedom", {{"what", ""}, {"constraints", ""}}, {}};
    for (const ConstraintRow& row : paper_table_2(counted, true)) {
        text += fmt::format("{},{}\n", row.what, row.constraints);
        total += row.constraints;
        table.rows.push_back({row.what, double(row.constraints)});
    }
    table.rows.push_back({"total", double(total)});
    table.rows.push_back({"coordinates", double(7 * counted.bodies)});
    table.rows.push_back({"as printed: coordinates less constraints", double(7 * counted.bodies - total)});
    table.rows.push_back({"degrees of freedom, the rack prescribed", double(counted.degrees_of_freedom)});
    page.blocks.push_back(table);
    text += fmt::format("total,{}\ncoordinates,{}\nas printed: coordinates - total,{}\n", total, 7 * counted.bodies,
                        7 * counted.bodies - total);
    text += fmt::format("degrees of freedom (the rack's coordinate counted with its driver),{}\n",
                        counted.degrees_of_freedom);
    write_file(folder + "/table2_degrees_of_freedom.csv", text);
    return {{"constraints", total},
            {"coordinates", 7 * counted.bodies},
            {"as_printed", 7 * counted.bodies - total},
            {"degrees_of_freedom", counted.degrees_of_freedom},
            {"cut_equations", counted.cut_equations}};
}

nlohmann::json write_table_3(const std::string& folder, double step, io::Page& page) {
    std::string text = "method,order,paper's ST_k,exact limit,paper's alpha [1/s],largest stable alpha [1/s]\n";
    nlohmann::json rows = nlohmann::json::array();
    io::Table table{"Table 3  Stability limits",
                    {{"method", ""},
                     {"order", ""},
                     {"paper's ST_k", "1"},
                     {"exact limit", "1"},
                     {"paper's alpha", "1/s"},
                     {"largest stable alpha", "1/s"}},
                    {}};
    for (const Method& method : methods) {
        if (!method.paper_limit) continue;
        table.rows.push_back({std::string(method.name), double(method.order), *method.paper_limit,
                              method.real_axis_limit, *method.paper_limit / step, method.real_axis_limit / step});
        text += fmt::format("{},{},{},{:.6g},{:.6g},{:.6g}\n", method.name, method.order, *method.paper_limit,
                            method.real_axis_limit, *method.paper_limit / step, method.real_axis_limit / step);
        rows.push_back({{"order", method.order}, {"paper", *method.paper_limit}, {"exact", method.real_axis_limit}});
    }
    page.blocks.push_back(table);
    write_file(folder + "/table3_stability_limits.csv", text);
    return rows;
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

// The sweep as rows of a table and as curves of the two pictures.
struct Figure9 {
    std::string table = "alpha [1/s],alpha h,rms norm of Phi,largest norm of Phi,reached [s],stable\n";
    io::Chart over_time{"Fig. 9  Norm of the constraint violations", "time [s]", "|Phi|", {}, true, {}};
    io::Curve rms{"root mean square over the run", {}, {}, true}, largest{"largest", {}, {}, true};

    void add(const SweepRun& run, double step) {
        table += fmt::format("{},{:.6g},{},{},{:.6g},{}\n", run.gain, run.gain * step, run.rms_norm, run.max_norm,
                             run.ended, run.blew_up ? "no" : "yes");
        if (run.blew_up) return;
        rms.x.push_back(run.gain), rms.y.push_back(run.rms_norm);
        largest.x.push_back(run.gain), largest.y.push_back(run.max_norm);
    }
    void show(const SweepRun& run, const std::string& folder) {
        io::Curve curve{fmt::format("alpha = {:g}", run.gain), run.time, run.norm};
        for (double& y : curve.y) y = std::max(y, 1e-17);  // zero has no logarithm
        over_time.curves.push_back(curve);
        write_columns(fmt::format("{}/fig09_alpha_{:g}.csv", folder, run.gain), {"time [s]", "|Phi|"},
                      {&run.time, &run.norm});
    }
};

nlohmann::json write_figure_9(const std::string& folder, const VehicleDescription& vehicle,
                              const ScenarioDescription& scenario, io::Page& page) {
    const double step = scenario.solver.step, limit = find_method(scenario.solver.integrator)->real_axis_limit / step;
    const double scale = limit / paper_limit_gain;
    std::vector<double> gains;
    for (const double gain : sweep_gains) gains.push_back(gain * scale);
    const auto runs = stabilization_sweep(vehicle, scenario, gains, figure_interval, [] { return !interrupted(); });
    if (runs.size() < gains.size()) return nullptr;
    Figure9 figure;
    nlohmann::json facts{{"paper_claim", {{"comparatively_small_at_gain_per_s", paper_gain}, {"norm", paper_norm}}},
                         {"stability_limit_per_s", limit},
                         {"first_unstable_gain_per_s", nullptr},
                         {"least_rms_at_gain_per_s", nullptr},
                         {"least_rms_norm", nullptr}};
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const SweepRun& run = runs[i];
        figure.add(run, step);
        if (std::find(shown_gains.begin(), shown_gains.end(), sweep_gains[i]) != shown_gains.end())
            figure.show(run, folder);
        if (sweep_gains[i] == paper_gain) {
            facts["paper_gain_per_s"] = run.gain;
            facts["rms_norm_at_paper_gain"] = run.rms_norm;
            facts["largest_norm_at_paper_gain"] = run.max_norm;
        }
        auto& unstable = facts["first_unstable_gain_per_s"];
        if (run.blew_up && unstable.is_null()) unstable = run.gain;
        auto& least = facts["least_rms_norm"];
        if (!run.blew_up && (least.is_null() || run.rms_norm < least.get<double>())) {
            least = run.rms_norm;
            facts["least_rms_at_gain_per_s"] = run.gain;
        }
    }
    write_file(folder + "/fig09_sweep.csv", figure.table);
    page.blocks.push_back(figure.over_time);
    page.blocks.push_back(io::Chart{"Fig. 9 swept: constraint violation against the gain",
                                    "alpha [1/s]",
                                    "norm of Phi",
                                    {figure.rms, figure.largest},
                                    true,
                                    {{limit, fmt::format("stability limit {:.0f}", limit)}}});
    return facts;
}

std::string number(const nlohmann::json& value, const char* format) {
    return value.is_null() ? "none" : fmt::format(fmt::runtime(format), value.get<double>());
}

void print_paper(const nlohmann::json& facts, const std::string& folder) {
    const auto& fig9 = facts["figure_9"];
    print_summary(facts["run"]);
    fmt::print(
        "\nTable 2   {} coordinates - {} constraints = {} as printed; {} degrees of freedom (the rack is prescribed)\n",
        facts["table_2"]["coordinates"].get<int>(), facts["table_2"]["constraints"].get<int>(),
        facts["table_2"]["as_printed"].get<int>(), facts["table_2"]["degrees_of_freedom"].get<int>());
    fmt::print("Table 3   ST_3 = 0.4 in print, 6/11 exactly\n");
    fmt::print("Figure 9  paper: comparatively small at alpha = {:g}, norm {:g}\n", paper_gain, paper_norm);
    fmt::print("          here:  least RMS norm {} at alpha = {}; at {} RMS {}, largest {}\n",
               number(fig9["least_rms_norm"], "{:.2e}"), number(fig9["least_rms_at_gain_per_s"], "{:.4g}"),
               number(fig9["paper_gain_per_s"], "{:.4g}"), number(fig9["rms_norm_at_paper_gain"], "{:.2e}"),
               number(fig9["largest_norm_at_paper_gain"], "{:.2e}"));
    fmt::print("          first run lost: alpha = {}; the stability limit S / h is {}\n",
               number(fig9["first_unstable_gain_per_s"], "{:.4g}"), number(fig9["stability_limit_per_s"], "{:.1f}"));
    fmt::print("Car, drive torque and steering are ours; the paper prints none of them.\n");
    fmt::print("\nAll tables and figures: {0}/paper.html; their data: {0}/*.csv\n", folder);
}

}  // namespace

io::ExitCode paper(const Options& options) {
    const std::string file = options.file.empty() ? shipped_file("scenarios/paper.toml") : options.file;
    const ScenarioDescription scenario = io::read_scenario(file);
    const VehicleDescription vehicle = io::read_vehicle(scenario.vehicle);
    const std::string folder = options.output.empty() ? "out/paper" : options.output;
    const io::FolderLock lock = take_folder(folder);
    const InterruptWatch watch;
    Simulation simulation = in_files(file, scenario.vehicle, [&] { return Simulation(vehicle, scenario); });
    nlohmann::json facts;
    io::Page page{
        .title = "The paper's case", .subtitle = vehicle.name + ", " + scenario.name, .blocks = {}, .runs = {}};
    page.blocks.push_back(what_is_ours(scenario));
    facts["table_2"] = write_table_2(folder, simulation, page);
    facts["table_3"] = write_table_3(folder, scenario.solver.step, page);
    const RunSummary summary = write_motion_figures(folder, simulation, all_channels(vehicle), page);
    io::write_page(folder + "/paper.html", page);  // whatever becomes of Figure 9
    facts["run"] = summary_json(simulation, summary, {});
    if (summary.interrupted) {
        fmt::print(stderr, "hamilcar: interrupted; Figures 11 to 14 end at t = {:.3f} s, Figure 9 is missing\n",
                   summary.duration);
        return io::ExitCode::interrupted;
    }
    if (summary.ended_early) throw io::Error(io::ExitCode::numerical, *summary.ended_early);
    if (facts["table_2"]["cut_equations"] == 0) {
        throw io::Error(io::ExitCode::bad_file, file + ": Figure 9 shows cut constraints, and this car has none");
    }
    facts["figure_9"] = write_figure_9(folder, vehicle, scenario, page);
    if (facts["figure_9"].is_null()) {
        fmt::print(stderr, "hamilcar: interrupted; Figure 9 is missing\n");
        return io::ExitCode::interrupted;
    }
    io::write_page(folder + "/paper.html", page);
    facts["folder"] = folder;
    write_file(folder + "/summary.json", io::json_text(facts) + "\n");
    if (options.json) {
        fmt::print("{}\n", io::json_text(facts));
    } else {
        print_paper(facts, folder);
    }
    return io::ExitCode::ok;
}

}  // namespace hamilcar::cli
