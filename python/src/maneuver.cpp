// Standard maneuvers, with their figures and what was driven.
#include "hamilcar/maneuver/maneuver.hpp"

#include <nlohmann/json.hpp>

#include "documents.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/json_text.hpp"
#include "hamilcar/maneuver/outcome_file.hpp"
#include "python.hpp"

namespace hamilcar::python {

namespace {

struct Driven {
    ManeuverRun run;
    Outcome outcome;
};

TypedSettings typed(nb::dict settings) {
    TypedSettings out;
    for (const auto& [key, value] : settings) {
        const auto name = nb::cast<std::string>(key);
        if (nb::isinstance<nb::bool_>(value)) {
            out[name] = nb::cast<bool>(value) ? "yes" : "no";
        } else if (nb::isinstance<nb::str>(value)) {
            out[name] = nb::cast<std::string>(value);
        } else {
            out[name] = nb::cast<double>(nb::float_(value));
        }
    }
    return out;
}

// `scenario`: its solver and road are driven with; or null.
Driven drive(const std::string& name, const VehicleDocument& vehicle, nb::dict chosen, const ScenarioDocument* scenario,
             const std::vector<std::string>& channels, bool keep_runs) {
    const Maneuver& maneuver = require_maneuver(name);
    require_support(maneuver, vehicle.description);
    const TypedSettings given = typed(chosen);
    Interruption interruption;
    Driven out;
    // Copies: another thread may change the documents meanwhile.
    const VehicleDescription driven = vehicle.description;
    const std::string source = vehicle.source;
    ManeuverOptions options{.keep_runs = keep_runs, .channels = channels};
    if (scenario) {
        options.solver = scenario->description.solver, options.road = scenario->description.road;
        options.controllers_off = scenario->description.controllers_off;
        options.steering_mechanics = scenario->description.steering_mechanics;
    }
    {
        const nb::gil_scoped_release release;
        options.keep_going = [&](double) { return !interruption.asked(); };
        const Settings settings = complete_settings(maneuver, driven, settings_in_numbers(maneuver, driven, given));
        out.run = {.maneuver = maneuver.name,
                   .title = maneuver.title,
                   .standard = maneuver.standard,
                   .vehicle = driven.name,
                   .vehicle_file = source,
                   .settings = {},
                   .step = options.solver.step,
                   .integrator = options.solver.integrator,
                   .program = "Hamilcar " HAMILCAR_VERSION};
        for (const Setting& setting : maneuver.settings(driven)) {
            out.run.settings.emplace_back(setting, settings.at(setting.name));
        }
        out.outcome = maneuver.drive(driven, settings, options);
    }
    interruption.raise_if_interrupted();
    return out;
}

nb::list list_of(const VehicleDocument& vehicle) {
    nb::list out;
    for (const Maneuver& maneuver : maneuvers()) {
        nb::list settings;
        for (const Setting& one : maneuver.settings(vehicle.description)) {
            settings.append(nb::make_tuple(one.name, one.unit, one.meaning, setting_text(one, one.default_value),
                                           setting_range(one)));
        }
        out.append(nb::make_tuple(maneuver.name, maneuver.title, maneuver.standard, maneuver.summary,
                                  maneuver.unsupported_reason(vehicle.description), settings));
    }
    return out;
}

}  // namespace

void add_maneuvers(nb::module_& module) {
    nb::class_<Driven>(module, "Driven")
        .def_prop_ro("maneuver", [](const Driven& driven) { return driven.run.maneuver; })
        .def_prop_ro("title", [](const Driven& driven) { return driven.run.title; })
        .def_prop_ro("figures",
                     [](const Driven& driven) {
                         nb::list out;
                         for (const Figure& one : driven.outcome.figures) {
                             out.append(nb::make_tuple(one.name, one.value, one.unit, one.meaning));
                         }
                         return out;
                     })
        .def_prop_ro("verdicts",
                     [](const Driven& driven) {
                         nb::list out;
                         for (const Verdict& one : driven.outcome.verdicts) {
                             out.append(nb::make_tuple(one.criterion, one.passed, one.found));
                         }
                         return out;
                     })
        .def_prop_ro("passed", [](const Driven& driven) { return driven.outcome.passed(); })
        .def_prop_ro("failed", [](const Driven& driven) { return driven.outcome.failed; })
        .def_prop_ro("notes", [](const Driven& driven) { return driven.outcome.notes; })
        .def_prop_ro("runs", [](const Driven& driven) { return driven.outcome.runs; })
        .def("json", [](const Driven& driven) { return io::json_text(outcome_json(driven.run, driven.outcome)); })
        .def(
            "page", [](const Driven& driven) { return io::page_text(outcome_page(driven.run, driven.outcome)); },
            nb::call_guard<nb::gil_scoped_release>());
    module.def("drive", &drive, "name"_a, "vehicle"_a, "settings"_a, "scenario"_a.none(), "channels"_a, "keep_runs"_a);
    module.def("maneuvers", &list_of, "vehicle"_a);
}

}  // namespace hamilcar::python
