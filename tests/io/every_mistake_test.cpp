// All mistakes of a file come in one message, and who compares a file with its format agrees with who reads it.
#include "hamilcar/io/every_mistake.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "files.hpp"
#include "hamilcar/io/key_record.hpp"
#include "hamilcar/io/scenario_file.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace hamilcar::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const TableRecord& vehicle_format() {
    static const TableRecord format = record_keys([](const TableReader& file) { read_vehicle(file); });
    return format;
}
const TableRecord& scenario_format() {
    static const TableRecord format = record_keys([](const TableReader& file) { read_scenario(file); });
    return format;
}

std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

TEST(EveryMistake, OfAVehicleIsToldUnknownKeysFirst) {
    const TemporaryFolder folder;
    std::string text = changed(shipped_car_text(), "mass_kg = 1002.0", "mass = 1002.0\ncolor = 'red'");
    text = changed(text, "rate_N_per_m = 26200.0", "rate_N_per_m = -1 ");
    text = changed(text, "suspension = \"macpherson\"", "suspension = \"macfersen\"");
    text = changed(text, "rack_travel_m", "# rack_travel_m");
    const std::string path = folder.write("car.toml", text);
    EXPECT_THAT(
        lines_of(message_of([&] { read_vehicle(path); })),
        ElementsAre("5 mistakes",
                    path + ":" + position_in(text, "mass = 1002") +
                        ": key 'chassis.mass' = 1002.0 is unknown: did you mean 'mass_kg', a positive number [kg]?",
                    StartsWith(path + ":" + position_in(text, "color") +
                               ": key 'chassis.color' = 'red' is unknown: expected '"),
                    path + ":" + position_in(text, "[steering]") +
                        ": key 'steering.rack_travel_m' is missing: expected a positive number [m]",
                    StartsWith(path + ":" + position_in(text, "\"macfersen\"") +
                               ": key 'axle[front].suspension' = \"macfersen\": expected one of '"),
                    path + ":" + position_in(text, "-1 ") +
                        ": key 'axle[front].spring.rate_N_per_m' = -1: expected a positive number [N/m]"));
}

TEST(EveryMistake, OfAScenarioIsTold) {
    const TemporaryFolder folder;
    const std::string text =
        "name = \"x\"\nvehicle = \"car.toml\"\n[solver]\nstep = 0.001\nintegrator = \"rk5\"\n"
        "[inputs.brake]\ntime_s = [0, 1]\ncommand = [0, 2]\n[outputs]\n";
    const std::vector<std::string> lines = lines_of(message_of([&] { read_scenario(folder.write("run.toml", text)); }));
    ASSERT_EQ(lines.size(), 6u) << testing::PrintToString(lines);
    EXPECT_THAT(lines[1], HasSubstr("'solver.step' = 0.001 is unknown: did you mean 'step_s'"));
    EXPECT_THAT(lines[2], HasSubstr("'outputs' = a table is unknown: did you mean 'output'"));
    EXPECT_THAT(lines[3], HasSubstr("'duration_s' is missing: expected a positive number [s]"));
    EXPECT_THAT(lines[4], HasSubstr("'solver.integrator' = \"rk5\": expected one of 'ab1'"));
    EXPECT_THAT(lines[5], HasSubstr("'inputs.brake.command[1]' = 2: expected a number from 0 to 1"));
}

TEST(EveryMistake, AloneIsToldAsTheReaderTellsIt) {
    const TemporaryFolder folder;
    const std::string path = folder.write("car.toml", changed(shipped_car_text(), "mass_kg = 1002.0", "mass_kg = -3"));
    EXPECT_THAT(message_of([&] { read_vehicle(path); }),
                testing::EndsWith(": key 'chassis.mass_kg' = -3: expected a positive number [kg]"));
}

TEST(EveryMistake, AreAtMostTwentyInAMessage) {
    const TemporaryFolder folder;
    std::string wrong;
    for (int i = 0; i < 30; ++i) wrong += "nonsense_" + std::to_string(i) + " = 1\n";
    const auto lines =
        lines_of(message_of([&] { read_vehicle(folder.write("car.toml", wrong + shipped_car_text())); }));
    ASSERT_EQ(lines.size(), 22u);
    EXPECT_EQ(lines.front(), "30 mistakes");
    EXPECT_EQ(lines.back(), "and 10 more");
}

// As many as fit in a file: who looks for all of them would read the file once for each.
TEST(EveryMistake, OfAFileThatIsSomethingElseAreNotAllLookedFor) {
    const TemporaryFolder folder;
    std::string wrong;
    for (int i = 0; wrong.size() < 3'900'000; ++i) wrong += "k" + std::to_string(i) + " = 1\n";
    const std::string message = message_of([&] { read_vehicle(folder.write("car.toml", wrong)); });
    EXPECT_THAT(message, testing::MatchesRegex("10[01] mistakes or more\n.*"));
    EXPECT_LT(message.size(), 20'000u);
}

std::vector<std::string> shipped(const char* folder) {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(repository_path(folder))) {
        if (entry.path().extension() == ".toml") out.push_back(entry.path());
    }
    return out;
}

TEST(EveryMistake, AreNoneInWhatIsShipped) {
    for (const std::string& path : shipped("vehicles")) {
        EXPECT_THAT(mistakes_of(read_toml(path), vehicle_format()), IsEmpty()) << path;
    }
    for (const std::string& path : shipped("scenarios")) {
        Node document = read_toml(path);
        read_scenario(document);
        EXPECT_THAT(mistakes_of(document, scenario_format()), IsEmpty()) << path;
    }
}

// Calls f with every table of a document that a file may hold.
void for_each_table(Node& node, const std::function<void(Node&)>& f) {
    if (std::holds_alternative<TableValue>(node.value)) f(node);
    if (auto* table = std::get_if<TableValue>(&node.value)) {
        for (Node& entry : table->entries) for_each_table(entry, f);
    } else if (auto* list = std::get_if<ListValue>(&node.value)) {
        for (Node& item : list->items) for_each_table(item, f);
    }
}

// Takes every key out of a file, one after the other: what the reader still takes has no mistake, and where the reader misses a
// key, so does the comparison.
TEST(EveryMistake, AgreesWithTheReaderWhicheverKeyIsTakenOut) {
    // Only together with other values are these needed, which the reader alone knows.
    const std::set<std::string> wanted_by_others{"outputs", "upshift_rpm", "downshift_closed_rpm", "drive_share"};
    int refused = 0, missed = 0;
    for (const char* name : {"vehicles/pickup.toml", "vehicles/truck_semitrailer.toml", "vehicles/formula.toml"}) {
        const Node whole = read_toml(repository_path(name));
        Node counted = whole;
        std::size_t tables = 0;
        for_each_table(counted, [&](Node&) { ++tables; });
        for (std::size_t t = 0; t < tables; ++t) {
            for (std::size_t k = 0;; ++k) {
                Node document = whole;
                std::string taken;
                std::size_t at = 0;
                for_each_table(document, [&](Node& table) {
                    auto& entries = std::get<TableValue>(table.value).entries;
                    if (at++ != t || k >= entries.size()) return;
                    taken = entries[k].key;
                    entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(k));
                });
                if (taken.empty()) break;
                const auto found = mistakes_of(document, vehicle_format());
                const std::string message = message_of([&] { read_vehicle(TableReader(document, "")); });
                if (message.empty()) {
                    EXPECT_THAT(found, IsEmpty()) << name << ", without " << taken;
                }
                if (message.find("is missing") == std::string::npos || wanted_by_others.contains(taken)) continue;
                ++refused;
                if (found.empty()) ++missed, ADD_FAILURE() << name << ", without " << taken << ": " << message;
            }
        }
    }
    EXPECT_GT(refused, 100);
    EXPECT_EQ(missed, 0);
}

}  // namespace
}  // namespace hamilcar::io
