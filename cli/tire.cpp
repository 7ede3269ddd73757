// `hamilcar tire FILE`: a tire's curves as tables and pictures, its key figures, and what its file leaves open.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "hamilcar/analysis/tire_curves.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/io/csv.hpp"
#include "hamilcar/io/file_kind.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/page.hpp"
#include "hamilcar/io/tir_file.hpp"

namespace hamilcar::cli {

namespace {

using units::degree;

struct TireOptions {
    std::string file, output;
    bool json = false;
};

std::string csv(const std::vector<TireCurve>& curves, const char* first, double scale, const char* unit) {
    io::CsvText table(
        {"load [N]", fmt::format("{} [{}]", first, unit), "Fx [N]", "Fy [N]", "Mx [N m]", "My [N m]", "Mz [N m]"});
    for (const TireCurve& curve : curves) {
        for (std::size_t i = 0; i < curve.slip.size(); ++i) {
            const TireForce<double>& f = curve.force[i];
            table.cell(curve.load, 6).cell(scale * curve.slip[i], 6);
            for (const double figure : {f.Fx, f.Fy, f.Mx, f.rolling_moment, f.Mz}) table.cell(figure, 7);
            table.end_row();
        }
    }
    return table.text();
}

std::vector<io::Chart> charts(const TireCurves& curves) {
    const auto chart = [](const char* title, const char* x, const char* y, const std::vector<TireCurve>& family,
                          double scale, double TireForce<double>::*what, const auto& label) {
        io::Chart out{.title = title, .x_label = x, .y_label = y, .curves = {}, .vertical_marks = {}};
        for (std::size_t k = 0; k < family.size(); ++k) {
            io::Curve curve{.label = label(k), .x = {}, .y = {}};
            for (std::size_t i = 0; i < family[k].slip.size(); ++i) {
                curve.x.push_back(scale * family[k].slip[i]), curve.y.push_back(family[k].force[i].*what);
            }
            out.curves.push_back(curve);
        }
        return out;
    };
    using F = TireForce<double>;
    const auto load = [&](std::size_t k) { return fmt::format("{:.0f} N", curves.lateral[k].load); };
    const auto angle = [&](std::size_t k) { return fmt::format("{:.0f} deg", curves.combined_alpha[k] / degree); };
    return {chart("Longitudinal force", "slip [1]", "[N]", curves.longitudinal, 1, &F::Fx, load),
            chart("Side force", "slip angle [deg]", "[N]", curves.lateral, 1 / degree, &F::Fy, load),
            chart("Aligning moment", "slip angle [deg]", "[N m]", curves.lateral, 1 / degree, &F::Mz, load),
            chart("Longitudinal force at slip angles", "slip [1]", "[N]", curves.combined, 1, &F::Fx, angle),
            chart("Side force at slip angles", "slip [1]", "[N]", curves.combined, 1, &F::Fy, angle),
            chart("Aligning moment at slip angles", "slip [1]", "[N m]", curves.combined, 1, &F::Mz, angle)};
}

io::Table figures_table(const std::vector<TireFigures>& figures) {
    io::Table table{"Key figures",
                    {{"load", "N"},
                     {"cornering stiffness", "N/deg"},
                     {"slip stiffness", "N"},
                     {"camber stiffness", "N/deg"},
                     {"lateral peak friction", "1"},
                     {"at slip angle", "deg"},
                     {"longitudinal peak friction", "1"},
                     {"at slip", "1"},
                     {"locked friction", "1"},
                     {"pneumatic trail", "m"}},
                    {}};
    for (const TireFigures& f : figures) {
        table.rows.push_back({f.load, f.cornering_stiffness * degree, f.slip_stiffness, f.camber_stiffness * degree,
                              f.peak_y, f.peak_alpha / degree, f.peak_x, f.peak_kappa, f.sliding_x,
                              std::isnan(f.trail) ? io::Cell() : io::Cell(f.trail)});
    }
    return table;
}

nlohmann::json json_of(const io::TirFile& file, const std::vector<TireFigures>& figures) {
    const MagicFormulaDescription& tire = file.tire;
    nlohmann::json out{{"format", file.format},
                       {"nominal_load_N", tire.nominal_load},
                       {"unloaded_radius_m", tire.casing.radius},
                       {"rolling_radius_m", tire.casing.rolling_radius},
                       {"vertical_stiffness_N_per_m", tire.casing.vertical_stiffness},
                       {"loads", nlohmann::json::array()},
                       {"notes", file.tire.remarks}};
    for (const TireFigures& f : figures) {
        out["loads"].push_back({{"load_N", f.load},
                                {"cornering_stiffness_N_per_deg", f.cornering_stiffness * degree},
                                {"slip_stiffness_N", f.slip_stiffness},
                                {"camber_stiffness_N_per_deg", f.camber_stiffness * degree},
                                {"peak_friction_lateral", f.peak_y},
                                {"at_slip_angle_deg", f.peak_alpha / degree},
                                {"peak_friction_longitudinal", f.peak_x},
                                {"at_slip", f.peak_kappa},
                                {"locked_friction", f.sliding_x},
                                {"pneumatic_trail_m", f.trail}});
    }
    return out;
}

void print_report(const std::string& path, const io::TirFile& file, const std::vector<TireFigures>& figures) {
    const MagicFormulaDescription& t = file.tire;
    fmt::print("{}: {}\n", path, file.format);
    fmt::print(
        "  unloaded radius {:.4f} m, rolling radius {:.4f} m, vertical stiffness {:.1f} N/mm, nominal load {:.0f} N\n",
        t.casing.radius, t.casing.rolling_radius, 1e-3 * t.casing.vertical_stiffness, t.nominal_load);
    fmt::print(
        "  made for loads {:.0f} to {:.0f} N, slip {:g} to {:g}, slip angles {:.1f} to {:.1f} deg, camber {:.1f} to "
        "{:.1f} deg\n",
        t.load[0], t.load[1], t.slip[0], t.slip[1], t.angle[0] / degree, t.angle[1] / degree, t.camber[0] / degree,
        t.camber[1] / degree);
    if (figures.back().load > t.load[1]) {
        fmt::print("  above {:.0f} N the forces stay, so friction below falls with the load\n", t.load[1]);
    }
    fmt::print("\n  {:>8}{:>14}{:>12}{:>12}{:>20}{:>18}{:>9}{:>9}\n", "load", "cornering", "slip", "camber",
               "lateral peak", "drive peak", "locked", "trail");
    fmt::print("  {:>8}{:>14}{:>12}{:>12}{:>20}{:>18}{:>9}{:>9}\n", "[N]", "[N/deg]", "[kN]", "[N/deg]", "[1] at [deg]",
               "[1] at [1]", "[1]", "[mm]");
    for (const TireFigures& f : figures) {
        const std::string trail = std::isnan(f.trail) ? "none" : fmt::format("{:.1f}", 1e3 * f.trail);
        fmt::print("  {:>8.0f}{:>14.1f}{:>12.2f}{:>12.1f}{:>11.3f} at {:>5.1f}{:>10.3f} at {:>4.3f}{:>9.3f}{:>9}\n",
                   f.load, f.cornering_stiffness * degree, 1e-3 * f.slip_stiffness, f.camber_stiffness * degree,
                   f.peak_y, f.peak_alpha / degree, f.peak_x, f.peak_kappa, f.sliding_x, trail);
    }
    if (!file.tire.remarks.empty()) fmt::print("\n");
    for (const std::string& note : file.tire.remarks) fmt::print("note: {}\n", note);
}

io::ExitCode tire(const TireOptions& options) {
    io::TirFile file;
    io::expect_kind(options.file, io::FileKind::tire, [&] { file = io::read_tir(options.file); });
    const Tire<double> tire = make_tire<double>(TireDescription(file.tire));
    std::vector<TireFigures> figures;
    std::vector<double> loads;
    for (const double share : {0.25, 0.5, 1.0, 1.5, 2.0}) loads.push_back(share * file.tire.nominal_load);
    for (const double load : loads) figures.push_back(tire_figures(tire, load));
    if (options.json) {
        fmt::print("{}\n", io::json_text(json_of(file, figures)));
    } else {
        print_report(options.file, file, figures);
    }
    if (options.output.empty()) return io::ExitCode::ok;
    const TireCurves curves = tire_curves(tire, loads);
    make_folder(options.output);
    write_file(options.output + "/longitudinal.csv", csv(curves.longitudinal, "slip", 1, "1"));
    for (std::size_t i = 0; i < curves.combined.size(); ++i) {
        write_file(fmt::format("{}/combined_{:.0f}_deg.csv", options.output, curves.combined_alpha[i] / degree),
                   csv({curves.combined[i]}, "slip", 1, "1"));
    }
    write_file(options.output + "/lateral.csv", csv(curves.lateral, "slip angle", 1 / degree, "deg"));
    io::Page page{.title = std::filesystem::path(options.file).filename().string(),
                  .subtitle = file.format,
                  .blocks = {},
                  .runs = {}};
    for (io::Chart& chart : charts(curves)) page.blocks.push_back(std::move(chart));
    page.blocks.push_back(figures_table(figures));
    for (const std::string& note : file.tire.remarks) page.blocks.push_back(io::Paragraph{note});
    io::write_page(options.output + "/tire.html", page);
    tell_written(options.json, "tire.html and tables of the curves to " + options.output);
    return io::ExitCode::ok;
}

}  // namespace

void add_tire(CommandList& list) {
    auto [command, o] =
        list.add<TireOptions>("tire", "print a tire file's curves, key figures and what it leaves open", tire);
    command.add("file", o.file, "tire property file (.tir)").required();
    command.add("-o,--output", o.output, "folder for tables and a page");
    command.add_json(o.json);
}

}  // namespace hamilcar::cli
