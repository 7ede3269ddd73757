// Holds JSON against schemas/page.schema.json, as far as that schema goes: the words below and no others.
#pragma once

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "support/paths.hpp"

namespace hamilcar::test {

class PageSchema {
public:
    PageSchema() : root_(nlohmann::json::parse(std::ifstream(source_path("schemas/page.schema.json")))) {}

    const nlohmann::json& definition(const std::string& name) const { return root_.at("$defs").at(name); }
    double constant(const std::string& name) const { return definition("constants")["properties"][name]["const"]; }

    // What is wrong with the value as a `definition`, with its place in it; "" where nothing is.
    std::string mistake(const nlohmann::json& value, const std::string& name) const {
        return mistake(value, definition(name), name);
    }

private:
    using json = nlohmann::json;

    std::string mistake(const json& value, const json& schema, const std::string& place) const {
        if (schema.contains("$ref")) {
            return mistake(value, root_.at(json::json_pointer(schema["$ref"].get<std::string>().substr(1))), place);
        }
        if (schema.contains("oneOf")) return mistake_in_choice(value, schema["oneOf"], place);
        if (schema.contains("const")) return value == schema["const"] ? "" : place + ": not " + schema["const"].dump();
        if (schema.contains("enum")) {
            const bool known = std::ranges::find(schema["enum"], value) != schema["enum"].end();
            return known ? "" : place + ": unknown " + value.dump();
        }
        if (!is_of(value, schema["type"]))
            return place + ": " + value.dump().substr(0, 80) + " is no " + schema["type"].dump();
        if (value.is_object()) return mistake_in_object(value, schema, place);
        if (value.is_array()) return mistake_in_array(value, schema, place);
        if (value.is_number() && value < schema.value("minimum", value)) return place + ": below the minimum";
        if (value.is_number() && value > schema.value("maximum", value)) return place + ": above the maximum";
        return "";
    }

    std::string mistake_in_choice(const json& value, const json& choices, const std::string& place) const {
        std::string all;
        for (const json& choice : choices) {
            const std::string one = mistake(value, choice, place);
            if (one.empty()) return "";
            all += "\n  " + one;
        }
        return place + ": none of" + all;
    }

    std::string mistake_in_object(const json& value, const json& schema, const std::string& place) const {
        for (const json& key : schema["required"]) {
            if (!value.contains(key)) return place + ": no " + key.dump();
        }
        for (const auto& [key, part] : value.items()) {
            if (!schema["properties"].contains(key)) return place + ": unknown key " + key;
            const std::string one = mistake(part, schema["properties"][key], place + "." + key);
            if (!one.empty()) return one;
        }
        return "";
    }

    std::string mistake_in_array(const json& value, const json& schema, const std::string& place) const {
        if (value.size() < schema.value("minItems", 0u) || value.size() > schema.value("maxItems", ~0u)) {
            return place + ": wrong length";
        }
        for (std::size_t i = 0; i < value.size(); ++i) {
            const std::string one = mistake(value[i], schema["items"], place + "[" + std::to_string(i) + "]");
            if (!one.empty()) return one;
        }
        return "";
    }

    static bool is_of(const json& value, const json& type) {
        if (type.is_array()) return std::ranges::any_of(type, [&](const json& one) { return is_of(value, one); });
        const std::string& word = type.get_ref<const std::string&>();
        return (word == "object" && value.is_object()) || (word == "array" && value.is_array()) ||
               (word == "string" && value.is_string()) || (word == "boolean" && value.is_boolean()) ||
               (word == "null" && value.is_null()) || (word == "number" && value.is_number()) ||
               (word == "integer" && value.is_number_integer());
    }

    json root_;
};

}  // namespace hamilcar::test
