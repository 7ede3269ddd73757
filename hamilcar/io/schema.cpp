#include "hamilcar/io/schema.hpp"

#include <map>

#include "hamilcar/io/key_schema.hpp"
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

constexpr std::size_t worth_sharing = 1000;  // of a schema's text [characters]

void count(const Json& json, std::map<std::string, int>& places) {
    if (json.is_primitive()) return;
    const std::string text = json.dump();
    if (text.size() < worth_sharing || (json.is_object() && ++places[text] > 1)) return;
    for (const Json& inner : json) count(inner, places);
}

// Schemas that stand at several places, such as that of an axle of the motor vehicle or of a trailer, become
// references.
Json shared(const Json& json, const std::string& name, const std::map<std::string, int>& places, Json& definitions) {
    if (json.is_primitive()) return json;
    const auto found = json.is_object() ? places.find(json.dump()) : places.end();
    if (found != places.end() && found->second > 1) {
        std::string id = name;
        while (definitions.contains(id) && definitions[id] != json) id += "_";
        definitions[id] = json;
        return {{"$ref", "#/definitions/" + id}};
    }
    Json out = json;
    for (auto& [key, inner] : out.items()) {
        const bool is_name = json.is_object() && key != "items";
        inner = shared(inner, is_name ? key : name, places, definitions);
    }
    return out;
}

}  // namespace

// A file with a base may leave out whatever the base has, so only the names and the values of its keys can be judged.
std::string schema_of(const std::string& title, const std::function<void(const TableReader&)>& read) {
    const TableRecord file = record_keys(read);
    Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
    schema.update(table_schema(file));
    schema["properties"]["base"] = {{"type", "string"},
                                    {"minLength", 1},
                                    {"description", "another such file, relative to this one, to start from"}};
    schema["if"] = {{"not", {{"required", {"base"}}}}};
    schema["then"] = requirements(file);
    std::map<std::string, int> places;
    count(schema, places);
    Json definitions = Json::object();
    schema = shared(schema, "file", places, definitions);
    if (!definitions.empty()) schema["definitions"] = definitions;
    return written(schema, "") + "\n";
}

std::string vehicle_schema() {
    return schema_of("Hamilcar vehicle", [](const TableReader& file) { read_vehicle(file); });
}

std::string scenario_schema() {
    return schema_of("Hamilcar scenario", [](const TableReader& file) { read_scenario(file); });
}

}  // namespace hamilcar::io
