// A catalog for tests, and helpers for asynchronous conditions.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "hamilcar/io/error.hpp"
#include "hamilcar/live/session.hpp"
#include "support/car.hpp"

namespace hamilcar::live {

// A lane of 4 m along x, from 0 to 20 m, with cones at its corners.
inline TestCourse gates() {
    return {.id = "gates",
            .name = "Test 1",
            .title = "Gates",
            .course = {.cones = {{0, 2}, {0, -2}, {20, 2}, {20, -2}},
                       .boundaries = {{{0, 2}, {20, 2}}, {{20, -2}, {0, -2}}},
                       .line = {{-30, 0}, {50, 0}}}};
}

// "car" is the 323i on the paper's tires, "aided" has an anti-lock system, traction control and stability control, "wreck" a file that cannot be read; "waves" is an uneven road, "drop" ends a run
// within a second, "gates" has the lane above as a course.
inline Catalog test_catalog() {
    return {
        .vehicles = {{"car", "A car"}, {"aided", "A car with aids"}, {"wreck", "None"}},
        .roads = {{"flat", "Flat"}, {"waves", "Waves"}, {"drop", "From 4 m"}, {"gates", "Gates", true}},
        .open =
            [](const LoadRequest& request) {
                if (request.vehicle == "wreck") throw io::Error(io::ExitCode::bad_file, "wreck.toml: no wheels");
                VehicleDescription car = request.vehicle == "aided"
                                             ? io::read_vehicle(test::source_path("vehicles/bmw_e90_330i.toml"))
                                             : test::paper_car();
                ScenarioDescription scenario = test::scenario(1);
                if (request.road == "waves") scenario.road.waves = {{.amplitude = 0.02, .wavelength = 3}};
                if (request.road == "drop") {
                    car = io::read_vehicle(test::source_path("vehicles/formula.toml"));
                    for (SuspensionDescription& suspension : car.suspensions) {
                        for (SuspensionWheelDescription& wheel : suspension.wheels) wheel.bump = wheel.rebound = {};
                    }
                    scenario.initial.settle = false, scenario.initial.height = 4;
                }
                return std::pair(car, scenario);
            },
        .course = [](const std::string& road,
                     const VehicleDescription&) { return road == "gates" ? std::optional(gates()) : std::nullopt; }};
}

inline std::string scratch_folder() {
    static std::atomic<int> number{0};
    const auto path = std::filesystem::temp_directory_path() /
                      ("hamilcar_live_" + std::to_string(getpid()) + "_" + std::to_string(number++));
    std::filesystem::remove_all(path);
    return path.string();
}

// Waits up to half a minute for a condition, in case the machine is busy.
inline bool becomes_true(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (std::chrono::steady_clock::now() < end) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
}

}  // namespace hamilcar::live
