// Charts and verdicts as JSON, in the form of schemas/page.schema.json: in the document of a page, where numbers are references
// into one block of bytes, and in an outcome.json, where they stand as they are.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>

#include "hamilcar/io/page.hpp"

namespace hamilcar::io {

// `column` makes JSON of a list of numbers.
template <class Json, class Column>
Json chart_json(const Chart& chart, Column&& column) {
    Json curves = Json::array(), marks = Json::array();
    for (const Curve& curve : chart.curves) {
        curves.push_back(
            {{"label", curve.label}, {"x", column(curve.x)}, {"y", column(curve.y)}, {"points", curve.points}});
    }
    for (const auto& [x, label] : chart.vertical_marks) marks.push_back({{"x", x}, {"label", label}});
    Json out{{"kind", "chart"},
             {"title", chart.title},
             {"x", {{"label", chart.x_label}, {"logarithmic", chart.log_x}}},
             {"y", {{"label", chart.y_label}, {"logarithmic", chart.log_y}}},
             {"curves", curves},
             {"marks", marks}};
    // Only what is there: most charts stand in no landscape.
    if (chart.equal_axes) out["equal_axes"] = true;
    for (const auto& [y, label] : chart.horizontal_marks)
        out["horizontal_marks"].push_back({{"y", y}, {"label", label}});
    for (const Marks& cones : chart.marks) {
        out["cones"].push_back({{"label", cones.label}, {"x", column(cones.x)}, {"y", column(cones.y)}});
    }
    for (const Line& line : chart.lines) out["lines"].push_back({line.x0, line.y0, line.x1, line.y1});
    return out;
}

// Of a chart whose numbers stand as they are; null is a gap. Throws nlohmann::json::exception for what is no chart.
template <class Json>
Chart chart_of(const Json& json) {
    const auto numbers = [](const Json& list) {
        std::vector<double> out;
        for (const Json& one : list) {
            out.push_back(one.is_null() ? std::numeric_limits<double>::quiet_NaN() : one.template get<double>());
        }
        return out;
    };
    const auto list = [&](const char* key) { return json.value(key, Json::array()); };
    Chart out{.title = json.at("title"), .x_label = json.at("x").at("label"), .y_label = json.at("y").at("label")};
    out.log_x = json.at("x").at("logarithmic"), out.log_y = json.at("y").at("logarithmic");
    out.equal_axes = json.value("equal_axes", false);
    for (const Json& curve : json.at("curves")) {
        out.curves.push_back({.label = curve.at("label"),
                              .x = numbers(curve.at("x")),
                              .y = numbers(curve.at("y")),
                              .points = curve.at("points")});
    }
    for (const Json& mark : json.at("marks")) out.vertical_marks.emplace_back(mark.at("x"), mark.at("label"));
    for (const Json& mark : list("horizontal_marks")) out.horizontal_marks.emplace_back(mark.at("y"), mark.at("label"));
    for (const Json& cones : list("cones")) {
        out.marks.push_back({cones.at("label"), numbers(cones.at("x")), numbers(cones.at("y"))});
    }
    for (const Json& line : list("lines")) out.lines.push_back({line.at(0), line.at(1), line.at(2), line.at(3)});
    return out;
}

template <class Json>
Json verdicts_json(const std::vector<Verdict>& verdicts) {
    Json out = Json::array();
    for (const auto& [criterion, passed, found] : verdicts) {
        out.push_back({{"criterion", criterion}, {"passed", passed}, {"found", found}});
    }
    return out;
}

}  // namespace hamilcar::io
