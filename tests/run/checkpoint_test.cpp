// Going on from a file, in a simulation that was made anew, to the same bits.
#include "hamilcar/run/checkpoint.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "hamilcar/io/error.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

class Checkpoint : public testing::Test {
protected:
    Checkpoint()
        : folder_(std::filesystem::temp_directory_path() / ("hamilcar_checkpoint_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }
    ~Checkpoint() override { std::filesystem::remove_all(folder_); }
    std::string path(const char* name = "state") const { return (folder_ / name).string(); }

private:
    std::filesystem::path folder_;
};

// A driver on a bent path who shifts and holds a speed.
ScenarioDescription driven() {
    ScenarioDescription s = test::scenario(6, 8);
    s.driver.steering.emplace();
    s.driver.steering->path.points = {{0, 0}, {40, 0}, {80, 6}, {140, 6}, {200, 0}};
    s.driver.speed.emplace();
    s.driver.speed->speed = {{0, 6}, {8, 20}, Interpolation::linear};
    s.driver.shifting.emplace();
    return s;
}

void expect_same(const Simulation& a, const Simulation& b) {
    ASSERT_EQ(a.steps_taken(), b.steps_taken());
    for (int i = 0; i < a.model().vehicle.state_size; ++i) {
        const auto k = static_cast<std::size_t>(i);
        ASSERT_EQ(a.state().values[k], b.state().values[k]) << i;
    }
}

TEST_F(Checkpoint, GoesOnToTheSameBitsWithADriver) {
    for (const char* method : {"ab3", "rk4", "dopri5"}) {
        ScenarioDescription s = driven();
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
    Simulation car(test::shipped_car(), driven());
    Progressed so_far;
    so_far.summary.worst_opening = 1e-9, so_far.summary.largest_kinetic_energy = 5e4;
    so_far.x = {1, 2, 3}, so_far.y = {4, 5, 6};
    write_checkpoint(path(), car, so_far);
    const Progressed read = read_checkpoint(path(), car);
    EXPECT_EQ(read.summary.worst_opening, 1e-9);
    EXPECT_EQ(read.summary.largest_kinetic_energy, 5e4);
    EXPECT_EQ(read.y, so_far.y);
    EXPECT_FALSE(std::filesystem::exists(path() + ".part"));
}

TEST_F(Checkpoint, IsRefusedForAnotherCarScenarioOrFile) {
    Simulation car(test::shipped_car(), driven());
    for (int i = 0; i < 100; ++i) ASSERT_FALSE(car.advance());
    write_checkpoint(path(), car, {});
    VehicleDescription stiffer = test::shipped_car();
    stiffer.corners[0].spring.rate *= 1.001;
    ScenarioDescription finer = driven(), slippery = driven();
    finer.solver.step = 5e-4, slippery.road.friction = 0.9;
    for (Simulation other : {Simulation(stiffer, driven()), Simulation(test::shipped_car(), finer),
                             Simulation(test::shipped_car(), slippery)}) {
        EXPECT_THROW(read_checkpoint(path(), other), io::Error);
    }
    std::filesystem::resize_file(path(), 1000);
    EXPECT_THROW(read_checkpoint(path(), car), io::Error) << "cut off";
    std::ofstream(path("text")) << "no checkpoint at all";
    EXPECT_THROW(read_checkpoint(path("text"), car), io::Error);
    EXPECT_THROW(read_checkpoint(path("missing"), car), io::Error);
    EXPECT_THROW(write_checkpoint("/nowhere/at/all", car, {}), io::Error);
}

}  // namespace
}  // namespace hamilcar
