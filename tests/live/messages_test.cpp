// Valid messages of a page, and near misses, which are refused without an exception.
#include "hamilcar/live/messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "live/test_catalog.hpp"

namespace hamilcar::live {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string good_input =
    R"({"type":"input","sequence":7,"device":"axes","steer":-0.25,"throttle":1,"brake":0,"reverse":true})";

// For a car with gears.
const std::string shifting_input =
    R"({"type":"input","sequence":8,"device":"keys","steer":0,"throttle":0,"brake":0,"reverse":false,)"
    R"("selector":"manual","gear":3,"clutch":0.5})";

std::string problem(const std::string& text) {
    const auto parsed_message = read_message(text);
    const auto* invalid = std::get_if<InvalidMessage>(&parsed_message);
    return invalid ? invalid->message : "";
}

template <class T>
T accepted(const std::string& text) {
    const auto parsed_message = read_message(text);
    EXPECT_TRUE(std::holds_alternative<ClientMessage>(parsed_message)) << text << ": " << problem(text);
    return std::get<T>(std::get<ClientMessage>(parsed_message));
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
}

TEST(ClientMessages, AreParsed) {
    const auto input = accepted<InputMessage>(good_input);
    EXPECT_EQ(input.sequence, 7u);
    EXPECT_EQ(input.controls.device, Device::axes);
    EXPECT_EQ(input.controls.steer, -0.25);
    EXPECT_EQ(input.controls.throttle, 1);
    EXPECT_EQ(input.controls.brake, 0);
    EXPECT_EQ(input.controls.selector, Selector::reverse);
    accepted<ResetMessage>(R"({"type":"reset"})");
    accepted<TakeMessage>(R"({"type":"take"})");
    EXPECT_TRUE(accepted<PauseMessage>(R"({"type":"pause","on":true})").on);
    EXPECT_EQ(accepted<PaceMessage>(R"({"type":"pace","factor":0.05})").factor, 0.05);
    EXPECT_FALSE(accepted<RecordMessage>(R"( { "on" : false, "type" : "record" } )").on);
    const auto to_switch = accepted<SwitchMessage>(R"({"type":"switch","aid":"abs","on":true})");
    EXPECT_EQ(to_switch.aid, "abs");
    EXPECT_TRUE(to_switch.on);
    const LoadRequest request =
        accepted<LoadMessage>(R"({"type":"load","vehicle":"a","road":"b","friction":1.5})").request;
    EXPECT_EQ(request.vehicle, "a");
    EXPECT_EQ(request.road, "b");
    EXPECT_EQ(request.friction, 1.5);
}

TEST(ClientMessages, ParseGearSelection) {
    const Controls manual = accepted<InputMessage>(shifting_input).controls;
    EXPECT_EQ(manual.selector, Selector::manual);
    EXPECT_EQ(manual.gear, 3);
    EXPECT_EQ(manual.clutch, 0.5);
    for (const auto& [word, selector] : {std::pair("drive", Selector::drive), {"neutral", Selector::neutral}}) {
        const std::string text = replaced(shifting_input, "manual", word);
        EXPECT_EQ(accepted<InputMessage>(text).controls.selector, selector);
    }
    const std::string back = replaced(shifting_input, "manual", "reverse");
    EXPECT_THAT(problem(back), HasSubstr("'reverse': expected the direction of the selector"));
    EXPECT_EQ(accepted<InputMessage>(replaced(back, "false", "true")).controls.selector, Selector::reverse);
    const Controls simple = accepted<InputMessage>(replaced(good_input, "true", "false")).controls;
    EXPECT_EQ(simple.selector, Selector::drive);
    EXPECT_EQ(simple.gear, 1);
    EXPECT_EQ(simple.clutch, 0);
}

TEST(ClientMessages, RequireAllGearFieldsOrNone) {
    for (const auto& [part, name] : {std::pair(R"("selector":"manual",)", "'selector'"),
                                     {R"("gear":3,)", "'gear'"},
                                     {R"(,"clutch":0.5)", "'clutch'"}}) {
        EXPECT_THAT(problem(replaced(shifting_input, part, "")), HasSubstr(name));
    }
    const std::pair<const char*, std::vector<const char*>> wrong[] = {
        {"\"manual\"", {"\"sport\"", "\"\"", "1", "null"}},
        {"\"gear\":3", {"\"gear\":0", "\"gear\":-1", "\"gear\":1.5", "\"gear\":21", "\"gear\":4294967297"}},
        {"0.5", {"-0.1", "1.1", "true", "\"0\""}}};
    for (const auto& [good, bad] : wrong) {
        for (const char* value : bad) {
            EXPECT_THAT(problem(replaced(shifting_input, good, value)), HasSubstr("expected")) << value;
        }
    }
}

TEST(ClientMessages, RejectMissingAndUnknownFields) {
    for (const char* field : {"type", "sequence", "device", "steer", "throttle", "brake", "reverse"}) {
        const std::string name = "\"" + std::string(field) + "\"";
        EXPECT_THAT(problem(replaced(good_input, name, "\"other\"")), HasSubstr("'" + std::string(field) + "'"));
        EXPECT_THAT(problem(replaced(good_input, "{", "{" + name + ":0,")), HasSubstr("duplicate key"));
    }
    EXPECT_THAT(problem(replaced(good_input, "{", "{\"horn\":0,")), HasSubstr("unknown key 'horn'"));
    EXPECT_THAT(problem(R"({"type":"pause"})"), HasSubstr("'on': expected true or false"));
    EXPECT_THAT(problem(R"({"type":"switch","on":true})"), HasSubstr("'aid': expected a string"));
    EXPECT_THAT(problem(R"({"type":"switch","aid":"abs"})"), HasSubstr("'on': expected true or false"));
    EXPECT_THAT(problem(R"({"type":"fly"})"), HasSubstr("'type'"));
    EXPECT_THAT(problem(R"({})"), HasSubstr("'type'"));
}

TEST(ClientMessages, RejectWrongTypesAndRanges) {
    const std::pair<const char*, std::vector<const char*>> wrong[] = {
        {"\"sequence\":7", {"\"sequence\":-1", "\"sequence\":1.5", "\"sequence\":4294967296", "\"sequence\":\"7\""}},
        {"\"axes\"", {"\"wheel\"", "1", "null", "\"\""}},
        {"-0.25", {"-1.001", "2", "\"0\"", "null", "true"}},
        {"\"throttle\":1", {"\"throttle\":-0.1", "\"throttle\":1.1", "\"throttle\":18446744073709551615"}},
        {"\"brake\":0", {"\"brake\":-1", "\"brake\":1e9", "\"brake\":false"}},
        {"true", {"1", "\"true\"", "null"}}};
    for (const auto& [good, bad] : wrong) {
        for (const char* value : bad)
            EXPECT_THAT(problem(replaced(good_input, good, value)), HasSubstr("expected")) << value;
    }
    for (const char* number : {"NaN", "Infinity", "1e999", "-", "+1", "0x1", "1."}) {
        EXPECT_NE(problem(replaced(good_input, "-0.25", number)), "") << number;
    }
    EXPECT_NE(problem(R"({"type":"pace","factor":0.04})"), "");
    EXPECT_NE(problem(R"({"type":"load","vehicle":"a","road":"b","friction":0})"), "");
}

TEST(ClientMessages, RejectAnythingButOneFlatObject) {
    const std::string deep(4000, '['), deeper = [] {
        std::string text;
        for (int i = 0; i < 600; ++i) text += "{\"a\":";
        return text;
    }();
    for (const std::string& text :
         {std::string(), std::string("null"), std::string("7"), std::string("\"reset\""), std::string("[]"), deep,
          deeper, good_input + good_input, good_input + "x", std::string(R"({"type":{}})"),
          std::string(R"({"type":["reset"]})"), std::string("{\"type\":\"reset\xff\"}"), std::string(4096, ' ')}) {
        EXPECT_NE(problem(text), "") << text.substr(0, 40);
    }
}

TEST(ClientMessages, SurviveRandomBytes) {
    std::mt19937 random(1);
    const std::string alphabet = "{}[]\":,.-+eE0123456789 \\utrfalsn\x80\xff";
    for (int i = 0; i < 20000; ++i) {
        std::string text = i % 2 ? good_input : std::string(random() % 60, ' ');
        const std::size_t changes = i % 2 ? 1 + random() % 4 : text.size();
        for (std::size_t k = 0; k < changes; ++k) {
            text[i % 2 ? random() % text.size() : k] = alphabet[random() % alphabet.size()];
        }
        EXPECT_NO_THROW(read_message(text));
    }
}

json parsed(const std::string& text) {
    return json::parse(text);
}

TEST(ServerMessages, DescribeDriveline) {
    const json simple = parsed(car_message(LiveSimulation(1, {"car", "flat"}, test::paper_car(), test::scenario(1))));
    EXPECT_TRUE(simple.at("driveline").is_null());
    EXPECT_TRUE(simple.at("course").is_null());
    const json shifted =
        parsed(car_message(LiveSimulation(1, {"car", "flat"}, test::shipped_car(), test::scenario(1))));
    const json& driveline = shifted.at("driveline");
    const json& unit = driveline.at("units").at(0);
    EXPECT_EQ(unit.at("name"), "engine");
    EXPECT_NEAR(unit.at("idle").get<double>(), 800, 1e-6);
    EXPECT_NEAR(unit.at("max").get<double>(), 6400, 1e-6);
    EXPECT_EQ(driveline.at("gears"), 5);
    EXPECT_EQ(driveline.at("reverse"), true);
    EXPECT_EQ(driveline.at("clutch"), true);
    EXPECT_EQ(driveline.at("automatic"), false);
    std::vector<std::string> names;
    for (const json& channel : shifted.at("channels")) names.push_back(channel.at("name"));
    for (const char* name :
         {"engine.speed", "engine.torque", "engine.throttle", "engine.gear", "engine.clutch_torque"}) {
        EXPECT_THAT(names, testing::Contains(name));
    }
}

TEST(ServerMessages, NameTheAidsButNoControllerThatIsCommandedFromOutside) {
    VehicleDescription car = test::shipped_car();
    EXPECT_EQ(parsed(car_message(LiveSimulation(1, {"car", "flat"}, car, test::scenario(1)))).at("aids"),
              json::array());
    car.controllers = {{.kind = "external"}, {.kind = "traction_control"}};
    const json aids = parsed(car_message(LiveSimulation(1, {"car", "flat"}, car, test::scenario(1)))).at("aids");
    ASSERT_EQ(aids.size(), 1u);
    EXPECT_EQ(aids.at(0).at("keyword"), "traction_control");
    EXPECT_THAT(aids.at(0).at("meaning").get<std::string>(), HasSubstr("driven wheels"));
}

TEST(ServerMessages, DescribeCourseAndResult) {
    const VehicleDescription car = test::paper_car();
    const LiveSimulation simulation(1, {"car", "gates"}, car, test::scenario(1), gates());
    const json course = parsed(car_message(simulation)).at("course");
    EXPECT_EQ(course.at("id"), "gates");
    EXPECT_EQ(course.at("name"), "Test 1");
    EXPECT_EQ(course.at("title"), "Gates");
    EXPECT_THAT(course.at("summary").get<std::string>(), HasSubstr("no cone may be hit and no boundary crossed"));
    EXPECT_EQ(course.at("cones").at(0), json::parse("[0.0, 2.0]"));
    EXPECT_EQ(course.at("boundaries").at(0), json::parse("[0.0, 2.0, 20.0, 2.0]"));
    EXPECT_EQ(course.at("line").size(), 2u);
    CourseRun run{.entered = true, .over = true, .cones = 2, .time = 3, .entry_speed = 10};
    const json failed = parsed(result_message(*simulation.course(), run));
    EXPECT_EQ(failed.at("type"), "result");
    EXPECT_EQ(failed.at("course"), "gates");
    EXPECT_EQ(failed.at("finished"), false);
    EXPECT_EQ(failed.at("passed"), false);
    EXPECT_EQ(failed.at("time"), 3.0);
    EXPECT_EQ(failed.at("values").at(0).at("name"), "entry speed");
    EXPECT_EQ(failed.at("values").at(0).at("unit"), "km/h");
    EXPECT_NEAR(failed.at("values").at(0).at("value").get<double>(), 36, 1e-9);
    EXPECT_TRUE(failed.at("values").at(1).at("value").is_null());  // the run is unfinished
    EXPECT_EQ(failed.at("verdicts").at(1),
              json::parse(R"({"criterion":"no cone is hit","passed":false,"found":"2 cones"})"));
    EXPECT_TRUE(failed.at("verdicts").at(0).at("passed").is_null());  // for the same reason
    TestCourse line = gates();
    line.course.cones.clear(), line.course.boundaries.clear();
    EXPECT_TRUE(parsed(result_message(line, run)).at("passed").is_null());
}

TEST(ServerMessages, HaveFieldsOfProtocol) {
    const LiveSimulation simulation(3, {"car", "flat", 0.8}, test::paper_car(), test::scenario(1));
    const std::string car = car_message(simulation);
    EXPECT_THAT(car, HasSubstr(R"("type":"car")"));
    EXPECT_THAT(car, HasSubstr(R"("car":3)"));
    EXPECT_THAT(car, HasSubstr(R"("friction":0.8)"));
    EXPECT_THAT(car, HasSubstr(R"("name":"chassis.position.x")"));
    EXPECT_THAT(car, HasSubstr(R"("scene":{)"));
    EXPECT_THAT(hello_message(2, test_catalog()), HasSubstr(R"("vehicles":[{"course":false,"id":"car",)"));
    EXPECT_THAT(refusal_message("a \"b\" \xff"), HasSubstr(R"("message":"a \"b\" )"));
    const std::string status =
        status_message({1, 2}, {.paused = Pause::ended, .ended = "why"}, {"f.nc", 1.5, 0}, {"abs", "esc"}, 9);
    for (const char* part : {R"("driver":1)", R"("pages":2)", R"("paused":"ended")", R"("ended":"why")", R"("pace":)",
                             R"("time":)", R"("steps":)", R"("step_ms":)", R"("period_ms":)", R"("compute_us":)",
                             R"("worst_overrun_ms":)", R"("overruns":)", R"("recording":"f.nc")", R"("recorded_s":1.5)",
                             R"("lost_rows":0)", R"("lost_frames":9)", R"("switched_off":["abs","esc"])"}) {
        EXPECT_THAT(status, HasSubstr(part));
    }
}

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
    T number;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

TEST(ServerMessages, BinaryMessagesHaveHeaders) {
    const std::string frame = frame_message(5, {.time = 1.25, .page = 2, .sequence = 77, .values = {0.5F, -3}});
    ASSERT_EQ(frame.size(), 24u + 8u);
    EXPECT_EQ(number_at<std::uint32_t>(frame, 0), 1u);
    EXPECT_EQ(number_at<std::uint32_t>(frame, 4), 5u);
    EXPECT_EQ(number_at<double>(frame, 8), 1.25);
    EXPECT_EQ(number_at<std::uint32_t>(frame, 16), 77u);
    EXPECT_EQ(number_at<std::uint32_t>(frame, 20), 2u);
    EXPECT_EQ(number_at<float>(frame, 28), -3.0F);
    const std::string tile = tile_message(5, {.ix = -1, .iy = 2, .heights = std::vector<float>(65 * 65, 0.5F)});
    ASSERT_EQ(tile.size(), 16u + 4u * 65 * 65);
    EXPECT_EQ(number_at<std::uint32_t>(tile, 0), 2u);
    EXPECT_EQ(number_at<std::int32_t>(tile, 8), -1);
    EXPECT_EQ(number_at<std::int32_t>(tile, 12), 2);
}

}  // namespace
}  // namespace hamilcar::live
