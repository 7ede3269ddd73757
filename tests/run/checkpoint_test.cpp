// Going on from a file, in a simulation that was made anew, to the same bits.
#include "hamilcar/run/checkpoint.hpp"

#include <fstream>
#include <iterator>
#include <tuple>

#include "run/checkpoint_folder.hpp"

namespace hamilcar {
namespace {

using testing::HasSubstr;

TEST_F(Checkpoint, GoesOnToTheSameBitsWithADriver) {
    for (const char* method : {"ab3", "rk4", "dopri5"}) {
        ScenarioDescription s = test::driven();
        if (!find_method(method)) continue;
        s.solver.integrator = method;
        Simulation whole(test::shipped_car(), s), first(test::shipped_car(), s);
        for (int i = 0; i < 1503; ++i) ASSERT_FALSE(first.advance());  // between two decisions
        write_checkpoint(path(), first, {});
        Simulation second(test::shipped_car(), s);
        read_checkpoint(path(), second);
        expect_same(first, second);
        test::run_to_end(whole);
        test::run_to_end(second);
        expect_same(whole, second);
    }
}

TEST_F(Checkpoint, KeepsHowTheRunWent) {
    Simulation car(test::shipped_car(), test::driven());
    for (int i = 0; i < 3; ++i) ASSERT_FALSE(car.advance());
    Progressed so_far;
    so_far.summary.max_violation = 1e-9, so_far.summary.max_kinetic_energy = 5e4;
    so_far.x = {1, 2, 3}, so_far.y = {4, 5, 6};
    write_checkpoint(path(), car, so_far);
    const Progressed read = read_checkpoint(path(), car);
    EXPECT_EQ(read.summary.max_violation, 1e-9);
    EXPECT_EQ(read.summary.max_kinetic_energy, 5e4);
    EXPECT_EQ(read.y, so_far.y);
    EXPECT_TRUE(is_alone());
}

TEST_F(Checkpoint, IsRefusedForAnotherCarOrScenario) {
    Simulation car(test::shipped_car(), test::driven());
    for (int i = 0; i < 100; ++i) ASSERT_FALSE(car.advance());
    write_checkpoint(path(), car, {}, {.vehicle = 1, .scenario = 2});
    VehicleDescription stiffer = test::shipped_car();
    stiffer.suspensions[0].springs[0].spring.rate *= 1.001;
    ScenarioDescription finer = test::driven(), slippery = test::driven(), other_method = test::driven();
    finer.solver.step = 5e-4, slippery.road.friction = 0.9, other_method.solver.integrator = "rk4";
    const Origin same{.vehicle = 1, .scenario = 2};
    for (const auto& [vehicle, scenario, what] :
         std::vector<std::tuple<VehicleDescription, ScenarioDescription, const char*>>{
             {stiffer, test::driven(), "the rates are not the same"},
             {test::shipped_car(), slippery, "the rates are not the same"},
             {test::shipped_car(), finer, "of another step (0.001 s)"},
             {test::shipped_car(), other_method, "of another method (ab3)"}}) {
        Simulation other(vehicle, scenario);
        EXPECT_THAT(message_of(path(), other, same), HasSubstr(what));
    }
    EXPECT_THAT(message_of(path(), car, {.vehicle = 3, .scenario = 2}), HasSubstr("of another vehicle"));
    EXPECT_THAT(message_of(path(), car, {.vehicle = 3, .scenario = 4}), HasSubstr("of another vehicle, scenario"));
    EXPECT_EQ(message_of(path(), car, same), "");
}

TEST_F(Checkpoint, IsRefusedWhereverItIsDamaged) {
    Simulation car(test::shipped_car(), test::driven());
    for (int i = 0; i < 100; ++i) ASSERT_FALSE(car.advance());
    write_checkpoint(path(), car, {{}, {1, 2}, {3, 4}});
    std::ifstream file(path(), std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(file), {}};
    const auto put = [&](const std::string& bytes) { std::ofstream(path("bad"), std::ios::binary) << bytes; };
    for (std::size_t i = 0; i < whole.size(); i += i < 128 ? 1 : 997) {
        for (const char damage : {'\x01', '\x80', '\xff'}) {
            std::string bytes = whole;
            bytes[i] = static_cast<char>(bytes[i] ^ damage);
            put(bytes);
            ASSERT_NE(message_of(path("bad"), car), "") << i;
        }
        put(whole.substr(0, i));
        ASSERT_NE(message_of(path("bad"), car), "") << "cut off at " << i;
    }
    put(whole + "more");
    EXPECT_THAT(message_of(path("bad"), car), HasSubstr("damaged or cut off"));
    put("no checkpoint at all");
    EXPECT_THAT(message_of(path("bad"), car), HasSubstr("expected a checkpoint"));
    put("hamilcar state 1, of an earlier layout");
    EXPECT_THAT(message_of(path("bad"), car), HasSubstr("of another version"));
    EXPECT_NE(message_of(path("missing"), car), "");
    EXPECT_NE(message_of(path("."), car), "");
    put(whole);
    EXPECT_EQ(message_of(path("bad"), car), "");
}

TEST_F(Checkpoint, TakesThePlaceOfNothingElse) {
    Simulation car(test::shipped_car(), test::driven());
    EXPECT_THROW(write_checkpoint("/nowhere/at/all", car, {}), io::Error);
    EXPECT_THROW(write_checkpoint(path("."), car, {}), io::Error);
    std::ofstream(path("scenario.toml")) << "name = \"precious\"\n";
    EXPECT_THROW(write_checkpoint(path("scenario.toml"), car, {}), io::Error);
    EXPECT_EQ(std::filesystem::file_size(path("scenario.toml")), 18u);
    EXPECT_TRUE(is_alone());
    std::ofstream(path("empty")).close();
    write_checkpoint(path("empty"), car, {});
    write_checkpoint(path("empty"), car, {});
}

}  // namespace
}  // namespace hamilcar
