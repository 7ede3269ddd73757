#include "hamilcar/io/schema.hpp"

#include "hamilcar/io/key_schema.hpp"
#include "hamilcar/io/key_survey.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace hamilcar::io {

namespace {

constexpr std::size_t line_width = 120;

// On one line what fits there, one entry a line what does not.
std::string written(const Json& json, const std::string& indent) {
    std::string line = json.dump();
    if (json.is_primitive() || indent.size() + line.size() <= line_width) return line;
    std::string out(1, line.front());
    const std::string deeper = indent + " ";
    const auto add = [&](const std::string& key, const Json& value) {
        out += (out.size() > 1 ? ",\n" : "\n") + deeper + key + written(value, deeper);
    };
    if (json.is_array()) {
        for (const Json& value : json) add("", value);
    } else {
        for (const auto& [key, value] : json.items()) add(Json(key).dump() + ": ", value);
    }
    return out + "\n" + indent + line.back();
}

// A file with a base may leave out whatever the base has, so only the names and the values of its keys can be judged.
std::string schema_of(const TableRecord& file, const std::string& title) {
    Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
    schema.update(table_schema(file));
    schema["properties"]["base"] = {{"type", "string"},
                                    {"minLength", 1},
                                    {"description", "another such file, relative to this one, to start from"}};
    schema["if"] = {{"not", {{"required", {"base"}}}}};
    schema["then"] = requirements(file);
    return written(schema, "") + "\n";
}

}  // namespace

std::string vehicle_schema() {
    return schema_of(survey_keys([](const TableReader& file) { read_vehicle(file); }), "Hamilcar vehicle");
}

std::string scenario_schema() {
    return schema_of(survey_keys([](const TableReader& file) { read_scenario(file); }), "Hamilcar scenario");
}

}  // namespace hamilcar::io
