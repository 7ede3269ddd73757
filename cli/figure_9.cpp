#include "figure_9.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "files.hpp"
#include "hamilcar/io/csv.hpp"
#include "interrupt.hpp"

namespace hamilcar::cli {

namespace {

// Gains of Fig. 9 [1/s] for third-order Adams-Bashforth at 1 ms, around the paper's 400 and on both sides of the limit;
// another method or step has them in the same ratio to its own limit.
const std::vector<double> sweep_gains{10, 25, 50, 100, 150, 200, 250, 300, 350, 400, 450, 500, 540, 550, 600, 800};
const std::vector<double> shown_gains{50, 200, 400, 500};
constexpr double paper_limit_gain = 6.0 / 11 / 1e-3;  // [1/s]

struct Steering {
    Interpolation interpolation;
    const char *name, *told;
};
constexpr Steering steerings[] = {
    {Interpolation::smoother, "smoother", "steering with a continuous acceleration"},
    {Interpolation::smooth, "smooth", "steering whose acceleration jumps"},
};

// The sweeps as rows of a table and as curves of the pictures.
struct Figure9Charts {
    io::CsvText table{
        {"steering", "alpha [1/s]", "alpha h", "rms norm of Phi", "largest norm of Phi", "reached [s]", "stable"}};
    std::vector<io::Chart> over_time;
    std::vector<io::Curve> over_gain;

    void begin(const Steering& steering) {
        over_time.push_back({fmt::format("Fig. 9  Norm of the constraint violations, {}", steering.told),
                             "time [s]",
                             "|Phi|",
                             {},
                             true,
                             {}});
        over_gain.push_back({fmt::format("{}: root mean square", steering.name), {}, {}, true});
        over_gain.push_back({fmt::format("{}: largest", steering.name), {}, {}, true});
    }
    void add(const SweepRun& run, double step, const Steering& steering) {
        table.cell(steering.name).cell(run.gain).cell(run.gain * step, 6).cell(run.rms_norm).cell(run.max_norm);
        table.cell(run.ended, 6).cell(run.blew_up ? "no" : "yes").end_row();
        if (run.blew_up) return;
        io::Curve &rms = over_gain.end()[-2], &largest = over_gain.end()[-1];
        rms.x.push_back(run.gain), rms.y.push_back(run.rms_norm);
        largest.x.push_back(run.gain), largest.y.push_back(run.max_norm);
    }
    void show(const SweepRun& run, const Steering& steering, const std::string& folder) {
        io::Curve curve{fmt::format("alpha = {:g}", run.gain), run.time, run.norm};
        for (double& y : curve.y) y = std::max(y, 1e-17);  // zero has no logarithm
        over_time.back().curves.push_back(curve);
        write_columns(fmt::format("{}/fig09_{}_alpha_{:g}.csv", folder, steering.name, run.gain), {"time [s]", "|Phi|"},
                      {&run.time, &run.norm});
    }
};

nlohmann::json json_of(const GainSweep& sweep) {
    nlohmann::json out{{"steering", sweep.steering},
                       {"first_unstable_gain_per_s", nullptr},
                       {"min_rms_at_gain_per_s", nullptr},
                       {"min_rms_norm", nullptr}};
    if (sweep.first_unstable_gain) out["first_unstable_gain_per_s"] = *sweep.first_unstable_gain;
    if (sweep.best) out["min_rms_at_gain_per_s"] = sweep.best->gain, out["min_rms_norm"] = sweep.best->rms_norm;
    if (sweep.at_paper_gain) {
        out["paper_gain_per_s"] = sweep.at_paper_gain->gain;
        out["rms_norm_at_paper_gain"] = sweep.at_paper_gain->rms_norm;
        out["max_norm_at_paper_gain"] = sweep.at_paper_gain->max_norm;
    }
    return out;
}

}  // namespace

void write_columns(const std::string& path, const std::vector<std::string>& headings,
                   const std::vector<const std::vector<double>*>& columns) {
    io::CsvText table(headings);
    std::size_t rows = 0;
    for (const auto* column : columns) rows = std::max(rows, column->size());
    for (std::size_t i = 0; i < rows; ++i) {
        for (const auto* column : columns) {
            if (i < column->size()) {
                table.cell((*column)[i]);
            } else {
                table.cell("");
            }
        }
        table.end_row();
    }
    write_file(path, table.text());
}

std::optional<Figure9> write_figure_9(const std::string& folder, const VehicleDescription& vehicle,
                                      const ScenarioDescription& scenario, io::Page& page) {
    const double step = scenario.solver.step, limit = find_method(scenario.solver.integrator)->real_axis_limit / step;
    const double scale = limit / paper_limit_gain;
    std::vector<double> gains;
    for (const double gain : sweep_gains) gains.push_back(gain * scale);
    Figure9Charts charts;
    Figure9 figure{.stability_limit = limit, .sweeps = {}};
    for (const Steering& steering : steerings) {
        ScenarioDescription steered = scenario;
        steered.steering.interpolation = steering.interpolation;
        const auto runs = stabilization_sweep(vehicle, steered, gains, figure_interval, [] { return !interrupted(); });
        if (runs.size() < gains.size()) return std::nullopt;
        GainSweep sweep{.steering = steering.name, .first_unstable_gain = {}, .best = {}, .at_paper_gain = {}};
        charts.begin(steering);
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const SweepRun& run = runs[i];
            charts.add(run, step, steering);
            if (std::ranges::find(shown_gains, sweep_gains[i]) != shown_gains.end()) charts.show(run, steering, folder);
            if (sweep_gains[i] == paper_gain) sweep.at_paper_gain = run;
            if (run.blew_up && !sweep.first_unstable_gain) sweep.first_unstable_gain = run.gain;
            if (!run.blew_up && (!sweep.best || run.rms_norm < sweep.best->rms_norm)) sweep.best = run;
        }
        figure.sweeps.push_back(std::move(sweep));
    }
    write_file(folder + "/fig09_sweep.csv", charts.table.text());
    for (const io::Chart& chart : charts.over_time) page.blocks.push_back(chart);
    page.blocks.push_back(io::Chart{"Fig. 9 swept: constraint violation against the gain",
                                    "alpha [1/s]",
                                    "norm of Phi",
                                    charts.over_gain,
                                    true,
                                    {{limit, fmt::format("stability limit {:.0f}", limit)}}});
    return figure;
}

nlohmann::json json_of(const Figure9& figure) {
    nlohmann::json sweeps = nlohmann::json::array();
    for (const GainSweep& sweep : figure.sweeps) sweeps.push_back(json_of(sweep));
    return {{"paper_claim", {{"comparatively_small_at_gain_per_s", paper_gain}, {"norm", paper_norm}}},
            {"stability_limit_per_s", figure.stability_limit},
            {"sweeps", sweeps}};
}

}  // namespace hamilcar::cli
