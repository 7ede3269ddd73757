// `hamilcar equilibrium VEHICLE` and `hamilcar modes VEHICLE`: where a vehicle stands or drives steadily, and how it moves
// about that.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/analysis/modes.hpp"
#include "hamilcar/base/text.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/csv.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/page.hpp"

namespace hamilcar::cli {

namespace {

using units::degree;

struct OperationOptions {
    VehicleChoice vehicle;
    std::string output;
    double speed = 0, lateral_acceleration = 0;  // [m/s], [m/s^2]
    bool json = false;
};

OperatingPoint find_point(const Linearizer& linearizer, const OperationOptions& options) {
    if (options.speed == 0 && options.lateral_acceleration != 0) {
        throw io::Error(io::ExitCode::usage, "--lateral-acceleration: expected a --speed above zero with it [m/s]");
    }
    const OperatingPoint at = linearizer.operating_point({options.speed, options.lateral_acceleration});
    if (at.found) return at;
    throw io::Error(io::ExitCode::numerical, fmt::format("{}: {}", options.vehicle.file, at.problem));
}

std::string describe(const OperationOptions& options) {
    if (options.speed == 0) return "at rest on a flat road";
    if (options.lateral_acceleration == 0) return fmt::format("straight ahead at {:g} m/s", options.speed);
    return fmt::format("on a circle of {:.1f} m at {:g} m/s, {:g} m/s^2 to the {}",
                       options.speed * options.speed / std::abs(options.lateral_acceleration), options.speed,
                       std::abs(options.lateral_acceleration), options.lateral_acceleration > 0 ? "left" : "right");
}

nlohmann::json json_of(const OperatingPoint& at, const LinearModel& model) {
    nlohmann::json outputs, states;
    for (std::size_t i = 0; i < model.outputs.size(); ++i) {
        outputs[model.outputs[i]] = {{"value", model.output[static_cast<Eigen::Index>(i)]},
                                     {"unit", model.output_units[i]}};
    }
    for (std::size_t i = 0; i < model.states.size(); ++i) states[model.states[i]] = at.z[static_cast<Eigen::Index>(i)];
    return {{"speed_m_per_s", at.operation.speed},
            {"lateral_acceleration_m_per_s2", at.operation.lateral_acceleration},
            {"rack_m", at.input.rack.displacement},
            {"drive_torque_N_m", at.input.drive_torque},
            {"residual", at.residual},
            {"state", states},
            {"outputs", outputs}};
}

void print_point(const OperatingPoint& at, const LinearModel& model, const OperationOptions& options,
                 const VehicleDescription& vehicle) {
    fmt::print("{} {}\n", vehicle.name, describe(options));
    fmt::print("  residual            {:.1e} N or N m unbalanced\n", at.residual);
    fmt::print("  roll, pitch         {}, {} deg\n", fixed_text(at.z[1] / degree, 3), fixed_text(at.z[2] / degree, 3));
    if (options.speed != 0) {
        fmt::print("  rack                {:.3f} mm\n  drive torque        {:.1f} N m\n",
                   1e3 * at.input.rack.displacement, at.input.drive_torque);
        fmt::print("  sideslip            {:.3f} deg\n  yaw rate            {:.3f} deg/s\n",
                   std::atan2(model.output[output_lateral_velocity], model.output[output_speed]) / degree,
                   model.output[output_yaw_rate] / degree);
    }
    const Eigen::Index wheels = (model.output.size() - first_wheel_output) / 2;
    for (Eigen::Index i = 0; i < wheels; ++i) {
        const std::string& output = model.outputs[static_cast<std::size_t>(first_wheel_output + i)];
        fmt::print("  {:<20}{:>8.0f} N on the road, travel {:+.2f} mm\n", output.substr(0, output.find('.')),
                   model.output[first_wheel_output + wheels + i], 1e3 * model.output[first_wheel_output + i]);
    }
}

std::string csv(const Eigen::MatrixXd& matrix, const std::vector<std::string>& rows,
                const std::vector<std::string>& columns) {
    std::vector<std::string> headings{""};
    headings.insert(headings.end(), columns.begin(), columns.end());
    io::CsvText table(headings);
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        table.cell(rows[static_cast<std::size_t>(i)]);
        for (Eigen::Index j = 0; j < matrix.cols(); ++j) table.cell(matrix(i, j), 17);
        table.end_row();
    }
    return table.text();
}

std::vector<double> frequencies(double from, double to, int count) {
    std::vector<double> out;
    for (int i = 0; i < count; ++i) out.push_back(from * std::pow(to / from, double(i) / (count - 1)));
    return out;
}

// Road to seat: the seat's acceleration over the road's, the road moving up and down as a whole. Seen from the road the
// vehicle feels its acceleration as gravity, and the seat's own adds to it.
std::vector<double> road_to_seat(const LinearModel& model, const std::vector<double>& f) {
    std::vector<double> w, out;
    for (const double one : f) w.push_back(2 * std::numbers::pi * one);
    const auto response = frequency_response(model, output_seat_velocity, gravity, -1, w);
    for (std::size_t i = 0; i < w.size(); ++i) {
        out.push_back(std::abs(1.0 + std::complex<double>(0, w[i]) * response[i]));
    }
    return out;
}

std::vector<double> steer_to_yaw(const LinearModel& model, const std::vector<double>& f) {
    std::vector<double> w, out;
    for (const double one : f) w.push_back(2 * std::numbers::pi * one);
    for (const auto& one : frequency_response(model, output_yaw_rate, rack, rack_rate, w)) {
        out.push_back(1e-3 * std::abs(one) / degree);  // per millimeter of rack
    }
    return out;
}

std::string shape_of(const Mode& mode) {
    std::string text;
    for (const auto& [name, share] : mode.shape) {
        if (share > 0.05) text += fmt::format("{}{} {:.2f}", text.empty() ? "" : ", ", name, share);
    }
    return text;
}

io::Table modes_table(const std::vector<Mode>& all) {
    io::Table table{"Modes",
                    {{"mode", ""},
                     {"frequency", "Hz"},
                     {"damping ratio", ""},
                     {"eigenvalue, real", "1/s"},
                     {"eigenvalue, imaginary", "1/s"},
                     {"what moves", ""}},
                    {}};
    for (const Mode& mode : all) {
        if (mode.shape.empty()) continue;
        table.rows.push_back({mode.name, mode.frequency > 0 ? io::Cell(mode.frequency) : io::Cell(),
                              mode.frequency > 0 ? io::Cell(mode.damping_ratio) : io::Cell(), mode.eigenvalue.real(),
                              mode.eigenvalue.imag(), shape_of(mode)});
    }
    return table;
}

void write_files(const OperationOptions& options, const LinearModel& model, const std::vector<Mode>& all,
                 const VehicleDescription& vehicle) {
    make_folder(options.output);
    const auto path = [&](const char* name) { return options.output + "/" + name; };
    write_file(path("A.csv"), csv(model.A, model.states, model.states));
    write_file(path("B.csv"), csv(model.B, model.states, model.inputs));
    write_file(path("C.csv"), csv(model.C, model.outputs, model.states));
    write_file(path("D.csv"), csv(model.D, model.outputs, model.inputs));
    io::CsvText table({"real [1/s]", "imaginary [1/s]", "frequency [Hz]", "damping ratio [1]", "name"});
    for (const Mode& mode : all) {
        table.cell(mode.eigenvalue.real(), 9).cell(mode.eigenvalue.imag(), 9);
        table.cell(mode.frequency, 9).cell(mode.damping_ratio, 9).cell(mode.name).end_row();
    }
    write_file(path("modes.csv"), table.text());
    const std::vector<double> f = frequencies(0.1, 30, 300);
    const std::vector<double> seat = road_to_seat(model, f), yaw = steer_to_yaw(model, f);
    io::CsvText responses({"frequency [Hz]", "seat over road [1]", "yaw rate over rack [deg/s/mm]"});
    for (std::size_t i = 0; i < f.size(); ++i) responses.cell(f[i], 9).cell(seat[i], 9).cell(yaw[i], 9).end_row();
    write_file(path("responses.csv"), responses.text());
    std::vector<io::Chart> charts{{.title = "Road to seat",
                                   .x_label = "frequency [Hz]",
                                   .y_label = "[1]",
                                   .curves = {{"", f, seat}},
                                   .vertical_marks = {},
                                   .log_x = true}};
    if (options.speed > 0) {
        charts.push_back({.title = "Rack to yaw rate",
                          .x_label = "frequency [Hz]",
                          .y_label = "[deg/s per mm]",
                          .curves = {{"", f, yaw}},
                          .vertical_marks = {},
                          .log_x = true});
    }
    io::Page page{.title = vehicle.name, .subtitle = describe(options), .blocks = {}, .runs = {}};
    for (io::Chart& chart : charts) page.blocks.push_back(std::move(chart));
    page.blocks.push_back(modes_table(all));
    io::write_page(path("modes.html"), page);
}

// Of those that move nothing else, the brakes' wind-up and what rolls freely, only the number.
void print_modes(const std::vector<Mode>& all) {
    int windup = 0, neutral = 0;
    for (const Mode& mode : all) {
        windup += mode.name == "brake wind-up" ? 1 : 0, neutral += mode.name == "neutral" ? 1 : 0;
        if (mode.shape.empty()) continue;
        const double rate = mode.eigenvalue.real();
        const std::string pace =
            mode.frequency > 0 ? fmt::format("{:.2f} Hz", mode.frequency) : fmt::format("{:.3g} s", -1 / rate);
        const std::string damping = mode.frequency > 0 ? fmt::format("{:.3f}", mode.damping_ratio) : "";
        fmt::print("  {:>9}  {:>7}  {:<28}{}\n", pace, damping, mode.name, shape_of(mode));
    }
    fmt::print("  and {} neutral, {} of released brakes\n", neutral, windup);
}

io::ExitCode equilibrium(const OperationOptions& options) {
    const VehicleDescription vehicle = read_vehicle(options.vehicle);
    const Linearizer linearizer(vehicle);
    const OperatingPoint at = find_point(linearizer, options);
    const LinearModel model = linearizer.linearize(at);
    if (options.json) {
        fmt::print("{}\n", io::json_text(json_of(at, model)));
    } else {
        print_point(at, model, options, vehicle);
    }
    return io::ExitCode::ok;
}

io::ExitCode modes(const OperationOptions& options) {
    const VehicleDescription vehicle = read_vehicle(options.vehicle);
    const Linearizer linearizer(vehicle);
    const LinearModel model = linearizer.linearize(find_point(linearizer, options));
    const std::vector<Mode> all = hamilcar::modes(model, vehicle);
    if (options.json) {
        nlohmann::json list = nlohmann::json::array();
        for (const Mode& mode : all) {
            list.push_back({{"real_per_s", mode.eigenvalue.real()},
                            {"imaginary_per_s", mode.eigenvalue.imag()},
                            {"frequency_Hz", mode.frequency},
                            {"damping_ratio", mode.damping_ratio},
                            {"name", mode.name},
                            {"shape", mode.shape}});
        }
        fmt::print("{}\n", io::json_text(list));
    } else {
        fmt::print("{} {}\n  {:>9}  {:>7}  {:<28}{}\n", vehicle.name, describe(options), "pace", "damping", "mode",
                   "what moves");
        print_modes(all);
    }
    if (!options.output.empty()) {
        write_files(options, model, all, vehicle);
        tell_written(options.json, "modes.html, A, B, C, D, modes and responses to " + options.output);
    }
    return io::ExitCode::ok;
}

void add_operation(Command& command, OperationOptions& o) {
    command.add("vehicle", o.vehicle.file, "vehicle file (TOML)").required();
    add_vehicle_set(command, o.vehicle);
    command.add("--speed", o.speed, {0, 100, "m/s"}, "forward speed, at rest if 0");
    command.add("--lateral-acceleration", o.lateral_acceleration, {-30, 30, "m/s^2"}, "to the left");
    command.add_json(o.json);
}

}  // namespace

void add_equilibrium(CommandList& list) {
    auto [command, o] = list.add<OperationOptions>(
        "equilibrium", "find where a vehicle stands, drives straight or goes round", equilibrium);
    add_operation(command, o);
}

void add_modes(CommandList& list) {
    auto [command, o] = list.add<OperationOptions>(
        "modes", "linearize a vehicle exactly; frequencies, damping, shapes, responses", modes);
    add_operation(command, o);
    command.add("-o,--output", o.output, "folder for tables and a page");
}

}  // namespace hamilcar::cli
