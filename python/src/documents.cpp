#include "documents.hpp"

#include <fmt/format.h>

#include "controls.hpp"
#include "hamilcar/analysis/dimensions.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/io/file_kind.hpp"
#include "hamilcar/io/key_list.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/set_key.hpp"
#include "hamilcar/io/spelling.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/run/channels.hpp"
#include "hamilcar/run/scene.hpp"
#include "values.hpp"

namespace hamilcar::python {

namespace {

void read(io::Node& tables, VehicleDescription& to) {
    to = io::read_vehicle(tables);
}
void read(io::Node& tables, ScenarioDescription& to) {
    to = io::read_scenario(tables);
}
constexpr io::FileKind kind_of(const VehicleDescription&) {
    return io::FileKind::vehicle;
}
constexpr io::FileKind kind_of(const ScenarioDescription&) {
    return io::FileKind::scenario;
}
const char* place_of(const VehicleDescription&) {
    return "Vehicle";
}
const char* place_of(const ScenarioDescription&) {
    return "Scenario";
}
void describe(const io::TableReader& file, const VehicleDescription&) {
    io::read_vehicle(file);
}
void describe(const io::TableReader& file, const ScenarioDescription&) {
    io::read_scenario(file);
}

// Reading notes in the tables which keys are known, and a scenario's masters leave keys out: in a copy.
template <class Description>
void adopt(io::Node tables, Document<Description>& to) {
    io::Node read_tables = tables;
    Description description;
    read(read_tables, description);
    to.tables = std::move(tables), to.description = std::move(description);
}

template <class Description>
void change(Document<Description>& document, io::Node tables, nb::dict changes) {
    const Source source = typed_in(place_of(Description{}), --document.generation);
    for (const auto& [key, value] : changes) {
        if (!nb::isinstance<nb::str>(key)) throw nb::type_error("keys must be texts, as 'chassis.mass_kg'");
        io::set_key(tables, nb::cast<std::string>(key), node_of(value, source), "");
    }
    adopt(std::move(tables), document);
}

template <class Description>
Document<Description> from_file(const std::string& path, nb::dict changes) {
    Document<Description> out;
    out.source = path;
    io::expect_kind(path, kind_of(Description{}), [&] { change(out, io::read_toml(path), changes); });
    return out;
}

template <class Description>
Document<Description> from_dict(nb::dict tables, const std::string& name) {
    Document<Description> out;
    adopt(node_of(tables, typed_in(name, --out.generation)), out);
    return out;
}

template <class Description>
void set(Document<Description>& document, nb::dict changes) {
    change(document, document.tables, changes);
}

template <class Description>
const io::TableRecord& format() {
    return io::format_of([](const io::TableReader& file) { describe(file, Description{}); });
}

template <class Description>
std::vector<io::NamedNumber> numbers(const Document<Description>& document) {
    return io::numbers_in(document.tables, format<Description>());
}

template <class Description>
nb::object get(const Document<Description>& document, const std::string& key) {
    if (const io::Node* node = io::value_at(document.tables, key)) return object_of(*node);
    const std::vector<io::NamedNumber> all = numbers(document);
    std::vector<std::string_view> names;
    for (const io::NamedNumber& one : all) {
        if (one.name == key) return nb::cast(one.value);  // left out: the default
        names.push_back(one.name);
    }
    const std::string hint = io::did_you_mean(key, names);
    throw nb::key_error(fmt::format("'{}'{}", key, hint.empty() ? "" : ": " + hint).c_str());
}

template <class Description>
nb::class_<Document<Description>> add_document(nb::module_& module, const char* name) {
    using D = Document<Description>;
    nb::class_<D> made(module, name);
    made.def_static("from_file", &from_file<Description>, "path"_a, "changes"_a = nb::dict())
        .def_static("from_dict", &from_dict<Description>, "tables"_a, "name"_a)
        .def("copy", [](const D& from) { return D(from); })
        .def("set", &set<Description>, "changes"_a, "All of them or none; as in a file.")
        .def("get", &get<Description>, "key"_a)
        .def("numbers", &numbers<Description>)
        .def("tables",
             [](const D& from) { return object_of(io::without_overridden(from.tables, format<Description>())); })
        .def_ro("source", &D::source)
        .def_prop_ro("name", [](const D& from) { return from.description.name; });
    return made;
}

}  // namespace

void add_documents(nb::module_& module) {
    nb::class_<io::NamedNumber>(module, "NamedNumber", "A number of a vehicle or a scenario, with what it may be.")
        .def_ro("name", &io::NamedNumber::name)
        .def_ro("value", &io::NamedNumber::value)
        .def_ro("unit", &io::NamedNumber::unit)
        .def_ro("min", &io::NamedNumber::min)
        .def_ro("max", &io::NamedNumber::max)
        .def_ro("min_included", &io::NamedNumber::min_included)
        .def_ro("is_whole", &io::NamedNumber::is_whole)
        .def_ro("meaning", &io::NamedNumber::meaning)
        .def_ro("is_default", &io::NamedNumber::is_default)
        .def("__repr__", [](const io::NamedNumber& n) {
            return fmt::format("NamedNumber({}={:g}{}{})", n.name, n.value, n.unit.empty() ? "" : " ", n.unit);
        });
    add_document<ScenarioDescription>(module, "ScenarioDocument")
        .def_prop_ro("vehicle", [](const ScenarioDocument& from) { return from.description.vehicle; })
        .def_prop_ro("step", [](const ScenarioDocument& from) { return from.description.solver.step; })
        .def_prop_ro("duration", [](const ScenarioDocument& from) { return from.description.duration; })
        .def_prop_ro("interval", [](const ScenarioDocument& from) { return from.description.output.interval; })
        .def_prop_ro("maneuver", [](const ScenarioDocument& from) { return from.description.maneuver.name; });
    add_document<VehicleDescription>(module, "VehicleDocument")
        .def_prop_ro("wheels",
                     [](const VehicleDocument& from) {
                         std::vector<std::string> names;
                         for_each_wheel(from.description,
                                        [&](const auto& wheel, std::size_t) { names.push_back(wheel.name); });
                         return names;
                     })
        .def_prop_ro("is_powered", [](const VehicleDocument& from) { return !from.description.power_units.empty(); })
        .def_prop_ro("total_mass", [](const VehicleDocument& from) { return total_mass(from.description); })
        .def("channels", [](const VehicleDocument& from) { return described(all_channels(from.description)); })
        .def(
            "scene", [](const VehicleDocument& from) { return scene_json(from.description, {}); },
            "What the vehicle looks like at design, as JSON.");
}

}  // namespace hamilcar::python
