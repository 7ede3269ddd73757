// The schemas in schemas/ are those of the readers; the survey finds what depends on what in small readers whose schemas can
// be written down by hand.
#include "hamilcar/io/schema.hpp"

#include <gtest/gtest.h>

#include "files.hpp"
#include "hamilcar/io/key_schema.hpp"

namespace hamilcar::io {
namespace {

Json written(const char* text) {
    return Json::parse(text);
}

// Whether every key below a table of a file stands in the schema of that table.
void expect_known(const Node& node, const Json& root, const Json& at, const std::string& path) {
    const Json& schema =
        at.contains("$ref") ? root.at(Json::json_pointer(at["$ref"].get<std::string>().substr(1))) : at;
    if (const auto* list = std::get_if<ListValue>(&node.value)) {
        if (!schema.contains("items")) return;
        for (const Node& item : list->items) expect_known(item, root, schema["items"], path + "[]");
    } else if (const auto* table = std::get_if<TableValue>(&node.value)) {
        for (const Node& entry : table->entries) {
            const bool listed = schema["properties"].contains(entry.key);
            const Json& below = listed ? schema["properties"][entry.key] : schema["additionalProperties"];
            EXPECT_TRUE(below.is_object()) << path << "." << entry.key;
            if (below.is_object()) expect_known(entry, root, below, path + "." + entry.key);
        }
    }
}

TEST(Schema, CommittedFilesAreThoseOfTheProgram) {
    EXPECT_EQ(read_file(repository_path("schemas/vehicle.schema.json")), vehicle_schema())
        << "run `hamilcar schema vehicle -o schemas/vehicle.schema.json`";
    EXPECT_EQ(read_file(repository_path("schemas/scenario.schema.json")), scenario_schema())
        << "run `hamilcar schema scenario -o schemas/scenario.schema.json`";
}

TEST(Schema, KnowsEveryKeyOfTheShippedFiles) {
    for (const std::string kind : {"vehicle", "scenario", "study"}) {
        const Json schema = Json::parse(read_file(repository_path("schemas/" + kind + ".schema.json")));
        for (const auto& file :
             std::filesystem::directory_iterator(repository_path(kind == "study" ? "studies" : kind + "s"))) {
            if (file.path().extension() != ".toml") continue;
            expect_known(read_toml(file.path().string()), schema, schema, file.path().filename().string());
        }
    }
}

TEST(KeyRecord, KeysHaveTheirRangeUnitAndDefault) {
    const TableRecord file = record_keys([](const TableReader& table) {
        table.number("mass_kg", positive);
        table.number("angle_deg", Range{"number from -45 to 45", -45, 45}, M_PI / 180);
        table.number("spacing_m", positive, 0);  // "none" is not a distance
        table.array<2>("at_m");
        table.text("title");
    });
    EXPECT_EQ(table_schema(file), written(R"({"type": "object", "properties": {
        "mass_kg": {"type": "number", "exclusiveMinimum": 0.0, "description": "a positive number [kg]"},
        "angle_deg": {"type": "number", "minimum": -45.0, "maximum": 45.0,
                      "description": "a number from -45 to 45 [deg]", "default": 1.0},
        "spacing_m": {"type": "number", "exclusiveMinimum": 0.0, "description": "a positive number [m]"},
        "at_m": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2,
                 "description": "2 numbers [m]"},
        "title": {"type": "string", "minLength": 1, "description": "a text in quotes"}},
        "additionalProperties": false})"));
    EXPECT_EQ(requirements(file), written(R"({"required": ["mass_kg", "at_m", "title"]})"));
}

TEST(KeyRecord, AWordDecidesWhichKeysBelongToIt) {
    constexpr std::string_view words[] = {"round", "square"};
    const TableRecord file = record_keys([&](const TableReader& table) {
        table.choose("shape", words, {},
                     [&](std::size_t shape) { table.number(shape == 0 ? "radius_m" : "side_m", any_number); });
    });
    EXPECT_EQ(requirements(file), written(R"({"required": ["shape"], "allOf": [
        {"if": {"required": ["shape"], "properties": {"shape": {"const": "round"}}},
         "then": {"required": ["radius_m"], "properties": {"shape": {}, "radius_m": {}}, "additionalProperties": false}},
        {"if": {"required": ["shape"], "properties": {"shape": {"const": "square"}}},
         "then": {"required": ["side_m"], "properties": {"shape": {}, "side_m": {}}, "additionalProperties": false}}]})"));
}

// As a steered solid axle wants a beam: only of one kind, and the flag stands in another table.
TEST(KeyRecord, AFlagMayDecideWithinAWordAboutTheTableBesideIt) {
    constexpr std::string_view words[] = {"solid", "independent"};
    const TableRecord file = record_keys([&](const TableReader& table) {
        table.choose("kind", words, {}, [&](std::size_t kind) {
            table.table("points").choose_flag("steered", false, table, [&](bool steered) {
                if (kind == 0 && steered) table.table("beam").number("mass_kg", any_number);
            });
        });
    });
    EXPECT_EQ(requirements(file), written(R"({"required": ["kind", "points"], "allOf": [
        {"if": {"required": ["kind"], "properties": {"kind": {"const": "solid"}}},
         "then": {"allOf": [
            {"if": {"properties": {"points": {"properties": {"steered": {"const": false}}}}},
             "then": {"properties": {"kind": {}, "points": {}}, "additionalProperties": false}},
            {"if": {"required": ["points"],
                    "properties": {"points": {"required": ["steered"], "properties": {"steered": {"const": true}}}}},
             "then": {"required": ["beam"], "properties": {"beam": {"required": ["mass_kg"]}}}}]}},
        {"if": {"required": ["kind"], "properties": {"kind": {"const": "independent"}}},
         "then": {"properties": {"kind": {}, "points": {}}, "additionalProperties": false}}]})"));
}

TEST(KeyRecord, OneOfSeveralWaysToSayTheSame) {
    const TableRecord file = record_keys([](const TableReader& table) {
        table.choose({{"area"}, {"width", "height"}}, [&](std::size_t group) {
            if (group == 0) return static_cast<void>(table.number("area", positive));
            table.number("width", positive), table.number("height", positive);
        });
    });
    EXPECT_EQ(requirements(file), written(R"({
        "if": {"anyOf": [{"required": ["width"]}, {"required": ["height"]}]},
        "then": {"required": ["width", "height"], "properties": {"width": {}, "height": {}},
                 "additionalProperties": false},
        "else": {"required": ["area"], "properties": {"area": {}}, "additionalProperties": false}})"));
}

TEST(KeyRecord, AnOptionalTableIsNotRequiredButItsKeysAre) {
    const TableRecord file = record_keys([](const TableReader& table) {
        if (const auto brake = table.optional_table("brake")) brake->number("torque_N_m", positive);
    });
    EXPECT_EQ(requirements(file), written(R"({"properties": {"brake": {"required": ["torque_N_m"]}}})"));
}

TEST(KeyRecord, TablesOfAnyNameAndTheirNamesElsewhere) {
    const TableRecord file = record_keys([](const TableReader& table) {
        std::vector<std::string_view> names;
        const auto tires = table.named_tables("tire");
        for (const auto& [name, tire] : tires) names.push_back(name), tire.number("radius_m", positive);
        for (const TableReader& axle : table.tables("axle")) axle.one_of("tire", names);
    });
    const Json schema = table_schema(file);
    EXPECT_EQ(schema["properties"]["tire"]["additionalProperties"]["properties"].size(), 1u);
    EXPECT_EQ(schema["properties"]["axle"]["items"]["properties"]["tire"],
              written(R"({"type": "string", "minLength": 1, "description": "a name from this file"})"));
    EXPECT_EQ(requirements(file), written(R"({"required": ["tire", "axle"], "properties": {
        "tire": {"minProperties": 1, "additionalProperties": {"required": ["radius_m"]}},
        "axle": {"items": {"required": ["tire"]}}}})"));
}

TEST(KeyRecord, WhatEveryBranchReadsBelongsToTheTable) {
    constexpr std::string_view words[] = {"round", "square"};
    const TableRecord file = record_keys([&](const TableReader& table) {
        table.choose("shape", words, 0, [&](std::size_t) {
            table.number("mass_kg", positive);
            if (const auto spring = table.optional_table("spring")) spring->number("rate", positive);
        });
    });
    EXPECT_EQ(requirements(file),
              written(R"({"required": ["mass_kg"], "properties": {"spring": {"required": ["rate"]}}})"));
}

// Two choices in one table leave each other's keys alone.
TEST(KeyRecord, ChoicesBesideEachOtherAllowWhatTheOtherReads) {
    constexpr std::string_view words[] = {"one", "two"};
    const TableRecord file = record_keys([&](const TableReader& table) {
        for (const std::string word : {"a", "b"}) {
            table.choose(word, words, {}, [&](std::size_t i) {
                if (i == 1) table.number("of_" + word, any_number);
            });
        }
    });
    const Json first = requirements(file)["allOf"][0];
    EXPECT_EQ(first["if"], written(R"({"required": ["a"], "properties": {"a": {"const": "one"}}})"));
    EXPECT_EQ(first["then"],
              written(R"({"properties": {"a": {}, "b": {}, "of_b": {}}, "additionalProperties": false})"));
}

}  // namespace
}  // namespace hamilcar::io
