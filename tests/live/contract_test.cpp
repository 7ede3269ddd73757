// What passes between program and page is what schemas/page.schema.json says, from which the page's side is generated.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "hamilcar/io/vehicle_file.hpp"
#include "hamilcar/live/messages.hpp"
#include "hamilcar/road/tile.hpp"
#include "live/test_catalog.hpp"
#include "support/fleet.hpp"
#include "support/json_schema.hpp"

namespace hamilcar::live {
namespace {

using nlohmann::json;

const test::PageSchema& schema() {
    static const test::PageSchema read;
    return read;
}

std::string mistake(const std::string& message) {
    return schema().mistake(json::parse(message), "server_message");
}

TEST(Contract, HoldsForTheGreetingTheStatusAndARefusal) {
    EXPECT_EQ(mistake(hello_message(2, test_catalog())), "");
    for (const Pause pause : {Pause::none, Pause::driver, Pause::no_driver, Pause::ended}) {
        EXPECT_EQ(mistake(status_message({1, 2}, {.paused = pause, .ended = "why"}, {"f.nc", 1.5, 0}, {"abs"}, 9)), "");
    }
    EXPECT_EQ(mistake(refusal_message("no \xff")), "");
    EXPECT_NE(mistake(R"({"type":"refusal"})"), "");
    EXPECT_NE(mistake(R"({"type":"refusal","message":"a","more":1})"), "");
}

class ContractOfACar : public testing::TestWithParam<std::string> {};

TEST_P(ContractOfACar, HoldsForItsMessageOnEveryKindOfRoad) {
    for (const char* road : {"flat", "waves", "gates"}) {
        const Catalog catalog = test_catalog();
        const LoadRequest request{GetParam(), road, 0.8};
        const auto scenario = catalog.open({"car", road, 1}).second;
        const LiveSimulation simulation(3, request, test::shipped(GetParam()), scenario,
                                        catalog.course(road, test::paper_car()));
        EXPECT_EQ(mistake(car_message(simulation)), "") << road;
    }
}

INSTANTIATE_TEST_SUITE_P(Fleet, ContractOfACar, testing::ValuesIn(test::fleet()),
                         [](const auto& named) { return named.param; });

TEST(Contract, HoldsForResultsOfACourseDrivenAndNotDriven) {
    EXPECT_EQ(mistake(result_message(gates(), {})), "");
    CourseRun run;
    run.entered = run.over = run.finished = true;
    run.time = 12, run.samples = 2;
    EXPECT_EQ(mistake(result_message(gates(), run)), "");
}

TEST(Contract, StatesTheSizesOfBinaryMessages) {
    EXPECT_EQ(schema().constant("tile_size"), tile_size);
    EXPECT_EQ(schema().constant("tile_nodes"), tile_nodes);
    const std::string frame = frame_message(5, {});
    EXPECT_EQ(static_cast<double>(frame.size()), schema().constant("frame_header"));
    EXPECT_EQ(frame[0], schema().constant("frame_kind"));
    const std::string tile = tile_message(5, {});
    EXPECT_EQ(static_cast<double>(tile.size()), schema().constant("tile_header"));
    EXPECT_EQ(tile[0], schema().constant("tile_kind"));
}

// A value that the schema of a scalar accepts, at one of its ends.
json sample(const json& field, bool high) {
    if (field.contains("$ref")) return sample(schema().definition(field["$ref"].get<std::string>().substr(8)), high);
    if (field.contains("const")) return field["const"];
    if (field.contains("enum")) return high ? field["enum"].back() : field["enum"].front();
    if (field["type"] == "string") return "a";
    if (field["type"] == "boolean") return false;
    return high ? field["maximum"] : field["minimum"];
}

bool accepted(const json& message) {
    return std::holds_alternative<ClientMessage>(read_message(message.dump()));
}

TEST(Contract, IsWhatTheProgramAcceptsOfAPage) {
    for (const json& choice : schema().definition("client_message")["oneOf"]) {
        const json& type = schema().definition(choice["$ref"].get<std::string>().substr(8));
        for (const bool high : {false, true}) {
            json message;
            for (const auto& [name, field] : type["properties"].items()) message[name] = sample(field, high);
            EXPECT_TRUE(accepted(message)) << message;
            for (const json& name : type["required"]) {
                json less = message;
                less.erase(name.get<std::string>());
                EXPECT_FALSE(accepted(less)) << less;
            }
            for (const auto& [name, field] : type["properties"].items()) {
                if (!field.contains("minimum")) continue;
                json beyond = message;
                beyond[name] = high ? field["maximum"].get<double>() + 1 : field["minimum"].get<double>() - 1;
                EXPECT_FALSE(accepted(beyond)) << beyond;
            }
        }
    }
}

}  // namespace
}  // namespace hamilcar::live
