#include "hamilcar/maneuver/outcome_file.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "hamilcar/io/chart_json.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/whole_file.hpp"
#include "hamilcar/run/validity_report.hpp"

namespace hamilcar {

namespace {

using Json = nlohmann::ordered_json;

// JSON has no NaN.
Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}
double number_of(const Json& json) {
    return json.is_number() ? json.get<double>() : std::nan("");
}

Json numbers(const std::vector<double>& values) {
    Json out = Json::array();
    for (const double value : values) out.push_back(number(value));
    return out;
}

Json settings_json(const ManeuverRun& run) {
    Json out = Json::array();
    for (const auto& [setting, value] : run.settings) {
        out.push_back({{"name", setting.name}, {"unit", setting.unit}, {"value", value}, {"meaning", setting.meaning}});
        if (!setting.choices.empty()) out.back()["word"] = setting_text(setting, value);
    }
    return out;
}

Json energy_json(const EnergyBalance& energy) {
    return {{"supplied_J", number(energy.supplied)},
            {"stored_J", number(energy.stored)},
            {"dissipated_J", number(energy.dissipated)},
            {"residual_J", number(energy.residual())},
            {"exchanged_J", number(energy.exchanged)}};
}

}  // namespace

Json outcome_json(const ManeuverRun& run, const Outcome& outcome) {
    Json figures = Json::array(), charts = Json::array();
    for (const Figure& f : outcome.figures) {
        figures.push_back({{"name", f.name}, {"unit", f.unit}, {"value", number(f.value)}, {"meaning", f.meaning}});
        if (const auto other = per_g(f)) figures.back()["per_g"] = number(other->value);
    }
    for (const io::Chart& chart : outcome.charts) charts.push_back(io::chart_json<Json>(chart, numbers));
    return {{"program", run.program},
            {"maneuver", {{"name", run.maneuver}, {"title", run.title}, {"standard", run.standard}}},
            {"vehicle", {{"name", run.vehicle}, {"file", run.vehicle_file}, {"set", run.vehicle_set}}},
            {"settings", settings_json(run)},
            {"solver", {{"step_s", run.step}, {"integrator", run.integrator}}},
            {"passed", outcome.passed() && !run.interrupted},
            {"failed", outcome.failed ? Json(*outcome.failed) : Json(nullptr)},
            {"figures", figures},
            {"verdicts", io::verdicts_json<Json>(outcome.verdicts)},
            {"notes", outcome.notes},
            {"validity", validity_json(outcome.validity)},
            {"energy", energy_json(outcome.energy)},
            {"charts", charts},
            {"interrupted", run.interrupted},
            {"files", run.files}};
}

std::pair<ManeuverRun, Outcome> read_outcome(const std::string& path) {
    const Json json = io::parse_json<Json>(io::read_whole_file(path, io::FileLimit::outcome));
    try {
        ManeuverRun run;
        run.program = json.at("program");
        const Json &maneuver = json.at("maneuver"), &vehicle = json.at("vehicle"), &solver = json.at("solver");
        run.maneuver = maneuver.at("name"), run.title = maneuver.at("title"), run.standard = maneuver.at("standard");
        run.vehicle = vehicle.at("name"), run.vehicle_file = vehicle.at("file");
        run.vehicle_set = vehicle.value("set", run.vehicle_set);
        run.interrupted = json.value("interrupted", false);
        run.files = json.value("files", run.files);
        run.step = solver.at("step_s"), run.integrator = solver.at("integrator");
        for (const Json& s : json.at("settings")) {
            run.settings.emplace_back(Setting{.name = s.at("name"), .unit = s.at("unit"), .meaning = s.at("meaning")},
                                      s.at("value").get<double>());
            if (s.contains("word")) run.settings.back().first.choices = {{s.at("word"), s.at("value")}};
        }
        Outcome outcome;
        for (const Json& f : json.at("figures")) {
            outcome.figures.push_back({f.at("name"), f.at("unit"), f.at("meaning"), number_of(f.at("value"))});
        }
        for (const Json& v : json.at("verdicts")) {
            outcome.verdicts.push_back({v.at("criterion"), v.at("passed"), v.at("found")});
        }
        for (const Json& chart : json.at("charts")) outcome.charts.push_back(io::chart_of(chart));
        for (const Json& note : json.at("notes")) outcome.notes.push_back(note);
        if (json.contains("validity"))
            outcome.validity = validity_of(json.at("validity"));  // earlier versions had none
        if (json.at("failed").is_string()) outcome.failed = json.at("failed");
        return {run, outcome};
    } catch (const nlohmann::json::exception&) {
        throw io::Error(io::ExitCode::bad_file,
                        path + ": expected the outcome.json that 'hamilcar run --maneuver' writes");
    }
}

}  // namespace hamilcar
