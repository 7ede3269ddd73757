#include "hamilcar/maneuver/outcome_file.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/io/whole_file.hpp"

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
std::vector<double> numbers_of(const Json& json) {
    std::vector<double> out;
    for (const Json& value : json) out.push_back(number_of(value));
    return out;
}

Json limits(const std::vector<std::pair<double, std::string>>& marks) {
    Json out = Json::array();
    for (const auto& [at, label] : marks) out.push_back({{"at", at}, {"label", label}});
    return out;
}
std::vector<std::pair<double, std::string>> limits_of(const Json& json) {
    std::vector<std::pair<double, std::string>> out;
    for (const Json& mark : json) out.emplace_back(mark.at("at").get<double>(), mark.at("label").get<std::string>());
    return out;
}

Json chart_json(const io::Chart& chart) {
    Json curves = Json::array(), marks = Json::array(), lines = Json::array();
    for (const io::Curve& curve : chart.curves) {
        curves.push_back(
            {{"label", curve.label}, {"x", numbers(curve.x)}, {"y", numbers(curve.y)}, {"points", curve.points}});
    }
    for (const io::Marks& mark : chart.marks) {
        marks.push_back({{"label", mark.label}, {"x", numbers(mark.x)}, {"y", numbers(mark.y)}});
    }
    for (const io::Line& line : chart.lines) lines.push_back({line.x0, line.y0, line.x1, line.y1});
    return {{"title", chart.title},
            {"x", chart.x_label},
            {"y", chart.y_label},
            {"log_x", chart.log_x},
            {"log_y", chart.log_y},
            {"equal_axes", chart.equal_axes},
            {"curves", curves},
            {"marks", marks},
            {"lines", lines},
            {"vertical_limits", limits(chart.vertical_marks)},
            {"horizontal_limits", limits(chart.horizontal_marks)}};
}

io::Chart chart_of(const Json& json) {
    io::Chart chart;
    chart.title = json.at("title"), chart.x_label = json.at("x"), chart.y_label = json.at("y");
    chart.log_x = json.at("log_x"), chart.log_y = json.at("log_y"), chart.equal_axes = json.at("equal_axes");
    for (const Json& curve : json.at("curves")) {
        chart.curves.push_back({.label = curve.at("label"),
                                .x = numbers_of(curve.at("x")),
                                .y = numbers_of(curve.at("y")),
                                .points = curve.at("points")});
    }
    for (const Json& mark : json.at("marks")) {
        chart.marks.push_back({mark.at("label"), numbers_of(mark.at("x")), numbers_of(mark.at("y"))});
    }
    for (const Json& line : json.at("lines")) chart.lines.push_back({line.at(0), line.at(1), line.at(2), line.at(3)});
    chart.vertical_marks = limits_of(json.at("vertical_limits"));
    chart.horizontal_marks = limits_of(json.at("horizontal_limits"));
    return chart;
}

Json settings_json(const ManeuverRun& run) {
    Json out = Json::array();
    for (const auto& [setting, value] : run.settings) {
        out.push_back({{"name", setting.name}, {"unit", setting.unit}, {"value", value}, {"meaning", setting.meaning}});
    }
    return out;
}

Json energy_json(const EnergyBook& book) {
    return {{"supplied_J", number(book.supplied)},
            {"stored_J", number(book.stored)},
            {"dissipated_J", number(book.dissipated)},
            {"gap_J", number(book.gap())},
            {"turnover_J", number(book.turnover)}};
}

}  // namespace

Json outcome_json(const ManeuverRun& run, const Outcome& outcome) {
    Json figures = Json::array(), verdicts = Json::array(), charts = Json::array();
    for (const Figure& f : outcome.figures) {
        figures.push_back({{"name", f.name}, {"unit", f.unit}, {"value", number(f.value)}, {"meaning", f.meaning}});
    }
    for (const Verdict& v : outcome.verdicts) {
        verdicts.push_back({{"criterion", v.criterion}, {"passed", v.passed}, {"found", v.found}});
    }
    for (const io::Chart& chart : outcome.charts) charts.push_back(chart_json(chart));
    return {{"program", run.program},
            {"maneuver", {{"name", run.maneuver}, {"title", run.title}, {"standard", run.standard}}},
            {"vehicle", {{"name", run.vehicle}, {"file", run.vehicle_file}}},
            {"settings", settings_json(run)},
            {"solver", {{"step_s", run.step}, {"integrator", run.integrator}}},
            {"passed", outcome.passed()},
            {"failed", outcome.failed ? Json(*outcome.failed) : Json(nullptr)},
            {"figures", figures},
            {"verdicts", verdicts},
            {"notes", outcome.notes},
            {"energy", energy_json(outcome.energy)},
            {"charts", charts}};
}

std::pair<ManeuverRun, Outcome> read_outcome(const std::string& path) {
    const Json json = io::parse_json<Json>(io::read_whole_file(path, io::LargestFile::outcome));
    try {
        ManeuverRun run;
        run.program = json.at("program");
        const Json &maneuver = json.at("maneuver"), &vehicle = json.at("vehicle"), &solver = json.at("solver");
        run.maneuver = maneuver.at("name"), run.title = maneuver.at("title"), run.standard = maneuver.at("standard");
        run.vehicle = vehicle.at("name"), run.vehicle_file = vehicle.at("file");
        run.step = solver.at("step_s"), run.integrator = solver.at("integrator");
        for (const Json& s : json.at("settings")) {
            run.settings.emplace_back(Setting{.name = s.at("name"), .unit = s.at("unit"), .meaning = s.at("meaning")},
                                      s.at("value").get<double>());
        }
        Outcome outcome;
        for (const Json& f : json.at("figures")) {
            outcome.figures.push_back({f.at("name"), f.at("unit"), f.at("meaning"), number_of(f.at("value"))});
        }
        for (const Json& v : json.at("verdicts")) {
            outcome.verdicts.push_back({v.at("criterion"), v.at("passed"), v.at("found")});
        }
        for (const Json& chart : json.at("charts")) outcome.charts.push_back(chart_of(chart));
        for (const Json& note : json.at("notes")) outcome.notes.push_back(note);
        if (json.at("failed").is_string()) outcome.failed = json.at("failed");
        return {run, outcome};
    } catch (const nlohmann::json::exception&) {
        throw io::Error(io::ExitCode::bad_file,
                        path + ": expected the outcome.json that 'hamilcar run --maneuver' writes");
    }
}

}  // namespace hamilcar
